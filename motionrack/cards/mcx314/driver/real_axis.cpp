// Conversion of physical units for the function library.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/real_axis.hpp>

namespace motionrack::mcx314 {

Result<RealSetting> RealAxis::set(const RealDrive& drive) {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "set"));
    MOTIONRACK_TRY(const RealSetting setting, real_setting(scale_, drive));
    const unsigned own = 1u << axis_;
    MOTIONRACK_CHECK(driver_.SetRange(own, setting.R));
    MOTIONRACK_CHECK(driver_.SetSV(own, setting.start_speed.value));
    MOTIONRACK_CHECK(driver_.SetV(own, setting.speed.value));
    MOTIONRACK_CHECK(driver_.SetA(own, setting.acceleration.value));
    MOTIONRACK_CHECK(driver_.SetD(own, setting.deceleration.value));
    if (setting.s_curve) MOTIONRACK_CHECK(driver_.SetAA(own, setting.jerk.value));
    MOTIONRACK_CHECK(driver_.SetAsymmetric(own, setting.asymmetric));
    MOTIONRACK_CHECK(driver_.AutoDec(own));
    setting_ = setting;
    set_ = true;
    return setting;
}

Result<void> RealAxis::check_set(const char* who) const {
    if (set_) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: the speeds of {} are not set. Nothing was written. Call set first.", who,
                            axis_ >= 0 && axis_ < 4 ? axes_text(1u << axis_) : "no axis"));
}

/// The curve of a move, completed so that it ends at its start speed.
Result<CurveData> RealAxis::curve(std::int64_t pulses) const {
    CurveData out = setting_.curve();
    out.pulses = rules::magnitude(pulses);
    return with_slow_end(out);
}

Result<RealPlan> RealAxis::plan(double distance) const {
    MOTIONRACK_CHECK(check_set("plan"));
    MOTIONRACK_TRY(const Rounded rounded, to_pulses(scale_, distance));
    MOTIONRACK_TRY(const CurveData data, curve(rounded.value));
    MOTIONRACK_TRY(const CurvePlan plan, plan_drive(data));
    return in_units(scale_, plan);
}

Result<Rounded> RealAxis::move(double distance) {
    MOTIONRACK_CHECK(check_set("move"));
    MOTIONRACK_TRY(const Rounded rounded, to_pulses(scale_, distance));
    const unsigned own = 1u << axis_;
    const CurveData data = setting_.curve();
    // AO acts at once, so it must not be written during a drive; the curve is then refused.
    if (!driver_.moving(own)) MOTIONRACK_CHECK(driver_.SetAO(own, std::nullopt));
    if (data.s_curve)
        MOTIONRACK_CHECK(driver_.SCurve_F(own, data.SV, data.V, data.A, data.K, rounded.value));
    else
        MOTIONRACK_CHECK(driver_.TCurve_F(own, data.SV, data.V, data.A, rounded.value));
    return rounded;
}

Result<Rounded> RealAxis::move_to(double position) {
    MOTIONRACK_CHECK(check_set("move_to"));
    MOTIONRACK_TRY(const Rounded target, to_pulses(scale_, position));
    const double from = this->position();
    MOTIONRACK_CHECK(move(target.real - from));
    return target;
}

Result<void> RealAxis::run(bool negative) {
    MOTIONRACK_CHECK(check_set("run"));
    const CurveData data = setting_.curve();
    const unsigned own = 1u << axis_;
    if (data.s_curve) return driver_.SCurve_C(own, data.SV, data.V, data.A, data.K, negative);
    return driver_.TCurve_C(own, data.SV, data.V, data.A, negative);
}

Result<Rounded> RealAxis::change_speed(double speed) {
    MOTIONRACK_CHECK(check_set("change_speed"));
    RealDrive drive = real_values(scale_, setting_.curve());
    drive.speed = speed;
    MOTIONRACK_TRY(const RealSetting changed, real_setting_at(scale_, drive, setting_.R));
    MOTIONRACK_CHECK(driver_.change_speed(1u << axis_, changed.speed.value));
    return changed.speed;
}

Result<Rounded> RealAxis::change_distance(double distance) {
    MOTIONRACK_TRY(const Rounded rounded, to_pulses(scale_, distance));
    MOTIONRACK_CHECK(driver_.change_pulses(axis_, rounded.value));
    return rounded;
}

Result<Rounded> RealAxis::set_position(double position) {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "set_position"));
    MOTIONRACK_TRY(const Rounded rounded, to_pulses(scale_, position));
    MOTIONRACK_CHECK(driver_.LPS(1u << axis_, rounded.value));
    return rounded;
}

Result<double> RealAxis::speed() {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "speed"));
    MOTIONRACK_TRY(const auto speeds, driver_.axis_speeds());
    return speeds[static_cast<std::size_t>(axis_)] / scale_.pulses_per_unit;
}

}  // namespace motionrack::mcx314
