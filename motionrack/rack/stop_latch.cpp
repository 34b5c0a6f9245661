// Sets the latch, leaves axes to their cards, and writes the sentences.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/stop_latch.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

/// Bounce time of a switch that has been left; it causes no new trip.
constexpr Duration bounces_for = milliseconds(20);
/// Time allowed for a card to stop by itself: a ramp from full velocity.
constexpr Duration card_has = whole_seconds(2);
/// Time allowed for the driver to detect standstill.
constexpr Duration seen_within = milliseconds(300);

struct SourceWords {
    StopSource source;
    std::string_view name, advice;
};
constexpr std::array<SourceWords, stop_sources.size()> words = {{
    {StopSource::emergency_stop, "emergency stop", "Release it, then reset."},
    {StopSource::stop_command, "STOP command", "Reset, then start again."},
    {StopSource::drive_alarm, "drive alarm", "Clear it at the drive, then reset."},
    {StopSource::limit_switch, "limit switch", "Reset, then move it off the switch."},
    {StopSource::watchdog, "watchdog", "Reset, then home."},
    {StopSource::following_error, "following error",
     "Check its motor, its load and its encoder, then reset and home it."},
}};

const SourceWords& words_of(StopSource source) {
    return words[static_cast<std::size_t>(source)];
}

}  // namespace

std::string_view name_of(StopSource source) {
    return words_of(source).name;
}

StopLatch::StopLatch(Rack& rack)
    : rack_(rack),
      kernel_(rack.kernel()),
      id_(kernel_.add(*this, sim::Phase::observers, "stop_latch")),
      following_(rack),
      ramps_(rack),
      contacts_(kernel_, rack.config().safety) {
    const auto watch = [this](const Input& input) {
        MOTIONRACK_ASSERT(input.wire != sim::WireId::none);
        kernel_.listen(input.wire, id_, static_cast<int>(inputs_.size()));
        inputs_.push_back(input);
    };
    watch({kernel_.find_wire("estop"), StopSource::emergency_stop});
    for (std::size_t c = 0; c < rack_.config().cards.size(); ++c) {
        const RackCard& card = rack_.config().cards[c];
        const CardType* type = find_card_type(card.type);
        for (const StopPin& pin : type->stop_pins) {
            const bool of_card = std::any_of(type->chip_pins.begin(), type->chip_pins.end(),
                                             [&](const PinType& own) { return own.name == pin.pin; });
            if (of_card)
                watch({kernel_.find_wire(fmt::format("{}.{}", card.name, pin.pin)), pin.source, pin.active,
                       pin.direction, static_cast<int>(c)});
            for (std::size_t a = 0; a < rack_.axes().size() && !of_card; ++a)
                if (const RackAxis& axis = rack_.axes()[a].config; axis.card == card.name)
                    watch({kernel_.find_wire(fmt::format("{}.{}{}", card.name, axis.channel, pin.pin)), pin.source,
                           pin.active, pin.direction, static_cast<int>(c), static_cast<int>(a)});
        }
        if (const auto code = rack_.cards()[c]->watchdog_condition(); code) {
            inputs_.push_back({sim::WireId::none, StopSource::watchdog, *code, 0, static_cast<int>(c)});
            has_watchdogs_ = true;
        }
    }
    for (std::size_t a = 0; a < rack_.axes().size(); ++a)
        inputs_.push_back({sim::WireId::none, StopSource::following_error, 0, 0, -1, static_cast<int>(a)});
}

bool StopLatch::is_active(const Input& input) const {
    return input.wire != sim::WireId::none && kernel_.level(input.wire) == input.active;
}

// ---- setting

void StopLatch::arm() {
    state_.armed = 1;
    const Instant now = kernel_.now();
    state_.evaluated = kernel_.dropped_conditions() + kernel_.conditions().size();
    following_.begin();
    ramps_.arm(now);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const StopSource source = inputs_[i].source;
        if (is_active(inputs_[i]) && (source == StopSource::emergency_stop || source == StopSource::drive_alarm))
            trip(source, static_cast<int>(i), now);
    }
}

void StopLatch::disarm() {
    const State before = state_;
    state_ = {};
    state_.left = before.left;
    state_.evaluated = before.evaluated;
    state_.trips = before.trips;
    state_.heeds_door = before.heeds_door;
    halted_ = false;
    following_.end();
    ramps_.end();
}

void StopLatch::on_wire(int pin, int, Instant now) {
    const Input& input = inputs_[static_cast<std::size_t>(pin)];
    if (is_active(input)) {
        if (state_.armed != 0 && trips(input, now)) trip(input.source, pin, now);
    } else if (input.source == StopSource::limit_switch) {
        left_at(input) = now;
    }
}

Instant& StopLatch::left_at(const Input& input) {
    return state_.left[2 * static_cast<std::size_t>(input.axis) + (input.direction > 0 ? 1 : 0)];
}

/// Called when an input has become active.
bool StopLatch::trips(const Input& input, Instant now) {
    if (input.source != StopSource::limit_switch) return true;
    if (const Instant left = left_at(input); left != Instant{} && now - left < bounces_for) return false;
    return (state_.searching & 1u << input.axis) == 0 || is_behind(input, now);
}

void StopLatch::search(std::size_t axis, bool on) {
    state_.searching = on ? state_.searching | 1u << axis : state_.searching & ~(1u << axis);
}

/// Returns true for a limit switch that becomes active while its axis moves away from it. The switch is wired wrongly
/// or broken, and the axis may be about to reach its other end; this also applies to homing. A switch that is already
/// active leaves the way back free.
bool StopLatch::is_behind(const Input& input, Instant now) const {
    if (input.source != StopSource::limit_switch) return false;
    const RunningAxis& axis = rack_.axes()[static_cast<std::size_t>(input.axis)];
    return axis.moves(now) && axis.velocity(now) * input.direction < 0;
}

/// Returns true if the card itself stops the motion at this input.
bool StopLatch::left_to_card(const Input& input, Instant now) const {
    const std::vector<RunningAxis>& axes = rack_.axes();
    switch (input.source) {
        case StopSource::limit_switch:
            return axes[static_cast<std::size_t>(input.axis)].moves(now) && !is_behind(input, now);
        case StopSource::emergency_stop:  // poll() finds the cards that have received it
            return std::any_of(axes.begin(), axes.end(), [now](const RunningAxis& axis) { return axis.moves(now); });
        case StopSource::watchdog:
            return std::any_of(axes.begin(), axes.end(), [&](const RunningAxis& axis) { return axis.moves(now); }) &&
                   std::all_of(axes.begin(), axes.end(),
                               [&](const RunningAxis& axis) { return !axis.moves(now) || is_on_card(axis, input); });
        case StopSource::drive_alarm:
        case StopSource::following_error:
        case StopSource::stop_command:
            break;
    }
    return false;
}

/// Returns true if the card stops this axis by itself at the input that set the latch.
bool StopLatch::is_stopped_by_card(char letter) const {
    if (state_.input < 0) return false;
    const Input& input = inputs_[static_cast<std::size_t>(state_.input)];
    const std::vector<RunningAxis>& axes = rack_.axes();
    switch (cause()) {
        case StopSource::limit_switch:
            return axes[static_cast<std::size_t>(input.axis)].config.letter == letter;
        case StopSource::emergency_stop:
            return true;
        case StopSource::watchdog:
            return std::any_of(axes.begin(), axes.end(), [&](const RunningAxis& axis) {
                return axis.config.letter == letter && is_on_card(axis, input);
            });
        case StopSource::drive_alarm:
        case StopSource::following_error:
        case StopSource::stop_command:
            break;
    }
    return false;
}

void StopLatch::trip(StopSource source, int input, Instant now) {
    const Input* from = input < 0 ? nullptr : &inputs_[static_cast<std::size_t>(input)];
    ++state_.trips;
    if ((state_.tripped & bit(source)) == 0 || source == StopSource::stop_command) state_.pending |= bit(source);
    state_.tripped |= bit(source);
    note_lost(source, from, now);
    const bool first = state_.latched == 0;
    const bool adds_cause = !first && is_ordered() && source != StopSource::stop_command;
    if (first) ramps_.begin(now);
    state_.latched = 1;
    if (first || adds_cause) {
        state_.at = now;
        state_.cause = static_cast<std::int32_t>(source);
        state_.input = input;
        if (from != nullptr && is_behind(*from, now)) state_.behind = -from->direction;
    }
    if (from == nullptr || !left_to_card(*from, now)) halted_ = true;
    kernel_.break_run();
}

void StopLatch::stays_behind(std::size_t axis, Instant now) {
    if (state_.latched != 0 && !is_ordered()) {
        state_.lost |= 1u << rack_.axes()[axis].config.index();
        state_.unfollowed |= 1u << rack_.axes()[axis].config.index();
        return;
    }
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        if (inputs_[i].source == StopSource::following_error && inputs_[i].axis == static_cast<int>(axis))
            trip(StopSource::following_error, static_cast<int>(i), now);
}

/// Marks axes with possible step loss: a motor stopped without a ramp above its start-stop rate, a drive that failed in
/// motion, or a following error. Cards that position by an encoder know their own state.
void StopLatch::note_lost(StopSource source, const Input* input, Instant now) {
    const std::vector<RunningAxis>& axes = rack_.axes();
    for (std::size_t a = 0; a < axes.size(); ++a) {
        const RunningAxis& axis = axes[a];
        if (source == StopSource::watchdog && is_on_card(axis, *input)) state_.lost |= 1u << axis.config.index();
        if (source == StopSource::following_error && input->axis == static_cast<int>(a)) {
            state_.lost |= 1u << axis.config.index();
            state_.unfollowed |= 1u << axis.config.index();
        }
        if (rack_.config().positions_alone(axis.config)) continue;
        const double velocity = std::fabs(axis.velocity(now));
        const bool without_ramp = source == StopSource::emergency_stop && velocity > axis.config.max_velocity_step;
        const bool drive_gave_up =
            source == StopSource::drive_alarm && input->axis == static_cast<int>(a) && velocity > 0;
        if (without_ramp || drive_gave_up) state_.lost |= 1u << axis.config.index();
    }
}

void StopLatch::stop() {
    trip(StopSource::stop_command, -1, kernel_.now());
    poll();
}

bool StopLatch::is_on_card(const RunningAxis& axis, const Input& input) const {
    return input.card >= 0 && rack_.cards()[static_cast<std::size_t>(input.card)]->motion() == axis.card;
}

// ---- executing

/// Sets the latch for new watchdog conditions of the cards; conditions are polled because no device receives them.
void StopLatch::look_at_watchdogs() {
    const std::vector<sim::Condition> conditions = kernel_.conditions();
    const std::uint64_t dropped = kernel_.dropped_conditions();
    for (std::size_t k = state_.evaluated > dropped ? state_.evaluated - dropped : 0; k < conditions.size(); ++k)
        for (std::size_t i = 0; i < inputs_.size(); ++i)
            if (inputs_[i].source == StopSource::watchdog && conditions[k].code == inputs_[i].active &&
                rack_.cards()[static_cast<std::size_t>(inputs_[i].card)]->device() == conditions[k].device)
                trip(StopSource::watchdog, static_cast<int>(i), conditions[k].at);
    state_.evaluated = dropped + conditions.size();
}

void StopLatch::poll() {
    if (state_.armed != 0 && has_watchdogs_) look_at_watchdogs();
    if (state_.armed != 0 && state_.heeds_door != 0 && state_.latched == 0 && contacts_.door_open()) {
        state_.by_door = 1;
        trip(StopSource::stop_command, -1, std::max(contacts_.door_opened(), Instant{}));
    }
    if (state_.latched == 0) return;
    for (const StopSource source : stop_sources)
        if ((std::exchange(state_.pending, state_.pending & ~bit(source)) & bit(source)) != 0) react(rack_, source);
    if (halted_) return;
    const Instant now = kernel_.now();
    bool any = false, is_received = true;
    for (const RunningAxis& axis : rack_.axes()) {
        if (!axis.moves(now)) continue;
        any = true;
        for (const Input& input : inputs_)
            if (input.source == StopSource::emergency_stop && cause() == input.source && is_on_card(axis, input))
                is_received = is_received && is_active(input);
    }
    const Duration since = now - state_.at;
    if (!is_received || since > card_has || (!any && since > seen_within)) halted_ = true;
}

void StopLatch::settle(bool failed) {
    if (state_.latched == 0) {
        if (failed && state_.armed != 0) ramps_.look_back(kernel_.now());
        return;
    }
    halted_ = true;
    ramps_.settle();
}

// ---- resetting

Result<void> StopLatch::reset() {
    if (contacts_.differs())
        return fail(ErrorKind::refused,
                    "Not reset: the two channels of the emergency stop differ. Nothing was changed; check both "
                    "contacts and their wires, then reset.");
    for (const Input& input : inputs_) {
        if (!is_active(input)) continue;
        if (input.source == StopSource::emergency_stop)
            return fail(ErrorKind::refused,
                        "Not reset: the emergency stop is still pressed. Nothing was changed; release it, then reset.");
        if (input.source == StopSource::drive_alarm)
            return fail(ErrorKind::refused,
                        fmt::format("Not reset: the drive of {} still reports an alarm. Nothing was changed; clear it "
                                    "at the drive, then reset.",
                                    rack_.axes()[static_cast<std::size_t>(input.axis)].config.letter));
    }
    disarm();
    state_.armed = 1;
    following_.begin();
    ramps_.arm(kernel_.now());
    return {};
}

// ---- sentences

std::string StopLatch::input_text() const {
    const Input* input = state_.input < 0 ? nullptr : &inputs_[static_cast<std::size_t>(state_.input)];
    const char letter =
        input == nullptr || input->axis < 0 ? '?' : rack_.axes()[static_cast<std::size_t>(input->axis)].config.letter;
    switch (cause()) {
        case StopSource::emergency_stop:
            return "The emergency stop was pressed";
        case StopSource::stop_command:
            return state_.by_door != 0 ? "The door was opened" : "Stopped on request";
        case StopSource::drive_alarm:
            return fmt::format("The drive of {} reported an alarm", letter);
        case StopSource::limit_switch:
            if (state_.behind != 0)
                return fmt::format("The {} limit switch of {} became active while {} moved in {} direction",
                                   input->direction > 0 ? "+" : "-", letter, letter, state_.behind > 0 ? "+" : "-");
            return fmt::format("The {} limit switch of {} was reached", input->direction > 0 ? "+" : "-", letter);
        case StopSource::watchdog:
            return fmt::format("The watchdog of card {} restarted it",
                               rack_.config().cards[static_cast<std::size_t>(input->card)].name);
        case StopSource::following_error:
            return following_.alarm_text(static_cast<std::size_t>(input->axis));
    }
    return {};
}

std::string StopLatch::sentence() const {
    return fmt::format("{} at {:.3f} s.", input_text(), to_seconds(state_.at));
}

std::string StopLatch::position_sentence() const {
    constexpr std::array<std::string_view, 3> reasons = {"its motor did not follow, or its encoder does not count",
                                                         "its card was reset and counts from 0",
                                                         "steps may have been lost"};
    std::array<std::string, reasons.size()> lost;
    for (const RunningAxis& axis : rack_.axes()) {
        const int index = axis.config.index();
        if (keeps_position(index)) continue;
        const bool unfollowed = (state_.unfollowed & 1u << index) != 0;
        std::string& axes = lost[unfollowed ? 0 : rack_.config().positions_alone(axis.config) ? 1 : 2];
        axes += fmt::format("{}{}", axes.empty() ? "" : ", ", axis.config.letter);
    }
    std::string out;
    for (std::size_t i = 0; i < reasons.size(); ++i)
        if (!lost[i].empty())
            out += fmt::format("{}The position of {} is not valid any more: {}; home again.", out.empty() ? "" : " ",
                               lost[i], reasons[i]);
    return out.empty() ? "The positions are kept." : out;
}

std::string_view StopLatch::advice() const {
    if (state_.by_door != 0) return "Close it, then reset.";
    if (state_.behind != 0)
        return "Check the wiring of both its limit switches: they may be swapped, or a wire is broken. Then reset.";
    return words_of(cause()).advice;
}

Result<void> check_released(const StopLatch& latch, std::string_view what) {
    if (!latch.latched()) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: {} Nothing was moved. {}", what, latch.sentence(), latch.advice()));
}

}  // namespace motionrack::rack
