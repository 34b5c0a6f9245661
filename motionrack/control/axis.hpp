// The canonical axis: what a program can ask of one axis, whatever card moves it. Units are mm or degrees, and seconds.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>

namespace motionrack::control {

enum class AxisState : std::uint8_t { standstill, moving, stopping, error };

class Axis {
  public:
    virtual ~Axis() = default;
    /// Starts a move to `position` at no more than `speed` (> 0); an S-curve where the axis has a jerk limit. Refused (nothing moves): past
    /// the travel, speed above the axis' limit or not finite, axis moving.
    virtual Result<void> move_to(double position, double speed) = 0;
    /// Starts moving until stop() at `speed`; the sign is the direction.
    virtual Result<void> move_at(double speed) = 0;
    /// Waits until the axis stands still or `timeout` has passed (an error that says where the axis is).
    virtual Result<void> wait(Duration timeout) = 0;
    /// Decelerates to a stop. Accepted in every state.
    virtual void stop() = 0;
    /// Stops at once, without a ramp. Accepted in every state.
    virtual void stop_now() = 0;
    /// Where the card says the axis is.
    virtual double position() = 0;
    /// What the encoder says, in the axis' unit.
    virtual double measured_position() = 0;
    /// Declares the present place to be `position`; refused while moving.
    virtual Result<void> set_position(double position) = 0;
    virtual AxisState state() = 0;
};

}  // namespace motionrack::control
