// Checks values of words; applies modal G codes and the feed rate.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <motionrack/control/gcode/mode_words.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr double largest_line_number = 9'999'999;

}  // namespace

bool ModeWords::check() {
    constexpr std::uint32_t not_negative = letter_bit('F') | letter_bit('N') | letter_bit('P') | letter_bit('S') |
                                           letter_bit('T') | letter_bit('L') | letter_bit('Q');
    for (std::uint32_t left = block().words & not_negative; left != 0; left &= left - 1) {
        const int index = std::countr_zero(left);
        if (block().value[index] >= 0) continue;
        const char letter = static_cast<char>('A' + index);
        if ((letter == 'P' || letter == 'Q') && negative_handles()) continue;
        if (letter == 'Q' && block().has_m(m_io) && block().m[m_io] >= 67) continue;  // a value
        return fail_word(letter, GrblStatus::negative_value,
                         fmt::format("{} is negative; {} must be 0 or more", word_text(letter), letter));
    }
    if (const std::uint32_t absent = block().words & axis_words & ~travel().present_words(); absent != 0) {
        const char letter = static_cast<char>('A' + std::countr_zero(absent));
        std::string present;
        for (const char axis : axis_letters) {
            if ((travel().present_words() & letter_bit(axis)) != 0)
                present += present.empty() ? std::string(1, axis) : fmt::format(" {}", axis);
        }
        return fail_word(
            letter, GrblStatus::unsupported,
            fmt::format("{}: this machine has no {} axis (it has {}); take the word out or set the axis up",
                        word_text(letter), letter, present.empty() ? "none" : present));
    }
    if (block().has('N') && (block()['N'] > largest_line_number || block()['N'] != std::floor(block()['N']))) {
        return fail_word('N', GrblStatus::bad_line_number,
                         fmt::format("{}: line numbers are integers from N0 to N9999999", word_text('N')));
    }
    if (block().has('T')) {
        if (!need_integer('T', 0, 1e9, "a tool number")) return false;
        if (block()['T'] > largest_tool)
            return fail_word('T', GrblStatus::value_too_large,
                             fmt::format("{}: tools are T0 to T99999", word_text('T')));
        if (!require_tool('T', static_cast<std::int32_t>(block()['T']))) return false;
    }
    return true;
}

bool ModeWords::set_feed_mode(std::int16_t code) {
    const bool inverse = code == 930;
    if (inverse != next().inverse_time) next().feed = next().feed_rotary = 0;
    next().inverse_time = inverse;
    return true;
}

bool ModeWords::set_system(std::int16_t code) {
    next().system = static_cast<std::uint8_t>(code > 590 ? code - 585 : (code - 540) / 10);
    edit_frame().activate(next().system);
    return true;
}

bool ModeWords::set_path(std::int16_t code) {
    next().path = code == 610   ? PathControl::exact_path
                  : code == 611 ? PathControl::exact_stop
                                : PathControl::continuous;
    if (code != 640) return true;
    if (!claim_for_g(code, letter_bit('P'))) return false;
    // P0 gives no tolerance, as in LinuxCNC; a tolerance of 0 would stop at each corner, which is G61.
    const bool has_tolerance = block().has('P') && block()['P'] > 0;
    next().tolerance_mm = has_tolerance ? scaled('P') : settings().path_tolerance_mm;
    return true;
}

void ModeWords::apply_feed() {
    if (next().inverse_time) {
        next().feed = block()['F'] / 60;
    } else {
        next().feed = scaled('F') / 60;
        next().feed_rotary = block()['F'] / 60;
    }
}

/// Returns true if P and Q may be negative: as distances of G5, not as a time, a tolerance or a depth.
bool ModeWords::negative_handles() const {
    const std::int16_t code = block().has_g(g_motion) ? block().g[g_motion] : modes().motion;
    return code == 50 && !block().has_g(g_nonmodal) && !block().has_g(g_path) && !block().has_m(m_tool) &&
           !block().has_m(m_override);
}

}  // namespace motionrack::control::gcode
