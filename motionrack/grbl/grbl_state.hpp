// State of a Grbl: the machine's state, and states that only a Grbl has, such as its alarms, door and sleep.
#pragma once

#include <cstdint>
#include <motionrack/grbl/gcode_lines.hpp>
#include <motionrack/operate/machine.hpp>

namespace motionrack::grbl {

/// Machine states as defined by Grbl.
enum class State : std::uint8_t { idle, run, hold, jog, alarm, door, check, home, sleep };

class GrblState {
  public:
    /// Both must outlive this.
    GrblState(operate::Machine& machine, const GcodeLines& gcode);

    State now() const;
    /// Returns true if lines that move are refused until the machine is unlocked or homed.
    bool is_locked() const;
    bool needs_unlock() const { return alarm_; }
    bool needs_reset() const { return critical_; }
    bool is_stopped() const { return stopped_; }
    bool is_asleep() const { return asleep_; }
    bool is_held() const { return held_ || door_; }

    /// Updates the state from the machine's: jogs, and holds that another client ends. Call every slice.
    void watch_machine();
    /// Returns true once for each error stop of the machine.
    bool enters_error_stop();
    /// Enables a machine that was never enabled, since a Grbl has no such state.
    void enable_new_machine();
    /// Treats a machine that was never enabled like one that was disabled: in Alarm.
    void lock_disabled_machine() { never_enabled_ = false; }

    /// Resets the machine. stopped() of the session may be called within it.
    void reset_machine(const operate::StopOrigin& by);
    /// Returns true within reset_machine(): the reported stop is the session's own.
    bool is_resetting_machine() const { return resets_; }
    /// Sets the positions shown as valid for axes that were not homed.
    void validate_positions();

    /// Begins a hold (`begun`), or ends it because the machine refused it.
    void hold(bool begun) { held_ = begun; }
    void open_door();
    void end_hold() { held_ = door_ = hold_seen_ = false; }
    void sleep() { asleep_ = true; }
    void begin_alarm() { alarm_ = true; }
    void end_alarm() { alarm_ = false; }
    void require_reset() { critical_ = true; }
    /// Begins a lock after a stop by another client. Returns true if such a lock, or an alarm that needs a reset, was
    /// already in force.
    bool lock();
    /// Ends the lock after a stop by another client. Returns false if there was none.
    bool release();
    void reset();

  private:
    operate::Machine& machine_;
    const GcodeLines& gcode_;
    bool alarm_ = false;          ///< until unlocking or homing
    bool critical_ = false;       ///< until a reset
    bool stopped_ = false;        ///< stopped by another client, until unlocking or reset
    bool resets_ = false;         ///< within reset_machine()
    bool never_enabled_ = false;  ///< the machine has never been enabled
    bool held_ = false, door_ = false, asleep_ = false;
    bool hold_seen_ = false;      ///< the machine has reached its hold
    bool jogging_ = false;        ///< the machine jogs, or decelerates after a jog
    bool stop_reported_ = false;  ///< the present error stop of the machine was reported
};

}  // namespace motionrack::grbl
