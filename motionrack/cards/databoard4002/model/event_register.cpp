// Raising, latching and enabling of events.
#include <motionrack/cards/databoard4002/model/event_register.hpp>

namespace motionrack::databoard4002 {

void EventRegister::raise(std::uint8_t bits) {
    state_.event |= bits & state_.enables;
    check();
}

void EventRegister::check() {
    if (state_.pending || !(state_.event & state_.enables)) return;
    state_.latched = state_.event;
    state_.pending = 1;
}

std::uint8_t EventRegister::enable(std::uint8_t value) {
    const std::uint8_t shown = word();
    clear(shown & ~event::WATCH_OUT);
    state_.pending = 0;
    state_.enables = value & event::maskable;
    state_.interrupts = value & (event::ON_READY | event::ON_EVENT);
    state_.armed = value & (event::ZERO | event::REF);
    state_.armed_condition = zero_condition();
    return shown;
}

bool EventRegister::zero_condition() const {
    if ((state_.armed & event::ZERO) && pins_.level(zero_pin) == 0) return false;
    return state_.armed != 0 && (!(state_.armed & event::REF) || pins_.input(ref_pin, stat::REF));
}

std::uint8_t EventRegister::take_armed() {
    if (!state_.armed) return 0;
    const bool condition = zero_condition();
    if (!condition || state_.armed_condition) {
        state_.armed_condition = condition;
        return 0;
    }
    const std::uint8_t seen = state_.armed;
    state_.armed = 0;
    return seen;
}

void EventRegister::take_stops() {
    state_.stops = active_stops();
}

std::uint8_t EventRegister::note_stops() {
    const std::uint8_t active = active_stops();
    const bool risen = (active & ~state_.stops) != 0;
    state_.stops = active;
    if (risen) raise(event::STOP);
    return active;
}

void EventRegister::update_interrupt(bool ready) {
    pins_.set_interrupt(((state_.interrupts & event::ON_READY) && ready) ||
                        ((state_.interrupts & event::ON_EVENT) && state_.pending));
}

}  // namespace motionrack::databoard4002
