// Errors of words: their place in the line, numbers that must be integers, words that no code uses.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/line_words.hpp>
#include <motionrack/control/gcode/scanner.hpp>
#include <utility>

namespace motionrack::control::gcode {

bool LineWords::fail_at(std::size_t column, GrblStatus status, std::string message, ErrorKind trouble) {
    set_problem(problem_, block_.text, column, status, std::move(message), trouble);
    return false;
}

bool LineWords::fail_word(char letter, GrblStatus status, std::string message) {
    return fail_at(block_.column[letter_index(letter)], status, std::move(message));
}

std::string_view LineWords::word_text(char letter) const {
    return word_at(block_.text, block_.column[letter_index(letter)]);
}

bool LineWords::need_integer(char letter, double low, double high, const char* meaning) {
    const double value = block_[letter];
    if (value != std::floor(value)) {
        return fail_word(
            letter, GrblStatus::not_an_integer,
            fmt::format("{}: {} is {}, an integer; write e.g. {}{}", word_text(letter), letter, meaning, letter, low));
    }
    if (value < low || value > high) {
        return fail_word(letter, GrblStatus::value_too_large,
                         fmt::format("{}: {} is {}, from {} to {}", word_text(letter), letter, meaning, low, high));
    }
    return true;
}

tl::unexpected<Problem> LineWords::problem_of(std::int32_t number) {
    problem_.location.line = number;
    return tl::unexpected<Problem>(problem_);
}

tl::unexpected<Problem> LineWords::problem_of_earlier(std::int32_t number) {
    set_problem(problem_, {}, 0, problem_.status, std::move(problem_.message));
    return problem_of(number);
}

std::size_t LineWords::error_column() const {
    if (block_.has_g(g_motion)) return block_.g_column[g_motion];
    std::size_t first = block_.text.size();
    for (std::uint32_t left = block_.words & (axis_words | offset_words); left != 0; left &= left - 1) {
        first = std::min<std::size_t>(first, block_.column[std::countr_zero(left)]);
    }
    return first;
}

bool LineWords::claim(std::uint32_t letters, std::int16_t code) {
    const std::uint32_t present = letters & block_.words;
    if ((present & used_) != 0) return fail_claim(static_cast<char>('A' + std::countr_zero(present & used_)), code);
    use(letters);
    for (std::uint32_t left = present; left != 0; left &= left - 1)
        claimed_by_[static_cast<std::size_t>(std::countr_zero(left))] = code;
    return true;
}

bool LineWords::fail_claim(char letter, std::int16_t code) {
    const auto name = [](std::int16_t of) { return of < 0 ? fmt::format("M{}", ~of) : name_of_g(of); };
    const std::int16_t first = claimed_by_[static_cast<std::size_t>(letter_index(letter))];
    return fail_word(letter, GrblStatus::axis_conflict,
                     fmt::format("{}: {} and {} both use the {} word; put them on two lines", word_text(letter),
                                 name(first), name(code), letter));
}

/// Detects X1e3: the E would be a separate word.
bool LineWords::fail_exponent() {
    const std::string_view text = block_.text;
    const std::size_t column = block_.column[letter_index('E')];
    if (column == 0 || !(is_digit(text[column - 1]) || text[column - 1] == '.')) return false;
    std::size_t begin = column;
    while (begin > 0 && !is_letter(text[begin - 1])) --begin;
    if (begin > 0) --begin;
    return !fail_at(begin, GrblStatus::bad_number,
                    fmt::format("{}{}: numbers of G-code have no exponent; write 1000, not 1e3",
                                text.substr(begin, column - begin), word_text('E')));
}

bool LineWords::fail_unused(std::int16_t motion) {
    const int index = std::countr_zero(block_.words & ~used_);
    const char letter = static_cast<char>('A' + index);
    const char* hint = "";
    if (letter == 'I' || letter == 'J' || letter == 'K') {
        hint = motion == 20 || motion == 30
                   ? "; the offsets of an arc are I J in G17, I K in G18, J K in G19, and none beside R"
                   : "; it is the centre of an arc (G2, G3)";
    } else if (letter == 'R') {
        hint = "; it is the radius of an arc (G2, G3) or the retract height of a drilling cycle (G73, G81 .. G89)";
    } else if (letter == 'P') {
        hint =
            "; use it with G4, G10, G64, M50 .. M53, M62 .. M66 and the cycles that wait, and with arcs that have an "
            "end or offsets on the same line";
    } else if (letter == 'L') {
        hint = "; use it with G10, M66 and the drilling cycles (G73, G81 .. G89)";
    } else if (letter == 'E') {
        if (fail_exponent()) return false;
        hint = "; use it with M66, M67 and M68 (an analog input or output); the machine has no extruder";
    } else if (letter == 'D') {
        hint = "; use it with G41, G42 (a tool's number), G41.1 and G42.1 (a diameter)";
    } else if (letter == 'H') {
        hint = "; use it with G43 and G43.2 (a tool's number)";
    } else if (letter == 'Q') {
        hint =
            "; it is the peck depth of G73 and G83, a control point of G5, the longest wait of M66, and the value of "
            "M67 and M68";
    }
    return fail_word(letter, GrblStatus::unused_word,
                     fmt::format("{}: nothing on this line uses the {} word{}", word_text(letter), letter, hint));
}

}  // namespace motionrack::control::gcode
