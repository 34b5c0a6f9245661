// G-code lines of a sender: executed by the machine, or in check mode read only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <motionrack/operate/machine.hpp>
#include <optional>
#include <string>
#include <utility>

namespace motionrack::grbl {

inline constexpr std::size_t planner_blocks = 15;  ///< number of blocks a sender can fill

class GcodeLines {
  public:
    /// The machine must outlive this.
    explicit GcodeLines(operate::Machine& machine) : machine_(machine) {}

    /// Returns the interpreter that reads lines: the machine's, or in check mode ($C) its own.
    const control::gcode::Interpreter& interpreter() const {
        return check_ ? *check_ : machine_.stream().interpreter();
    }
    /// Returns the motion mode for $G: N of GN; 80 after G80; 0 before the first one, as in Grbl.
    int motion_mode() const;
    /// Returns the N word of the line being executed, if it has one.
    std::optional<std::int32_t> executed_n_word() const;

    /// Returns true if the machine accepts a line and a block is free.
    bool has_room() const;
    std::size_t free_blocks() const;

    bool is_checking() const { return check_.has_value(); }
    void begin_check();
    /// Reads a line without executing it. Requires check mode.
    control::gcode::Outcome<void> check(const std::string& text) { return check_->line(text, 0); }
    /// Passes a line to the machine; sends G0 first if no motion mode is set, because a Grbl starts in G0.
    control::gcode::Outcome<void> execute(const std::string& text, std::int32_t n_word);
    /// Notes whether the block sets a motion mode or G80. Call for each line that was accepted.
    void note_motion_mode(const control::gcode::Block& block);

    void drop_executed_n_words();
    void drop_n_words() { n_words_.clear(); }
    void reset();

  private:
    operate::Machine& machine_;
    std::optional<control::gcode::Interpreter> check_;  ///< check mode
    std::int32_t line_number_ = 0;
    std::deque<std::pair<std::int32_t, std::int32_t>> n_words_;  ///< N words of lines that are not executed yet
    bool was_g80_ = false;                                       ///< no motion mode, because of G80
};

}  // namespace motionrack::grbl
