// Overrides in percent. Those of feed and rapids are the machine's; it has none for the spindle, so that is kept here.
#pragma once

#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/operate/machine.hpp>

namespace motionrack::grbl {

/// Percent.
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

    /// Requires a real-time byte that changes an override.
    void change(Realtime what);
    void toggle_spindle_stop() { spindle_stopped_ = !spindle_stopped_; }
    void end_spindle_stop() { spindle_stopped_ = false; }
    /// Sets all overrides to 100 %, as M2 and M30 do.
    void end_program();
    /// Resets those of the spindle.
    void reset_spindle();

  private:
    operate::Machine& machine_;
    int spindle_ = 100;
    bool spindle_stopped_ = false;
};

/// Returns true for the real-time bytes that change an override.
bool is_override(Realtime what);

}  // namespace motionrack::grbl
