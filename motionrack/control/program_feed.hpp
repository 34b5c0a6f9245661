// Feeds a whole program to a StreamExecutor, line by line in the order of its O words.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/gcode/step_budget.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <string>
#include <string_view>

namespace motionrack::control {

class ProgramFeed {
  public:
    /// `executor` and `text` must outlive the feed.
    ProgramFeed(StreamExecutor& executor, std::string_view text, const gcode::Settings& settings, std::string file);

    /// Feeds lines while the executor has room for them, and then the end of the program. Errors: a line cannot be
    /// executed, and nothing is fed after it.
    gcode::Outcome<void> feed();
    /// Returns true until the end of the program, or an error.
    bool more() const { return more_; }
    /// Returns the number of lines read.
    std::int64_t lines() const { return program_flow_.highest_line(); }
    /// Returns true if the program was ended by M2 or M30.
    bool ended() const { return ended_; }

  private:
    gcode::Outcome<void> line(std::string_view text);
    gcode::Outcome<void> program_over();

    StreamExecutor& executor_;
    gcode::ProgramFlow program_flow_;
    gcode::StepBudget budget_;
    std::int64_t steps_before_;  ///< steps of earlier programs
    bool more_ = true, ended_ = false;
};

}  // namespace motionrack::control
