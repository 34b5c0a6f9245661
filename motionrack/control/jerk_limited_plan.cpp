// Path plan with limited jerk: the interpolator holds, resumes and overrides along its trajectory; the axes get its
// moves one by one.
#include <motionrack/control/make_planner.hpp>
#include <motionrack/control/path_plan.hpp>

namespace motionrack::control {

namespace {

/// Time before deceleration for the end of the plan at which an unfinished path is flushed, s. The interpolator returns
/// nothing of the last moves until it knows what follows. It is flushed if no line has come and deceleration for the
/// end of its plan is this near.
constexpr double ends_before = 0.2;
constexpr Duration sender_is_silent = milliseconds(50);

class JerkLimitedPlan final : public PathPlan {
  public:
    JerkLimitedPlan(const PathPlanSettings& settings, const AxisGroup& axes, const Point& start, Interrupt& host)
        : settings_(settings), host_(host), interpolator_(interpolator(axes, start)) {}

    void reset(const AxisGroup& axes, const Point& position) override {
        interpolator_ = interpolator(axes, position);
        ends_ = true;
    }
    bool brakes_itself() const override { return true; }
    void hold() override { interpolator_.generator().hold(); }
    void resume() override { interpolator_.generator().resume(); }
    void set_overrides(MoveQueue&, double feed, double rapid, bool) override {
        interpolator_.generator().set_overrides(feed, rapid);
    }
    bool has_room() const override { return interpolator_.has_room(); }
    Result<void> push(QueueEntry& entry) override;
    bool waits(const MoveQueue& queue, const PathOutlook& outlook) override;
    bool pull(const MoveQueue&, const PathOutlook&, PlannedMove& planned) override {
        return interpolator_.pull(planned, true);
    }
    bool may_go_on(const PathOutlook& outlook) const override {
        return !ends_ && !outlook.rest_known && !outlook.brakes;
    }

    void submit(MoveQueue&, const PlannedMove& planned) override { blocks_.push_back({planned.number}); }
    /// Removes the passed moves of the queue; one of them becomes several planned moves.
    void pass(MoveQueue& queue, std::int64_t blocks) override {
        for (; blocks > 0; --blocks) {
            blocks_.pop_front();
            queue.pass_blocks(1);
        }
        queue.pop_before(blocks_.front().number);
    }
    void finish(MoveQueue& queue) override {
        interrupt(queue);
        queue.pop_before(interpolator_.generator().first_pending_move());
    }

  private:
    TrajectoryInterpolator interpolator(const AxisGroup& axes, const Point& position) const {
        InterpolatorSettings settings;
        settings.cut_dwells = true;
        return make_trajectory_interpolator(axes, settings_.limits, settings_.accel_reserve, settings, position);
    }

    PathPlanSettings settings_;
    Interrupt& host_;
    TrajectoryInterpolator interpolator_;  ///< a block's number: that of its move in the trajectory
    bool ends_ = true;                     ///< the interpolator was flushed
    Instant last_push_{};
};

Result<void> JerkLimitedPlan::push(QueueEntry& entry) {
    entry.number = interpolator_.generator().pushed();
    MOTIONRACK_CHECK(interpolator_.push(entry.step.move, entry.is_overridable()));
    ends_ = false;
    last_push_ = host_.now();
    return {};
}

/// A single first move waits for the line after it. Ends the path if the rest of it is known, or the sender is late.
bool JerkLimitedPlan::waits(const MoveQueue& queue, const PathOutlook& outlook) {
    if (!outlook.rest_known && !outlook.begun && !outlook.brakes && queue.planned() == 1 && !ends_) return true;
    const bool late =
        interpolator_.generator().seconds_to_braking() < ends_before && host_.now() > last_push_ + sender_is_silent;
    if (!ends_ && (outlook.rest_known || late) && interpolator_.has_room()) {
        interpolator_.flush();
        ends_ = true;
    }
    return false;
}

}  // namespace

std::unique_ptr<PathPlan> make_jerk_limited_plan(const PathPlanSettings& settings, const AxisGroup& axes,
                                                 const Point& start, Interrupt& host) {
    return std::make_unique<JerkLimitedPlan>(settings, axes, start, host);
}

}  // namespace motionrack::control
