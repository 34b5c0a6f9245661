// Rounding to registers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>
#include <motionrack/cards/mcx314/driver/units.hpp>

namespace motionrack::mcx314 {

namespace {

using rules::clock_hz, rules::rate_unit, rules::jerk_unit;
constexpr double max_range_multiple = 500;
constexpr double max_drive_units = static_cast<double>(rules::max_units);
constexpr double max_distance = 2'147'483'647;

/// One value of a drive: its name, and its maximum for M = 1.
struct Kind {
    const char* name;
    const char* time;  ///< s, s2 or s3: units/s, ..
    double max_per_multiple;
};
constexpr Kind speed_kind{"drive speed", "s", max_drive_units};
constexpr Kind start_kind{"start speed", "s", max_drive_units};
constexpr Kind accel_kind{"acceleration", "s2", max_drive_units* rate_unit};
constexpr Kind decel_kind{"deceleration", "s2", max_drive_units* rate_unit};
constexpr Kind jerk_kind{"jerk", "s3", jerk_unit};

Result<void> check_scale(const Scale& scale) {
    if (std::isfinite(scale.pulses_per_unit) && scale.pulses_per_unit > 0) return {};
    return fail(ErrorKind::refused,
                fmt::format("The scale is {} pulses a unit, but it must be more than 0. Nothing was set.",
                            scale.pulses_per_unit));
}

/// Checks that a value is finite, above 0 and within reach of the multiple.
Result<void> check_value(const Kind& kind, const Scale& scale, double value, double multiple) {
    if (!std::isfinite(value) || value <= 0)
        return fail(ErrorKind::refused,
                    fmt::format("The {} is {} units/{}, but it must be more than 0. Nothing was set.", kind.name, value,
                                kind.time));
    const double max_rate = kind.max_per_multiple * multiple;
    // R is a whole number, so the chosen multiple may miss by the last digit of a double.
    if (value * scale.pulses_per_unit <= max_rate * (1 + 1e-12)) return {};
    return fail(ErrorKind::refused,
                fmt::format("The {} of {} units/{} is {:.0f} pulses/{}, but the chip makes at most {:.0f}{}: {:.6g} "
                            "units/{}. Nothing was set.",
                            kind.name, value, kind.time, value * scale.pulses_per_unit, kind.time, max_rate,
                            multiple < max_range_multiple ? fmt::format(" with M = {:.6g}", multiple) : std::string(),
                            max_rate / scale.pulses_per_unit, kind.time));
}

Result<void> check_drive(const Scale& scale, const RealDrive& drive, double multiple) {
    MOTIONRACK_CHECK(check_scale(scale));
    MOTIONRACK_CHECK(check_value(speed_kind, scale, drive.speed, multiple));
    MOTIONRACK_CHECK(check_value(start_kind, scale, drive.start_speed, multiple));
    MOTIONRACK_CHECK(check_value(accel_kind, scale, drive.acceleration, multiple));
    if (drive.deceleration != 0) MOTIONRACK_CHECK(check_value(decel_kind, scale, drive.deceleration, multiple));
    if (drive.jerk != 0) MOTIONRACK_CHECK(check_value(jerk_kind, scale, drive.jerk, multiple));
    return {};
}

std::int64_t nearest(double value, const Parameter& parameter) {
    const double inside =
        std::clamp(std::floor(value + 0.5), static_cast<double>(parameter.min), static_cast<double>(parameter.max));
    return static_cast<std::int64_t>(inside);
}

Rounded rounded(const Scale& scale, double asked, double unit_pulses, const Parameter& parameter) {
    const std::int64_t value = nearest(asked * scale.pulses_per_unit / unit_pulses, parameter);
    return {asked, static_cast<double>(value) * unit_pulses / scale.pulses_per_unit, value};
}

/// The jerk is the reciprocal of its register: selects the nearer of the two neighbours.
Rounded rounded_jerk(const Scale& scale, double asked, double multiple) {
    const double exact = jerk_unit * multiple / (asked * scale.pulses_per_unit);
    auto real = [&](std::int64_t k) { return jerk_unit * multiple / (static_cast<double>(k) * scale.pulses_per_unit); };
    const std::int64_t below = nearest(std::floor(exact), param::K), above = nearest(std::floor(exact) + 1, param::K);
    const std::int64_t k = std::fabs(real(below) - asked) <= std::fabs(real(above) - asked) ? below : above;
    return {asked, real(k), k};
}

RealSetting with_range(const Scale& scale, const RealDrive& drive, std::int64_t range) {
    const double multiple = clock_hz / static_cast<double>(range);
    RealSetting out;
    out.R = range;
    out.speed = rounded(scale, drive.speed, multiple, param::V);
    out.start_speed = rounded(scale, drive.start_speed, multiple, param::SV);
    out.acceleration = rounded(scale, drive.acceleration, rate_unit * multiple, param::A);
    out.deceleration =
        drive.deceleration == 0 ? out.acceleration : rounded(scale, drive.deceleration, rate_unit * multiple, param::D);
    out.s_curve = drive.jerk != 0;
    out.asymmetric = out.deceleration.value != out.acceleration.value;
    if (out.s_curve) out.jerk = rounded_jerk(scale, drive.jerk, multiple);
    return out;
}

}  // namespace

Result<RealSetting> real_setting(const Scale& scale, const RealDrive& drive) {
    MOTIONRACK_CHECK(check_drive(scale, drive, max_range_multiple));
    const double pulses = scale.pulses_per_unit;
    const double min_multiple = std::max({1.0, drive.speed * pulses / speed_kind.max_per_multiple,
                                          drive.start_speed * pulses / start_kind.max_per_multiple,
                                          drive.acceleration * pulses / accel_kind.max_per_multiple,
                                          drive.deceleration * pulses / decel_kind.max_per_multiple,
                                          drive.jerk * pulses / jerk_kind.max_per_multiple});
    const double widest = std::clamp(std::floor(clock_hz / min_multiple), static_cast<double>(param::R.min),
                                     static_cast<double>(param::R.max));
    // V is the largest value within the widest range; R is then reduced until V gives the requested speed, rounded to
    // reach it.
    const double v = std::clamp(std::floor(drive.speed * pulses * widest / clock_hz), 1.0, max_drive_units);
    const auto with_v = [&](double units) {
        const double range = std::floor(clock_hz * units / (drive.speed * pulses));
        return with_range(scale, drive,
                          static_cast<std::int64_t>(std::clamp(range, static_cast<double>(param::R.min), widest)));
    };
    // At the end of R, V cannot be reached by reducing R further: the next V in the widest range may be nearer.
    const RealSetting own = with_v(v);
    if (own.R > param::R.min) return own;
    const RealSetting next = with_v(v + 1);
    return std::fabs(next.speed.error()) < std::fabs(own.speed.error()) ? next : own;
}

Result<RealSetting> real_setting_at(const Scale& scale, const RealDrive& drive, std::int64_t range) {
    if (range < param::R.min || range > param::R.max)
        return fail(ErrorKind::refused, fmt::format("{} is {}; it must be {} to {}. Nothing was set.", param::R.name,
                                                    range, param::R.min, param::R.max));
    MOTIONRACK_CHECK(check_drive(scale, drive, clock_hz / static_cast<double>(range)));
    return with_range(scale, drive, range);
}

RealDrive real_values(const Scale& scale, const CurveData& curve) {
    const double unit = clock_hz / static_cast<double>(curve.R) / scale.pulses_per_unit;
    return {static_cast<double>(curve.V) * unit, static_cast<double>(curve.SV) * unit,
            static_cast<double>(curve.A) * rate_unit * unit,
            curve.asymmetric ? static_cast<double>(curve.D) * rate_unit * unit : 0,
            curve.s_curve ? jerk_unit * unit / static_cast<double>(curve.K) : 0};
}

Result<Rounded> to_pulses(const Scale& scale, double distance) {
    MOTIONRACK_CHECK(check_scale(scale));
    const double pulses = std::floor(distance * scale.pulses_per_unit + 0.5);
    if (!std::isfinite(pulses) || std::fabs(pulses) > max_distance)
        return fail(
            ErrorKind::refused,
            fmt::format("The distance of {} units is {} pulses, but counters hold at most {:.0f}: {:.6g} units. "
                        "Nothing was set.",
                        distance, pulses, max_distance, max_distance / scale.pulses_per_unit));
    return Rounded{distance, pulses / scale.pulses_per_unit, static_cast<std::int64_t>(pulses)};
}

double RealSetting::max_error() const {
    double out = 0;
    for (const Rounded* value : {&speed, &start_speed, &acceleration, &deceleration, &jerk})
        out = std::max(out, std::fabs(value->error()));
    return out;
}

std::string RealSetting::text() const {
    struct Row {
        const char* name;
        const char* symbol;
        const Rounded& value;
    };
    std::string out = fmt::format("R {}: M = {:.6g}\n", R, clock_hz / static_cast<double>(R));
    for (const Row& row :
         {Row{"speed", "V", speed}, Row{"start speed", "SV", start_speed}, Row{"acceleration", "A", acceleration},
          Row{"deceleration", "D", deceleration}, Row{"jerk", "K", jerk}}) {
        if (row.value.value == 0) continue;
        out += fmt::format("{} {:.6g} -> {} {}: {:.6g} ({:+.4f} %)\n", row.name, row.value.asked, row.symbol,
                           row.value.value, row.value.real, 100 * row.value.error());
    }
    return out;
}

CurveData RealSetting::curve() const {
    CurveData out;
    out.R = R;
    out.SV = start_speed.value;
    out.V = speed.value;
    out.A = acceleration.value;
    out.D = deceleration.value;
    if (s_curve) out.K = jerk.value;
    out.s_curve = s_curve;
    out.asymmetric = asymmetric;
    return out;
}

RealPlan in_units(const Scale& scale, const CurvePlan& plan) {
    const double pulses = scale.pulses_per_unit;
    auto part = [&](const CurvePart& from) {
        return RealPart{to_seconds(from.time()), static_cast<double>(from.pulses) / pulses,
                        plan.hz(from.from_v) / pulses, plan.hz(from.to_v) / pulses,
                        plan.peak_acceleration(from) / pulses};
    };
    RealPlan out;
    out.rise = part(plan.rise);
    out.cruise = part(plan.cruise);
    out.fall = part(plan.fall);
    out.creep = part(plan.creep);
    out.seconds = to_seconds(plan.time());
    out.distance = static_cast<double>(plan.pulses) / pulses;
    out.top_speed = plan.top_hz() / pulses;
    out.end_speed = plan.hz(plan.end_v) / pulses;
    out.jerk = plan.jerk() / pulses;
    out.reaches_speed = plan.reaches_v;
    out.plan = plan;
    return out;
}

}  // namespace motionrack::mcx314
