// Index of the O words of a text and their pairing, for jumps.
#pragma once

#include <map>
#include <motionrack/control/gcode/language/oword.hpp>
#include <motionrack/control/gcode/program_lines.hpp>
#include <vector>

namespace motionrack::control::gcode {

/// Index of a location that does not exist.
inline constexpr std::int32_t no_location = -1;

/// A line with an O word. Locations are indices into OWordIndex::places.
///
///     o1 if [..]      begin of all four is the if; branch of the if is the elseif, of the elseif the else, of the
///     o1 elseif [..]  else the endif; end of all is the endif
///     o1 else
///     o1 endif
///     o2 while [..]   likewise do .. while, repeat .. endrepeat, sub .. endsub; break, continue: those of their loop;
///     o2 endwhile     return: those of its sub
struct OWordLocation {
    OWord word = OWord::sub;
    std::uint16_t column = 0;  ///< column of the O word, from 0
    std::uint16_t rest = 0;    ///< column of its arguments, from 0
    std::int32_t line = 0;     ///< line number, from 1
    std::int32_t label = 0;    ///< equal labels have equal numbers
    std::int32_t begin = no_location;
    std::int32_t branch = no_location;
    std::int32_t end = no_location;
    std::string_view text;  ///< text of the line
    ProgramLines before;    ///< position before the line
    ProgramLines after;     ///< position after the line

    OWordLocation(const ProgramLines& from, const ProgramLines& to) : before(from), after(to) {}
};

struct OWordIndex {
    std::vector<OWordLocation> locations;                       ///< in line order
    std::map<std::string, std::int32_t, std::less<>> subs;      ///< locations of the subs, by label
    std::map<std::string, std::int32_t, std::less<>> programs;  ///< as `subs`, for numbered programs (O100 .. M99)
    std::vector<Problem> problems;                              ///< errors in the pairing, without the file
    std::int32_t lines = 0;                                     ///< number of lines of the text

    /// Returns the location in `line`, or no_location.
    std::int32_t at_line(std::int32_t line) const;
};

/// Indexes the whole text, or up to its closing '%'. At most 100 problems.
OWordIndex index_owords(std::string_view text, bool block_delete);

}  // namespace motionrack::control::gcode
