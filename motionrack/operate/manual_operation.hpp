// Manual operation of a machine: jogs, homing, set positions. Commands record requests, and steps execute them.
#pragma once

#include <atomic>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/operate/jogs.hpp>
#include <motionrack/rack/homing.hpp>
#include <optional>
#include <string>

namespace motionrack::operate {

class AlarmList;
class AxisHandover;
class Door;
class PendingStop;
class PositionSetter;
class PositionValidity;
class ProgramRun;
class StartConditions;
class StatusPublisher;

/// Used only by the motion thread.
class ManualOperation {
  public:
    /// Parts of the machine that manual operation reads and changes; they must outlive this.
    struct ManualParts {
        rack::Rack& rack;
        const StartConditions& conditions;
        const Door& door;
        StatusPublisher& publisher;
        AlarmList& alarms;
        ProgramRun& programs;
        AxisHandover& handover;
        PositionValidity& validity;
        PositionSetter& positions;
        PendingStop& pending_stop;
    };
    struct ManualTimes {
        Duration jog_lease;
        Jogs::Clock wall;  ///< for leases of jogs
        Duration slice;    ///< step of virtual time while jogs move
    };
    ManualOperation(const ManualParts& parts, ManualTimes times);

    // ---- commands; refused ones (ErrorKind::refused) change nothing
    /// Jogs at `speed` (mm/s or degrees/s; sign: direction; 0 ends the jog) while it is called again within the lease,
    /// to the end of the travel at most. Also refused: a command older than another one of its session, and a renewal
    /// of an ended jog.
    Result<void> jog(char axis, double speed, const JogOrigin& origin = {});
    /// Jogs by `distance` (mm or degrees) at `speed` (mm/s or degrees/s).
    Result<void> jog_by(char axis, double distance, double speed);
    /// Jogs along a straight line in machine coordinates at the path velocity `speed` (per second), after earlier jogs
    /// of this kind; Machine::cancel ends them. Modal state is unchanged. Errors: refused, also outside the travel;
    /// invalid_input for an unknown axis or a missing speed.
    Result<void> jog_to(const control::Point& target, double speed);
    /// Homes these axes; empty: all axes with a home switch.
    Result<void> home(std::string axes);
    /// Sets the position of an axis (mm or degrees) and makes it valid. Refused while something moves.
    Result<void> set_position(char axis, double position);

    // ---- queries
    /// Jogs of single axes and their leases.
    Jogs& jogs() { return jogs_; }
    /// Result of the last homing, if any.
    const std::optional<rack::HomingOutcome>& last_homing() const { return homed_; }
    bool wants_homing() const { return home_wanted_.has_value(); }

    // ---- steps, for the loop of Machine
    /// Continues all jogs by one slice. `failed` is called with each failure that ends all motion; other axes may still
    /// decelerate.
    void step_jogs(const std::function<void(const Error&)>& failed);
    /// Homes the requested axes; returns when homing has ended. Errors: a failure that ends all motion.
    Result<void> step_homing();
    /// Drops the requests, and ends homing and jogs.
    void cancel();
    /// Permits homing again after cancel(). Call at standstill.
    void end_stop() { home_stop_ = false; }

  private:
    ManualParts parts_;
    Duration slice_;
    Jogs jogs_;
    std::optional<std::string> home_wanted_;
    std::optional<rack::HomingOutcome> homed_;
    rack::SeenIndexes seen_indexes_;
    std::atomic<bool> home_stop_{false};
};

}  // namespace motionrack::operate
