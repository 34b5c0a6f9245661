// Gains and losses of position validity.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/operate/position_validity.hpp>
#include <utility>

namespace motionrack::operate {

namespace {

/// Delay after which the effect of an immediate stop on a fast motor shows.
constexpr Duration poll_period = milliseconds(20);
/// Limit of attempts to set a position, for a servo that is pushed during each attempt.
constexpr int max_takes = 3;

}  // namespace

std::size_t PositionValidity::index(char letter) const {
    return static_cast<std::size_t>(rack_.config().axis(letter)->index());
}

std::size_t PositionValidity::number(char letter) const {
    const auto& axes = rack_.axes();
    const auto found =
        std::find_if(axes.begin(), axes.end(), [letter](const auto& axis) { return axis.config.letter == letter; });
    return static_cast<std::size_t>(found - axes.begin());
}

void PositionValidity::begin(char letter, const rack::ValidityWatch::Mark& from) {
    valid_[index(letter)] = true;
    watch_.begin(number(letter), from);
}

/// Sets the position again if a servo was pushed meanwhile: its card needs some milliseconds to take it over.
Result<void> PositionValidity::take(control::Axis& axis, const Declared& declared) {
    const auto moved = [&] { return watch_.moved_since(number(declared.letter), declared.stood); };
    for (int i = 0; i < max_takes; ++i) {
        const double before = moved();
        MOTIONRACK_CHECK(axis.set_position(declared.position + before));
        if (moved() == before) break;
    }
    begin(declared.letter, declared.stood);
    return {};
}

void PositionValidity::begin_at_home(char letter, Instant since) {
    begin(letter, {since, watch_.mark(number(letter)).lost_pulses});
}

/// Invalidates the axes of a card that its watchdog has restarted. During a stop, the stop's own alarm reports this.
void PositionValidity::invalidate_reset(bool comes_to_rest, std::vector<Alarm>& out) {
    const rack::StopLatch& latch = rack_.stop_latch();
    if (std::exchange(trips_, latch.trips()) == latch.trips() || !latch.tripped_by(rack::StopSource::watchdog)) return;
    for (const rack::RackAxis& axis : rack_.config().axes) {
        if (latch.keeps_position(axis.index()) || !of(axis.letter)) continue;
        invalidate(axis.letter);
        if (comes_to_rest) continue;
        Alarm& alarm = out.emplace_back();
        alarm.source = "position";
        alarm.axis = axis.letter;
        alarm.text = fmt::format("The watchdog of card {} restarted it. The position of axis {} is not valid any more.",
                                 axis.card, axis.letter);
    }
}

/// Reports nothing during homing, before positions are known, or during a stop, whose own alarm reports the losses.
std::vector<Alarm> PositionValidity::poll(Instant now, MachineState state) {
    std::vector<Alarm> out;
    if (state == MachineState::homing || now < due_) return out;
    rack_.stop_latch().following().poll(now);
    const bool comes_to_rest = rack_.stop_latch().latched() && state != MachineState::error_stop;
    invalidate_reset(comes_to_rest, out);
    if (comes_to_rest) return out;
    due_ = now + poll_period;
    const bool stand = is_stationary(state), stood = std::exchange(stood_, stand);
    for (const rack::ValidityFinding& found : watch_.poll(stand && stood)) {
        if (found.axis == rack::ValidityFinding::no_axis) {
            Alarm& alarm = out.emplace_back();
            alarm.source = "stage";
            alarm.text = fmt::format("{}.", found.text);
            continue;
        }
        const char letter = rack_.axes()[found.axis].config.letter;
        if (!of(letter)) continue;  // invalid already, and its counters are meaningless
        if (found.lost) invalidate(letter);
        Alarm& alarm = out.emplace_back();
        alarm.source = found.follows_badly ? "following error" : "position";
        alarm.text = found.lost ? fmt::format("{}. The position of axis {} is not valid any more.", found.text, letter)
                                : fmt::format("{}.", found.text);
        if (found.lost || found.follows_badly) alarm.axis = letter;
    }
    return out;
}

std::vector<Alarm> PositionValidity::take_losses() {
    std::vector<Alarm> out;
    rack::StopLatch& latch = rack_.stop_latch();
    if (!latch.latched()) return out;
    invalidate_reset(false, out);
    for (std::size_t i = 0; i < rack_.axes().size(); ++i) {
        const rack::RackAxis& axis = rack_.axes()[i].config;
        if (latch.keeps_position(axis.index()) || !of(axis.letter)) continue;
        invalidate(axis.letter);
        const bool exceeded = latch.following().has_exceeded(i);
        Alarm& alarm = out.emplace_back();
        alarm.source = exceeded ? "following error" : "position";
        alarm.axis = axis.letter;
        alarm.text = fmt::format(
            "{}. The position of axis {} is not valid any more.",
            exceeded ? latch.following().alarm_text(i) : fmt::format("Steps of {} may have been lost", axis.letter),
            axis.letter);
    }
    return out;
}

std::string PositionValidity::invalidate_unknown() {
    std::string out;
    for (std::size_t i = 0; i < rack_.axes().size(); ++i) {
        const char letter = rack_.axes()[i].config.letter;
        if (!of(letter) || watch_.knows_itself(i)) continue;
        invalidate(letter);
        out += letter;
    }
    return out;
}

}  // namespace motionrack::operate
