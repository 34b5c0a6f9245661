// The canonical axis: the commands and queries of one axis, the same for every card. Units are mm or degrees, and
// seconds.
//
//   position invalid ── home(), set_position() ──► valid ── emergency stop, alarm, stop_now() in motion ──► invalid
//
// Only wait() blocks. Commands start an action and step() continues it, so that one loop can serve many axes.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/control/homing.hpp>

namespace motionrack::control {

enum class AxisState : std::uint8_t { standstill, moving, jogging, homing, stopping, error };

class Axis {
  public:
    virtual ~Axis() = default;

    // ---- commands; a refused command (ErrorKind::refused) moves nothing
    /// Starts a move to `position` at no more than `velocity` (> 0); a double-S profile if the axis has a jerk limit.
    /// Refused: position not valid, target outside the travel, velocity above the axis limit or not finite, or the axis
    /// is moving.
    virtual Result<void> move_to(double position, double velocity) = 0;
    /// Starts a relative move by `distance`; also allowed while the position is not valid, because the travel is
    /// unknown then.
    virtual Result<void> move_by(double distance, double velocity) = 0;
    /// Jogs at `velocity`; the sign is the direction, 0 ends the jog. Keep calling: the axis decelerates when the calls
    /// stop for longer than its hold time. Changes the velocity on the fly; a reversal goes through a stop. Refused:
    /// above the limit, into an active limit switch, while the axis moves otherwise.
    virtual Result<void> jog(double velocity, Instant now) = 0;
    /// Starts homing. The position is not valid until home is found. Refused: switch or index not available, invalid
    /// velocities, axis moving, alarm, emergency stop.
    virtual Result<void> home(const HomingRequest& order, Instant now) = 0;
    /// Sets the current position to `position`, which is valid afterwards. Refused while moving.
    virtual Result<void> set_position(double position) = 0;
    /// Decelerates to a stop. Accepted in every state.
    virtual void stop() = 0;
    /// Stops at once, without a ramp. Invalidates the position if the axis was faster than its velocity step limit.
    virtual void stop_now() = 0;

    // ---- processing
    /// Updates the axis once; call every few ms while it jogs or homes.
    virtual void step(Instant now) = 0;
    /// Waits for standstill: calls step() and lets time pass. Errors (ErrorKind::machine): still moving after
    /// `timeout`; stopped by a limit, an alarm or the emergency stop; homing failed. ErrorKind::stopped: the user
    /// requested a stop, and the axis has decelerated.
    virtual Result<void> wait(Duration timeout) = 0;

    // ---- queries
    virtual AxisState state() = 0;
    /// Returns true if position() is a machine position.
    virtual bool position_valid() const = 0;
    /// Returns the commanded position that the card reports.
    virtual double position() = 0;
    /// Returns the encoder position in the unit of the axis; 0 without an encoder.
    virtual double measured_position() = 0;
    /// Returns the name of the current homing state; "" before the first one.
    virtual std::string_view home_state() const = 0;
    /// Returns the result of the last homing.
    virtual HomingResult home_outcome() const = 0;
};

}  // namespace motionrack::control
