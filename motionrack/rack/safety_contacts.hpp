// The contacts that a machine has for its people: an emergency stop with two channels, and a door.
//
//   estop1 ──┐
//            ├── both closed ──► estop ──► cards, stop latch        the first contact that opens acts at once
//   estop2 ──┘
//      └── unlike for longer than they may ──► a fault: no reset until both are alike again
//
//   door ──► open: the feed is held, or what has nobody to hold it is stopped; nothing begins to move
//
// The wires estop1, estop2 and door are there where the rack file says so, high while the contact is closed.
#pragma once

#include <array>
#include <motionrack/base/time.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

class SafetyContacts final : public sim::Device {
  public:
    /// Behind the wire `estop`, before the kernel starts. Adds wires only where there are contacts.
    SafetyContacts(sim::Kernel& kernel, const RackSafety& settings);

    /// The channels are unlike, and have been for longer than they may.
    bool differs() const { return state_.differs != 0; }
    bool door_open() const { return has_door() && kernel_.level(door_) == 0; }
    bool has_door() const { return door_ != sim::WireId::none; }
    /// When it was opened last.
    Instant door_opened() const { return state_.door_opened; }
    /// "The two channels of the emergency stop have differed for 500 ms at 1.700 s: ...", each once.
    std::vector<std::string> take_alarms();

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    static constexpr int door_pin = 2;
    struct State {
        Instant differs_at{}, door_opened{};
        std::int32_t differs = 0, told = 0;
    };
    int level(int channel) const { return kernel_.level(channels_[static_cast<std::size_t>(channel)]); }

    sim::Kernel& kernel_;
    RackSafety settings_;
    sim::DeviceId id_{};
    sim::WireId estop_, door_ = sim::WireId::none;
    std::array<sim::WireId, 2> channels_{sim::WireId::none, sim::WireId::none};
    State state_{};
};

}  // namespace motionrack::rack
