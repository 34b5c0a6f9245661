// The laser behind its gate: the instants and the power of its light.
//
//   gate   ____|‾‾‾‾‾‾|____
//   light  ______|‾‾‾‾‾‾‾|_      each edge delayed by its own delay
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <span>

namespace motionrack::parts {

struct LaserSettings {
    double power_w = 20;     ///< mean power while on, 0 .. 1e5
    double on_delay_us = 0;  ///< 0 .. 1e5
    double off_delay_us = 0;
};

class LaserGate {
  public:
    static Result<LaserGate> make(const LaserSettings& settings);

    /// Records a change of the gate `half_us` half-microseconds after 0 s; in order of time.
    void change(std::int64_t half_us, bool on);

    /// Interval of light within a tick of 10 us, as parts of it: 0 .. 1.
    struct Light {
        double from = 0, to = 0;
    };
    /// Calls f(Light) for tick `tick`; ticks in order, with all changes of the tick known.
    template <class F>
    void shine(std::int64_t tick, F&& f) {
        double cursor = 0;
        while (state_.count > 0 && first().at < static_cast<double>(tick + 1)) {
            const double at = first().at - static_cast<double>(tick);
            if (state_.on && at > cursor) f(Light{cursor, at});
            if (at > cursor) cursor = at;
            take_first();
        }
        if (state_.on) f(Light{cursor, 1.0});
    }
    /// Returns true if no light is possible in this tick.
    bool dark(std::int64_t tick) const {
        return !state_.on && (state_.count == 0 || first().at >= static_cast<double>(tick + 1));
    }
    bool on() const { return state_.on != 0; }
    double power_w() const { return settings_.power_w; }
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(&state_, 1)); }

    /// Capacity for changes waiting for their delay; beyond it the earliest take effect at once.
    static constexpr std::int64_t max_waiting = 4096;

  private:
    struct LightEdge {
        double at = 0;  ///< instant, in ticks of 10 us since 0 s
        std::int64_t on = 0;
    };
    struct State {
        std::array<LightEdge, max_waiting> edges{};  ///< ring buffer from `head`
        std::int64_t head = 0, count = 0, on = 0;
    };
    const LightEdge& first() const { return state_.edges[static_cast<std::size_t>(state_.head)]; }
    void take_first() {
        state_.on = first().on;
        state_.head = (state_.head + 1) % max_waiting;
        --state_.count;
    }

    LaserSettings settings_;
    State state_;
};

}  // namespace motionrack::parts
