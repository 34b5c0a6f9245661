// Jog, step, manual home: a small state machine around single drive commands.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>

namespace motionrack::mcx314 {

namespace {

/// Pause between the last pulse in one direction and the first in the other: an immediate reversal would be a velocity
/// step of twice the start speed.
constexpr Duration turn_rest = milliseconds(20);

constexpr StateInfo states[] = {
    {"standing", "no manual drive"},
    {"jogging", "a renewed drive: continuous, or to the soft limit"},
    {"turning", "decelerates to standstill, to reverse the jog"},
    {"stepping", "a fixed drive"},
    {"homing", "a renewed homing"},
    {"stopping", "decelerates"},
};
constexpr TransitionInfo transitions[] = {
    {"standing", "jogging", "jog()"},
    {"standing", "stepping", "step_jog()"},
    {"standing", "homing", "home()"},
    {"jogging", "turning", "jog() in the other direction"},
    {"jogging", "stopping", "not renewed, jog(0) or stop()"},
    {"jogging", "standing", "the chip ended the drive, or the soft limit is reached"},
    {"turning", "jogging", "the axis stood still and the jog is renewed"},
    {"turning", "stopping", "not renewed, jog(0) or stop()"},
    {"turning", "standing", "the axis stands at a limit of the new direction"},
    {"stepping", "standing", "the pulses are out, or the chip ended the drive"},
    {"stepping", "stopping", "stop()"},
    {"homing", "standing", "the homing has ended"},
    {"stopping", "turning", "jog()"},
    {"stopping", "standing", "the axis stands"},
};
constexpr MachineInfo machine = {"manual operation", "one axis moved by hand", states, transitions};
static_assert(declared<machine_flaw(machine)>());

}  // namespace

const MachineInfo& manual_machine() {
    return machine;
}

Result<void> Manual::set(const ManualSettings& settings) {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "Manual operation"));
    struct Bound {
        const char* name;
        std::int64_t value, min, max;
    };
    const Bound bounds[] = {
        {"the initial speed SV", settings.sv, param::SV.min, param::SV.max},
        {"the acceleration A", settings.a, param::A.min, param::A.max},
        {"the greatest speed", settings.max_v, param::V.min, param::V.max},
        {"the time a jog is held, in ms,", settings.hold / milliseconds(1), 1, 10'000},
    };
    for (const Bound& bound : bounds)
        if (bound.value < bound.min || bound.value > bound.max)
            return fail(ErrorKind::refused,
                        fmt::format("Manual operation of {}: {} is {}; it must be {} to {}. Nothing was changed.",
                                    name(), bound.name, bound.value, bound.min, bound.max));
    if (state_ != ManualState::standing)
        return fail(
            ErrorKind::refused,
            fmt::format("Manual operation of {}: it is {}. Nothing was changed; stop it first.", name(), state_name()));
    settings_ = settings;
    return {};
}

/// Checks that a manual drive at `v` may start now, or continue.
Result<void> Manual::check_ready(const char* what, std::int64_t v) {
    const auto refuse = [&](const std::string& why) {
        return fail(ErrorKind::refused, fmt::format("{} of {}: {}. Nothing was moved.", what, name(), why));
    };
    if (v == 0 || v > settings_.max_v || v < -settings_.max_v)
        return refuse(fmt::format("the speed is {}; it must be 1 to {} in either direction", v, settings_.max_v));
    if (state_ == ManualState::stepping || state_ == ManualState::homing)
        return refuse(fmt::format("it is {}; stop that first", state_name()));
    if (state_ == ManualState::standing && driver_.moving(mask()))
        return refuse("it moves already, by another command; stop that first");
    const DriveStatus status = driver_.axis_status(axis_);
    if (field("RR2", "EMG").test(status.rr2)) return refuse("the emergency stop is active; release it");
    if (field("RR2", "ALARM").test(status.rr2)) return refuse("its drive reports an alarm; clear it");
    const bool negative = v < 0;
    if ((negative ? field("RR2", "HLMTM") : field("RR2", "HLMTP")).test(status.rr2))
        return refuse(fmt::format("it is on the {} limit switch; move it in {} direction", negative ? "-" : "+",
                                  negative ? "+" : "-"));
    if ((negative ? field("RR2", "SLMTM") : field("RR2", "SLMTP")).test(status.rr2))
        return refuse(fmt::format("it is beyond the {} software limit; move it in {} direction", negative ? "-" : "+",
                                  negative ? "+" : "-"));
    if (settings_.travel && distance_left(negative) <= 0)
        return refuse(fmt::format("it is at pulse {}, the {} end of its travel; move it in {} direction",
                                  driver_.ReadLPS(axis_), negative ? "-" : "+", negative ? "+" : "-"));
    return {};
}

/// Pulses to the end of the travel.
std::int64_t Manual::distance_left(bool negative) {
    const std::int64_t at = driver_.ReadLPS(axis_);
    return negative ? at - settings_.travel->min : settings_.travel->max - at;
}

/// Within a travel the drive has only the pulses to its end: the chip itself cannot exceed it.
Result<void> Manual::begin_jog() {
    why_.clear();
    const bool negative = wanted_ < 0;
    const std::int64_t v = negative ? -wanted_ : wanted_;
    if (!settings_.travel) return driver_.TCurve_C(mask(), settings_.sv, v, settings_.a, negative);
    const std::int64_t distance = std::min(distance_left(negative), param::pulses.max);
    const double pulses_per_v = static_cast<double>(rules::speed_carry) / static_cast<double>(settings_.a) *
                                driver_.multiple(axis_) / rules::clock_hz;
    reserve_ = RampReserve(settings_.sv, pulses_per_v, v);
    MOTIONRACK_CHECK(driver_.SetAO(mask(), std::min(reserve_.pulses(), param::AO.max)));
    return driver_.TCurve_F(mask(), settings_.sv, v, settings_.a, negative ? -distance : distance);
}

Result<void> Manual::change_speed(std::int64_t v) {
    if (settings_.travel) {
        reserve_.change(driver_.ReadCV(axis_), v);
        MOTIONRACK_CHECK(driver_.SetAO(mask(), std::min(reserve_.pulses(), param::AO.max)));
    }
    return driver_.SetV(mask(), v);
}

Result<void> Manual::jog(std::int64_t v, Instant now) {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "Jog"));
    if (v == 0) {
        if (state_ == ManualState::jogging || state_ == ManualState::turning) stop();
        return {};
    }
    step(now);  // a motion may have ended in the meantime
    MOTIONRACK_CHECK(check_ready("Jog", v));
    const bool turns = (v < 0) != (wanted_ < 0);
    if (state_ == ManualState::standing) {
        wanted_ = v;
        MOTIONRACK_CHECK(begin_jog());
        state_ = ManualState::jogging;
    } else if (state_ == ManualState::jogging && !turns) {
        if (v != wanted_) MOTIONRACK_CHECK(change_speed(v < 0 ? -v : v));
    } else if (state_ != ManualState::turning) {
        driver_.SlowStop(mask());
        state_ = ManualState::turning;
    }
    wanted_ = v;
    until_ = now + settings_.hold;
    return {};
}

Result<void> Manual::step_jog(std::int64_t pulses, std::int64_t v) {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "Step"));
    if (state_ != ManualState::standing)
        return fail(ErrorKind::refused,
                    fmt::format("Step jog of {}: it is {}. Nothing was moved; stop it first.", name(), state_name()));
    if (pulses == 0)
        return fail(
            ErrorKind::refused,
            fmt::format("Step jog of {}: the distance is 0 pulses; it must not be 0. Nothing was moved.", name()));
    if (v < 0)
        return fail(ErrorKind::refused,
                    fmt::format("Step jog of {}: the speed is {}; it must be 0 or more. Nothing was moved. "
                                "The sign of the pulses is the direction.",
                                name(), v));
    MOTIONRACK_CHECK(check_ready("Step", pulses < 0 ? -v : v));
    why_.clear();
    MOTIONRACK_CHECK(driver_.TCurve_F(mask(), settings_.sv, v, settings_.a, pulses));
    state_ = ManualState::stepping;
    return {};
}

Result<void> Manual::home(const HomeSettings& settings, Instant now) {
    if (state_ != ManualState::homing) {
        if (state_ != ManualState::standing)
            return fail(
                ErrorKind::refused,
                fmt::format("Manual home of {}: it is {}. Nothing was moved; stop it first.", name(), state_name()));
        MOTIONRACK_CHECK(home_.start(settings, now));
        why_.clear();
        state_ = ManualState::homing;
    }
    until_ = now + settings_.hold;
    return {};
}

void Manual::step(Instant now) {
    if (state_ == ManualState::standing) return;
    if (state_ == ManualState::homing) {
        if (now >= until_) home_.stop();
        home_.step(now);
        if (home_.running()) return;
        state_ = ManualState::standing;
        if (!home_.homed()) why_ = home_.report().sentence;
        return;
    }
    const bool held = now < until_;
    if ((state_ == ManualState::jogging || state_ == ManualState::turning) && !held) stop();
    if (driver_.moving(mask())) {
        rests_until_ = now + turn_rest;
        return;
    }
    const bool turns = state_ == ManualState::turning && held;
    if (turns && now < rests_until_) return;
    end_drive();
    if (turns) {
        state_ = ManualState::standing;
        const Result<void> begun = [&]() -> Result<void> {
            MOTIONRACK_CHECK(check_ready("Jog", wanted_));
            return begin_jog();
        }();
        if (begun)
            state_ = ManualState::jogging;
        else
            why_ = begun.error().message;
        return;
    }
    state_ = ManualState::standing;
}

/// Reason of the end. Fixed drives of other functions reserve no pulses for their end.
void Manual::end_drive() {
    why_ = driver_.axis_status(axis_).why_stopped();
    if (!settings_.travel || state_ == ManualState::stepping) return;
    static_cast<void>(driver_.SetAO(mask(), std::nullopt));
    const bool negative = wanted_ < 0;
    if (why_.empty() && state_ == ManualState::jogging && distance_left(negative) <= 0)
        why_ = fmt::format("the {} soft limit was reached", negative ? "-" : "+");
}

void Manual::stop() {
    if (state_ == ManualState::homing) {
        home_.stop();
        until_ = Instant{0};
        return;
    }
    driver_.SlowStop(mask());
    if (state_ != ManualState::standing) state_ = ManualState::stopping;
}

void Manual::stop_now() {
    if (state_ == ManualState::homing) home_.stop();
    driver_.QuickStop(mask());
    if (state_ != ManualState::standing && state_ != ManualState::homing) state_ = ManualState::stopping;
}

}  // namespace motionrack::mcx314
