// Operator safety contacts of a machine: an emergency stop with two channels, and a door.
//
//   estop1 ──┐
//            ├── both closed ──► estop ──► cards, stop latch        the first contact that opens acts immediately
//   estop2 ──┘
//      └── different for longer than permitted ──► a fault: no reset until both agree again
//   the button of an operator's page acts in series with both
//
//   door ──► open: feed hold, or a stop if the driver cannot hold; no motion starts
//
// The wires estop1, estop2 and door exist if the rack file declares them; high while the contact is closed.
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
    /// Drives the existing wire `estop`. Adds the wires of the declared contacts. Call before the kernel starts.
    SafetyContacts(sim::Kernel& kernel, const RackSafety& settings);

    /// Returns true if the channels have differed for longer than permitted.
    bool differs() const { return state_.differs != 0; }
    /// Presses or releases an operator's button, which acts in series with the contacts. Call between runs.
    void press(bool pressed);
    /// Returns true while the button is pressed, a contact is open, or the wire `estop` is held low.
    bool is_pressed() const { return kernel_.level(estop_) == 0; }
    bool door_open() const { return has_door() && kernel_.level(door_) == 0; }
    bool has_door() const { return door_ != sim::WireId::none; }
    /// Returns the instant at which the door was last opened.
    Instant door_opened() const { return state_.door_opened; }
    /// Returns new alarms, each once, as sentences with the duration and the instant.
    std::vector<std::string> take_alarms();

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    static constexpr int door_pin = 2;
    struct State {
        Instant differs_at{}, door_opened{};
        std::int32_t differs = 0, reported = 0, pressed = 0, unused = 0;
    };
    bool has_channels() const { return channels_[0] != sim::WireId::none; }
    void drive();
    int level(int channel) const { return kernel_.level(channels_[static_cast<std::size_t>(channel)]); }

    sim::Kernel& kernel_;
    RackSafety settings_;
    sim::DeviceId id_{};
    sim::WireId estop_, door_ = sim::WireId::none;
    std::array<sim::WireId, 2> channels_{sim::WireId::none, sim::WireId::none};
    State state_{};
};

}  // namespace motionrack::rack
