// Handovers of the axes between the executor and other drivers.
#include <algorithm>
#include <motionrack/operate/axis_handover.hpp>
#include <motionrack/rack/job.hpp>
#include <utility>

namespace motionrack::operate {

Result<control::AxisGroup*> AxisHandover::group() {
    if (rack_.axes().empty()) return &no_axes_;
    return rack_.path_axes_here();
}

Result<void> AxisHandover::start(const rack::RackConfig& config) {
    MOTIONRACK_TRY(control::AxisGroup * axes, group());
    control::StreamExecutorSettings settings;
    settings.gcode = rack::reader_settings(config);
    settings.gcode.start = axes->commanded_position();
    settings.accel_reserve = rack::accel_reserve_of(rack_);
    settings.jerk_limited = config.jerk_limited();
    programs_.start(*axes, host_of(rack_), settings);
    group_holds_ = true;
    rack_.set_stop_flag(programs_.stream().stop_flag());
    return {};
}

Result<void> AxisHandover::take_group() {
    if (group_holds_) return {};
    in_progress_ = true;
    const Result<control::AxisGroup*> axes = group();
    in_progress_ = false;
    if (!axes) return tl::unexpected<Error>(axes.error());
    rack_.set_stop_flag(programs_.stream().stop_flag());
    programs_.stream().resync_axes(**axes);
    group_holds_ = true;
    return {};
}

Result<control::Axis*> AxisHandover::take_axis(char letter) {
    const rack::RunningAxis& axis =
        *std::find_if(rack_.axes().begin(), rack_.axes().end(),
                      [letter](const rack::RunningAxis& one) { return one.config.letter == letter; });
    group_holds_ = false;
    in_progress_ = true;
    Result<control::Axis*> taken = axis.card->axis(rack_.config(), letter);
    in_progress_ = false;
    return taken;
}

Result<void> AxisHandover::hand_over(const std::function<Result<void>()>& set_up) {
    in_progress_ = true;
    Result<void> done = set_up();
    in_progress_ = false;
    return done;
}

Result<void> AxisHandover::take_back() {
    if (!group_holds_) return take_group();
    rack_.set_stop_flag(programs_.stream().stop_flag());
    return {};
}

}  // namespace motionrack::operate
