// What a door does to a machine that people operate: opened it holds the feed and puts the spindle off, and nothing
// begins to move until it is closed. Closing it moves nothing; a resume does, and brings the spindle back.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <string>

namespace motionrack::operate {

class Door {
  public:
    /// Of a rack that must outlive this. It heeds its door itself from now on.
    explicit Door(rack::Rack& rack);

    /// Refused while it is open: "The program was not begun: the door is open. ..."
    Result<void> check_closed(const char* what) const;
    /// It was opened since the last look: the alarm, with what that does in this state.
    std::optional<std::string> take_opening(MachineState state);
    /// Spindle and coolant as they are, for resume().
    void keep_tools(const Status& status);
    /// Gives them back, once.
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
