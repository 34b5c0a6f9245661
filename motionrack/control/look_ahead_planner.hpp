// Look-ahead: moves go in one by one, planned moves come out in order, each with the speeds at its ends.
//
//   push --> | ready: speeds final | open: speeds may still rise |
//   pull <---'                     '-- entry speed is committed
//
// An open window ends at rest, so whatever happens next the machine can stop on its path. Speeds are found backwards
// from that rest (what can still be braked), then forwards (what can be reached). The backward pass does not run at
// every push but when a quarter more than the window is open; it ends where nothing can change any more, which is where
// an entry speed is limited by its joint and not by braking. So a push costs the same for any window.
//
// Hardware asks for moves that take their time (DriveConstraints::min_seconds). Straight moves that are shorter go
// into one line with those behind them, as far as the tolerance lets them; what is left short is driven slowly.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/path_limits.hpp>
#include <motionrack/control/trajectory_planner.hpp>
#include <vector>

namespace motionrack::control {

struct LookAheadSettings {
    /// Every move is planned with at least this many moves after it in view, unless the path stands still before; 1 ..
    /// 1'000'000.
    int window = 1024;
    /// May be null; must outlive the planner.
    const DriveConstraints* drive = nullptr;
};

/// Plans trapezoids for a machine: a planned move for each move. Allocates only when it is made and for the text of an
/// error.
class LookAheadPlanner final : public TrajectoryPlanner {
  public:
    /// `start`: where the machine stands, at rest.
    LookAheadPlanner(const MachineLimits& limits, const Point& start, LookAheadSettings settings = {});

    Result<void> push(const Move& move) override;
    bool has_room() const override { return tail_ - head_ <= mask_; }
    void flush() override;
    bool pull(PlannedMove& planned) override;

    /// The same, and if none is ready the first open one with what is known: its speeds are final then. False if there
    /// is none at all.
    bool pull_early(PlannedMove& planned);

    /// The next move that is pushed stays a move of its own.
    void keep_apart() { apart_ = true; }

    /// How many moves can be pulled or are open.
    std::size_t size() const { return tail_ - head_; }

    /// Plans the moves that were not pulled once more, with other feeds: `change` gets each of them, in order, and sets
    /// the feed and the rapid_override of its move. They stay cut and merged as they are, so what could be braked
    /// before still can be, whatever the speed with which the last pulled move ends.
    void change_feeds(const std::function<void(PlannedMove&)>& change);

    /// Where the path ends so far.
    const Point& position() const { return position_; }

  private:
    /// What the two passes need of a move, apart from the rest so that they stay in the cache.
    struct Node {
        double joint;   ///< square of the greatest speed at the start
        double reach;   ///< change of the square of the speed over the move: 2 accel length
        double cruise;  ///< square of the greatest speed on the move
        double entry;   ///< square of the speed at the start from which the end of the window can be reached
        double gain;    ///< by what the square of the speed grows at the start, at once; 1 or more
        double lag;     ///< speed that could be taken off before a new one counts: accel late_seconds
    };

    /// What the next joint needs of the last move.
    struct Last {
        Geometry path;
        AlongPathLimits along;
        PathControl control = PathControl::exact_stop;
        double tolerance_mm = 0;
    };

    Node& node(std::uint64_t index) { return nodes_[index & mask_]; }
    PlannedMove& slot(std::uint64_t index) { return slots_[index & mask_]; }
    void append_dwell(const Move& move);
    void append(const Move& move, const Geometry& path, const AlongPathLimits& along, double joint);
    bool merge(const Move& move, const Geometry& path);
    double min_length(const Geometry& path, const Move& move) const;
    bool is_on_the_way(const Geometry& line, double tolerance_mm) const;
    AlongPathLimits along_of(const Geometry& path, const Move& move) const;
    double join_corner(const Last& before, const Geometry& path, const AlongPathLimits& along) const;
    double gain_of(const Last& before, const Geometry& path) const;
    Node node_of(const Geometry& path, const AlongPathLimits& along, double joint, double gain) const;
    static double braked(const Node& node, double exit);
    static double min_exit(const Node& node, double entry);
    void backward();
    void forward(std::uint64_t until);

    PathLimits limits_;
    const DriveConstraints* drive_ = nullptr;
    std::vector<PlannedMove> slots_;
    std::vector<Node> nodes_;
    std::uint64_t mask_ = 0;
    std::uint64_t batch_ = 0;    ///< so many open moves start the passes
    std::uint64_t chunk_ = 0;    ///< at least so many then become ready
    std::uint64_t head_ = 0;     ///< next to pull
    std::uint64_t ready_ = 0;    ///< first open move
    std::uint64_t tail_ = 0;     ///< one past the last move
    std::uint64_t settled_ = 0;  ///< the entry speed of this move and of all before it is final
    double committed_ = 0;       ///< entry speed of the first open move
    std::int64_t pushed_ = 0;    ///< moves that are planned or were
    Point position_;
    Last last_, before_last_;  ///< open moves
    double min_seconds_ = 0, late_seconds_ = 0;
    std::array<double, axis_count> half_pulse_ = {};
    bool apart_ = false;
    static constexpr std::size_t max_between = 31;
    std::array<Point, max_between> between_ = {};  ///< where the moves meet that the last one is made of
    std::size_t between_size_ = 0;
};

/// Seconds that a planned move takes: a dwell its seconds, a move its trapezoid, or its S-curve where it has a jerk.
double seconds_of(const PlannedMove& planned);

/// Sums over planned moves, for reports.
struct PlanSummary {
    std::int64_t moves = 0;
    std::int64_t dwells = 0;
    std::int64_t stops = 0;    ///< moves that end at rest
    double seconds = 0;        ///< all, dwells included
    double path_mm = 0;        ///< XYZ path; moves of ABC alone add nothing
    double peak_velocity = 0;  ///< mm/s, of moves of XYZ

    void add(const PlannedMove& planned);
};

}  // namespace motionrack::control
