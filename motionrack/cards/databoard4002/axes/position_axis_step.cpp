// Polling of the axis: supervision of the motion and its end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/databoard4002/axes/position_axis.hpp>
#include <utility>

namespace motionrack::databoard4002 {

namespace {

constexpr Duration poll_period = milliseconds(1);
// The watchdog resets a hung card after one second; the motor coasts to a stop.
constexpr Duration watchdog_rest = milliseconds(1'500);

}  // namespace

void PositionAxis::look_at_events(Instant now) {
    if (!driver_.status().event()) return;
    const auto seen = driver_.enable_events(event::POSITION | event::STOP);
    if (!seen) return end_with(seen.error());
    if (seen->was_reset())
        return end_with(
            {ErrorKind::machine,
             fmt::format("The card of axis {} was reset while it moved (its watchdog, or the bus); its position is not "
                         "valid. Home it, which initialises the card again.",
                         settings_.name)});
    if (seen->stop()) stop_seen_ = later(now, contacts_rest);
    if (seen->position() && (doing_ == Doing::moving || doing_ == Doing::jogging || doing_ == Doing::stopping))
        rest(now);
}

/// Ends the motion if a stop blocks the axis; called when the contacts of the stop have settled. A stop on the other
/// side is ignored.
void PositionAxis::look_at_stop() {
    stop_seen_ = never;
    const StatusByte status = driver_.status();
    std::string why = status.emergency() || status.end_stop(forward_) ? status.stops() : std::string();
    if (why.empty()) {
        const auto rate = driver_.rate();
        if (!rate) return end_with(rate.error());
        if (*rate != 0 || driver_.status().event()) return;
        why = "the emergency stop was active";
    }
    end_with(
        {ErrorKind::machine,
         fmt::format(
             "Axis {} reached a stop at {:.4f} {}: {}. The move was ended; its position is still counted. Move it the "
             "other way, or release the stop.",
             settings_.name, position(), settings_.unit, why)},
        true);
}

void PositionAxis::settle(Instant now) {
    const std::int64_t before = last_counts_;
    const auto here = counts();
    // It hung for less than its watchdog allows, and drives on by its last commands.
    const bool drives_on = here && driver_.quit_due();
    if (!here || (drives_on && !driver_.quit())) {
        position_valid_ = false, unanswered_ = true;
        if (!here && !error_) error_ = here.error();
        if (now - still_since_ > watchdog_rest) doing_ = Doing::nothing;  // until then it may still drive
        return;
    }
    if (drives_on || *here != before) still_since_ = now;
    if (now - still_since_ < settings_.settle) return;
    doing_ = Doing::nothing;
    if (next_jog_ != 0) {
        const double speed = std::exchange(next_jog_, 0);
        if (const Result<void> begun = begin_jog(speed, now); !begun) error_ = begun.error();
        return;
    }
    if (!hold_after_ || error_ || !settings_.position_window) return;
    const auto window =
        static_cast<std::int64_t>(std::floor(*settings_.position_window * settings_.counts_per_unit + 0.5));
    Result<void> held = driver_.set_deviation(window);
    if (held) held = driver_.lock();
    if (!held) error_ = held.error();
}

void PositionAxis::step(Instant now) {
    if (search_.running()) {
        search_.step(now);
        if (search_.homed()) {
            offset_ = search_.home_position();
            position_valid_ = true;
        } else if (!search_.running()) {
            rest(now);
        }
        return;
    }
    if (doing_ == Doing::nothing) return;
    look_at_events(now);
    if (now >= stop_seen_) look_at_stop();
    if (now >= progress_due_ && (doing_ == Doing::moving || doing_ == Doing::jogging)) look_at_progress(now);
    switch (doing_) {
        case Doing::jogging:
            return jog_on(now);
        case Doing::stopping:
            return ramp_down(now);
        case Doing::settling:
            return settle(now);
        default:
            return;
    }
}

Result<void> PositionAxis::wait(Duration timeout) {
    const Instant end = later(host_.now(), timeout);
    const bool homing = search_.running();
    bool asked = false;
    while (true) {
        step(host_.now());
        if (!busy()) break;
        if (!asked && host_.stop_requested()) {
            asked = true;
            stop();
        }
        if (host_.now() >= end)
            return fail(
                ErrorKind::machine,
                fmt::format(
                    "Axis {} still moves after {:.3f} s, at {:.4f} {}; nothing was stopped. Wait longer, or stop it.",
                    settings_.name, to_seconds(timeout), position(), settings_.unit));
        host_.pass(poll_period);
    }
    if (homing && !search_.homed()) return tl::unexpected<Error>(search_.error());
    if (asked)
        return fail(ErrorKind::stopped, fmt::format("Axis {} was stopped on request at {:.4f} {}.", settings_.name,
                                                    position(), settings_.unit));
    if (error_) return tl::unexpected<Error>(*error_);
    return {};
}

control::AxisState PositionAxis::state() {
    using control::AxisState;
    if (search_.running()) return AxisState::homing;
    switch (doing_) {
        case Doing::moving:
            return AxisState::moving;
        case Doing::jogging:
            return AxisState::jogging;
        case Doing::stopping:
            return AxisState::stopping;
        case Doing::settling:
            return hold_after_ ? AxisState::moving : AxisState::stopping;
        case Doing::nothing:
            break;
    }
    return error_ || driver_.status().emergency() ? AxisState::error : AxisState::standstill;
}

}  // namespace motionrack::databoard4002
