// The counter EP: follows the connected encoder in closed form, or counts the edges of xeca and xecb.
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>

namespace motionrack::mcx314 {

namespace {

/// Returns the encoder edges that EP counts: all of them for up/down pulses and for the undefined division 11.
sim::Edges edges_of(const Axis& axis) {
    if (wr2::PINMD.test(axis.wr2)) return sim::Edges::all;
    switch (wr2::PIND.get(axis.wr2)) {
        case 1:
            return sim::Edges::both_of_a;
        case 2:
            return sim::Edges::rising_a;
        default:
            return sim::Edges::all;
    }
}

}  // namespace

void EncoderInputs::connect(int a, sim::PositionFunction& counts, sim::PositionListener& listener) {
    ConnectedEncoder& source = sources_[a];
    MOTIONRACK_ASSERT(source.motion == nullptr);
    source.motion = &counts;
    source.slot = counts.add_listener(listener);
    set_position(a, state_.axis[a].ep);
}

std::int32_t EncoderInputs::position(const Axis& axis, int a) const {
    if (!connected(a)) return axis.ep;
    const std::int64_t count = axis.encoder.value(*sources_[a].motion, kernel_.now());
    if (axis.ring) return stepped(axis, 0, count);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(count));
}

/// Writes EP; also applies the edge ratio of WR2 and the direction of EM.
void EncoderInputs::set_position(int a, std::int32_t value) {
    Axis& axis = state_.axis[a];
    if (axis.ring) value = stepped(axis, value, 0);
    axis.ep = value;
    axis.encoder = sim::ClosedFormCounter(edges_of(axis), em::EPINV.test(state_.extension[a].em6));
    if (!connected(a)) return;
    const std::int64_t count = axis.ring ? std::int64_t{static_cast<std::uint32_t>(value)} : value;
    axis.encoder.set(count, *sources_[a].motion, kernel_.now());
}

/// Subscribes axis `a` to its encoder, at the next count that may change a comparison with EP.
void EncoderInputs::watch(int a) {
    const Axis& axis = state_.axis[a];
    const ConnectedEncoder& source = sources_[a];
    if (!source.motion) return;
    if (!connected(a) || !wr2::CMPSL.test(axis.wr2) || !compares(axis)) {
        source.motion->watch(source.slot, sim::unwatched_below, sim::unwatched_above);
        return;
    }
    const std::int64_t count = axis.encoder.value(*source.motion, kernel_.now());
    const std::int32_t counter = position(axis, a);
    axis.encoder.watch(*source.motion, source.slot, count - steps_to_comparison(axis, counter, -1),
                       count + steps_to_comparison(axis, counter, +1));
}

void EncoderInputs::take(int a, Instant now) {
    if (!connected(a)) return;
    Axis& axis = state_.axis[a];
    axis.ep = position(axis, a);
    axis.encoder_lines = sim::lines_of(sources_[a].motion->count(now));
    for (int i = 0; i < 2; ++i) kernel_.force(wires_.encoders[a][i], axis.encoder_lines >> i & 1);
    watch(a);
}

void EncoderInputs::give_back(int a) {
    if (connected(a)) return;
    for (const sim::WireId wire : wires_.encoders[a]) kernel_.release(wire);
    set_position(a, state_.axis[a].ep);
    watch(a);
}

bool EncoderInputs::count_lines(int a) {
    Axis& axis = state_.axis[a];
    if (connected(a)) return false;
    const unsigned lines =
        (kernel_.level(wires_.encoders[a][0]) != 0 ? 1u : 0u) | (kernel_.level(wires_.encoders[a][1]) != 0 ? 2u : 0u);
    const unsigned before = axis.encoder_lines;
    axis.encoder_lines = static_cast<std::uint8_t>(lines);
    int change = 0;
    if (wr2::PINMD.test(axis.wr2)) {
        const unsigned risen = lines & ~before;  // up/down pulses: A counts up, B counts down
        change = static_cast<int>(risen & 1u) - static_cast<int>(risen >> 1);
    } else {
        sim::QuadratureDecoder decoder(edges_of(axis), static_cast<std::uint8_t>(before));
        change = decoder.lines(static_cast<std::uint8_t>(lines));
    }
    if (change == 0) return false;
    if (em::EPINV.test(state_.extension[a].em6)) change = -change;
    axis.ep = stepped(axis, axis.ep, change);
    return true;
}

}  // namespace motionrack::mcx314
