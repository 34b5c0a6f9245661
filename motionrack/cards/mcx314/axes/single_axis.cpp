// Commands in mm and seconds as calls of the function library; supervision of the position.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/mcx314/axes/geometry.hpp>
#include <motionrack/cards/mcx314/axes/initialise.hpp>
#include <motionrack/cards/mcx314/axes/single_axis.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr Duration poll_period = milliseconds(1);
constexpr double pulse_slack = 1e-6;  // a value this close to a whole pulse is taken as whole
constexpr double max_pulses = static_cast<double>(param::pulses.max), max_place = static_cast<double>(param::LP.max);

}  // namespace

SingleAxis::SingleAxis(Driver& driver, const SingleAxisSettings& settings)
    : driver_(driver),
      settings_(settings),
      real_(driver, settings.channel, {settings.limits.pulses_per_unit}, {settings.counts_per_unit}),
      home_(driver, settings.channel),
      manual_(driver, settings.channel) {}

Result<void> SingleAxis::prepare(Driver& driver) {
    return prepare_chip(driver);
}

Result<void> SingleAxis::set_up() {
    set_position_valid(false);
    MOTIONRACK_CHECK(driver_.LPS(mask(), 0));
    MOTIONRACK_CHECK(driver_.EPS(mask(), 0));
    return write_travel(driver_, settings_.channel, settings_.limits);
}

Result<void> SingleAxis::go_on(std::int64_t pulses, std::int64_t counts, bool valid) {
    MOTIONRACK_CHECK(driver_.LPS(mask(), pulses));
    MOTIONRACK_CHECK(driver_.EPS(mask(), counts));
    set_position_valid(valid);
    return {};
}

// ---- refused commands

tl::unexpected<Error> SingleAxis::refuse(const char* what, const std::string& why) const {
    return fail(ErrorKind::refused, fmt::format("{} of axis {}: {}. Nothing was moved.", what, settings_.name, why));
}

Result<void> SingleAxis::check_speed(const char* what, double speed) const {
    if (std::isfinite(speed) && speed > 0 && speed <= settings_.limits.max_velocity) return {};
    return refuse(what, fmt::format("the velocity is {} {}/s; it must be above 0 and up to {}", speed, settings_.unit,
                                    settings_.limits.max_velocity));
}

Result<void> SingleAxis::check_free(const char* what) {
    if (busy()) return refuse(what, "it moves; stop it and wait for standstill");
    const DriveStatus status = driver_.axis_status(settings_.channel);
    if (field("RR2", "EMG").test(status.rr2)) return refuse(what, "the emergency stop is active; release it");
    if (field("RR2", "ALARM").test(status.rr2)) return refuse(what, "its drive reports an alarm; clear it");
    return {};
}

Result<void> SingleAxis::check_into_limit(const char* what, bool negative) {
    const DriveStatus status = driver_.axis_status(settings_.channel);
    if (!(negative ? field("RR2", "HLMTM") : field("RR2", "HLMTP")).test(status.rr2)) return {};
    return refuse(what, fmt::format("it is on the {} limit switch; move it in {} direction", negative ? "-" : "+",
                                    negative ? "+" : "-"));
}

// ---- moves

RealDrive SingleAxis::drive_at(double speed, bool with_jerk) const {
    const control::AxisLimits& limits = settings_.limits;
    RealDrive drive;
    drive.speed = speed;
    drive.start_speed = std::min(speed, limits.max_velocity_step);
    drive.acceleration = limits.max_accel;
    drive.jerk = with_jerk ? limits.max_jerk : 0;
    return drive;
}

Result<void> SingleAxis::begin_move(double distance, double speed) {
    MOTIONRACK_CHECK(real_.set(drive_at(speed, settings_.limits.max_jerk > 0)));
    MOTIONRACK_CHECK(real_.move(distance));
    moving_ = true;
    jogged_ = stopping_ = false;
    return {};
}

Result<void> SingleAxis::move_to(double position, double speed) {
    const control::AxisLimits& limits = settings_.limits;
    if (!position_valid_)
        return refuse("Move", "its position is not valid; home it, or set its position with set_position");
    MOTIONRACK_CHECK(check_speed("Move", speed));
    if (!(position >= limits.min_position && position <= limits.max_position))
        return refuse("Move", fmt::format("{} {} is outside its travel of {} to {}", position, settings_.unit,
                                          limits.min_position, limits.max_position));
    MOTIONRACK_CHECK(check_free("Move"));
    const double distance = position - real_.position();
    MOTIONRACK_CHECK(check_into_limit("Move", distance < 0));
    return begin_move(distance, speed);
}

Result<void> SingleAxis::move_by(double distance, double speed) {
    if (position_valid_) return move_to(real_.position() + distance, speed);
    MOTIONRACK_CHECK(check_speed("Move", speed));
    const double max_travel = max_pulses / settings_.limits.pulses_per_unit;
    if (!(std::fabs(distance) <= max_travel))
        return refuse("Move", fmt::format("the distance is {} {}; it must be at most {:.0f}", distance, settings_.unit,
                                          max_travel));
    MOTIONRACK_CHECK(check_free("Move"));
    MOTIONRACK_CHECK(check_into_limit("Move", distance < 0));
    return begin_move(distance, speed);
}

/// Travel in whole pulses.
ManualTravel SingleAxis::travel() const {
    const control::AxisLimits& limits = settings_.limits;
    const double scale = limits.pulses_per_unit;
    return {static_cast<std::int64_t>(std::ceil(limits.min_position * scale - pulse_slack)),
            static_cast<std::int64_t>(std::floor(limits.max_position * scale + pulse_slack))};
}

/// Refuses a jog if no pulse remains in its direction.
Result<void> SingleAxis::check_travel(double speed) {
    const bool negative = speed < 0;
    const std::int64_t at = driver_.ReadLPS(settings_.channel);
    if (!position_valid_ || (negative ? at > travel().min : at < travel().max)) return {};
    return refuse("Jog",
                  fmt::format("it is at the {} end of its travel, {} {}; move it in {} direction", negative ? "-" : "+",
                              negative ? settings_.limits.min_position : settings_.limits.max_position, settings_.unit,
                              negative ? "+" : "-"));
}

Result<void> SingleAxis::jog(double speed, Instant now) {
    if (speed == 0) return manual_.jog(0, now);
    MOTIONRACK_CHECK(check_speed("Jog", std::fabs(speed)));
    if (manual_.state() != ManualState::standing) step(now);  // a motion may have ended in the meantime
    if (manual_.state() == ManualState::standing) {
        MOTIONRACK_CHECK(check_free("Jog"));
        MOTIONRACK_CHECK(check_travel(speed));
        MOTIONRACK_TRY(const RealSetting setting, real_.set(drive_at(settings_.limits.max_velocity, false)));
        ManualSettings manual;
        manual.sv = setting.start_speed.value;
        manual.a = setting.acceleration.value;
        manual.hold = settings_.hold;
        if (position_valid_) manual.travel = travel();
        MOTIONRACK_CHECK(manual_.set(manual));
    }
    const double unit = driver_.multiple(settings_.channel) / settings_.limits.pulses_per_unit;
    const auto v = static_cast<std::int64_t>(std::clamp(std::floor(std::fabs(speed) / unit + 0.5), 1.0, max_units));
    MOTIONRACK_CHECK(manual_.jog(speed < 0 ? -v : v, now));
    jogged_ = true;
    return {};
}

// ---- homing

Result<HomeSettings> SingleAxis::home_settings(const control::HomingRequest& order) const {
    const control::AxisLimits& limits = settings_.limits;
    MOTIONRACK_CHECK(check_speed("Homing", order.search_velocity));
    const auto outside = [&](const char* what, double value, double min, double max) -> Result<void> {
        if (value >= min && value <= max) return {};
        return refuse("Homing", fmt::format("{} is {}; it must be {} to {}", what, value, min, max));
    };
    const double max_way = max_pulses / limits.pulses_per_unit, max_home = max_place / limits.pulses_per_unit;
    MOTIONRACK_CHECK(outside("the home offset", order.home_offset, -max_home, max_home));
    MOTIONRACK_CHECK(outside("the backoff", order.backoff, 0, max_way));
    MOTIONRACK_CHECK(outside("the settling time in s", order.settle_s, 0, 10));
    MOTIONRACK_CHECK(outside("the longest search", order.travel, 0, max_way));
    MOTIONRACK_CHECK(outside("the latch velocity", order.latch_velocity, 1e-9,
                             std::min(order.search_velocity, limits.max_velocity_step)));
    const bool index = order.method == control::HomingMethod::index_after_switch ||
                       order.method == control::HomingMethod::twice_and_index;
    if (index && !(settings_.counts_per_unit > 0))
        return refuse("Homing", "it has no encoder, so no index; home it with type 1 or 2");
    MOTIONRACK_TRY(const RealSetting setting,
                   real_setting({limits.pulses_per_unit}, drive_at(order.search_velocity, false)));
    const auto pulses = [&](double distance) {
        return static_cast<std::int64_t>(std::min(max_pulses, std::floor(distance * limits.pulses_per_unit + 0.5)));
    };
    const double unit = rules::clock_hz / static_cast<double>(setting.R) / limits.pulses_per_unit;
    HomeSettings out;
    out.type = static_cast<int>(order.method);
    out.negative = !order.towards_plus;
    out.input = order.switch_input;
    out.active_high = order.switch_active_high;
    out.index_input = order.index_input;
    out.index_high = order.index_active_high;
    out.range = setting.R;
    out.sv = setting.start_speed.value;
    out.v = setting.speed.value;
    out.a = setting.acceleration.value;
    out.slow_v = std::clamp<std::int64_t>(static_cast<std::int64_t>(order.latch_velocity / unit), 1, out.sv);
    out.travel = std::max<std::int64_t>(
        1, pulses(order.travel > 0 ? order.travel : 1.2 * (limits.max_position - limits.min_position)));
    out.turn = settings_.pulses_per_turn;
    if (index && order.index_after) {
        MOTIONRACK_CHECK(outside("the distance from the switch to the index", *order.index_after, 0, max_way));
        out.index_after = pulses(*order.index_after);
    }
    if (order.hysteresis) {
        MOTIONRACK_CHECK(outside("the hysteresis of the switch", *order.hysteresis, 0, max_way));
        out.hysteresis = pulses(*order.hysteresis) + 1;
        out.repeats = pulses(contacts_repeat) + 2;
    }
    out.backoff = std::min(out.travel, pulses(order.backoff));
    out.settle = from_seconds(order.settle_s);
    out.turn_at_limit = order.turn_at_limit;
    out.home_position = nearest_pulse(order.home_offset, limits.pulses_per_unit);
    out.home_counts = nearest_pulse(order.home_offset, settings_.counts_per_unit);
    out.name = settings_.name;
    out.unit = settings_.unit;
    out.pulses_per_unit = limits.pulses_per_unit;
    return out;
}

Result<void> SingleAxis::home(const control::HomingRequest& order, Instant now) {
    MOTIONRACK_TRY(const HomeSettings settings, home_settings(order));
    MOTIONRACK_CHECK(check_free("Homing"));
    MOTIONRACK_CHECK(home_.start(settings, now));
    set_position_valid(false);
    jogged_ = stopping_ = false;
    return {};
}

control::HomingResult SingleAxis::home_outcome() const {
    const HomeReport& report = home_.report();
    const HomeSettings& settings = home_.settings();
    const double unit = 1 / settings_.limits.pulses_per_unit;
    // A failed homing gives no home position; positions then follow the counter as it was.
    const auto place = [&](std::int32_t lp) {
        return static_cast<double>(report.homed ? report.relative(lp) : lp) * unit;
    };
    const auto since = [&](Instant at) { return to_seconds(at - report.from); };
    control::HomingResult out;
    out.method = static_cast<control::HomingMethod>(report.type);
    out.towards_plus = !report.negative;
    out.homed = report.homed;
    out.sentence = report.sentence;
    for (const ChipHomingEdge& edge : report.edges) {
        const bool index = edge.input != report.input;
        out.edges.push_back({index         ? "index"
                             : edge.active ? "switch on"
                                           : "switch off",
                             std::string(edge.state), place(edge.lp), static_cast<double>(edge.within) * unit,
                             edge.speed_hz * unit, since(edge.at)});
    }
    for (const ChipHomingStateVisit& stay : report.stays)
        out.stays.push_back(
            {std::string(stay.state), since(stay.from), to_seconds(stay.took), place(stay.from_lp), place(stay.to_lp)});
    out.notes = report.notes;
    out.bounces = report.bounces;
    out.position = report.homed           ? static_cast<double>(settings.home_position) * unit
                   : report.stays.empty() ? 0
                                          : place(report.stays.back().to_lp);
    out.moved_by = report.homed ? static_cast<double>(settings.home_position - report.zero_lp) * unit : 0;
    if (const auto distance = report.switch_to_index()) out.switch_to_index = static_cast<double>(*distance) * unit;
    out.from = report.from;
    out.took_s = to_seconds(report.took);
    return out;
}

// ---- position, stops

/// The software limits are enabled exactly while the position is valid.
void SingleAxis::set_position_valid(bool on) {
    position_valid_ = on;
    const unsigned rest = driver_.mode2(settings_.channel) & ~software_limits;
    driver_.WriteMode2(mask(), static_cast<std::uint16_t>(on ? rest | software_limits : rest));
}

Result<void> SingleAxis::set_position(double position) {
    const double max_position = max_place / std::max(settings_.limits.pulses_per_unit, settings_.counts_per_unit);
    if (!(std::fabs(position) <= max_position))
        return refuse("Position", fmt::format("it is {0}; it must be -{1:.0f} to {1:.0f} {2}", position, max_position,
                                              settings_.unit));
    if (busy()) return refuse("Position", "it moves; stop it and wait for standstill");
    MOTIONRACK_CHECK(real_.set_position(position));
    if (settings_.counts_per_unit > 0)
        MOTIONRACK_CHECK(driver_.EPS(mask(), nearest_pulse(position, settings_.counts_per_unit)));
    set_position_valid(true);
    return {};
}

void SingleAxis::stop() {
    home_.stop();
    manual_.stop();
    driver_.SlowStop(mask());
    stopping_ = driver_.moving(mask());
}

void SingleAxis::stop_now() {
    const double speed =
        driver_.ReadCV(settings_.channel) * driver_.multiple(settings_.channel) / settings_.limits.pulses_per_unit;
    driver_.QuickStop(mask());
    home_.stop();
    manual_.stop();
    if (position_valid_ && speed > settings_.limits.max_velocity_step) set_position_valid(false);
    stopping_ = driver_.moving(mask());
}

// ---- polling

/// Handles the end of a drive: checks whether the cause was an immediate stop.
void SingleAxis::note_end() {
    const DriveStatus status = driver_.axis_status(settings_.channel);
    if (position_valid_ && (status.alarm() || status.emergency())) set_position_valid(false);
}

void SingleAxis::step(Instant now) {
    if (home_.running()) {
        home_.step(now);
        if (!home_.running() && home_.homed()) set_position_valid(true);
        return;
    }
    if (manual_.state() != ManualState::standing) {
        manual_.step(now);
        if (manual_.state() == ManualState::standing) note_end();
    } else if ((moving_ || stopping_) && !driver_.moving(mask())) {
        moving_ = stopping_ = false;
        note_end();
    }
}

Result<void> SingleAxis::wait(Duration timeout) {
    Interrupt& host = driver_.interrupt();
    const Instant end = later(host.now(), timeout);
    const bool homing = home_.running();
    bool asked = false;
    while (true) {
        step(host.now());
        if (!busy()) break;
        if (!asked && host.stop_requested()) {
            asked = true;
            stop();
        }
        if (host.now() >= end)
            return fail(
                ErrorKind::machine,
                fmt::format(
                    "Axis {} still moves after {:.3f} s, at {:.4f} {}; nothing was stopped. Wait longer, or stop it.",
                    settings_.name, to_seconds(timeout), position(), settings_.unit));
        const Instant before = host.now();
        if (host.wait(poll_period)) driver_.read_interrupts(settings_.channel);
        if (host.now() == before) host.pass(poll_period);
    }
    if (homing && !home_.homed()) return home_.report().result();
    if (asked)
        return fail(ErrorKind::stopped, fmt::format("Axis {} was stopped on request at {:.4f} {}.", settings_.name,
                                                    position(), settings_.unit));
    const std::string why = jogged_ ? manual_.why_ended() : driver_.axis_status(settings_.channel).why_stopped();
    if (!homing && !why.empty())
        return fail(
            ErrorKind::machine,
            fmt::format("Axis {} was stopped at {:.4f} {}: {}. {}", settings_.name, position(), settings_.unit, why,
                        position_valid_ ? "Move it the other way." : "Its position is not valid; home it."));
    return {};
}

control::AxisState SingleAxis::state() {
    using control::AxisState;
    if (home_.running()) return AxisState::homing;
    switch (manual_.state()) {
        case ManualState::jogging:
            return AxisState::jogging;
        case ManualState::turning:
        case ManualState::stopping:
            return AxisState::stopping;
        default:
            break;
    }
    if (driver_.moving(mask())) return stopping_ ? AxisState::stopping : AxisState::moving;
    const DriveStatus status = driver_.axis_status(settings_.channel);
    return field("RR2", "EMG").test(status.rr2) || field("RR2", "ALARM").test(status.rr2) ? AxisState::error
                                                                                          : AxisState::standstill;
}

}  // namespace motionrack::mcx314
