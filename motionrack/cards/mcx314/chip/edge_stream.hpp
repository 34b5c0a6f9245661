// Output pulse edges for the edge listeners of the axes: collected in batches while the generators advance.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/chip/pulse_listeners.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::mcx314 {

/// Pulses at one speed and range: the first at tick `at`. The intervals are `quotient` ticks, or one more when `slack`,
/// from which each interval takes `remainder`, becomes negative.
struct EvenPulses {
    std::int64_t at = 0, quotient = 0, remainder = 0, slack = 0, speed = 1;
};

class EdgeStream {
  public:
    EdgeStream(const State& state, const PulseListeners& listeners) : state_(state), listeners_(listeners) {}

    bool wanted(int a) const { return outputs_[a].listener != nullptr; }
    /// Returns true if an axis that the generator moves has an edge listener.
    bool wanted_of(int generator) const;
    /// Delivers the collected edges to the listener of axis `a`, then replaces that listener; nullptr: none.
    void set_listener(int a, sim::EdgeListener* listener);
    void flush(int a);

    /// Emits one edge of axis `a` at `tick`; `count`: position after it, pulses since the start.
    void add(int a, std::int64_t tick, int direction, std::int64_t count);
    /// Emits the next `pulses` basic pulses of a generator, which starts after `waited` more ticks; called before its
    /// state advances.
    void make(int generator, std::int64_t waited, std::int64_t pulses);

  private:
    struct BatchedEdges {
        sim::EdgeListener* listener = nullptr;
        sim::EdgeBatch batch;
        std::int64_t batch_tick = 0;  // tick of its origin
    };

    void begin_batch(int a, std::int64_t tick, int direction, std::int64_t count);
    void make_even_edges(int a, EvenPulses run, std::int64_t pulses, int direction);
    void make_led_edges(int i, EvenPulses run, std::int64_t pulses);
    void make_arc_edges(EvenPulses run, std::int64_t pulses);
    void make_varied_edges(std::int64_t waited, std::int64_t pulses);
    void make_varied_arc_edges(std::int64_t waited, std::int64_t pulses);

    const State& state_;
    const PulseListeners& listeners_;
    std::array<BatchedEdges, axes_of_chip> outputs_;
};

}  // namespace motionrack::mcx314
