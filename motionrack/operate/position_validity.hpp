// Position validity of a machine's axes: gained by homing or setting the position, lost as in a program run.
#pragma once

#include <array>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/validity_watch.hpp>
#include <string>
#include <vector>

namespace motionrack::operate {

/// A position commanded for an axis (mm or degrees); its card takes it over some milliseconds later.
struct Declared {
    char letter = 'X';
    double position = 0;
    rack::ValidityWatch::Mark stood;  ///< counters and losses at the command
};

/// Validity of the position of each axis, by letter.
class PositionValidity {
  public:
    /// All positions start as invalid. The rack must outlive this.
    explicit PositionValidity(rack::Rack& rack) : rack_(rack), watch_(rack) {}

    bool of(char letter) const { return valid_[index(letter)]; }
    void invalidate(char letter) { valid_[index(letter)] = false; }
    Declared declared(char letter, double position) const { return {letter, position, watch_.mark(number(letter))}; }
    /// Sets the declared position, corrected by the motion of a pushed servo since the command, and makes it valid. The
    /// next poll() reports pulses lost since then. Errors: as Axis::set_position.
    Result<void> take(control::Axis& axis, const Declared& declared);
    /// Makes the position of a homed axis valid from `since`.
    void begin_at_home(char letter, Instant since);
    /// Returns alarms with source, text and axis for losses, count errors and following errors since the last call.
    /// Call regularly between motions.
    std::vector<Alarm> poll(Instant now, MachineState state);
    /// Invalidates axes whose position the stop in force has lost since its error stop began. Returns their alarms.
    /// Call in the error stop, and before a reset, after which the stop latch knows no loss.
    std::vector<Alarm> take_losses();
    /// Invalidates axes that have lost their own position. Call at standstill. Returns their letters: "XY".
    std::string invalidate_unknown();

  private:
    std::size_t index(char letter) const;
    std::size_t number(char letter) const;  ///< index in Rack::axes()
    void begin(char letter, const rack::ValidityWatch::Mark& from);
    void invalidate_reset(bool comes_to_rest, std::vector<Alarm>& out);

    rack::Rack& rack_;
    std::uint64_t trips_ = 0;  ///< evaluated trips of the stop latch
    rack::ValidityWatch watch_;
    std::array<bool, control::axis_count> valid_ = {};
    Instant due_{};
    bool stood_ = false;
};

}  // namespace motionrack::operate
