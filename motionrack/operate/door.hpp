// Door of an operated machine. Opening it holds the feed, or ends a probing move, a jog or homing; spindle, laser,
// belts, stages and outputs go off as at a STOP. Nothing starts until it is closed. Closing it moves nothing; a resume
// starts motion and the spindle again.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <string>

namespace motionrack::operate {

class Door {
  public:
    /// Excludes the door from the rack's stop latch, since the machine handles it. The rack must outlive this.
    explicit Door(rack::Rack& rack);

    /// Refused while the door is open; `what` begins the message: "The program was not started: the door is open. ..."
    Result<void> check_closed(const char* what) const;
    /// Returns the alarm text if the door was opened since the last call. It names the effect. `moves`: a motion is
    /// stopped. `held`: a program is in feed hold because of the door or already before; a resume continues it.
    std::optional<std::string> take_opening(bool moves, bool held);
    /// Stores the spindle and coolant states of `status` for give_back_tools(), unless some are stored.
    void keep_tools(const Status& status);
    /// Applies an event of a program, which may still pass while the axes decelerate, to the stored states. Returns
    /// true if spindle and coolant must stay off: until the resume, or while the door is open.
    bool keep_event(const control::gcode::CanonCall& event);
    /// Applies a commanded coolant state to the stored ones, if there are any.
    void keep_coolant(bool mist, bool flood);
    /// Restores the stored spindle and coolant states, once.
    void give_back_tools(Status& status);
    void forget_tools() { kept_.reset(); }

  private:
    struct Tools {
        control::gcode::Spindle spindle = control::gcode::Spindle::off;
        bool mist = false, flood = false;
    };
    rack::SafetyContacts& contacts_;
    bool was_open_ = false;
    std::optional<Tools> kept_;
};

}  // namespace motionrack::operate
