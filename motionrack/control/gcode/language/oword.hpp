// Parser of one line with an O word: o100 while [#1 LT 5], o<drill> call [1] [2].
#pragma once

#include <motionrack/control/gcode/problem.hpp>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

enum class OWord : unsigned char {
    sub,
    endsub,
    call,
    return_sub,
    if_true,
    else_if,
    else_branch,
    endif,
    while_true,
    endwhile,
    do_once,
    repeat,
    endrepeat,
    break_loop,
    continue_loop,
    numbered  ///< O100 alone: start of a numbered program
};

struct OWordStatement {
    std::string label;      ///< "100" or "<drill>", lower case; empty if computed
    bool computed = false;  ///< o#1 call, o[#1 + 1] call: its value starts behind the O
    OWord word = OWord::sub;
    std::uint16_t column = 0;  ///< column of the O, from 0
    std::uint16_t rest = 0;    ///< column of the arguments, or the end of the line
};

/// Returns an O word as written: "while".
std::string_view name_of(OWord word);

/// Parses the line whose O word starts at `column` (from 0). Returns false with the error, without the line number, in
/// `problem`.
bool parse_oword(std::string_view text, std::size_t column, OWordStatement& line, Problem& problem);

/// Returns the column of an O word at the start of a line, behind '/' and N; npos if there is none.
std::size_t find_oword(std::string_view text, bool block_delete);

/// Detects the closing '%' of a program. A '%' before the first words of the text does not count. Lines with errors
/// must be passed as well, so that all readers of a text find the same end.
class ProgramEndDetector {
  public:
    explicit ProgramEndDetector(bool block_delete) : block_delete_(block_delete) {}

    /// Processes the next line of the text; returns true if it is the end.
    bool is_at(std::string_view line);
    /// Returns true after a line with more than comments.
    bool begun() const { return begun_; }

  private:
    bool block_delete_;
    bool begun_ = false;
};

/// Returns true if only blanks and comments follow from `at` on.
bool is_rest_empty(std::string_view text, std::size_t at);

}  // namespace motionrack::control::gcode
