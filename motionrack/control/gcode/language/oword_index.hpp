// Where the O words of a text are, and which belong together: so that who walks through it can jump.
#pragma once

#include <map>
#include <motionrack/control/gcode/language/oword.hpp>
#include <motionrack/control/gcode/program_lines.hpp>
#include <vector>

namespace motionrack::control::gcode {

/// Nothing belongs to it.
inline constexpr std::int32_t no_location = -1;

/// A line with an O word in its text. Places are indices into OWordIndex::places.
///
///     o1 if [..]      begin of all four is the if; branch of the if is the elseif, of the elseif the else, of the
///     o1 elseif [..]  else the endif; end of all is the endif
///     o1 else
///     o1 endif
///     o2 while [..]   likewise do .. while, repeat .. endrepeat, sub .. endsub; break, continue: those of their loop;
///     o2 endwhile     return: those of its sub
struct OWordLocation {
    OWord word = OWord::sub;
    std::uint16_t column = 0;  ///< of the O word, from 0
    std::uint16_t rest = 0;    ///< of its arguments
    std::int32_t line = 0;     ///< from 1
    std::int32_t label = 0;    ///< the same number for the same label
    std::int32_t begin = no_location;
    std::int32_t branch = no_location;
    std::int32_t end = no_location;
    std::string_view text;  ///< the line
    ProgramLines before;    ///< from where the line is next
    ProgramLines after;     ///< from where what follows it is next

    OWordLocation(const ProgramLines& from, const ProgramLines& to) : before(from), after(to) {}
};

struct OWordIndex {
    std::vector<OWordLocation> places;                          ///< in the order of their lines
    std::map<std::string, std::int32_t, std::less<>> subs;      ///< by label
    std::map<std::string, std::int32_t, std::less<>> programs;  ///< numbered ones: O100 .. M99
    std::vector<Problem> problems;  ///< of O words that do not fit together, without the file
    std::int32_t lines = 0;         ///< of the text

    /// The place in `line`; no_location: none.
    std::int32_t at_line(std::int32_t line) const;
};

/// Reads the whole text, or up to its closing '%'. At most 100 problems.
OWordIndex index_owords(std::string_view text, bool block_delete);

}  // namespace motionrack::control::gcode
