// Overrides in percent. Feed and rapid override are the machine's; it has no spindle override, so that is kept here.
#pragma once

#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/operate/machine.hpp>

namespace motionrack::grbl {

/// Feed, rapid and spindle override, percent.
struct Overrides {
    int feed = 100, rapid = 100, spindle = 100;
    friend bool operator==(const Overrides&, const Overrides&) = default;
};

class OverrideState {
  public:
    /// The machine must outlive this.
    explicit OverrideState(operate::Machine& machine) : machine_(machine) {}

    Overrides now() const;
    int spindle_percent() const { return spindle_; }
    /// Returns true while a hold keeps the spindle stopped.
    bool is_spindle_stopped() const { return spindle_stopped_; }

    /// Changes an override by a real-time command. Requires is_override(what).
    void change(Realtime what);
    void toggle_spindle_stop() { spindle_stopped_ = !spindle_stopped_; }
    void end_spindle_stop() { spindle_stopped_ = false; }
    /// Sets all overrides to 100 %, as M2 and M30 do.
    void end_program();
    /// Sets the spindle override to 100 % and ends a spindle stop.
    void reset_spindle();

  private:
    operate::Machine& machine_;
    int spindle_ = 100;
    bool spindle_stopped_ = false;
};

/// Returns true for the real-time bytes that change an override.
bool is_override(Realtime what);

}  // namespace motionrack::grbl
