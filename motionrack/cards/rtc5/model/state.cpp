// Resets the card's state, part by part.
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5 {

void EncodersState::reset() {
    EncodersState fresh;
    fresh.input = input;
    for (std::size_t e = 0; e < encoder_count; ++e) fresh.counters[e].raw = counters[e].raw;
    *this = fresh;
}

void McBsp::reset() {
    McBsp fresh;
    fresh.word = word, fresh.previous = previous, fresh.received = received;
    fresh.memory[0] = memory[0], fresh.filled = filled & 1, fresh.to_zero = to_zero;
    *this = fresh;
}

void Laser::reset() {
    Laser fresh;
    fresh.on = on, fresh.on_since = on_since, fresh.on_time = on_time;
    *this = fresh;
}

void Lists::reset(const Settings& settings) {
    *this = Lists{};
    begin = {0, settings.list1, settings.list1 + settings.list2, settings.list_memory};
    input_end = settings.list1;
}

void State::reset(const Settings& settings) {
    State fresh;
    fresh.tick = tick, fresh.sampled = sampled;
    encoders.reset(), mcbsp.reset(), laser.reset();
    fresh.encoders = encoders, fresh.mcbsp = mcbsp, fresh.laser = laser;
    fresh.lists.reset(settings);
    *this = fresh;
}

}  // namespace motionrack::rtc5
