// Look-ahead planner with trapezoidal profiles: moves are pushed one by one; planned moves are pulled in order, each
// with its entry and exit velocity.
//
//   push --> | ready: velocities final | open: velocities may still increase |
//   pull <---'                         '-- entry velocity is committed
//
// An open window ends at standstill, so the machine can always stop on its path. A backward pass from that standstill
// finds the velocities that can still be braked; a forward pass limits them to the reachable ones. The backward pass
// runs when 1.25 windows are open, not at every push. It ends where an entry velocity is limited by its junction and
// not by braking, because no earlier velocity can change. So a push costs the same for any window.
//
// Some hardware needs a minimum duration of a move (DriveConstraints::min_seconds). Shorter straight moves are merged
// with the following ones as far as the tolerance allows; a move that remains too short gets a lower velocity.
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
    /// Minimum number of moves in view behind a move when it is planned, unless the path stops before; 1 .. 1'000'000.
    int window = 1024;
    /// Constraints of the hardware; null: none. Must outlive the planner.
    const DriveConstraints* drive = nullptr;
};

/// Plans trapezoidal profiles: one planned move for each move or merged line. Allocates only in the constructor and for
/// error texts.
class LookAheadPlanner final : public TrajectoryPlanner {
  public:
    /// `start`: the current position, at standstill.
    LookAheadPlanner(const MachineLimits& limits, const Point& start, LookAheadSettings settings = {});

    Result<void> push(const Move& move) override;
    bool has_room() const override { return tail_ - head_ <= mask_; }
    void flush() override;
    bool pull(PlannedMove& planned) override;

    /// Returns the next planned move, as pull(). If none is ready, makes the velocities of the first open move final
    /// and returns it. Returns false if it has no move.
    bool pull_early(PlannedMove& planned);

    /// Returns true if the next `count` moves are whole moves as they were pushed, the path stands still before them,
    /// and behind them whatever is pushed. `path_ends`: nothing more is pushed.
    bool is_from_rest_to_rest(std::size_t count, bool path_ends) const;
    /// Pulls the next `count` moves, for which is_from_rest_to_rest() holds, as one: parts of a straight move. Its
    /// profile is that of the whole.
    void pull_as_one(std::size_t count, PlannedMove& planned);

    /// Excludes the next pushed move from merging.
    void keep_apart() { apart_ = true; }

    /// Returns the number of moves that are ready or open.
    std::size_t size() const { return tail_ - head_; }

    /// Replans the moves that were not pulled, with other feed rates. `change` gets each of them in order and sets the
    /// feed and the rapid_override of its move. Splits and merges stay as they are, so the path can still be braked
    /// after the last pulled move, whatever its exit velocity.
    void change_feeds(const std::function<void(PlannedMove&)>& change);

    /// Returns the end of the path so far.
    const Point& position() const { return position_; }

  private:
    /// Factor on velocity2 at the start of a move, from the pulse rate at the junction.
    struct Gain {
        double square = 1;    ///< the factor, 1 or more
        bool corner = false;  ///< not planned: the move before ends with the velocity of this one
        double braking = 1;   ///< as `square`, for a move that decelerates from its start
        double planned() const { return corner ? 1 : square; }
    };

    /// Data of a move for the two passes, kept apart from the rest so that it stays in the cache.
    struct Node {
        double junction;  ///< max_junction_velocity2 at the start
        double reach;     ///< change of velocity2 over the move: 2 accel length
        double cruise;    ///< highest velocity2 on the move
        double entry;     ///< velocity2 at the start from which the end of the window can be reached
        Gain gain;
        double lag;  ///< velocity lost in the delay of a new velocity: accel * late_seconds
    };

    /// Data of the last move for the next junction.
    struct Last {
        Geometry path;
        AlongPathLimits along;
        PathControl control = PathControl::exact_stop;
        double tolerance_mm = 0;
    };

    Node& node(std::uint64_t index) { return nodes_[index & mask_]; }
    PlannedMove& slot(std::uint64_t index) { return slots_[index & mask_]; }
    const PlannedMove& slot(std::uint64_t index) const { return slots_[index & mask_]; }
    void append_dwell(const Move& move);
    void append(const Move& move, const Geometry& path, const AlongPathLimits& along, double junction);
    bool merge(const Move& move, const Geometry& path);
    double min_length(const Geometry& path, const Move& move) const;
    bool is_on_the_way(const Geometry& line, double tolerance_mm) const;
    AlongPathLimits along_of(const Geometry& path, const Move& move) const;
    double junction_velocity2(const Last& before, const Geometry& path, const AlongPathLimits& along) const;
    Gain gain_of(const Last& before, const Geometry& path) const;
    Node node_of(const Geometry& path, const AlongPathLimits& along, double junction, const Gain& gain) const;
    static double braked(const Node& node, double exit);
    static double top_of(const Node& node, double ends, const PlannedMove& planned);
    static double min_exit(const Node& node, double entry);
    void backward();
    void forward(std::uint64_t until);

    PathLimits limits_;
    const DriveConstraints* drive_ = nullptr;
    std::vector<PlannedMove> slots_;
    std::vector<Node> nodes_;
    std::uint64_t mask_ = 0;
    std::uint64_t batch_ = 0;    ///< number of open moves that triggers the passes
    std::uint64_t chunk_ = 0;    ///< minimum number of moves that become ready then
    std::uint64_t head_ = 0;     ///< index of the move that is pulled next
    std::uint64_t ready_ = 0;    ///< index of the first open move
    std::uint64_t tail_ = 0;     ///< index after the last move
    std::uint64_t settled_ = 0;  ///< index of the last move whose entry velocity is final
    double committed_ = 0;       ///< entry velocity of the first open move
    std::int64_t pushed_ = 0;    ///< number of moves that were planned or are open
    Point position_;
    Last last_, before_last_;  ///< data of the last move, and of the one before it
    double min_seconds_ = 0, late_seconds_ = 0;
    std::array<double, axis_count> half_pulse_ = {};
    bool apart_ = false;
    static constexpr std::size_t max_between = 31;
    std::array<Point, max_between> between_ = {};  ///< junctions inside the last move, where moves were merged
    std::size_t between_size_ = 0;
};

/// Returns the duration of a planned move, s: a dwell, a trapezoid, or a double-S profile where it has a jerk.
double seconds_of(const PlannedMove& planned);

/// Totals over planned moves, for reports.
struct PlanSummary {
    std::int64_t moves = 0;
    std::int64_t dwells = 0;
    std::int64_t stops = 0;    ///< moves that end at standstill
    double seconds = 0;        ///< s, dwells included
    double path_mm = 0;        ///< XYZ path; moves of ABC only add nothing
    double peak_velocity = 0;  ///< mm/s, XYZ moves only

    void add(const PlannedMove& planned);
};

}  // namespace motionrack::control
