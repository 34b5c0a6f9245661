// One line with an O word, taken apart: o100 while [#1 LT 5], o<drill> call [1] [2].
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
    numbered  ///< O100 alone: a numbered program begins
};

struct OWordStatement {
    std::string label;      ///< "100" or "<drill>", lower case; empty where it is computed
    bool computed = false;  ///< o#1 call, o[#1 + 1] call: its value begins behind the O
    OWord word = OWord::sub;
    std::uint16_t column = 0;  ///< of the O, from 0
    std::uint16_t rest = 0;    ///< where the arguments begin, or the end of the line
};

/// "while"
std::string_view name_of(OWord word);

/// Takes apart the line whose O word begins at `column` (from 0). False: `problem` says what is wrong, but not in which
/// line.
bool parse_oword(std::string_view text, std::size_t column, OWordStatement& line, Problem& problem);

/// The column of the O word with which a line begins, behind '/' and N; npos: it begins with none.
std::size_t find_oword(std::string_view text, bool block_delete);

/// Whether a text's program is over at this line, by its '%': the one with which a text begins is none, nor is what
/// stands before it. Lines that are refused count as well, so that whoever goes through a text finds the same end.
class ProgramEndDetector {
  public:
    explicit ProgramEndDetector(bool block_delete) : block_delete_(block_delete) {}

    /// The next line of the text: is it the end?
    bool is_at(std::string_view line);
    /// Whether there was a line with more than comments on it.
    bool begun() const { return begun_; }

  private:
    bool block_delete_;
    bool begun_ = false;
};

/// Whether only blanks and comments stand at `at` and behind it.
bool is_rest_empty(std::string_view text, std::size_t at);

}  // namespace motionrack::control::gcode
