// Breaks a run for outside observers: periodically, and when a wire takes a level.
//
//   kernel ──act(t), on_wire──► RunBreaker ──break_run──► between runs: samples, waits
#pragma once

#include <motionrack/sim/kernel.hpp>

namespace motionrack::python {

class RunBreaker final : public sim::Device {
  public:
    /// Create before the rack starts and after all its wires exist. It listens to a wire only while it waits for it.
    explicit RunBreaker(sim::Kernel& kernel);
    /// Call after the rack has started.
    void begin();

    /// Breaks now and every `period` (> 0) from now on.
    void break_every(Duration period);
    void ring_no_more();
    /// Returns the instant of the last break once; never: none since the last call.
    Instant take_break();

    /// Breaks when `wire` takes that level. One wire at a time.
    void break_on_wire(sim::WireId wire, int level);
    void listen_no_more();
    bool heard() const { return heard_; }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    Duration period_{};
    Instant rung_ = never;
    sim::WireId wire_ = sim::WireId::none;
    int level_ = 0;
    bool heard_ = false;
};

}  // namespace motionrack::python
