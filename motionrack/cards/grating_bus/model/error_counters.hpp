// Counts the errors of a card, and reports its conditions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/cards/grating_bus/model/card_state.hpp>
#include <motionrack/cards/grating_bus/model/conditions.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::grating_bus {

class ErrorCounters {
  public:
    /// `state` is part of the card's state and must outlive this.
    ErrorCounters(ErrorCountersState& state, sim::Kernel& kernel, sim::DeviceId card)
        : state_(state), kernel_(kernel), card_(card) {}

    std::uint16_t operator[](std::size_t which) const { return state_.counters[which]; }
    void count(ErrorCounter which, std::uint32_t by = 1) {
        std::uint16_t& counter = state_.counters[which];
        counter = static_cast<std::uint16_t>(std::min<std::uint32_t>(0xFFFF, counter + by));
    }
    /// Counts an edge during a frame; reports the first one since clear().
    void count_overrun(std::uint32_t sequence) {
        count(ErrorCounter::overrun);
        if (state_.reported_overrun == 0) report(BusCondition::overrun, sequence);
        state_.reported_overrun = 1;
    }
    void clear() { state_ = {}; }

    void report(BusCondition code, std::int64_t a = 0, std::int64_t b = 0) const {
        kernel_.report(card_, static_cast<std::uint16_t>(code), a, b);
    }

  private:
    ErrorCountersState& state_;
    sim::Kernel& kernel_;
    sim::DeviceId card_;
};

}  // namespace motionrack::grating_bus
