// Conditions under which an operated machine accepts commands that start something.
//
//   may_start ──► not forbidden                       ready ──► no stop, standstill, nothing pending
//   may_begin ──► no stop, not forbidden, door closed      ready_for_lines ──► ready, door closed, all axes enabled
//                                                                              and with valid positions
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::operate {

class AxisEnables;
class Door;
class ManualAccess;
class PendingStop;
class PositionSetter;
class PositionValidity;
class Service;
class StatusPublisher;

/// Returns the axis with this letter. Errors: invalid_input if the machine has no such axis; `what` begins the message.
Result<const rack::RackAxis*> axis_named(const rack::RackConfig& config, const char* what, char letter);

/// Used only by the motion thread. `what`: first words of the error message, "Not homed". All errors are
/// ErrorKind::refused.
class StartConditions {
  public:
    /// Parts of the machine that the conditions read; they must outlive this.
    struct ConditionSources {
        rack::Rack& rack;
        const StatusPublisher& publisher;
        const AxisEnables& enables;
        const PositionValidity& validity;
        const Door& door;
        const PositionSetter& positions;
        const PendingStop& pending_stop;
        const ManualAccess& manual_access;
        const Service& service;
    };
    explicit StartConditions(const ConditionSources& sources) : sources_(sources) {}

    /// Forbids starts from now on; `reason` is part of the refusals.
    void forbid(std::string reason) { no_starts_ = std::move(reason); }
    bool forbids() const { return !no_starts_.empty(); }

    /// Requires that starts are not forbidden.
    Result<void> may_start(const char* what) const;
    /// Requires that anything may begin to move or to radiate, whatever the state of the axes: no stop is in force, the
    /// door is closed, and starts are not forbidden.
    Result<void> may_begin(const char* what) const;
    /// Requires a rack with axes.
    Result<void> has_axes(const char* what) const;
    /// Requires standstill and an enabled machine.
    Result<void> ready(const char* what) const;
    /// Requires that these axes are enabled and stay so, and that no set position is pending, since it applies to the
    /// axis position at its command.
    Result<void> axes_may_move(const char* what, std::string_view axes) const;
    /// Requires ready(), a closed door, and that every axis is enabled and has a valid position.
    Result<void> ready_for_lines(const char* what) const;
    /// Returns true while a stop or a set position is pending.
    bool has_pending() const;

  private:
    ConditionSources sources_;
    std::string no_starts_;  ///< reason that blocks starts; empty: starts are permitted
};

}  // namespace motionrack::operate
