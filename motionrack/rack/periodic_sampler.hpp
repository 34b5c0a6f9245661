// Samples a running rack at equal intervals of virtual time, between two events of the kernel.
#pragma once

#include <functional>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::rack {

class PeriodicSampler final : public sim::Device {
  public:
    /// Call before the rack starts.
    explicit PeriodicSampler(sim::Kernel& kernel)
        : kernel_(kernel), id_(kernel.add(*this, sim::Phase::observers, "probe")) {}
    /// Calls `sample` every `period` (> 0) from this instant, within the kernel's run; it must neither allocate nor
    /// change anything. Call between runs.
    void begin(Duration period, std::function<void(Instant now)> sample) {
        period_ = period;
        sample_ = std::move(sample);
        kernel_.schedule(id_, kernel_.now());
    }
    void end() {
        kernel_.schedule(id_, never);
        sample_ = nullptr;
    }
    void on_scheduled(Instant now) override {
        sample_(now);
        kernel_.schedule(id_, now + period_);
    }

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    Duration period_{};
    std::function<void(Instant)> sample_;
};

}  // namespace motionrack::rack
