// Breaks a run where somebody outside wants to look: at even instants, and where a wire takes a level.
//
//   kernel ──act(t), on_wire──► RunBreaker ──break_run──► between runs: samples, waits
#pragma once

#include <motionrack/sim/kernel.hpp>

namespace motionrack::python {

class RunBreaker final : public sim::Device {
  public:
    /// Before the rack is started, after all its wires were made. It hears none of them until it waits for one.
    explicit RunBreaker(sim::Kernel& kernel);
    /// After the rack was started.
    void begin();

    /// Rings now and every `period` (> 0) from now on.
    void break_every(Duration period);
    void ring_no_more();
    /// The instant of the last ring that was not taken yet, once; never: there was none.
    Instant take_break();

    /// Rings where `wire` takes that level. One wire at a time.
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
