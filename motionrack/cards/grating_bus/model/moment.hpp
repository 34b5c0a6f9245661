// State of a card's sequence at a time after it entered S1. It depends on that time only, so unobserved states need no
// stepping.
#pragma once

#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

struct Moment {
    State state = State::S0;
    int word = 0;
    Duration until{};  ///< time from entering S1 to the end of the state; 0 in S0
};

/// Returns the duration of a state S1 .. S12; S0 has none.
constexpr Duration time_in(const BusTiming& timing, State state) {
    switch (state) {
        case State::S1:
        case State::S7:
            return timing.t1;
        case State::S2:
        case State::S8:
            return timing.t2;
        case State::S3:
        case State::S9:
            return timing.t3;
        default:
            return timing.clock;
    }
}

/// The transitions of the map, by state and by whether words are left.
struct SequenceTable {
    State next[std::size(map::states)][2] = {};

    consteval SequenceTable() {
        const MachineInfo& machine = machine_named(map::machines, "frame");
        for (const TransitionInfo& t : machine.transitions) {
            const int from = state_index(machine, t.from), to = state_index(machine, t.to);
            if (t.when != map::words_left) next[from][0] = static_cast<State>(to);
            if (t.when != map::all_read) next[from][1] = static_cast<State>(to);
        }
    }
};
inline constexpr SequenceTable sequence_table;

/// Returns the state after `state`, by the transitions of the map.
constexpr State after(State state, bool words_left) {
    return sequence_table.next[static_cast<int>(state)][words_left];
}

/// Computes the state at `elapsed` >= 0 after entering S1, in a frame of `words`.
constexpr Moment moment_of(const BusTiming& timing, int words, Duration elapsed) {
    const Duration word_time = timing.word_time();
    const auto word = static_cast<int>(elapsed / word_time);
    const Duration begin = word * word_time;
    if (word >= words)
        return elapsed < timing.frame_time(words) ? Moment{State::S12, words - 1, timing.frame_time(words)} : Moment{};
    State state = word == 0 ? State::S1 : State::S7;
    Duration until = begin + time_in(timing, state);
    while (elapsed >= until) {
        state = after(state, word + 1 < words);
        until += time_in(timing, state);
    }
    return {state, word, until};
}

/// Levels that a host drives in a state.
struct Outputs {
    std::uint32_t hold, read_n, addr;
};
inline Outputs outputs_of(const Moment& moment, const CardSettings& settings) {
    const State s = moment.state;
    if (s == State::S0) return {0, 1, rest_of(Line::addr)};
    if (s == State::S1) return {1, 1, rest_of(Line::addr)};
    const bool reads = s == State::S2 || s == State::S3 || s == State::S8 || s == State::S9;
    const int word = s == State::S7 ? moment.word - 1 : moment.word;
    return {1, reads ? 0u : 1u, static_cast<std::uint32_t>(settings.address(word))};
}

static_assert(moment_of({}, 4, nanoseconds(50)).state == State::S3 &&
              moment_of({}, 4, nanoseconds(440)).state == State::S12);
static_assert(moment_of({}, 4, nanoseconds(449)).state == State::S12 &&
              moment_of({}, 4, nanoseconds(450)).state == State::S0);

}  // namespace motionrack::grating_bus
