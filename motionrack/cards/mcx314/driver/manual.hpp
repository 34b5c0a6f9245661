// Manual operation of one axis: buttons and override knob of an operator panel.
//
//   jog(+v) ══ jog(+v) ══ jog(+2v) ══ no call for `hold` ─► decelerates          every call renews for `hold`
//   jog(+v) ══ jog(-v) ──► decelerates, pauses, then reverses
//   jog(+v) ══ jog(+v) ══ decelerates ──► the last pulse of the travel, if given: the drive has no more pulses
//
// All calls return at once and read no clock: the caller passes the time and calls step() every few ms.
#pragma once

#include <motionrack/cards/mcx314/driver/home.hpp>
#include <motionrack/cards/mcx314/driver/ramp_reserve.hpp>
#include <optional>

namespace motionrack::mcx314 {

/// Range of a jog, as values of LP.
struct ManualTravel {
    std::int64_t min = 0, max = 0;
};

/// Settings of manual operation: speeds in V units, acceleration in A units, at the present R.
struct ManualSettings {
    std::int64_t sv = 50;                     ///< initial speed, 1 .. 8,000
    std::int64_t a = 100;                     ///< acceleration and deceleration, 1 .. 8,000
    std::int64_t max_v = 8'000;               ///< maximum speed of jog(), 1 .. 8,000
    Duration hold = milliseconds(250);        ///< duration of a jog or a manual homing without renewal, 1 ms .. 10 s
    std::optional<ManualTravel> travel = {};  ///< absent: a jog is unlimited
};

enum class ManualState : std::uint8_t { standing, jogging, turning, stepping, homing, stopping };

/// Returns the states and transitions of manual operation as a declared state machine, in the order of ManualState.
const MachineInfo& manual_machine();

class Manual {
  public:
    Manual(Driver& driver, int axis) : driver_(driver), axis_(axis), home_(driver, axis) {}

    /// Changes the settings. Errors: refused if a value is out of range or the axis is moving; nothing is changed.
    Result<void> set(const ManualSettings& settings);
    const ManualSettings& settings() const { return settings_; }

    /// Jogs at `v`, the sign is the direction; 0 releases. Starts, renews, changes the speed on the fly, or reverses
    /// through a stop. Refused: above max_v, at the end of the travel or into an active limit, with alarm or emergency
    /// stop active, while stepping or homing.
    Result<void> jog(std::int64_t v, Instant now);
    /// Moves one step of `pulses` (signed, not 0) at `v`. Refused unless at standstill, and as jog().
    Result<void> step_jog(std::int64_t pulses, std::int64_t v);
    /// Homes while the button is held: the first call starts, later calls renew. Refused as Home::start().
    Result<void> home(const HomeSettings& settings, Instant now);
    /// Executes one poll: ends a motion without renewal, starts the motion after a reversal, advances the homing.
    void step(Instant now);
    /// Stop: decelerating, or at once. Valid in every state.
    void stop();
    void stop_now();

    ManualState state() const { return state_; }
    std::string_view state_name() const { return manual_machine().states[static_cast<std::size_t>(state_)].name; }
    /// Returns the reason why the last motion ended, if it is abnormal ("the + limit switch was reached"); otherwise
    /// "".
    const std::string& why_ended() const { return why_; }
    const Home& homing() const { return home_; }

  private:
    unsigned mask() const { return 1u << axis_; }
    std::string name() const { return std::string(1, "XYZU"[axis_]); }
    Result<void> check_ready(const char* what, std::int64_t v);
    Result<void> begin_jog();
    Result<void> change_speed(std::int64_t v);
    std::int64_t distance_left(bool negative);
    void end_drive();

    Driver& driver_;
    int axis_;
    ManualSettings settings_;
    Home home_;
    ManualState state_ = ManualState::standing;
    std::int64_t wanted_ = 0;  ///< speed of the jog, or of the jog after a reversal
    Instant until_{};          ///< end of the renewal
    Instant rests_until_{};    ///< end of the pause of a reversal
    RampReserve reserve_;      ///< for a jog within a travel
    std::string why_;
};

}  // namespace motionrack::mcx314
