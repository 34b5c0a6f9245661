// Commands of the axis and their translation into commands of the card.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/databoard4002/axes/position_axis.hpp>
#include <utility>

namespace motionrack::databoard4002 {

namespace {

constexpr Duration min_progress_time = milliseconds(500);  // a heavy load needs some time until it moves
constexpr double count_slack = 1e-6;                       // a value this close to a whole count is taken as whole
constexpr std::int64_t min_progress = 2;                   // with one broken line the count alternates by one

/// Time between two progress checks: 10 times `min_progress` at `speed` counts/s, at least `min_progress_time`.
Duration progress_time(double speed) {
    return std::max(min_progress_time, from_seconds(10 * min_progress / std::max(speed, 1e-3)));
}

}  // namespace

PositionAxis::PositionAxis(Driver& driver, Interrupt& host, const PositionAxisSettings& settings)
    : driver_(driver), host_(host), settings_(settings), search_(driver, host) {
    MOTIONRACK_ASSERT(settings.counts_per_unit > 0);
}

Result<void> PositionAxis::set_up() {
    const control::AxisLimits& limits = settings_.limits;
    const double scale = settings_.counts_per_unit;
    SlopeDemand demand;
    demand.top_speed = limits.max_velocity * scale;
    demand.acceleration = demand.deceleration = limits.max_accel * scale;
    demand.creep_speed = limits.max_velocity_step < limits.max_velocity ? limits.max_velocity_step * scale : 0;
    demand.lag_s = settings_.lag_s;
    auto table = design_slope(demand, settings_.scale);
    if (!table) return refuse("Setting up", table.error().message);
    table_ = *table;
    MOTIONRACK_CHECK(driver_.connect());
    MOTIONRACK_CHECK(driver_.set_slope(table_));
    MOTIONRACK_TRY(last_counts_, driver_.position());
    doing_ = Doing::nothing;
    position_valid_ = unanswered_ = false;
    set_up_at_ = host_.now();
    error_.reset();
    return {};
}

// ---- refused commands

tl::unexpected<Error> PositionAxis::refuse(const char* what, const std::string& why) const {
    return fail(ErrorKind::refused, fmt::format("{} of axis {}: {}. Nothing was moved.", what, settings_.name, why));
}

Result<int> PositionAxis::rate_of(const char* what, double speed) const {
    if (!(std::isfinite(speed) && speed > 0 && speed <= settings_.limits.max_velocity))
        return refuse(what, fmt::format("the velocity is {} {}/s; it must be above 0 and up to {}", speed,
                                        settings_.unit, settings_.limits.max_velocity));
    const int rate = settings_.scale.rate_for(speed * settings_.counts_per_unit * (1 + 1e-12));
    if (rate > 0) return rate;
    return refuse(what, fmt::format("the velocity is {} {}/s, but the card's slowest rate gives {:.4g}", speed,
                                    settings_.unit, settings_.scale.speed(1) / settings_.counts_per_unit));
}

Result<void> PositionAxis::check_free(const char* what, bool forward) {
    if (busy()) return refuse(what, "it moves; stop it and wait for standstill");
    const StatusByte status = driver_.status();
    if (status.emergency()) return refuse(what, "the emergency stop is active; release it");
    if (status.end_stop(forward))
        return refuse(what, fmt::format("it is on the {} end stop; move it in {} direction", forward ? "right" : "left",
                                        forward ? "-" : "+"));
    return {};
}

// ---- moves

Result<std::int64_t> PositionAxis::counts() {
    MOTIONRACK_TRY(last_counts_, driver_.position());
    return last_counts_;
}

double PositionAxis::position() {
    static_cast<void>(counts());
    return offset_ + static_cast<double>(last_counts_) / settings_.counts_per_unit;
}

Result<void> PositionAxis::begin(const char* what, std::int64_t target, int rate, bool forward) {
    error_.reset();
    forward_ = forward;
    hold_after_ = false;
    stop_seen_ = never;
    MOTIONRACK_CHECK(driver_.on_regulation());
    MOTIONRACK_CHECK(driver_.set_rate(rate));
    MOTIONRACK_CHECK(driver_.set_target(target));
    MOTIONRACK_TRY(const Events old, driver_.enable_events(event::POSITION | event::STOP));
    if (old.was_reset()) {
        position_valid_ = false;
        return refuse(what,
                      "the card was reset since it was set up; its table and position are lost. Home it, or set its "
                      "position: either initialises the card again");
    }
    progress_time_ = progress_time(settings_.scale.speed(rate));
    progress_from_ = last_counts_;
    progress_due_ = later(host_.now(), progress_time_);
    return driver_.go();
}

Result<void> PositionAxis::move_to(double position, double speed) {
    const control::AxisLimits& limits = settings_.limits;
    if (!position_valid_)
        return refuse("Move", "its position is not valid; home it, or set its position with set_position");
    if (!(position >= limits.min_position && position <= limits.max_position))
        return refuse("Move", fmt::format("{} {} is outside its travel of {} to {}", position, settings_.unit,
                                          limits.min_position, limits.max_position));
    MOTIONRACK_TRY(const std::int64_t here, counts());
    return move_by((position - offset_) - static_cast<double>(here) / settings_.counts_per_unit, speed);
}

Result<void> PositionAxis::move_by(double distance, double speed) {
    MOTIONRACK_TRY(const int rate, rate_of("Move", speed));
    MOTIONRACK_TRY(const std::int64_t here, counts());
    const double target = std::floor(static_cast<double>(here) + distance * settings_.counts_per_unit + 0.5);
    if (!(target >= static_cast<double>(map::min_24) && target <= static_cast<double>(map::max_24)) ||
        std::fabs(target - static_cast<double>(here)) > static_cast<double>(max_move_counts))
        return refuse(
            "Move",
            fmt::format("it leads to {:.0f} counts, but the card's positions are {} to {} and its moves up to {}",
                        target, map::min_24, map::max_24, max_move_counts));
    const double there = offset_ + target / settings_.counts_per_unit, rounding = 1 / settings_.counts_per_unit;
    if (position_valid_ &&
        (there < settings_.limits.min_position - rounding || there > settings_.limits.max_position + rounding))
        return refuse("Move", fmt::format("{:.4f} {} is outside its travel of {} to {}", there, settings_.unit,
                                          settings_.limits.min_position, settings_.limits.max_position));
    const bool forward = target >= static_cast<double>(here);
    MOTIONRACK_CHECK(check_free("Move", forward));
    MOTIONRACK_CHECK(begin("Move", static_cast<std::int64_t>(target), rate, forward));
    doing_ = Doing::moving;
    hold_after_ = true;
    return {};
}

// ---- jogging

Result<void> PositionAxis::begin_jog(double speed, Instant now) {
    const bool forward = speed > 0;
    MOTIONRACK_TRY(const int rate, rate_of("Jog", std::fabs(speed)));
    MOTIONRACK_CHECK(check_free("Jog", forward));
    MOTIONRACK_TRY(const std::int64_t here, counts());
    const double end = forward ? settings_.limits.max_position : settings_.limits.min_position;
    const double counts_to_end = (end - offset_) * settings_.counts_per_unit;
    const auto limit = static_cast<std::int64_t>(forward ? std::floor(counts_to_end + count_slack)
                                                         : std::ceil(counts_to_end - count_slack));
    const std::int64_t counter_end = forward ? map::max_24 : map::min_24;
    const std::int64_t target =
        std::clamp(position_valid_ ? limit : counter_end, std::max(map::min_24, here - max_move_counts),
                   std::min(map::max_24, here + max_move_counts));
    if (forward ? target <= here : target >= here) return refuse("Jog", "it is at the end of its travel");
    MOTIONRACK_CHECK(begin("Jog", target, rate, forward));
    doing_ = Doing::jogging;
    speed_ = wanted_ = settings_.scale.speed(rate);
    at_ = renewed_ = now;
    return {};
}

Result<void> PositionAxis::jog(double speed, Instant now) {
    if (speed == 0) {
        next_jog_ = 0;
        if (doing_ == Doing::jogging) stop();
        return {};
    }
    if (doing_ == Doing::nothing && !search_.running()) return begin_jog(speed, now);
    if (doing_ == Doing::moving || search_.running()) return refuse("Jog", "it moves; stop it and wait for standstill");
    if (error_) return refuse("Jog", "something has stopped it; wait for standstill");
    MOTIONRACK_TRY(const int rate, rate_of("Jog", std::fabs(speed)));
    renewed_ = now;
    if (doing_ == Doing::jogging && (speed > 0) == forward_) {
        wanted_ = settings_.scale.speed(rate);
        return {};
    }
    if (doing_ == Doing::jogging) stop();
    next_jog_ = speed;  // after a stop
    return {};
}

/// Changes the velocity towards the jog command with the axis' acceleration.
void PositionAxis::jog_on(Instant now) {
    if (now - renewed_ > settings_.hold) return stop();
    const double change = settings_.limits.max_accel * settings_.counts_per_unit * to_seconds(now - at_);
    at_ = now;
    const double next = std::clamp(wanted_, speed_ - change, speed_ + change);
    if (next == speed_) return;
    speed_ = next;
    progress_time_ = progress_time(speed_);
    if (const Result<void> set = driver_.set_rate(std::max(1, settings_.scale.rate_for(speed_ * (1 + 1e-12)))); !set)
        end_with(set.error());
}

/// Detects a blocked or unpowered motor, and an encoder whose counts stand still or run the wrong way.
void PositionAxis::look_at_progress(Instant now) {
    const auto here = counts();
    if (!here) return end_with(here.error());
    const std::int64_t gone = (*here - std::exchange(progress_from_, *here)) * (forward_ ? 1 : -1);
    progress_due_ = later(now, progress_time_);
    if (gone >= min_progress) return;
    end_with({ErrorKind::machine,
              fmt::format("Axis {} does not follow: {} counts in {:.3f} s in {} direction, at {:.4f} {}. The move was "
                          "ended and the position is not valid: the motor is held or has no voltage, or its encoder "
                          "is not counted. Check both, then home it.",
                          settings_.name, gone, to_seconds(progress_time_), forward_ ? "+" : "-",
                          offset_ + static_cast<double>(*here) / settings_.counts_per_unit, settings_.unit)});
}

// ---- stops

/// Aborts a running search; its motor stops. Returns false if no search was running.
bool PositionAxis::stop_search() {
    if (!search_.running()) return false;
    search_.stop();
    rest(host_.now());
    return true;
}

void PositionAxis::stop() {
    if (stop_search()) return;
    if (doing_ != Doing::moving && doing_ != Doing::jogging) return;
    const auto rate = driver_.rate();
    if (!rate) return end_with(rate.error());
    doing_ = Doing::stopping;
    hold_after_ = false;
    next_jog_ = 0;
    speed_ = settings_.scale.speed(std::abs(*rate));
    at_ = host_.now();
}

void PositionAxis::stop_now() {
    if (stop_search()) return;
    next_jog_ = 0;
    if (const Result<void> done = driver_.quit(); !done) return end_with(done.error());
    if (doing_ == Doing::nothing) return;
    rest(host_.now());
    hold_after_ = false;
}

void PositionAxis::ramp_down(Instant now) {
    const double creep =
        std::min(settings_.limits.max_velocity_step, settings_.limits.max_velocity) * settings_.counts_per_unit;
    speed_ -= settings_.limits.max_accel * settings_.counts_per_unit * to_seconds(now - at_);
    at_ = now;
    const int rate = speed_ > creep ? settings_.scale.rate_for(speed_) : 0;
    const Result<void> done = rate > 0 ? driver_.set_rate(rate) : driver_.quit();
    if (!done) return end_with(done.error());
    if (rate == 0) rest(now);
}

/// Waits until the motor, whose output is 0, has stopped.
void PositionAxis::rest(Instant now) {
    doing_ = Doing::settling;
    still_since_ = now;
}

/// Ends the motion with an error. `counted`: the card answers and counts, so the position stays valid.
void PositionAxis::end_with(Error error, bool counted) {
    error_ = std::move(error);
    position_valid_ = position_valid_ && counted;
    unanswered_ = unanswered_ || !counted;
    hold_after_ = false, next_jog_ = 0;
    static_cast<void>(driver_.quit());
    rest(host_.now());
}

// ---- position and home

Result<void> PositionAxis::set_position(double position) {
    const double max_position = static_cast<double>(max_move_counts) / settings_.counts_per_unit;
    if (!(std::fabs(position) <= max_position))
        return refuse("Position", fmt::format("it is {0}; it must be -{1:.0f} to {1:.0f} {2}", position, max_position,
                                              settings_.unit));
    if (busy()) return refuse("Position", "it moves; stop it and wait for standstill");
    // The card's events show whether its watchdog has reset the card in the meantime.
    if (host_.now() != set_up_at_) MOTIONRACK_CHECK(driver_.enable_events(event::POSITION | event::STOP));
    if (unanswered_ || driver_.met_reset()) MOTIONRACK_CHECK(set_up());
    MOTIONRACK_TRY(const std::int64_t here, counts());
    offset_ = position - static_cast<double>(here) / settings_.counts_per_unit;
    position_valid_ = true;
    return {};
}

Result<void> PositionAxis::home(const control::HomingRequest& order, Instant now) {
    MOTIONRACK_TRY(const int rate, rate_of("Homing", order.search_velocity));
    MOTIONRACK_TRY(const int slow, rate_of("Homing", order.latch_velocity));
    if (busy()) return refuse("Homing", "it moves; stop it and wait for standstill");
    if (!(order.backoff >= 0 && std::isfinite(order.backoff) && std::isfinite(order.home_offset) && order.travel >= 0 &&
          std::isfinite(order.travel)))
        return refuse("Homing", "backoff, travel and home offset must be numbers, the first two 0 or more");
    const control::AxisLimits& limits = settings_.limits;
    const double travel = order.travel > 0 ? order.travel : 1.2 * (limits.max_position - limits.min_position);
    HomeFrame frame;
    frame.name = settings_.name;
    frame.unit = settings_.unit;
    frame.counts_per_unit = settings_.counts_per_unit;
    frame.speed_rate = rate;
    frame.slow_rate = slow;
    frame.travel = static_cast<std::int64_t>(
        std::clamp(std::ceil(travel * settings_.counts_per_unit), 1.0, static_cast<double>(max_move_counts)));
    frame.offset = offset_;
    frame.settle = settings_.settle;
    position_valid_ = hold_after_ = false;
    error_.reset();
    search_.begin(order, frame, now);
    if (!driver_.met_reset()) return {};
    MOTIONRACK_CHECK(set_up());  // the card was reset in between, as it has just reported
    search_.begin(order, frame, now);
    return {};
}

}  // namespace motionrack::databoard4002
