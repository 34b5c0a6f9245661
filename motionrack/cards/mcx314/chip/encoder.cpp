// EP: a counter for the connected encoder, in closed form, or for the wires xeca and xecb.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/chip/comparators.hpp>

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

void Chip::connect_encoder(int a, sim::PositionFunction& counts) {
    EncoderListener& listener = encoder_listeners_[a];
    MOTIONRACK_ASSERT(listener.motion == nullptr);
    listener.motion = &counts;
    listener.slot = counts.add_listener(listener);
    set_encoder_position(a, state_.axis[a].ep);
}

std::int32_t Chip::encoder_position(const Axis& axis, int a) const {
    if (!encoder_connected(a)) return axis.ep;
    const std::int64_t position = axis.encoder.value(*encoder_listeners_[a].motion, kernel_.now());
    if (axis.ring) return stepped(axis, 0, position);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(position));
}

/// Writes EP; also applies the edge ratio of WR2 and the direction of EM.
void Chip::set_encoder_position(int a, std::int32_t value) {
    Axis& axis = state_.axis[a];
    if (axis.ring) value = stepped(axis, value, 0);
    axis.ep = value;
    axis.encoder = sim::ClosedFormCounter(edges_of(axis), em::EPINV.test(state_.extension[a].em6));
    if (!encoder_connected(a)) return;
    const std::int64_t position = axis.ring ? std::int64_t{static_cast<std::uint32_t>(value)} : value;
    axis.encoder.set(position, *encoder_listeners_[a].motion, kernel_.now());
}

/// Subscribes to the encoder at the next count that may change a comparison with EP.
void Chip::watch_encoder(int a) {
    const Axis& axis = state_.axis[a];
    const EncoderListener& listener = encoder_listeners_[a];
    if (!listener.motion) return;
    if (!encoder_connected(a) || !wr2::CMPSL.test(axis.wr2) || !compares(axis)) {
        listener.motion->watch(listener.slot, sim::unwatched_below, sim::unwatched_above);
        return;
    }
    const std::int64_t position = axis.encoder.value(*listener.motion, kernel_.now());
    const std::int32_t counter = encoder_position(axis, a);
    axis.encoder.watch(*listener.motion, listener.slot, position - steps_to_comparison(axis, counter, -1),
                       position + steps_to_comparison(axis, counter, +1));
}

void Chip::encoder_crossed(int a, Instant now) {
    catch_up_before(now);
    compare(a);
    watch_encoder(a);
    requests_.look_anew();
    settle(now);
}

void Chip::take_encoder(int a, bool taken) {
    EncoderListener& listener = encoder_listeners_[a];
    if (!listener.motion) return;
    const Instant now = kernel_.now();
    catch_up(now);
    Axis& axis = state_.axis[a];
    if (taken && encoder_connected(a)) {
        axis.ep = encoder_position(axis, a);
        axis.encoder_lines = sim::lines_of(listener.motion->count(now));
        for (int i = 0; i < 2; ++i) kernel_.force(wires_.encoders[a][i], axis.encoder_lines >> i & 1);
        watch_encoder(a);
    } else if (!taken && !encoder_connected(a)) {
        for (const sim::WireId wire : wires_.encoders[a]) kernel_.release(wire);
        set_encoder_position(a, axis.ep);
        watch_encoder(a);
    }
    settle(now);
}

/// Wires without a connected encoder: every change is counted individually.
void Chip::encoder_lines(int a, Instant now) {
    Axis& axis = state_.axis[a];
    if (encoder_connected(a)) return;
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
    if (change == 0) return;
    if (em::EPINV.test(state_.extension[a].em6)) change = -change;
    axis.ep = stepped(axis, axis.ep, change);
    compare(a);
    requests_.look_anew();
    settle(now);
}

}  // namespace motionrack::mcx314
