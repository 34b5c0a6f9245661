// Control flow of a program: selects the next line according to the O words.
//
//     o100 sub .. endsub      a subprogram, before or after its calls; skipped when reached in sequence
//     o100 call [..] [..]     up to 30 arguments, #1 .. #30 there; o100 return [..] or endsub [..] sets #<_value>
//     o100 if [..] .. elseif [..] .. else .. endif
//     o100 while [..] .. endwhile      o100 do .. while [..]      o100 repeat [..] .. endrepeat
//     o100 break, continue    of the loop with that label
//     O100 .. M99             a numbered program, anywhere in the text; M98 P100 L3 calls it, with #1 .. #30 of the
//                             caller
//
// A call of o<name> that the text does not contain goes to Settings::subprogram. A program ends after M2 or M30, at the
// end of its text, or at a '%' that is not its first line with content. A plain program has no overhead: the first O
// word creates an index of the text.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/oword_index.hpp>
#include <motionrack/control/gcode/language/program_texts.hpp>
#include <motionrack/control/gcode/language/repeat_loops.hpp>
#include <optional>

namespace motionrack::control::gcode {

class ProgramFlow {
  public:
    /// `text` must stay valid.
    ProgramFlow(std::string_view text, const Settings& settings, std::string file);

    /// Returns the next line to read; false at the end.
    bool next(std::string_view& line) { return !over_ && (lines_.next(line) || text_ended()); }
    /// Processes a valid line: executes its O word and checks for the end of the program. Errors: the O word cannot be
    /// executed, and is skipped.
    Outcome<void> line_accepted(Interpreter& interpreter) {
        const Block& block = interpreter.block();
        if (block.percent || !end_.begun()) see_end(block.text);
        if (block.has_o_word) return follow(interpreter);
        if (block.has_m(m_program)) return follow_program(interpreter);
        if (interpreter.is_lathe_cycle()) return follow_contour(interpreter);
        if (block.has_m(m_stop) && (block.m[m_stop] == 2 || block.m[m_stop] == 30)) end();
        return {};
    }

    /// Ends the program.
    void end() { over_ = true; }

    /// Returns the line of the program; within another file, the line that called it.
    std::int32_t number() const { return called_at_ != 0 ? called_at_ : lines_.number(); }
    /// Returns the highest number() so far.
    std::int32_t highest_line() const { return std::max(furthest_, number()); }
    const std::string& file() const { return texts_.program().file; }  ///< file of the program
    bool at_end() const { return lines_.at_end(); }
    /// Processes a line with an error: completes the position in `problem` and checks for the end of the program.
    void line_rejected(std::string_view text, Problem& problem);

    /// Returns true if O words of the text do not match, as an if without endif; nothing more is executed then.
    bool has_faults() const { return texts_.has_faults(); }
    Problem take_fault() { return texts_.take_fault(); }

  private:
    using SubTarget = ProgramTexts::SubTarget;
    struct CallFrame {
        ProgramLines back;
        ProgramTexts::ProgramSource* source = nullptr;
        std::int32_t called_at = 0;
        std::int32_t program = no_location;  ///< location of the numbered program; no_location: a sub
        std::int64_t left = 0;               ///< remaining repetitions
    };

    Outcome<void> follow(Interpreter& interpreter);
    Outcome<void> follow_program(Interpreter& interpreter);
    Outcome<void> follow_contour(Interpreter& interpreter);
    bool read_contour(Interpreter& reader, std::vector<ContourSegment>& contour);
    OWordLocation this_line(const Block& block, std::size_t column) const;
    bool call_program(const OWordLocation& location, Interpreter& interpreter);
    bool leave_program(const OWordLocation& location, Interpreter& interpreter);
    bool end_call(const OWordLocation& location, Interpreter& interpreter, std::optional<double> returned);
    bool text_ended();
    void enter(const SubTarget& target, std::int32_t program, std::int64_t times);
    void back_to_caller();
    void see_end(std::string_view line);
    void location(Problem& problem) const;
    bool make_index(ProgramTexts::ProgramSource& source);
    bool within_budget(const OWordLocation& location);
    bool execute(const OWordLocation& location, std::int32_t at, Interpreter& interpreter);
    bool choose(std::int32_t at, Interpreter& interpreter);
    bool begin_repeat(const OWordLocation& location, std::int32_t at, Interpreter& interpreter);
    void break_loop(const OWordLocation& loop);
    void continue_loop(const OWordLocation& loop);
    bool call(const OWordLocation& location, Interpreter& interpreter);
    bool return_sub(const OWordLocation& location, Interpreter& interpreter);
    bool find_sub(const OWordLocation& location, const std::string& label, bool numbered, SubTarget& target);
    bool load(const OWordLocation& location, const std::string& label, bool numbered, SubTarget& target);
    bool evaluate(const OWordLocation& location, Interpreter& interpreter, double& value);
    bool label_of_call(const OWordLocation& location, Interpreter& interpreter, std::string& label);
    void jump(const OWordLocation& location);
    const OWordLocation& place_at(std::int32_t at) const {
        return source_->index->locations[static_cast<std::size_t>(at)];
    }
    bool fail(const OWordLocation& location, std::size_t column, std::string message);

    ProgramLines lines_;
    bool over_ = false;
    ProgramEndDetector end_;  ///< finds the end in the text of the program
    std::int32_t called_at_ = 0;
    std::int32_t furthest_ = 0;
    std::int64_t max_lines_;
    std::int64_t walked_ = 0;        ///< number of lines executed up to the last jump
    std::int32_t counted_from_ = 0;  ///< target line of the last jump
    SubprogramSource subprogram_;
    ProgramTexts texts_;
    ProgramTexts::ProgramSource* source_;
    std::vector<CallFrame> frames_;
    RepeatLoops repeats_;
    Problem problem_;
};

}  // namespace motionrack::control::gcode
