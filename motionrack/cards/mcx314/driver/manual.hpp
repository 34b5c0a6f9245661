// Manual operation of one axis: what a person at a panel does with buttons and a knob.
//
//   jog(+v) ══ jog(+v) ══ jog(+2v) ══ nothing for `hold` ──► decelerates         every call renews for `hold`
//   jog(+v) ══ jog(-v) ──► decelerates, rests, then the other way
//   jog(+v) ══ jog(+v) ══ decelerates ──► the last pulse of the travel, if one is given: the drive has no more pulses
//
// Nothing waits and nothing looks at a clock: the caller gives the time and calls step() every few ms.
#pragma once

#include <motionrack/cards/mcx314/driver/home.hpp>
#include <motionrack/cards/mcx314/driver/ramp_reserve.hpp>
#include <optional>

namespace motionrack::mcx314 {

/// Where a jog may go: values of LP.
struct ManualTravel {
    std::int64_t min = 0, max = 0;
};

/// Speeds in V units, acceleration in A units, at the R that is written.
struct ManualSettings {
    std::int64_t sv = 50;               ///< initial speed, 1 .. 8,000
    std::int64_t a = 100;               ///< acceleration and deceleration, 1 .. 8,000
    std::int64_t max_v = 8'000;         ///< greatest speed that jog() takes, 1 .. 8,000
    Duration hold = milliseconds(250);  ///< how long a jog or a manual home goes on without being renewed, 1 ms .. 10 s
    std::optional<ManualTravel> travel = {};  ///< absent: a jog goes on until something stops it
};

enum class ManualState : std::uint8_t { standing, jogging, turning, stepping, homing, stopping };

/// The same as a declared machine, in the order of ManualState.
const MachineInfo& manual_machine();

class Manual {
  public:
    Manual(Driver& driver, int axis) : driver_(driver), axis_(axis), home_(driver, axis) {}

    /// Errors: out of range, or the axis is not standing; nothing is changed.
    Result<void> set(const ManualSettings& settings);
    const ManualSettings& settings() const { return settings_; }

    /// Jogs at `v`, the sign is the direction; 0 lets go. Starts, renews, changes the speed on the fly, or turns round
    /// by way of a stop. Refused: above max_v, at the end of the travel or into an active limit, with alarm or
    /// emergency stop active, while stepping or homing.
    Result<void> jog(std::int64_t v, Instant now);
    /// One step of `pulses` (signed, not 0) at `v`. Refused unless standing, and as jog().
    Result<void> step_jog(std::int64_t pulses, std::int64_t v);
    /// Homes while the button is held: the first call begins, later ones renew. Refused as Home::start().
    Result<void> home(const HomeSettings& settings, Instant now);
    /// Looks once: ends what was not renewed, starts the way back after a turn, advances the homing.
    void step(Instant now);
    /// Decelerates, or stops at once. In every state.
    void stop();
    void stop_now();

    ManualState state() const { return state_; }
    std::string_view state_name() const { return manual_machine().states[static_cast<std::size_t>(state_)].name; }
    /// Why the last motion ended, if not as it should ("the + limit switch was reached"); empty else.
    const std::string& why_ended() const { return why_; }
    const Home& homing() const { return home_; }

  private:
    unsigned mask() const { return 1u << axis_; }
    std::string name() const { return std::string(1, "XYZU"[axis_]); }
    Result<void> check_ready(const char* what, std::int64_t v);
    Result<void> begin_jog();
    Result<void> change_speed(std::int64_t v);
    std::int64_t way_left(bool negative);
    void end_drive();

    Driver& driver_;
    int axis_;
    ManualSettings settings_;
    Home home_;
    ManualState state_ = ManualState::standing;
    std::int64_t wanted_ = 0;  ///< speed of the jog, or of the one after the turn
    Instant until_{};          ///< renewed up to here
    Instant rests_until_{};    ///< of a turn
    RampReserve reserve_;      ///< of a jog within a travel
    std::string why_;
};

}  // namespace motionrack::mcx314
