// System commands: lines that begin with $, and the states in which each is accepted.
#pragma once

#include <motionrack/grbl/answers.hpp>
#include <motionrack/grbl/gcode_lines.hpp>
#include <motionrack/grbl/grbl_state.hpp>
#include <motionrack/grbl/pending_answer.hpp>
#include <motionrack/grbl/reports.hpp>
#include <motionrack/grbl/sender_settings.hpp>
#include <motionrack/grbl/session_settings.hpp>
#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::grbl {

class SystemCommands {
  public:
    /// Read and changed by the commands. All must outlive them.
    struct SessionParts {
        operate::Machine& machine;
        const SessionSettings& settings;
        SenderSettings& sender_settings;
        GcodeLines& gcode;
        GrblState& state;
        const Reports& reports;
        Answers& answers;
        PendingAnswer& pending;
    };
    explicit SystemCommands(const SessionParts& parts) : on_(parts) {}

    /// Executes a command. Returns its error number; answer_later, or reset_now: it was answered, and the session must
    /// be reset.
    int execute(const std::string& text);

  private:
    int execute_at_rest(const std::string& text);
    int restore(const std::string& text);
    int check_mode();
    int unlock();
    int home();
    int jog(const std::string& text);
    bool control() { return take_control(on_.settings, on_.answers); }

    const SessionParts on_;
};

}  // namespace motionrack::grbl
