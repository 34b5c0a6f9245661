// Converts one line of G-code from words to canonical calls: modal state, order of execution, pending calls.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/scanner.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr double largest_line_number = 9'999'999;
/// Result of M66.
constexpr int input_parameter = 5399;

}  // namespace

Interpreter::Interpreter(const Settings& settings) : settings_(settings) {
    travel_.start(settings);
    modes_.start(settings.path_tolerance_mm, settings.start_in_g0);
    offsets_.start(settings);
}

Outcome<void> Interpreter::line(std::string_view text, std::int32_t number, Language language) {
    steps_.begin_line();
    held_.begin_line();
    words_.begin_line(number, language);
    steps_.apply_end(modes_, offsets_);
    const MachineParameters known(*this);
    if (!words_.scan(text, {settings_.block_delete, language, &known}) || !evaluate()) {
        steps_.clear();
        return words_.problem_of(number);
    }
    return {};
}

bool Interpreter::evaluate() {
    modes_.begin_line();
    offsets_.begin_line();
    cutter_plan_.clear();
    turning_.reset();
    words_.begin_interpretation();
    travel_.begin_line();
    if (!check_values()) return false;
    if (block().has_m(m_program) && !program_words()) return false;
    if ((block().m_groups | (block().words & (letter_bit('S') | letter_bit('T')))) != 0 && !apply_machine_words())
        return false;
    if ((block().g_groups & ~(1u << g_motion)) != 0 && !apply_modes()) return false;
    if (next().cutter != CutterSide::off && !cutter_allows()) return false;
    if (block().has('F')) apply_feed();
    if (block().has_g(g_nonmodal) && !nonmodal()) return false;
    if (!motion()) return false;
    if (block().has_m(m_io) && !ports()) return false;
    if (steps_.ends_program() && next().cutter != CutterSide::off && !end_cutter()) return false;
    if (held_.full() && !may_wait()) return false;
    if (!words_.need_all_used(next().motion)) return false;
    if (!block().comments.empty()) steps_.add_comments();
    if (!block().assignments.empty() && !assign()) return false;
    if (!block().comments.empty()) show_values();
    if (block().has_m(m_state)) modes_.save(block().m[m_state], static_cast<std::size_t>(parameters_.level()));
    if (block().has_m(m_io) && block().m[m_io] == 66) parameters_.set(input_parameter, steps_.port_value());
    commit();
    return true;
}

/// Executes all assignments, or none if a name does not fit.
bool Interpreter::assign() {
    std::size_t global = 0, local = 0;
    for (const auto& [parameter, value] : block().assignments) {
        if (parameter.number > 0 || parameters_.named(parameter.name)) continue;
        if (++(is_global(parameter.name) ? global : local) > parameters_.capacity_for(parameter.name)) {
            return words_.fail_at(
                block().text.find('#'), GrblStatus::unsupported,
                fmt::format("#<{}> is one named parameter too many; there may be {}", parameter.name, max_names));
        }
    }
    for (const auto& [parameter, value] : block().assignments) {
        if (parameter.number > 0)
            parameters_.set(parameter.number, value);
        else
            parameters_.set(parameter.name, value);
    }
    return true;
}

bool Interpreter::check_values() {
    constexpr std::uint32_t not_negative = letter_bit('F') | letter_bit('N') | letter_bit('P') | letter_bit('S') |
                                           letter_bit('T') | letter_bit('L') | letter_bit('Q');
    for (std::uint32_t left = block().words & not_negative; left != 0; left &= left - 1) {
        const int index = std::countr_zero(left);
        if (block().value[index] >= 0) continue;
        const char letter = static_cast<char>('A' + index);
        if ((letter == 'P' || letter == 'Q') && negative_handles()) continue;
        if (letter == 'Q' && block().has_m(m_io) && block().m[m_io] >= 67) continue;  // a value
        return words_.fail_word(letter, GrblStatus::negative_value,
                                fmt::format("{} is negative; {} must be 0 or more", words_.word_text(letter), letter));
    }
    if (const std::uint32_t absent = block().words & axis_words & ~travel_.present_words(); absent != 0) {
        const char letter = static_cast<char>('A' + std::countr_zero(absent));
        std::string present;
        for (const char axis : axis_letters) {
            if ((travel_.present_words() & letter_bit(axis)) != 0)
                present += present.empty() ? std::string(1, axis) : fmt::format(" {}", axis);
        }
        return words_.fail_word(
            letter, GrblStatus::unsupported,
            fmt::format("{}: this machine has no {} axis (it has {}); take the word out or set the axis up",
                        words_.word_text(letter), letter, present.empty() ? "none" : present));
    }
    if (block().has('N') && (block()['N'] > largest_line_number || block()['N'] != std::floor(block()['N']))) {
        return words_.fail_word(
            'N', GrblStatus::bad_line_number,
            fmt::format("{}: line numbers are integers from N0 to N9999999", words_.word_text('N')));
    }
    if (block().has('T')) {
        if (!words_.need_integer('T', 0, 1e9, "a tool number")) return false;
        if (block()['T'] > largest_tool)
            return words_.fail_word('T', GrblStatus::value_too_large,
                                    fmt::format("{}: tools are T0 to T99999", words_.word_text('T')));
        if (!require_tool('T', static_cast<std::int32_t>(block()['T']))) return false;
    }
    return true;
}

bool Interpreter::apply_modes() {
    if (block().has_g(g_units)) next().inch = block().g[g_units] == 200;
    if (block().has_g(g_feed_mode)) {
        const bool inverse = block().g[g_feed_mode] == 930;
        if (inverse != next().inverse_time) next().feed = next().feed_rotary = 0;
        next().inverse_time = inverse;
    }
    if (block().has_g(g_plane)) next().plane = static_cast<std::uint8_t>((block().g[g_plane] - 170) / 10);
    if (block().has_g(g_distance)) next().incremental = block().g[g_distance] == 910;
    if (block().has_g(g_arc_distance)) next().arc_absolute = block().g[g_arc_distance] == 901;
    if (block().has_g(g_retract)) next().retract_to_r = block().g[g_retract] == 990;
    if (block().has_g(g_cutter) && !cutter()) return false;
    if (block().has_g(g_tool_length) && !tool_length()) return false;
    if (block().has_g(g_system)) {
        const int code = block().g[g_system];
        next().system = static_cast<std::uint8_t>(code > 590 ? code - 585 : (code - 540) / 10);
        edit_frame().activate(next().system);
    }
    if (block().has_g(g_path)) {
        const int code = block().g[g_path];
        next().path = code == 610   ? PathControl::exact_path
                      : code == 611 ? PathControl::exact_stop
                                    : PathControl::continuous;
        if (code == 640) {
            next().tolerance_mm = settings_.path_tolerance_mm;
            const bool others =
                block().has_g(g_nonmodal) && (block().g[g_nonmodal] == 40 || block().g[g_nonmodal] == 100);
            if (block().has('P') && !others) {
                next().tolerance_mm = scaled('P');
                words_.use(letter_bit('P'));
            }
        }
    }
    return true;
}

void Interpreter::apply_feed() {
    if (next().inverse_time) {
        next().feed = block()['F'] / 60;
    } else {
        next().feed = scaled('F') / 60;
        next().feed_rotary = block()['F'] / 60;
    }
}

void Interpreter::commit() {
    steps_.commit(position(), next().feed_override);
    travel_.commit();
    modes_.commit();
    offsets_.commit();
    if (modes().cutter != CutterSide::off || off_path_) commit_cutter();
    if (steps_.is_probing()) store_probe_result(true, travel_.position());
}

Point Interpreter::program_position() const {
    return frame().to_program(position());
}

}  // namespace motionrack::control::gcode
