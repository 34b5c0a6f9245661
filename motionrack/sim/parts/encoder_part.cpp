// Positions of the edges, and watches for them.
#include <cstdlib>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/encoder_part.hpp>

namespace motionrack::parts {

EncoderPart::EncoderPart(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                         std::int64_t turn, std::int64_t position_per_turn, const LineOutputSettings& lines)
    : kernel_(kernel),
      position_(position),
      turn_(turn),
      position_per_turn_(position_per_turn),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      output_(kernel, name, lines, state_.lines),
      slot_(position.add_listener(*this)) {
    MOTIONRACK_ASSERT(turn > 0 && turn % 4 == 0 && position_per_turn > 0);
    kernel.schedule(id_, Instant{0});
}

// ---- geometry

/// The first position with a count of n or more.
std::int64_t EncoderPart::position_of(std::int64_t n) const {
    // Displacements in 2^-20 counts, so all further arithmetic is in whole numbers.
    constexpr std::int64_t fine = 1 << 20;
    const double early = displacement(floor_mod(n, turn_)) * static_cast<double>(fine);
    const auto whole = static_cast<std::int64_t>(early < 0 ? early - 0.5 : early + 0.5);
    if (whole == 0) return ceil_div(Wide{n} * position_per_turn_, turn_);
    return ceil_div((Wide{n} * fine - whole) * position_per_turn_, turn_ * fine);
}

std::int64_t EncoderPart::count_at(std::int64_t position) const {
    // The previous count is near, unless the position has jumped.
    const std::int64_t straight = floor_div(Wide{position} * turn_, position_per_turn_);
    std::int64_t n = std::llabs(straight - state_.count) < turn_ ? state_.count : straight;
    while (position_of(n + 1) <= position) ++n;
    while (position_of(n) > position) --n;
    return n;
}

// ---- time

void EncoderPart::schedule() {
    kernel_.schedule(id_, state_.begun ? output_.next() : Instant{0});
}

void EncoderPart::update(Instant now) {
    state_.count = count_at(position_.count(now));
    position_.watch(slot_, position_of(state_.count) - 1, position_of(state_.count + 1));
    if (blind()) {
        state_.was_blind = 1;
        return;
    }
    if (state_.was_blind) {
        // Motion while blind is known only within a revolution: the shorter way is assumed.
        const std::int64_t away = state_.count - output_.shown();
        output_.rename(floor_div(away + turn_ / 2, turn_) * turn_);
        state_.was_blind = 0;
    }
    output_.show(state_.count, now);
    schedule();
}

void EncoderPart::look_again(Instant now) {
    if (state_.begun) update(now);
}

void EncoderPart::on_scheduled(Instant now) {
    if (!state_.begun) {
        state_.begun = 1;
        state_.count = count_at(position_.count(now));
        output_.begin(state_.count);
        update(now);
    }
    output_.act(now);
    schedule();
}

std::string_view EncoderPart::bare(std::string_view fault_name) {
    constexpr std::string_view prefix = "encoder.";
    if (fault_name.starts_with(prefix)) fault_name.remove_prefix(prefix.size());
    return fault_name;
}

bool EncoderPart::fault(std::string_view name, double value, Instant now) {
    if (!output_.fault(bare(name), value, now)) return false;
    schedule();
    return true;
}

}  // namespace motionrack::parts
