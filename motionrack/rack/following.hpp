// How far an axis stays behind what drives it, by the counts of its encoder, while somebody drives the machine.
//
//   pulses of the card since the begin ───────────────┐
//   counts at the card's inputs since the begin ──────┴─► following error ──► above the warning limit: told once
//                        every millisecond                               └──► above the alarm limit: the stop latch
//
// It looks at pulses and lines, not at the card's counters, which hosts write. An encoder that is dead, swapped or not
// plugged in is an axis that stays behind, as well as a motor that is held or loses steps.
//
// A servo has no pulses. What its card drives it with, the volts of its output, goes through a servo of the rack file's
// numbers, which nothing hinders; what that turns more than is counted is its following error. It fades within half a
// second, since volts tell a speed and no place:
//
//   volts ──► dead band, gain, saturation ──► lag, current limit, friction ──► speed ──┐
//   counts at the card's inputs ───────────────────────────────────────────────────────┴─► sum, fading
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

class Rack;
struct RunningAxis;

class FollowingWatch final : public sim::Device {
  public:
    /// Of a rack that has all its wires, before it starts.
    explicit FollowingWatch(Rack& rack);

    /// Every axis is where it was sent, and is watched from now on. Between runs.
    void begin();
    /// This one is where it was sent: it was homed, or declared.
    void begin(std::size_t axis);
    /// Nothing is watched any more.
    void end();
    /// Now, without waiting for the millisecond.
    void look(Instant now);

    /// An axis that went beyond its warning limit, with the worst that was seen until now.
    struct Warning {
        std::size_t axis = 0;  ///< of Rack::axes()
        Instant at{};
        std::string text;  ///< without a full stop
    };
    /// Those that were not told yet; none of an axis that went beyond its alarm limit.
    std::vector<Warning> take_warnings();
    /// "The following error of X was 1.004 mm, above its limit of 1 mm".
    std::string alarm_text(std::size_t axis) const;

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    /// What is known of an axis; all in counts of its encoder.
    struct Watched {
        std::size_t axis = 0;
        double counts_per_pulse = 1;
        std::array<sim::WireId, 2> lines{sim::WireId::none, sim::WireId::none};  ///< at its card
        double warning = 0, alarm = 0;                                           ///< 0: none
        const parts::DcMotorSettings* servo = nullptr;                           ///< nullptr: it has pulses
        sim::WireId volts = sim::WireId::none;                                   ///< of a servo: its card's output, uV
    };
    struct AxisState {
        double origin = 0;         ///< the error when it began
        std::int64_t counted = 0;  ///< at the card's inputs
        double worst = 0;          ///< beyond the warning limit; 0: it was not
        double excess = 0;         ///< beyond the alarm limit; 0: it was not
        double speed = 0;          ///< of a servo as it should be
        double behind = 0;         ///< of a servo
        Instant looked{}, warned_at{};
        std::int64_t told = 0;
    };
    struct State {
        std::int64_t on = 0;
        std::array<AxisState, control::axis_count> axes{};
    };

    void add(std::size_t axis);
    double error(std::size_t i, Instant now);
    void follow_servo(std::size_t i, std::int64_t turned, Instant now);

    Rack& rack_;
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<Watched> watched_;  ///< goes with state_.axes
    State state_;
};

}  // namespace motionrack::rack
