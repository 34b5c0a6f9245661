// Following-error supervision: encoder counts of an axis against its pulses or servo volts, while the machine is
// driven.
//
//   pulses of the card since the start ──────────────┐
//   counts at the card's inputs since the start ─────┴─► following error ──► above the warning limit: reported once
//                        every millisecond                               └──► above the alarm limit: the stop latch
//
// It evaluates pulses and encoder lines, not the card's counters, which hosts write. A dead, swapped or unplugged
// encoder causes a following error, as does a motor that is blocked or loses steps.
//
// A servo has no pulses. The output volts of its card pass through a model of the servo with the rack file's numbers
// and without disturbances. The excess of the model's travel over the counts is the following error. It decays within
// half a second, since volts define a velocity, not a position:
//
//   volts ──► dead band, gain, saturation ──► lag, current limit, friction ──► velocity ──┐
//   counts at the card's inputs ──────────────────────────────────────────────────────────┴─► sum, decaying
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
    /// Call when the rack has all its wires, before it starts.
    explicit FollowingWatch(Rack& rack);

    /// Takes every axis as in position and starts supervision. Call between runs.
    void begin();
    /// Takes this axis as in position: it was homed, or its position was set.
    void begin(std::size_t axis);
    /// Ends supervision.
    void end();
    /// Evaluates immediately, without waiting for the millisecond.
    void poll(Instant now);

    /// An axis above its warning limit, with the largest error seen up to now.
    struct Warning {
        std::size_t axis = 0;  ///< index in Rack::axes()
        Instant at{};
        std::string text;  ///< without a full stop
    };
    /// Returns the unreported warnings, without those of an axis above its alarm limit.
    std::vector<Warning> take_warnings();
    /// Returns true if the following error of this axis has exceeded its alarm limit since begin().
    bool has_exceeded(std::size_t axis) const;
    /// "The following error of X was 1.004 mm, above its limit of 1 mm".
    std::string alarm_text(std::size_t axis) const;

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    /// State of an axis; all in counts of its encoder.
    struct Watched {
        std::size_t axis = 0;
        double counts_per_pulse = 1;
        std::array<sim::WireId, 2> lines{sim::WireId::none, sim::WireId::none};  ///< at the card's inputs
        double warning = 0, alarm = 0;                                           ///< limits; 0: none
        const parts::DcMotorSettings* servo = nullptr;                           ///< nullptr: an axis with pulses
        sim::WireId volts = sim::WireId::none;                                   ///< output of a servo's card, uV
    };
    struct ErrorState {
        double origin = 0;         ///< error at the start of supervision
        std::int64_t counted = 0;  ///< at the card's inputs
        double max_error = 0;      ///< error above the warning limit; 0: below
        double excess = 0;         ///< error above the alarm limit; 0: below
        double velocity = 0;       ///< model velocity of a servo
        double behind = 0;         ///< model following error of a servo
        Instant looked{}, warned_at{};
        std::int64_t reported = 0;
    };
    struct State {
        std::int64_t on = 0;
        std::array<ErrorState, control::axis_count> axes{};
    };

    void add(std::size_t axis);
    double error(std::size_t i, Instant now);
    void follow_servo(std::size_t i, std::int64_t turned, Instant now);

    Rack& rack_;
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<Watched> watched_;  ///< same order as state_.axes
    State state_;
};

}  // namespace motionrack::rack
