// A switch at a position of the machine: hysteresis, bounce, stuck contacts.
//
//   table   ----------+-------------+-------->       (a switch that is active at and above its position)
//   inactive          off          on  active        on: becomes active; off: is released
//   wire    ~~~~~~~~~~~~~~~~~~~~~~~~|_|~|_|~~|______
//
// The contacts bounce at fixed instants, derived from the number of changes so far.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/sim/parts/transmission.hpp>
#include <optional>

namespace motionrack::parts {

enum class SwitchSide : std::int32_t { at_and_below, at_and_above };

struct LimitSwitchSettings {
    std::optional<double> position;  ///< mm or degrees at which it becomes active; absent: no switch
    SwitchSide side = SwitchSide::at_and_below;
    double hysteresis = 0.05;           ///< mm or degrees between activation and release, >= 0
    Duration bounce = milliseconds(1);  ///< bounce time of the contacts at a change, 0 .. 1 s; 0: clean edges
    int active_level = 0;               ///< level of the wire while active; the other level while released
};

enum class SwitchFault : std::int32_t { none, stuck_open, stuck_closed };

struct LimitSwitchState {
    std::int64_t changes = 0;  ///< number of activations and releases
    Instant bounce_from{};     ///< the last change
    Instant next = never;      ///< the next edge of the bounce
    std::int32_t bounces = 0;  ///< even number of edges after the first of this bounce
    std::int32_t bounced = 0;  ///< edges already made
    std::int32_t active = 0;
    SwitchFault fault = SwitchFault::none;
};

class LimitSwitch {
  public:
    LimitSwitch(const LimitSwitchSettings& settings, const Transmission& axle, LimitSwitchState& state);

    bool present() const { return settings_.position.has_value(); }
    /// Position of the table (microsteps) at which it becomes active.
    std::int64_t acts_at() const { return on_; }
    /// Range of the table without a change; unlimited without a switch.
    Range range() const;
    /// Moves the table to `table`; the switch changes if that is beyond the range.
    void move(std::int64_t table, Instant now);
    /// Instant of the next edge that does not depend on move().
    Instant next() const { return state_.next; }
    /// Makes the edges due until `now`.
    void act(Instant now);
    /// Level of the wire.
    int level() const;
    bool active() const { return state_.active != 0; }
    /// Sets or clears a fault: stuck_open, the switch is never active; stuck_closed, always.
    void set_fault(SwitchFault fault) { state_.fault = fault; }

  private:
    bool acts(std::int64_t table) const;
    Instant bounce_edge(int i) const;

    LimitSwitchSettings settings_;
    LimitSwitchState& state_;
    std::int64_t on_ = 0;
    std::int64_t off_ = 0;
};

}  // namespace motionrack::parts
