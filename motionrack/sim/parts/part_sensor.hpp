// A light barrier beside a conveyor that carries parts at equal distances.
//
//   conveyor position   0 .. first ...... first + every ......      sensor  ~~~~~\____/~~~~~~~\____/~~~~
//                            |<-length->|                                        part         part
//                                                                           low: a part is present
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>

namespace motionrack::parts {

struct PartSensorSettings {
    std::int64_t first = 0;   ///< position of the conveyor with the first part's edge at the sensor, counts
    std::int64_t every = 1;   ///< counts from one part's leading edge to the next, > 0
    std::int64_t length = 1;  ///< counts, 0 < length < every: length of a part
};

class PartSensor final : public sim::Device, private sim::PositionListener {
  public:
    /// Adds the device `name` and the wire `wire` (high at rest) to the kernel before it starts.
    PartSensor(sim::Kernel& kernel, const std::string& name, const std::string& wire, sim::PositionFunction& position,
               const PartSensorSettings& settings);

    /// Number of parts whose leading edge has reached the sensor.
    std::int64_t parts(Instant now) const;
    void on_scheduled(Instant now) override { update(now); }

  private:
    void crossed(Instant now) override { update(now); }
    void rate_changed(double, double, Instant) override {}
    void update(Instant now);
    std::int64_t number(std::int64_t position) const;

    sim::Kernel& kernel_;
    sim::PositionFunction& position_;
    PartSensorSettings settings_;
    sim::DeviceId id_{};
    sim::WireId wire_{};
    int slot_ = 0;
};

}  // namespace motionrack::parts
