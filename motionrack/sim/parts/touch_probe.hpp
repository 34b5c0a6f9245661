// A touch probe carried by axes, and the block that it touches.
//
//   z   |                          wire ____|~~~~~~~|____   1 while the probe is within the block or on its faces
//       |      .--------.
//       |  <-- | block  | <--      each axis has a range of counts or none; without a range the block is
//       |______|________|____ x    unlimited along the axis
#pragma once

#include <cstdint>
#include <deque>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/range.hpp>
#include <string>

namespace motionrack::parts {

class TouchProbe final : public sim::Device {
  public:
    /// Adds the device "touch_" + `name` and the wire `name` to the kernel before it starts. Without any range it
    /// touches nothing.
    TouchProbe(sim::Kernel& kernel, const std::string& name);

    /// Before the kernel starts: limits the block to `from` .. `to`, counts of `position`, both included.
    void add_range(sim::PositionFunction& position, std::int64_t from, std::int64_t to);

    sim::WireId wire() const { return wire_; }
    bool touches(Instant t) const;

    void on_scheduled(Instant now) override;

  private:
    /// One axis of the block.
    struct Side final : sim::PositionListener {
        Side(TouchProbe& its, sim::PositionFunction& motion, sim::Interval of_block)
            : probe(its), position(motion), interval(of_block), slot(motion.add_listener(*this)) {}
        void crossed(Instant now) override { probe.update(now); }
        void rate_changed(double, double, Instant) override {}

        TouchProbe& probe;
        sim::PositionFunction& position;
        sim::Interval interval;
        int slot;
    };
    void update(Instant now);

    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    sim::WireId wire_{};
    std::deque<Side> sides_;
};

}  // namespace motionrack::parts
