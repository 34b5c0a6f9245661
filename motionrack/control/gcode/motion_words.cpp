// The motion of a line.
#include <fmt/format.h>

#include <bit>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/motion_words.hpp>
#include <motionrack/control/gcode/spline_words.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

bool MotionWords::read() {
    const bool is_explicit = block().has_g(g_motion);
    std::int16_t code = is_explicit ? block().g[g_motion] : modes().motion;
    if (code == 800) code = no_motion;
    next().motion = code;
    if (is_explicit && is_turning(code)) return rule_of_g(code).handler(in_, code);
    const bool own_axis_words = !axis_words_taken() && (block().words & axis_words) != 0;
    const bool own_offsets = (is_arc(code) || is_spline(code)) && (block().words & offset_words) != 0;
    const bool wants_motion = own_axis_words || (own_offsets && !axis_words_taken());
    if (!wants_motion && !is_explicit && !block().has_g(g_nonmodal)) return true;
    if (!motion_needs(code, wants_motion)) return false;
    if (!wants_motion) return true;
    use(axis_words);
    return rule_of_g(code).handler(in_, code);
}

/// Checks the combination of axis words and motion word.
bool MotionWords::motion_needs(std::int16_t code, bool wants_motion) {
    const bool is_explicit = block().has_g(g_motion);
    if (axis_words_taken() && is_explicit && code != no_motion) {
        const GroupG other =
            block().has_g(g_tool_length) && block().g[g_tool_length] != 490 ? g_tool_length : g_nonmodal;
        return fail_at(block().g_column[g_motion], GrblStatus::axis_conflict,
                       fmt::format("{} and {} on one line both use axis words; put them on two lines", name_of_g(code),
                                   name_of_g(block().g[other])));
    }
    if (block().has_g(g_nonmodal) && block().g[g_nonmodal] == 530) {
        const std::size_t column = block().g_column[g_nonmodal];
        if (code != 0 && code != 10) {
            return fail_at(
                column, GrblStatus::g53_without_line,
                fmt::format("G53 (machine coordinates) needs G0 or G1, and {} is active; write e.g. G53 G0 Z0",
                            code == no_motion ? "no motion" : name_of_g(code)));
        }
        if (!wants_motion) {
            return fail_at(column, GrblStatus::no_axis_words,
                           "axis words missing: G53 needs a target; write e.g. G53 G0 Z0");
        }
    }
    if (code == no_motion && wants_motion) {
        const char letter = static_cast<char>('A' + std::countr_zero(block().words & axis_words));
        return fail_word(letter, GrblStatus::axis_words_unused,
                         fmt::format("{}: no motion is active {}; write G0 (rapid) or G1 (feed) before it",
                                     word_text(letter), is_explicit ? "after G80" : "here"));
    }
    if (is_explicit && !wants_motion && !axis_words_taken() && is_spline(code))
        return SplineWords(in_).spline_allowed(code);
    if (is_explicit && !wants_motion && !axis_words_taken() && (is_arc(code) || is_cycle(code) || is_probing(code))) {
        return fail_at(block().g_column[g_motion], GrblStatus::no_axis_words,
                       is_probing(code) ? fmt::format("{} needs a target to probe towards; write e.g. {} Z-10 F60",
                                                      name_of_g(code), name_of_g(code))
                       : is_arc(code)   ? fmt::format("{} needs an end and a centre; write e.g. {} X10 Y0 I5 J0",
                                                      name_of_g(code), name_of_g(code))
                                        : fmt::format("{} needs a position and a depth; write e.g. {} X10 Y10 Z-5 R2",
                                                      name_of_g(code), name_of_g(code)));
    }
    return true;
}

}  // namespace motionrack::control::gcode
