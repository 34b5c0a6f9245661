// A switch that acts at a place of the machine: hysteresis, bounce, stuck contacts.
//
//   table   ----------+-------------+-------->       (a switch that is active at and above its place)
//   inactive          off          on  active        on: acts; off: where it is released again
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
    std::optional<double> position;  ///< mm or degrees where it acts; absent: there is no such switch
    SwitchSide side = SwitchSide::at_and_below;
    double hysteresis = 0.05;           ///< mm or degrees to go back until it is released, >= 0
    Duration bounce = milliseconds(1);  ///< how long contacts bounce at a change, 0 .. 1 s; 0: clean edges
    int active_level = 0;               ///< the wire's level when it acts; it rests at the other
};

enum class SwitchFault : std::int32_t { none, stuck_open, stuck_closed };

struct LimitSwitchState {
    std::int64_t changes = 0;  ///< how often it has acted or been released
    Instant bounce_from{};     ///< the last change
    Instant next = never;      ///< the next edge of the bounce
    std::int32_t bounces = 0;  ///< edges after the first of this bounce, an even number
    std::int32_t bounced = 0;  ///< those that have been
    std::int32_t active = 0;
    SwitchFault fault = SwitchFault::none;
};

class LimitSwitch {
  public:
    LimitSwitch(const LimitSwitchSettings& settings, const Transmission& axle, LimitSwitchState& state);

    bool present() const { return settings_.position.has_value(); }
    /// The place of the table (microsteps) at which it acts.
    std::int64_t acts_at() const { return on_; }
    /// The range of the table in which it does not change; all of it if there is no switch.
    Range range() const;
    /// The table has come to `table`: changes if that is beyond the range.
    void move(std::int64_t table, Instant now);
    /// The instant of the next edge that move() does not make.
    Instant next() const { return state_.next; }
    /// Makes the edges due until `now`.
    void act(Instant now);
    /// The wire's level.
    int level() const;
    bool active() const { return state_.active != 0; }
    /// stuck_open: never active; stuck_closed: always.
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
