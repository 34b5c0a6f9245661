// The canonical axis: what a program can ask of one axis, whatever card moves it. Units are mm or degrees, and seconds.
//
//   untrusted ── home(), set_position() ──► trusted ── emergency stop, alarm, stop_now() at speed ──► untrusted
//
// Nothing here waits but wait(): orders start something, and step() carries it on, so that one loop can serve many
// axes.
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

    // ---- orders; refused ones (ErrorKind::refused) move nothing
    /// Starts a move to `position` at no more than `speed` (> 0); an S-curve where the axis has a jerk limit. Refused:
    /// position not trusted, past the travel, speed above the axis' limit or not finite, axis moving.
    virtual Result<void> move_to(double position, double speed) = 0;
    /// Starts a move by `distance` from here; also where the position is not trusted, for there the travel is not
    /// known.
    virtual Result<void> move_by(double distance, double speed) = 0;
    /// Jogs at `speed` (the sign is the direction, 0 lets go) for as long as it is called again: it decelerates when it
    /// is not for the axis' hold time. Changes the speed on the fly; the other direction goes by way of a stop.
    /// Refused: above the limit, into an active limit switch, while the axis moves otherwise.
    virtual Result<void> jog(double speed, Instant now) = 0;
    /// Begins to search home. From here on the position is not trusted until it is found. Refused: no such switch or
    /// index, speeds, axis moving, alarm, emergency stop.
    virtual Result<void> home(const HomingRequest& order, Instant now) = 0;
    /// Declares the present place to be `position`, which is trusted then. Refused while moving.
    virtual Result<void> set_position(double position) = 0;
    /// Decelerates to a stop. Accepted in every state.
    virtual void stop() = 0;
    /// Stops at once, without a ramp: the position is no longer trusted if the axis was faster than its start speed.
    virtual void stop_now() = 0;

    // ---- carrying on
    /// One look at the axis; every few ms while it jogs or homes.
    virtual void step(Instant now) = 0;
    /// Steps and lets time pass until the axis stands. Errors (ErrorKind::machine): it did not within `timeout`, and
    /// still moves; it was stopped by a limit, an alarm or the emergency stop; homing failed. ErrorKind::stopped: the
    /// user asked, it has decelerated.
    virtual Result<void> wait(Duration timeout) = 0;

    // ---- looking
    virtual AxisState state() = 0;
    /// Whether position() means a place of the machine.
    virtual bool position_valid() const = 0;
    /// Where the card says the axis is.
    virtual double position() = 0;
    /// What the encoder says, in the axis' unit; 0 without one.
    virtual double measured_position() = 0;
    /// Name of the state that a homing is in; "" before the first one.
    virtual std::string_view home_state() const = 0;
    /// What the last homing found.
    virtual HomingResult home_outcome() const = 0;
};

}  // namespace motionrack::control
