// Path plan with trapezoidal profiles: overrides replan the moves that were not submitted, and the
// axes themselves brake.
#include <motionrack/control/make_planner.hpp>
#include <motionrack/control/path_plan.hpp>

namespace motionrack::control {

namespace {

class TrapezoidalPlan final : public PathPlan {
  public:
    TrapezoidalPlan(const PathPlanSettings& settings, const AxisGroup& axes, const Point& start)
        : settings_(settings), planner_(planner(axes, start)) {}

    void reset(const AxisGroup& axes, const Point& position) override { planner_ = planner(axes, position); }
    void set_overrides(MoveQueue& queue, double feed, double rapid, bool brakes) override;
    bool has_room() const override { return planner_.has_room(); }
    Result<void> push(QueueEntry& entry) override {
        Move move = entry.step.move;
        entry.override_feed(move, feed_, rapid_);
        return planner_.push(move);
    }
    void keep_apart() override { planner_.keep_apart(); }
    /// Holds a last move back while there is time for the line after it. A hold or stop submits it: deceleration may
    /// need the whole known path.
    bool waits(const MoveQueue&, const PathOutlook& outlook) override {
        if (outlook.rest_known || outlook.brakes || planner_.size() > 1) return false;
        return outlook.begun ? outlook.time_left : planner_.size() > 0;
    }
    bool pull(const MoveQueue& queue, const PathOutlook& outlook, PlannedMove& planned) override;
    bool may_go_on(const PathOutlook&) const override { return false; }

    void submit(MoveQueue& queue, const PlannedMove& planned) override {
        blocks_.push_back({planned.moves, pulled_override_});
        queue.submit(planned.moves, seconds_of(planned));
    }
    void pass(MoveQueue& queue, std::int64_t blocks) override {
        for (; blocks > 0; --blocks) {
            queue.pop_moves(blocks_.front().number);
            blocks_.pop_front();
            queue.pass_blocks(1);
        }
    }
    void finish(MoveQueue& queue) override {
        interrupt(queue);
        queue.pop_submitted();
    }
    std::int64_t moves_begun() const override {
        return (blocks_.empty() ? 1 : blocks_.front().number) + (blocks_.size() > 1 ? blocks_[1].number : 0);
    }

  private:
    LookAheadPlanner planner(const AxisGroup& axes, const Point& position) const {
        return make_look_ahead_planner(axes, settings_.limits, settings_.accel_reserve, settings_.planner, position);
    }

    PathPlanSettings settings_;
    LookAheadPlanner planner_;  ///< a block's number: how many moves of the queue it covers
    double feed_ = 1, rapid_ = 1;
    double pulled_override_ = 0;  ///< SubmittedMove::rapid_override of the move that was pulled last
};

/// Returns the number of slices of the rapid that is the next move; 0: the next move is another one, or not all of it
/// is planned. `at`: set to its first entry.
std::size_t slices_of_rapid(const MoveQueue& queue, std::size_t& at) {
    at = queue.submitted();
    while (at < queue.planned() && !queue[at].is_move()) ++at;
    for (std::size_t i = at; i < queue.planned(); ++i) {
        if (!queue[i].is_move() || queue[i].step.move.kind != MoveKind::rapid) return 0;
        if (queue[i].last) return i + 1 - at;
    }
    return 0;
}

/// A rapid from standstill to standstill is pulled as a whole, so that it can be one S-curve of the card.
bool TrapezoidalPlan::pull(const MoveQueue& queue, const PathOutlook& outlook, PlannedMove& planned) {
    std::size_t at = 0;
    const std::size_t slices = slices_of_rapid(queue, at);
    pulled_override_ = 0;
    if (slices < 2 || !planner_.is_from_rest_to_rest(slices, outlook.path_ends)) return planner_.pull_early(planned);
    planner_.pull_as_one(slices, planned);
    if (queue[at].step.overridable) pulled_override_ = planned.move.rapid_override;
    return true;
}

void TrapezoidalPlan::set_overrides(MoveQueue& queue, double feed, double rapid, bool brakes) {
    if (brakes || (feed == feed_ && rapid == rapid_)) return;
    feed_ = feed;
    rapid_ = rapid;
    std::size_t at = queue.submitted();
    planner_.change_feeds([&](PlannedMove& planned) {
        while (!queue[at].is_move()) ++at;
        queue[at].override_feed(planned.move, feed_, rapid_);
        for (std::int32_t left = planned.moves; left > 0; ++at) left -= queue[at].is_move();
    });
}

}  // namespace

std::unique_ptr<PathPlan> make_trapezoidal_plan(const PathPlanSettings& settings, const AxisGroup& axes,
                                                const Point& start) {
    return std::make_unique<TrapezoidalPlan>(settings, axes, start);
}

}  // namespace motionrack::control
