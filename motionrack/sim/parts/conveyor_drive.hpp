// Drive of a conveyor in virtual time: its velocity can be set manually, or follow its profile again.
//
//   ConveyorDrive ──► Conveyor ──┬─► ConveyorPosition: counts of an encoder
//                                ├─► ConveyorPosition: position of the parts
//                                └─► ScanHead, SerialWordSource
//
// Faults: drive.speed x (x mm/s or degrees/s from now on, up to the maximum velocity; 0: standstill), drive.profile
// (follow the profile again).
#pragma once

#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/conveyor.hpp>
#include <motionrack/sim/parts/conveyor_position.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::parts {

class ConveyorDrive final : public sim::Device {
  public:
    /// Adds the device `name` to the kernel before it starts. `max_velocity`: at most max_track_velocity.
    ConveyorDrive(sim::Kernel& kernel, const std::string& name, const Conveyor& track,
                  double max_velocity = max_track_velocity);

    const Conveyor& track() const { return track_; }
    sim::DeviceId id() const { return id_; }
    /// Adds a listener for velocity changes; before the start.
    void add(ConveyorPosition& motion) { motions_.push_back(&motion); }

    // ---- between runs
    /// Decelerates to a standstill; `go_on`: follows the profile again.
    void stop(Instant now);
    void go_on(Instant now);
    bool stopped(Instant now) const { return track_.by_hand() && track_.velocity(to_seconds(now)) == 0; }

    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return sim::bytes_of(track_.driving()); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    template <class Change>
    void change(Instant now, Change&& how);

    Conveyor track_;
    double max_velocity_;
    std::vector<ConveyorPosition*> motions_;
    sim::DeviceId id_{};
};

}  // namespace motionrack::parts
