// An error in a line of G-code: an Error with the word as written and the status number of Grbl.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <tl/expected.hpp>

namespace motionrack::control::gcode {

/// Status numbers of Grbl 1.1 ("error:n") that a line of G-code can cause.
enum class GrblStatus : int {
    none = 0,
    expected_letter = 1,
    bad_number = 2,
    system_command = 3,
    negative_value = 4,
    line_too_long = 11,
    travel_exceeded = 15,  ///< used by Grbl for jogs; a program that leaves the travel raises its alarm 2
    unsupported = 20,
    modal_group = 21,
    no_feed = 22,
    not_an_integer = 23,
    axis_conflict = 24,
    word_repeated = 25,
    no_axis_words = 26,
    bad_line_number = 27,
    word_missing = 28,
    no_such_system = 29,
    g53_without_line = 30,
    axis_words_unused = 31,
    no_plane_axis = 32,
    bad_target = 33,
    bad_radius = 34,
    no_offsets = 35,
    unused_word = 36,
    tool_length_axis = 37,
    value_too_large = 38
};

/// An Error (sentence, file, line, column) of one line; the line had no effect.
struct Problem : Error {
    GrblStatus status = GrblStatus::none;
    std::string word;  ///< as written, at the column of the error; empty if no word is the cause
};

template <class T>
using Outcome = tl::expected<T, Problem>;

}  // namespace motionrack::control::gcode
