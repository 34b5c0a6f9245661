// Settings that a sender changes with $ lines. They last until the program ends.
#pragma once

#include <array>
#include <motionrack/grbl/answers.hpp>
#include <motionrack/grbl/gcode_lines.hpp>
#include <motionrack/grbl/session_settings.hpp>
#include <motionrack/grbl/settings.hpp>
#include <motionrack/operate/machine.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::grbl {

class SenderSettings {
  public:
    /// All must outlive this.
    SenderSettings(operate::Machine& machine, const SessionSettings& settings, const GcodeLines& gcode,
                   Answers& answers)
        : machine_(machine), settings_(settings), gcode_(gcode), answers_(answers) {}

    const SessionSettingValues& values() const { return own_; }
    const std::array<std::string, 2>& startup_lines() const { return startup_lines_; }

    /// Sends the answer to $$.
    void list() const;
    /// Sends the answer to $N.
    void list_startup_lines() const;
    /// Sends the answer to $I.
    void list_build() const;

    // These return Grbl's error numbers.
    /// Changes a setting; `text`: "10=3" of $10=3.
    int store(std::string_view text);
    /// Stores a startup line; `text`: "0=G54" of $N0=G54. The line is checked but not executed. It may only set modes,
    /// since a reset starts nothing.
    int store_startup_line(std::string_view text);
    void store_build_text(std::string text) { build_text_ = std::move(text); }
    /// Restores defaults; `text`: "$RST=*". The session must be reset if it succeeds.
    int restore(const std::string& text);

  private:
    bool control() { return take_control(settings_, answers_); }

    operate::Machine& machine_;
    const SessionSettings& settings_;
    const GcodeLines& gcode_;
    Answers& answers_;
    SessionSettingValues own_;
    std::array<std::string, 2> startup_lines_;
    std::string build_text_;
};

}  // namespace motionrack::grbl
