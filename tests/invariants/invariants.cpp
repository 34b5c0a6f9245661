// Invariants, one function each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/gcode/program_reader.hpp>
#include <tests/invariants/invariants.hpp>
#include <utility>

namespace motionrack::test {

namespace {

using operate::MachineState;

/// Minimum interval of mean velocities.
constexpr Duration interval = milliseconds(10);
/// Time after which a driver has seen all axes at standstill where their card has stopped one of them.
constexpr Duration fails_within = milliseconds(300);
constexpr Duration lasers_off_within = milliseconds(4);
/// A position error is found within one or two checks at standstill, and slightly later than the lost pulses during
/// motion.
constexpr Duration off_standing = milliseconds(100), off_moving = milliseconds(40);

/// Hysteresis of the switch, plus the distance moved during its detection.
constexpr double home_tolerance = 0.5;

bool moves(MachineState state) {
    return !operate::is_stationary(state);
}

}  // namespace

std::string_view name_of(Rule rule) {
    constexpr std::array<std::string_view, 15> names = {"motion needs an order",
                                                        "a stop slows",
                                                        "a stop stays",
                                                        "a stop is taken",
                                                        "a reset is needed",
                                                        "a valid position is true",
                                                        "counters are pulses",
                                                        "limits are kept",
                                                        "travel is kept",
                                                        "one alarm a cause",
                                                        "time is monotone",
                                                        "nothing that was taken is missing",
                                                        "same seed, same history",
                                                        "nothing is allocated in the kernel's run",
                                                        "the machine can be used again"};
    return names[static_cast<std::size_t>(rule)];
}

Invariants::Invariants(std::vector<AxisFacts> axes, const Settings& settings, Report report)
    : facts_(std::move(axes)), settings_(settings), report_(std::move(report)), own_(facts_.size()) {}

void Invariants::found(Rule rule, Instant at, std::string text) {
    if (!reported_.insert(rule).second) return;
    findings_.push_back({rule, at, std::move(text)});
    if (report_) report_(findings_.back());
}

void Invariants::ordered(Order order) {
    knows_orders_ = true;
    if (order == Order::motion) may_move_ = 3;
    if (order == Order::position) may_declare_ = 25;
    if (order == Order::position) alarm_texts_.clear();
    if (order == Order::part) parts_stand_ = false;
    if (order == Order::stop) stop_due_ = 2, stop_now_ = true, reset_now_ = false;
    if (order == Order::reset) reset_ = reset_now_ = true, stop_now_ = false;
}

/// A motor that is held or pushed may have a position error until the next check.
void Invariants::disturbed() {
    may_declare_ = 25;
}

void Invariants::see(const Sight& now) {
    if (std::exchange(first_, false)) {
        base_at_ = now.at;
        for (std::size_t i = 0; i < own_.size(); ++i)
            own_[i].base = now.axes[i].sent, own_[i].offset = now.axes[i].true_position - now.axes[i].commanded;
        last_ = now;
        last_.alarms = nullptr;
        return see_alarms(now);
    }
    searched_ = searches_;
    searches_ = now.state == MachineState::homing || (searches_ && moves(now.state));
    serviced_ = serviced_ || now.state == MachineState::service;
    see_time(now);
    see_motion(now);
    see_counters(now);
    see_positions(now);
    see_travel(now);
    see_stop(now);
    see_parts(now);
    see_alarms(now);
    if (now.latched && now.abrupt) jumped_ = true;
    braked_ = braked_ || now.latched;
    if (now.at - base_at_ >= interval) end_interval(now);
    see_jumps(now);
    if (!searches_) search_disturbed_ = false;
    if (may_declare_ > 0) --may_declare_;
    if (hangs_ > 0) --hangs_;
    if (may_move_ > 0) --may_move_;
    last_ = now;
    last_.alarms = nullptr;
}

// ---- time

void Invariants::see_time(const Sight& now) {
    if (now.at < last_.at)
        found(Rule::time_is_monotone, now.at,
              fmt::format("the picture {} is of {:.6f} s, the one before of {:.6f} s", now.sequence, to_seconds(now.at),
                          to_seconds(last_.at)));
    if (now.sequence <= last_.sequence)
        found(Rule::time_is_monotone, now.at,
              fmt::format("picture {} came behind picture {}", now.sequence, last_.sequence));
}

// ---- motion

void Invariants::see_motion(const Sight& now) {
    const bool stand = !moves(now.state) && !moves(last_.state);
    for (std::size_t i = 0; i < facts_.size(); ++i) {
        if (facts_[i].servo || !moved(i, now)) continue;  // a servo oscillates around its position
        const auto pulses = now.axes[i].sent - last_.axes[i].sent;
        if (stand && !now.by_writes && !last_.by_writes)
            found(Rule::motion_needs_order, now.at,
                  fmt::format("axis {} was sent {} pulses in the state '{}'", facts_[i].letter, pulses,
                              operate::name_of(now.state)));
        if (!now.axes[i].enabled && !last_.axes[i].enabled)
            found(Rule::motion_needs_order, now.at,
                  fmt::format("axis {} is disabled and was sent {} pulses", facts_[i].letter, pulses));
    }
    if (!knows_orders_) return;
    if (moves(now.state) && operate::idle(last_.state) && !may_move_)
        found(Rule::motion_needs_order, now.at,
              fmt::format("the machine went from '{}' to '{}', and no order was taken", operate::name_of(last_.state),
                          operate::name_of(now.state)));
}

/// While no axis is homed and no position is set, counters change with the pulses.
void Invariants::see_counters(const Sight& now) {
    const bool by_order = searches_ || searched_ || (operate::idle(now.state) && (!knows_orders_ || may_declare_)) ||
                          (operate::idle(last_.state) && (!knows_orders_ || may_declare_));
    for (std::size_t i = 0; i < facts_.size() && !by_order; ++i) {
        if (facts_[i].servo || !now.axes[i].position_valid) continue;
        const auto sent = now.axes[i].sent - last_.axes[i].sent, counted = now.axes[i].counter - last_.axes[i].counter;
        if (static_cast<std::int32_t>(sent - counted) == 0) continue;  // counters have 32 bits
        found(Rule::counters_are_pulses, now.at,
              fmt::format("axis {} was sent {} pulses and its counter went by {} in the state '{}'", facts_[i].letter,
                          sent, counted, operate::name_of(now.state)));
    }
}

// ---- positions

void Invariants::see_positions(const Sight& now) {
    for (std::size_t i = 0; i < facts_.size(); ++i) {
        Own& own = own_[i];
        const AxisSight &axis = now.axes[i], &before = last_.axes[i];
        const double off = axis.true_position - axis.commanded;
        // A set position is the one the operator entered, also if a motion starts with the next command. A homed one is
        // the true position from the switch edge on, also while other axes are still homing or a stop occurs.
        const auto by_pulses = static_cast<std::int32_t>(axis.sent - before.sent);  // counters have 32 bits
        // Setting the position of a servo keeps its counter and changes the position of its zero.
        const double by_card = facts_[i].servo ? (axis.commanded - before.commanded) * facts_[i].pulses_per_unit
                                               : static_cast<std::int32_t>(axis.counter - before.counter);
        const bool counts_anew = std::fabs(by_card - by_pulses) > (facts_[i].servo ? 1.5 : 0);
        const bool becomes_valid = axis.position_valid && !before.position_valid;
        const bool homed = (searches_ || searched_) && (counts_anew || becomes_valid);
        const bool declared = becomes_valid && !homed;
        const bool stood = operate::idle(now.state) || operate::idle(last_.state);
        const bool again = stood && (knows_orders_ ? may_declare_ : !moved(i, now)) && counts_anew;
        if (homed || declared || again || !axis.position_valid) own.offset = off;
        if (becomes_valid) alarm_texts_.clear();  // the same cause may invalidate it again
        if (homed && becomes_valid && !search_disturbed_ && std::fabs(off) > home_tolerance)
            found(Rule::position_is_true, now.at,
                  fmt::format("axis {} was homed, says {:.5f}, and is at {:.5f}", facts_[i].letter, axis.commanded,
                              axis.true_position));
        const double tolerance = (facts_[i].servo ? 3 : 1.5) / facts_[i].pulses_per_unit;
        const double error = std::fabs(off - own.offset);
        const bool wrong = axis.position_valid && error > tolerance && now.state != MachineState::homing;
        if (!wrong) {
            own.off = false;
            continue;
        }
        if (!std::exchange(own.off, true)) own.off_since = now.at;
        const bool stand = operate::idle(now.state);
        const bool late = now.at - own.off_since > (stand ? off_standing : off_moving);
        const bool far = stand || (now.state != MachineState::stopping && error > 1.5 * facts_[i].following_alarm);
        if (moves(now.state) && !far) own.off_since = now.at;
        if (late && far)
            found(Rule::position_is_true, now.at,
                  fmt::format(
                      "the position of axis {} is valid, {:.5f}, and it is {:.5f} off, since {:.4f} s (state '{}')",
                      facts_[i].letter, axis.commanded, error, to_seconds(own.off_since), operate::name_of(now.state)));
    }
}

/// Homing exceeds the travel deliberately and may have to stop there.
void Invariants::see_travel(const Sight& now) {
    if (searches_) return;
    for (std::size_t i = 0; i < facts_.size(); ++i) {
        const AxisSight &axis = now.axes[i], &before = last_.axes[i];
        if (!axis.position_valid || !before.position_valid || facts_[i].servo || !moved(i, now)) continue;
        const double slack = 1 / facts_[i].pulses_per_unit + control::gcode::limit_slack;
        const double out = std::max(axis.commanded - facts_[i].max_position, facts_[i].min_position - axis.commanded);
        const double was =
            std::max(before.commanded - facts_[i].max_position, facts_[i].min_position - before.commanded);
        if (out > slack && out > was)
            found(Rule::travel_kept, now.at,
                  fmt::format("axis {} went on to {:.5f}, beyond its travel from {:g} to {:g}", facts_[i].letter,
                              axis.commanded, facts_[i].min_position, facts_[i].max_position));
    }
}

// ---- stops

void Invariants::see_stop(const Sight& now) {
    // Within one slice, a reset may be carried out and another stop may follow it.
    const bool stopped_again =
        now.latched && last_.latched && now.stopped_at != last_.stopped_at && (!knows_orders_ || reset_);
    if (stop_due_ > 0 && --stop_due_ == 0 && !now.latched && !reset_)
        found(Rule::stop_is_taken, now.at,
              fmt::format("a stop was ordered in the state '{}', and no stop is in force",
                          operate::name_of(last_.state)));
    const bool rests = operate::idle(now.state) && now.state != MachineState::error_stop;
    if (last_.state == MachineState::error_stop && now.state != MachineState::error_stop) {
        if ((knows_orders_ && !reset_) || (!rests && !(knows_orders_ && may_move_ > 0)))
            found(Rule::reset_is_needed, now.at,
                  fmt::format("the error stop ended in the state '{}' without a reset", operate::name_of(now.state)));
    }
    // A stop that arrives with the reset is checked in the next slice.
    unheeded_ = now.latched && rests ? unheeded_ + 1 : 0;
    if (unheeded_ > (hangs_ > 0 ? pictures_of_a_hang : 3))
        found(Rule::reset_is_needed, now.at,
              fmt::format("the machine is in the state '{}' while a stop is in force", operate::name_of(now.state)));
    if (last_.latched && !now.latched && knows_orders_ && !reset_)
        found(Rule::reset_is_needed, now.at, "the stop ended without a reset");
    if (rests && !now.latched && stop_due_ == 0) reset_ = false;
    if (stop_now_ || (now.latched && !last_.latched && !reset_now_))
        reset_ = false;  // the reset did not know of this stop
    stop_now_ = reset_now_ = false;
    if (now.latched == last_.latched && !stopped_again) return;
    latched_at_ = now.at;
    stands_by_ = never;
    stood_ = false;
}

void Invariants::see_parts(const Sight& now) {
    if (now.latched) parts_stand_ = true;
    if (!now.latched && parts_stand_ && knows_orders_ && now.belt_velocity > last_.belt_velocity)
        found(Rule::stop_stays, now.at, "a belt or table goes on by a reset, without an order");
    if (!now.latched || now.at - latched_at_ <= lasers_off_within) return;
    if (now.lasers_on > 0)
        found(Rule::stop_slows, now.at,
              fmt::format("a laser is on {:.4f} s after a stop", to_seconds(now.at - latched_at_)));
    if (now.belt_velocity > last_.belt_velocity && last_.latched)
        found(
            Rule::stop_slows, now.at,
            fmt::format("belts went from {:g} to {:g} a second after a stop", last_.belt_velocity, now.belt_velocity));
}

/// Uses the highest velocity of the intervals with the stop command as reference; afterwards the velocity may only
/// decrease.
void Invariants::see_braking(double seconds, const Sight& now) {
    double linear = 0, rotary = 0, noise = 0, min_accel = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < facts_.size(); ++i) {
        if (facts_[i].servo) continue;
        const bool is_linear = facts_[i].letter >= 'X';
        (is_linear ? linear : rotary) += own_[i].velocity * own_[i].velocity;
        noise += 2 * rounding(i, std::min(seconds, to_seconds(interval)));
        if (own_[i].velocity != 0) min_accel = std::min(min_accel, facts_[i].max_accel);
    }
    const bool heard = now.latched && base_at_ >= latched_at_ + settings_.obeyed;
    if (!heard) linear_moves_ = linear > 0 || (now.latched && linear_moves_);
    const double velocity = std::sqrt(linear_moves_ ? linear : rotary);
    if (!heard) {
        min_velocity_ = std::max(now.latched ? min_velocity_ : 0, velocity);
        if (now.latched && linear + rotary > 0)
            stands_by_ = latched_at_ + from_seconds(0.3 + to_seconds(settings_.obeyed) + 2 * settings_.jerk_time_s +
                                                    2.5 * std::sqrt(linear + rotary) / min_accel);
        return;
    }
    if (stood_ && linear + rotary > 0)
        found(Rule::stop_stays, now.at,
              fmt::format("something moved at {:g} a second while a stop is in force, {:.3f} s after it", velocity,
                          to_seconds(now.at - latched_at_)));
    // At the end of a jerk-limited ramp the pulse interval may exceed the check interval.
    const bool driven =
        std::any_of(now.axes.begin(), now.axes.end(), [](const AxisSight& axis) { return axis.driven; });
    if (linear + rotary == 0 && !driven) stood_ = true;
    if (velocity > min_velocity_ * 1.02 + noise)
        found(Rule::stop_slows, now.at,
              fmt::format("{:.3f} s after a stop the velocity grew from {:g} to {:g} a second",
                          to_seconds(now.at - latched_at_), min_velocity_, velocity));
    min_velocity_ = std::min(min_velocity_, velocity);
    if (!stood_ && stands_by_ != never && now.at > stands_by_)
        found(Rule::stop_slows, now.at,
              fmt::format("{:.3f} s after a stop it still moves at {:g} a second", to_seconds(now.at - latched_at_),
                          velocity));
}

// ---- alarms

void Invariants::see_alarms(const Sight& now) {
    if (now.alarms == nullptr) return;
    for (const operate::Alarm& alarm : *now.alarms) {
        if (alarm.number <= last_alarm_) continue;
        last_alarm_ = alarm.number;
        if (alarm.at > now.at)
            found(Rule::time_is_monotone, now.at,
                  fmt::format("alarm {} is of {:.6f} s, which has not come", alarm.number, to_seconds(alarm.at)));
        if (alarm.active && !alarm_texts_.insert(alarm.source + ": " + alarm.text).second)
            found(Rule::one_alarm_a_cause, now.at, fmt::format("twice before a reset: {}", alarm.text));
    }
    // A reset ends all alarms except those that stay, such as that of a journal that cannot be written.
    if (std::none_of(now.alarms->begin(), now.alarms->end(),
                     [](const auto& alarm) { return alarm.active && !alarm.stays; }))
        alarm_texts_.clear();
}

// ---- velocities

void Invariants::end_interval(const Sight& now) {
    const double seconds = to_seconds(now.at - base_at_);
    for (std::size_t i = 0; i < facts_.size(); ++i) {
        Own& own = own_[i];
        const double velocity = static_cast<double>(now.axes[i].sent - own.base) / facts_[i].pulses_per_unit / seconds;
        if (!facts_[i].servo) see_limits(i, velocity, seconds, now);
        own.velocity = velocity;
        own.base = now.axes[i].sent;
    }
    see_braking(seconds, now);
    last_seconds_ = seconds;
    base_at_ = now.at;
    jumped_ = (now.latched && now.abrupt) || serviced_;
    serviced_ = now.state == MachineState::service;
    was_braked_ = std::exchange(braked_, now.latched);
}

void Invariants::see_limits(std::size_t i, double velocity, double seconds, const Sight& now) {
    const AxisFacts& facts = facts_[i];
    if (serviced_) return;  // other functions drive the axis
    if (std::fabs(velocity) > facts.max_velocity * 1.01 + 2 * rounding(i, seconds))
        found(Rule::limits_kept, now.at,
              fmt::format("axis {} went at {:g} a second, above its {:g}", facts.letter, velocity, facts.max_velocity));
    if (jumped_ || last_seconds_ == 0) return;
    const double change = std::fabs(velocity - own_[i].velocity);
    // In runs with stops without a ramp, one direction may end and the other begin, each with a velocity step.
    const bool stops_dead = settings_.known.max_velocity_step > 2;
    const int steps = stops_dead && velocity * own_[i].velocity < 0 ? 2 : 1;
    const double explained = facts.max_accel * 1.05 * (seconds + last_seconds_) / 2,
                 step = facts.velocity_step * steps * settings_.known.max_velocity_step * 1.15 +
                        2 * rounding(i, seconds) + 2 * rounding(i, last_seconds_);
    peak_accel_factor_ = std::max(peak_accel_factor_, (change - step) / explained);
    const double allowed = explained * settings_.known.max_accel + step;
    if (change <= allowed) return;
    std::string text = fmt::format(
        "the velocity of axis {} changed from {:g} to {:g} a second within {:.4f} s, by {:g}; its limits explain {:g} "
        "(state '{}')",
        facts.letter, own_[i].velocity, velocity, seconds, change, allowed, operate::name_of(now.state));
    // A card that stops a motion by itself does so before its driver knows.
    const bool ends = braked_ || was_braked_ || now.state != MachineState::homing;
    if (ends && std::fabs(velocity) < std::fabs(own_[i].velocity))
        own_[i].jumped = std::move(text), own_[i].jumped_at = now.at;
    else
        found(Rule::limits_kept, now.at, std::move(text));
}

/// During a stop or a failing motion, a card may have to end its pulses without a ramp; then the position must become
/// invalid at standstill.
void Invariants::see_jumps(const Sight& now) {
    for (std::size_t i = 0; i < facts_.size(); ++i) {
        if (!now.axes[i].position_valid) own_[i].jumped.clear();
        if (own_[i].jumped.empty()) continue;
        const bool stopped = now.state == MachineState::error_stop;
        if (!stopped && (now.latched || now.at - own_[i].jumped_at <= fails_within)) continue;
        found(Rule::limits_kept, now.at,
              std::exchange(own_[i].jumped, {}) + (stopped ? ", and its position is valid" : ""));
    }
}

}  // namespace motionrack::test
