// A light barrier beside a track, past which parts come at equal distances.
//
//   place of the track  0 .. first ...... first + every ......      sensor  ~~~~~\____/~~~~~~~\____/~~~~
//                            |<-length->|                                        part         part
//                                                                           low: a part is there
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>

namespace motionrack::parts {

struct PartSensorSettings {
    std::int64_t first = 0;   ///< place of the track at which the first part's edge is at the sensor, counts
    std::int64_t every = 1;   ///< from part to part, > 0
    std::int64_t length = 1;  ///< of a part, 0 < length < every
};

class PartSensor final : public sim::Device, private sim::PositionListener {
  public:
    /// Adds the device `name` and the wire `wire` (at rest high) to the kernel, before it starts.
    PartSensor(sim::Kernel& kernel, const std::string& name, const std::string& wire, sim::PositionFunction& place,
               const PartSensorSettings& settings);

    /// Parts whose leading edge has come to the sensor, up to now.
    std::int64_t parts(Instant now) const;
    void on_scheduled(Instant now) override { look(now); }

  private:
    void crossed(Instant now) override { look(now); }
    void rate_changed(double, double, Instant) override {}
    void look(Instant now);
    std::int64_t number(std::int64_t place) const;

    sim::Kernel& kernel_;
    sim::PositionFunction& place_;
    PartSensorSettings settings_;
    sim::DeviceId id_{};
    sim::WireId wire_{};
    int slot_ = 0;
};

}  // namespace motionrack::parts
