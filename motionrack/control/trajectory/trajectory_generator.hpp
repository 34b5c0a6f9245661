// A program driven along its curve while it still comes: moves go in, the motion comes out bit by bit, and can be held,
// slowed and let go.
//
//   push ──► | known, without speeds | planned, to a rest | passed ──► at(), pass()
//                                    ^ planned anew from where the motion is: when more is known, on hold,
//                                      on other overrides
//
// What is planned always ends at rest, so that whatever happens next the motion can stop on its path. It is planned
// further before it has to slow down for that end. Each plan goes on from the speed and the acceleration of the one
// before; where none is found that keeps the limits, the one before goes on for a little, and another is sought.
#pragma once

#include <deque>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/trajectory/section_planner.hpp>
#include <motionrack/control/trajectory/trajectory_point.hpp>
#include <optional>
#include <vector>

namespace motionrack::control {

/// A move, and what its driver wants to know of it later.
struct TrajectoryMove {
    Move move;
    bool overridable = true;  ///< otherwise it goes at its own feed
    std::uint8_t axes = 0;    ///< that move, a bit each
};

struct TrajectoryGeneratorSettings {
    std::size_t window =
        32'768;  ///< so many pieces of the curve are known before a motion begins, unless its end is known; 1 or more
};

enum class NextMotion : std::uint8_t {
    nothing,  ///< all is driven, or held, or more has to be known first
    motion,
    dwell
};

/// Allocates only when more is known at once than ever before.
class TrajectoryGenerator {
  public:
    /// The axes stand at `start`.
    TrajectoryGenerator(const MachineLimits& limits, const Point& start, TrajectoryGeneratorSettings settings = {});

    bool has_room() const { return builder_.has_room(); }
    /// Ask has_room() first. A move that begins where the last one ended; all its numbers are finite, and feeds above
    /// 0.
    void push(const TrajectoryMove& move);
    /// The path ends here at rest, for now.
    void flush();

    /// What comes next. `early`: what is known is driven although there may be more.
    NextMotion next(bool early);

    // ---- a motion, from here on
    /// s that can be told and passed before next() is asked again.
    double left() const { return left_ - reach_; }
    /// s until it stands, if nothing more comes.
    double seconds_to_standstill() const { return left_; }
    /// `seconds` from now, 0 .. left().
    TrajectoryPoint at(double seconds) const;
    /// The motion has gone on for so long, 0 .. left().
    void advance(double seconds);

    // ---- a dwell
    /// What is left of it.
    double dwell_seconds() const { return now_.rest.seconds - dwelt_; }
    /// So much of it was waited, 0 .. dwell_seconds().
    void advance_dwell(double seconds) { dwelt_ += seconds; }

    // ---- wishes
    /// Parts of the programmed feed, and of the axes' greatest speed in rapids: above 0. Felt as soon as the limits
    /// allow.
    void set_overrides(double feed, double rapid);
    /// Slows down and stands on the path as soon as the limits allow; then next() tells nothing until resume().
    void hold() { held_ = true; }
    void resume() { held_ = false; }
    bool stands() const { return !(left_ > 0); }
    /// s until it has to slow down for the end of what is known.
    double seconds_to_braking() const { return left_ - braking_; }

    // ---- which move
    /// How many were pushed.
    std::int64_t pushed() const { return pushed_; }
    /// The move, in the order of push from 0, on which this state is; of several that became one line, the first.
    std::int64_t move_of(const TrajectoryPoint& state) const { return move_of(state.line); }
    /// The first that is not passed; pushed() if all are.
    std::int64_t first_pending_move() const;
    /// Of the dwell.
    std::int64_t move_of_rest() const { return move_of(now_.rest.line); }
    /// One that has not been passed, as it was pushed.
    const TrajectoryMove& move(std::int64_t number) const {
        return moves_[static_cast<std::size_t>(number - first_move_)];
    }

  private:
    /// A stretch from rest to rest, or as much of it as is known: in the columns a row for each piece.
    struct KnownSection {
        std::vector<CubicSegment> curve;
        std::vector<double> programmed;  ///< feeds without overrides
        std::vector<SegmentTuning> use;
        std::vector<ProfileSegment> feed;  ///< the plan
        double planned_to = 0;             ///< u, how far it goes
        bool whole = false;                ///< its rest is known
        PathElement rest;
        double known() const { return curve.empty() ? 0 : curve.back().begin + curve.back().length; }
        void clear();
    };
    /// A place in now_, and the motion there.
    struct PlanCursor {
        std::size_t feed = 0, piece = 0;
        double on_feed = 0;  ///< s
        PathMotion along;
    };

    std::int64_t move_of(std::int32_t tag) const;
    void fetch_segments(std::size_t most);
    void make_room();
    void append(KnownSection& part, const CubicSegment& piece);
    double feed_of(const KnownSection& part, std::size_t i) const;
    void set_feed(KnownSection& part, std::size_t i, double at_least = 0) const;
    bool is_ready(const KnownSection& part, std::size_t from, bool early) const;
    void drop_passed();
    void forget_moves_before(std::int64_t number);
    void advance_section();
    void begin();
    void update_plan(bool early);
    bool extend_plan();
    bool slow_down();
    bool apply_overrides();
    bool plan_to_end(std::size_t piece, const PathMotion& along);
    SegmentTuning use_for_stop(std::size_t piece, std::size_t& k, double planned) const;
    std::optional<double> find_stop(const PlanCursor& from);
    KnownSection with_feeds(const PlanCursor& from, std::span<const ProfileSegment> stop) const;
    void take(const PlanCursor& from, double seconds, double to);
    void measure();
    void plan_overlap(bool early);
    void cancel_overlap();
    PlanCursor spot_at(double seconds) const;
    std::size_t piece_at(double place, std::size_t piece) const;

    MachineLimits limits_;
    TrajectoryGeneratorSettings settings_;
    PathBuilder builder_;
    SectionPlanner planner_;
    KnownSection now_, then_;

    std::size_t piece_ = 0, feed_ = 0;  ///< of now_, where the motion is
    double place_ = 0;                  ///< u
    double on_feed_ = 0;                ///< s
    double left_ = 0;                   ///< s to the planned end
    double braking_ = 0;                ///< of these the last, in which it slows down for that end
    double reach_ = 0;                  ///< s before the end of now_ when then_ begins
    StoredRamp before_;                 ///< how the stretch before ends
    double before_left_ = 0;            ///< s that it has still to go
    double dwelt_ = 0;                  ///< s of the dwell at the end of now_
    double retry_delay_s_ = 0;          ///< s until another plan is sought
    bool held_ = false, holding_ = false, new_feeds_ = false, met_ = false;
    static constexpr double min_ease = 1.2;
    double ease_ = min_ease;  ///< how much longer than a stop a way into lower feeds may be
    double feed_override_ = 1, rapid_override_ = 1;

    std::vector<CubicSegment> stop_curve_;
    std::vector<SegmentTuning> stop_use_;
    std::deque<TrajectoryMove> moves_;
    std::int64_t pushed_ = 0, first_move_ = 0;  ///< of moves_
    std::int64_t flushed_ = 0;                  ///< all before this one are known to their end
    std::int64_t told_ = 0;                     ///< of which the builder has told something last
};

}  // namespace motionrack::control
