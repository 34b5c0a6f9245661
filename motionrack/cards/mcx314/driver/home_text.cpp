// Homing messages: refusals, and a sentence for every result.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/cards/mcx314/driver/home.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <tuple>

namespace motionrack::mcx314 {

namespace {

/// Formats a number with separators: "12,345".
std::string grouped(std::int64_t value) {
    std::string digits = fmt::format("{}", value < 0 ? -value : value);
    for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
    if (value < 0) digits.insert(0, 1, '-');
    return digits;
}

struct Bound {
    const char* name;
    std::int64_t value, min, max;
};

}  // namespace

// ---- the report

std::int64_t HomeReport::relative(std::int32_t lp) const {
    return pulse_delta(zero_lp, lp) + home_position;
}

std::optional<std::int64_t> HomeReport::switch_to_index() const {
    if (!switch_lp || !index_lp) return {};
    const std::int64_t distance = relative(*index_lp) - relative(*switch_lp);
    return distance < 0 ? -distance : distance;
}

Result<void> HomeReport::result() const {
    if (homed) return {};
    return motionrack::fail(fault == HomeFault::stopped ? ErrorKind::stopped : ErrorKind::machine, sentence);
}

// ---- refusals

Result<HomeSettings> home_settings(int type, unsigned WR1Reg, std::int64_t SV, std::int64_t V, std::int64_t A) {
    if (type < 1 || type > 4)
        return motionrack::fail(ErrorKind::refused,
                                fmt::format("The homing method is {}; it must be 1 to 4. Nothing was moved.", type));
    HomeSettings out;
    const bool to_index = type >= 3;
    out.type = type == 4 ? 5 : type;
    out.sv = SV;
    out.v = V;
    out.a = A;
    if (type == 3) out.slow_v = SV;
    constexpr int in2 = 2, in3 = 3;
    const auto enabled = [&](int input) { return (WR1Reg >> 2 * input & 2) != 0; };
    out.input = -1;
    for (int i = in3; i >= 0; --i)
        if (enabled(i) && !(to_index && i == in2)) out.input = i;
    if (out.input < 0 && enabled(in2)) {
        out.input = in2;
        out.index_input = in3;
    }
    if (out.input < 0)
        return motionrack::fail(
            ErrorKind::refused,
            fmt::format("HomeType{}: WR1Reg is {:04X}h, which enables none of IN0 to IN3 as home switch (bits 1, 3, 5, "
                        "7). Nothing was moved; enable one, with its level in the bit below.",
                        type, WR1Reg));
    out.active_high = (WR1Reg >> 2 * out.input & 1) != 0;
    out.index_high = (WR1Reg >> 2 * out.index_input & 1) != 0;
    return out;
}

Result<void> Home::check_ready() {
    MOTIONRACK_CHECK(Driver::check_channel(axis_, "Homing"));
    const HomeSettings& s = settings_;
    const std::string name = s.name.empty() ? std::string(1, "XYZU"[axis_]) : s.name;
    const auto refuse = [&](std::string why) {
        return motionrack::fail(ErrorKind::refused,
                                fmt::format("Axis {} was not homed: {}. Nothing was moved.", name, why));
    };
    const Bound bounds[] = {
        {"the type", s.type, 1, 5},
        {"the home input", s.input, 0, 3},
        {"the index input", s.index_input, 0, 3},
        {"the range R", s.range == 0 ? param::R.min : s.range, param::R.min, param::R.max},
        {"the initial speed SV", s.sv, param::SV.min, param::SV.max},
        {"the search speed V", s.v, param::V.min, param::V.max},
        {"the acceleration A", s.a, param::A.min, param::A.max},
        {"the speed off the switch (at most SV)", s.back_v == 0 ? 1 : s.back_v, 1, s.sv},
        {"the slow speed (at most SV)", s.slow_v == 0 ? 1 : s.slow_v, 1, s.sv},
        {"the travel", s.travel, 1, param::pulses.max},
        {"the pulses per revolution", s.turn, 0, param::pulses.max},
        {"the hysteresis of the switch (-1: not known)", s.hysteresis, -1, param::pulses.max},
        {"the repeatability of the switch", s.repeats, 0, param::pulses.max},
        {"the backoff", s.backoff, 0, s.travel},
        {"the settling time in ms", s.settle / milliseconds(1), 0, 10'000},
        {"the time-out in ms", s.timeout / milliseconds(1), 1, 1'000'000'000},
        {"the distance from the switch to the index (-1: any)", s.index_after, -1, param::pulses.max},
        {"the home position", s.home_position, param::LP.min, param::LP.max},
        {"the encoder's home position", s.home_counts, param::EP.min, param::EP.max},
    };
    for (const Bound& bound : bounds)
        if (bound.value < bound.min || bound.value > bound.max)
            return refuse(fmt::format("{} is {}; it must be {} to {}", bound.name, grouped(bound.value),
                                      grouped(bound.min), grouped(bound.max)));
    if (s.type >= 3 && s.input == s.index_input)
        return refuse(fmt::format("home switch and index are both IN{}", s.input));
    if (!(s.pulses_per_unit != 0) || !std::isfinite(s.pulses_per_unit))
        return refuse("the pulses per unit must be a number other than 0");
    if (running_) return refuse("it is being homed already; stop that first");
    if (driver_.status().driving(mask())) return refuse("it moves; stop it and wait for standstill");
    const DriveStatus status = driver_.axis_status(axis_);
    if (field("RR2", "EMG").test(status.rr2)) return refuse("the emergency stop is active; release it");
    if (field("RR2", "ALARM").test(status.rr2)) return refuse("its drive reports an alarm; clear it");
    if (field("RR2", "HLMTP").test(status.rr2) && field("RR2", "HLMTM").test(status.rr2))
        return refuse(
            "both limit switches are active, so it cannot move; look for a broken wire or a wrong level (WR2 "
            "HLMTP, HLMTM)");
    return {};
}

// ---- sentences

/// A distance: "1,200 pulses" or "3.7500 mm".
std::string Home::text(std::int64_t pulses) const {
    if (settings_.unit == "pulses") return grouped(pulses) + " pulses";
    return fmt::format("{:.4f} {}", static_cast<double>(pulses) / std::fabs(settings_.pulses_per_unit), settings_.unit);
}

std::string Home::place(std::int32_t lp) const {
    if (settings_.unit == "pulses") return fmt::format("LP {}", grouped(lp));
    return fmt::format("{:.4f} {} by its counter", lp / settings_.pulses_per_unit, settings_.unit);
}

std::string Home::switch_text() const {
    return fmt::format("the home switch (IN{}, active {})", settings_.input, settings_.active_high ? "High" : "Low");
}

/// The fault of switch or index, and its remedy.
std::pair<std::string, std::string> Home::input_failure(const std::string& how_far) const {
    const std::string index = fmt::format("the encoder's index (IN{}, active {})", settings_.index_input,
                                          settings_.index_high ? "High" : "Low");
    const bool found = report_.switch_lp.has_value();
    switch (report_.fault) {
        case HomeFault::not_found:
            return {fmt::format(
                        "{} was not {} within {} in {} direction{}", switch_text(), found ? "found again" : "found",
                        how_far,
                        settings_.negative == (table_->state(failed_in_).search_direction == SearchDirection::towards)
                            ? "-"
                            : "+",
                        turned_ && !found ? ", nor in the other direction up to the limit switch" : ""),
                    "Check its wire and level (RR4, RR5), or search in the other direction or farther"};
        case HomeFault::near_limit:
            return {
                fmt::format(
                    "{} is so near to the limit switch that the axis reached the limit while decelerating, after {}",
                    switch_text(), text(failed_after_)),
                "Shift the switch away from the limit, or search more slowly"};
        case HomeFault::not_released:
            return {fmt::format("{} is active and was not released within {}", switch_text(), how_far),
                    "Check whether it is stuck or its active level is set wrongly, or move the axis off it by hand"};
        case HomeFault::edges_differ:
            return {fmt::format("{} is not sound: {}", switch_text(),
                                conflict_->text([&](double distance) { return text(std::llround(distance)); })),
                    "Check for a loose wire and for contacts that break, stick or bounce for long"};
        case HomeFault::no_index:
            return {fmt::format("{} was not seen within {} after the switch", index, how_far),
                    "Check the encoder's Z wire and level, or home without it (type 1 or 2)"};
        case HomeFault::wrong_index:
            return {fmt::format("{} was found {} behind the switch; it must be {} behind it", index,
                                text(report_.switch_to_index().value_or(0)), text(settings_.index_after)),
                    "Look for a second index or noise on the encoder's Z wire, or whether the switch was moved"};
        default:
            return {
                fmt::format("{} is active at the switch edge, so another start might find another revolution", index),
                "Shift the switch by half a motor revolution, or check whether the index is stuck"};
    }
}

/// The failure, its position, the present position and the remedy; or the home position.
std::string Home::why_failed(const PollData& poll) const {
    const std::string axis = settings_.name.empty() ? std::string(1, "XYZU"[axis_]) : settings_.name;
    if (report_.homed)
        return settings_.unit == "pulses"
                   ? fmt::format("Axis {} is homed: its counter was {} at the position that is now {}.", axis,
                                 grouped(report_.zero_lp), grouped(settings_.home_position))
                   : fmt::format("Axis {} is homed: its counter was {:.4f} at the position that is now {:.4f} {}.",
                                 axis, report_.zero_lp / settings_.pulses_per_unit,
                                 static_cast<double>(settings_.home_position) / settings_.pulses_per_unit,
                                 settings_.unit);
    const bool at_limit = limit_ahead(poll, SearchDirection::towards) || limit_ahead(poll, SearchDirection::away);
    const std::string how_far = text(failed_after_) + (at_limit ? ", where a limit switch ended the search" : "");
    std::string what, next;
    switch (report_.fault) {
        case HomeFault::none:
            break;
        case HomeFault::not_found:
        case HomeFault::near_limit:
        case HomeFault::not_released:
        case HomeFault::edges_differ:
        case HomeFault::no_index:
        case HomeFault::index_at_switch:
        case HomeFault::wrong_index:
            std::tie(what, next) = input_failure(how_far);
            break;
        case HomeFault::alarm:
            what = "the drive's alarm became active", next = "Clear the cause in the drive";
            break;
        case HomeFault::emergency:
            what = "the emergency stop became active", next = "Clear the cause and release it";
            break;
        case HomeFault::time:
            what = fmt::format("{} lasted {:.3f} s, longer than it may; it had made {}", failed_in_,
                               to_seconds(report_.stays[report_.stays.size() - 3].took), text(failed_after_));
            next = "Check whether nINPOS is enabled but never active, or the home input keeps changing";
            if (failed_in_ == "SEARCH_WAIT")
                next =
                    "Check the home switch's wire and level, and whether nINPOS is enabled but never active, or "
                    "give the search more time";
            break;
        case HomeFault::foreign_stop:
            what =
                fmt::format("the drive of {} ended after {} without a reported cause", failed_in_, text(failed_after_));
            next = "No other program may command the axis meanwhile";
            break;
        case HomeFault::stopped:
            what = "it was stopped on request", next = "";
            break;
    }
    return fmt::format("Axis {} is not homed: {}. It {} {}; its position is not valid. {} again.", axis, what,
                       poll.driving ? "still moves after a stop command, at" : "was stopped at", place(poll.lp),
                       next.empty() ? "Home it" : fmt::format("{}, then home", next));
}

}  // namespace motionrack::mcx314
