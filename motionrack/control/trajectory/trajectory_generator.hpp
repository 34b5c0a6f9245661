// Online trajectory generator: moves are pushed while the motion is sampled. It can hold, override and stop at any
// time.
//
//   push ──► | known, without velocities | planned, to standstill | executed ──► at(), advance()
//                                         ^ replanned from the current point: when more moves are known, on hold,
//                                           on other overrides
//
// Every plan ends at standstill, so the motion can always stop on its path. The plan is extended before it has to
// decelerate for that end. Each plan continues from the velocity and the acceleration of the previous one. If no
// feasible plan exists, keeps the current plan and retries a little later.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/trajectory/known_section.hpp>
#include <motionrack/control/trajectory/pending_moves.hpp>
#include <motionrack/control/trajectory/section_planner.hpp>
#include <motionrack/control/trajectory/trajectory_point.hpp>
#include <optional>
#include <vector>

namespace motionrack::control {

struct TrajectoryGeneratorSettings {
    std::size_t window =
        32'768;  ///< number of known segments before a motion starts, unless its end is known; 1 or more
};

enum class NextMotion : std::uint8_t {
    nothing,  ///< everything is executed, or feed hold, or more segments must be known first
    motion,
    dwell
};

/// Allocates only when more segments are known at once than ever before.
class TrajectoryGenerator {
  public:
    /// `start`: the current position, at standstill.
    TrajectoryGenerator(const MachineLimits& limits, const Point& start, TrajectoryGeneratorSettings settings = {});

    bool has_room() const { return builder_.has_room(); }
    /// Adds a move that starts where the last one ended. Requires has_room(). All its numbers are finite, and feed
    /// rates above 0.
    void push(const TrajectoryMove& move);
    /// Ends the path here with a standstill, unless more moves are pushed in time.
    void flush();

    /// Returns the next action. `early`: start with the known segments although more may follow.
    NextMotion next(bool early);

    // ---- motion
    /// Returns the time that can be sampled and advanced before the next call of next(), s.
    double left() const { return left_ - reach_; }
    /// Returns the time to standstill if no more moves are pushed, s.
    double seconds_to_standstill() const { return left_; }
    /// Returns the trajectory point at `seconds` from now, 0 .. left().
    TrajectoryPoint at(double seconds) const;
    /// Advances the motion by `seconds`, 0 .. left().
    void advance(double seconds);

    // ---- dwell
    /// Returns the remaining time of the dwell, s.
    double dwell_seconds() const { return now_.rest.seconds - dwelt_; }
    /// Advances the dwell by `seconds`, 0 .. dwell_seconds().
    void advance_dwell(double seconds) { dwelt_ += seconds; }

    // ---- overrides and feed hold
    /// Sets the feed override and the rapid override (share of the axes' maximum velocities): above 0. They take effect
    /// as soon as the limits allow.
    void set_overrides(double feed, double rapid);
    /// Decelerates to a stop on the path as soon as the limits allow; next() then returns nothing until resume().
    void hold() { held_ = true; }
    void resume() { held_ = false; }
    bool is_stationary() const { return !(left_ > 0); }
    /// Returns the time until deceleration to the end of the known path begins, s.
    double seconds_to_braking() const { return left_ - braking_; }

    // ---- moves
    /// Returns the number of pushed moves.
    std::int64_t pushed() const { return moves_.pushed(); }
    /// Returns the number of the move of this point, in the order of push from 0; of merged moves, the first.
    std::int64_t move_of(const TrajectoryPoint& state) const { return moves_.number_of(state.line); }
    /// Returns the first move that is not fully executed; pushed() if all are.
    std::int64_t first_pending_move() const;
    /// Returns the number of the move of the dwell.
    std::int64_t move_of_rest() const { return moves_.number_of(now_.rest.line); }
    /// Returns a pending move as it was pushed.
    const TrajectoryMove& move(std::int64_t number) const { return moves_.move(number); }

  private:
    /// A position in now_ and the motion there.
    struct PlanCursor {
        std::size_t feed = 0, piece = 0;
        double on_feed = 0;  ///< s since the start of the profile segment
        PathMotion along;
    };

    void fetch_segments(std::size_t max_segments);
    void reserve();
    double feed_of(const KnownSection& part, std::size_t i) const;
    void set_feed(KnownSection& part, std::size_t i, double at_least = 0) const;
    void drop_passed();
    void advance_section();
    void begin();
    void update_plan(bool early);
    bool extend_plan();
    bool slow_down();
    bool apply_overrides();
    bool plan_to_end(std::size_t piece, const PathMotion& along);
    std::optional<double> find_stop(const PlanCursor& from, double above);
    KnownSection with_feeds(const PlanCursor& from, std::span<const ProfileSegment> stop) const;
    void take(const PlanCursor& from, double seconds, double to);
    void measure();
    void plan_overlap(bool early);
    void cancel_overlap();
    PlanCursor spot_at(double seconds) const;

    MachineLimits limits_;
    TrajectoryGeneratorSettings settings_;
    PathBuilder builder_;
    SectionPlanner planner_;
    KnownSection now_, then_;

    std::size_t piece_ = 0, feed_ = 0;  ///< current segment, and profile segment, in now_
    double position_ = 0;               ///< current u in now_
    double on_feed_ = 0;                ///< s since the start of the profile segment
    double left_ = 0;                   ///< s to the end of the plan
    double braking_ = 0;                ///< the last of these s, in which it decelerates to that end
    double reach_ = 0;                  ///< s before the end of now_ at which then_ starts
    StoredRamp before_;                 ///< final deceleration of the previous section
    double before_left_ = 0;            ///< remaining time of it, s
    double dwelt_ = 0;                  ///< elapsed time of the dwell at the end of now_, s
    double retry_delay_s_ = 0;          ///< delay before planning is retried, s
    bool held_ = false, holding_ = false, new_feeds_ = false, met_ = false;
    static constexpr double min_ease = 1.2;
    double ease_ = min_ease;  ///< allowed duration of a change to lower feed rates, relative to a stop
    double feed_override_ = 1, rapid_override_ = 1;

    std::vector<CubicSegment> stop_curve_;
    std::vector<SegmentTuning> stop_use_;
    PendingMoves moves_;
};

}  // namespace motionrack::control
