// A cam on a moving part with a switch: active between two positions, both included.
//
//   count  ----[from]~~~~~~~~~~[to]----->      wire: the active level between, the other one outside
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/range.hpp>
#include <string>

namespace motionrack::parts {

class ReferenceCam final : public sim::Device, private sim::PositionListener {
  public:
    /// Adds the device `name` and its wire of the same name to the kernel before it starts. `from` <= `to`, counts of
    /// `position`.
    ReferenceCam(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position, std::int64_t from,
                 std::int64_t to, int active_level = 1);

    sim::WireId wire() const { return wire_; }
    bool active(Instant t) const;

    void on_scheduled(Instant now) override;

  private:
    void crossed(Instant now) override { update(now); }
    void rate_changed(double, double, Instant) override {}
    void update(Instant now);

    sim::Kernel& kernel_;
    sim::PositionFunction& position_;
    sim::Interval interval_;
    int active_level_;
    sim::DeviceId id_{};
    sim::WireId wire_{};
    int slot_ = 0;
};

}  // namespace motionrack::parts
