// Executes the events of generators and inputs in the order of their ticks.
#include <motionrack/cards/mcx314/chip/event_executor.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

void EventExecutor::advance_to(std::int64_t to) {
    work_to(to);
    for_each_axis(state_.working, [&](int a) { forward_.bring_up(a, state_.tick); });
}

/// Executes the events up to tick `to`; generators without an event at the last of these ticks may stay behind.
void EventExecutor::work_to(std::int64_t to) {
    while (state_.tick < to) {
        if (state_.next_event > to) return skip_to(to);
        work_off(state_.next_event);
        find_next();
    }
}

/// Executes the ticks up to `to`, that of the next event. Generators that only change their speed advance in closed
/// form, the others execute the tick by the rules. Generators without an event keep their older state, except that of a
/// path, which is brought up too.
void EventExecutor::work_off(std::int64_t to) {
    state_.tick = to;
    if (state_.sampling.next <= to) filters_.sample(to);
    for_each_axis(state_.working, [&](int a) {
        Axis& axis = state_.axis[a];
        const bool path = axis.gen.drive == Drive::path;
        if (axis.gen.next_tick > to) {
            if (path) forward_.bring_up(a, to);
        } else if (axis.gen.walks) {
            forward_.bring_along(a, to);
        } else if (axis.gen.plain) {
            skip_speed(axis, to - axis.gen.at - 1);
            forward_.skip_phase(a, to - axis.gen.at);
            axis.gen.at = to;
            if (path) notifier_.note_rates();
            generators_.speed_step(a);
        } else {
            forward_.bring_up(a, to - 1);
            if (path) notifier_.note_rates();
            axis.gen.at = to;
            generators_.work(a);
        }
    });
    if ((state_.in_place | state_.sampled | state_.homing | state_.acting) == 0) return;
    look_at_in_position();
    external_.execute_requests();
    homes_.look();
    if (state_.acting != 0) actions_.act();
}

void EventExecutor::look_at_in_position() {
    for_each_axis(state_.in_place, [&](int a) {
        if (in_position(state_.axis[a])) state_.in_place &= ~(1u << a);
    });
}

/// Advances to tick `to` without an event.
void EventExecutor::skip_to(std::int64_t to) {
    for_each_axis(state_.working, [&](int a) { forward_.bring_up(a, to); });
    if (state_.in_place != 0) look_at_in_position();
    state_.tick = to;
}

/// Finds the tick of the next event.
void EventExecutor::find_next() {
    std::int64_t next = state_.sampling.next;
    for_each_axis(state_.working, [&](int a) {
        const Generator& gen = state_.axis[a].gen;
        if (gen.next_tick <= state_.tick || gen.full_tick || !gen.special_known) {
            forward_.bring_up(a, state_.tick);
            forward_.find_next_tick(a);
        }
        next = std::min(next, gen.next_tick);
    });
    for_each_axis(state_.following, [&](int a) {
        const Axis& axis = state_.axis[a];
        if (axis.pulses_wanted && axis.mark.active(state_.tick)) next = std::min(next, axis.mark.end());
    });
    state_.next_event = state_.sampled != 0 ? state_.tick + 1 : next;
    requests_.found_next();
}

}  // namespace motionrack::mcx314
