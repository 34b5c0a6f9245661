#include <fmt/format.h>

#include <motionrack/control/gcode/words.hpp>
#include <motionrack/grbl/line_rules.hpp>

namespace motionrack::grbl {

using control::gcode::Block;
using control::gcode::Interpreter;

namespace {

control::gcode::Spindle spindle_of(int code) {
    using control::gcode::Spindle;
    return code == 3 ? Spindle::clockwise : code == 4 ? Spindle::counter_clockwise : Spindle::off;
}

/// Returns error_none if the block is a valid jog, else Grbl's error number.
int fault_of_jog(const Block& block, int axes) {
    using namespace control::gcode;
    constexpr unsigned groups = 1u << g_units | 1u << g_distance | 1u << g_nonmodal;
    if (block.percent || block.m_groups != 0 || (block.g_groups & ~groups) != 0 ||
        (block.has_g(g_nonmodal) && block.g[g_nonmodal] != 530))
        return error_jog;
    if (!grbl_has(block, axes)) return error_unsupported;
    if ((block.words & ~(axis_words | letter_bit('F') | letter_bit('N'))) != 0) return error_unused_words;
    if (!block.has('F')) return error_no_feed;
    return (block.words & axis_words) == 0 ? error_no_axis_words : error_none;
}

}  // namespace

bool grbl_has(const Block& block, int axes) {
    using namespace control::gcode;
    const std::uint32_t others = axes > 3 ? letter_bit('B') | letter_bit('C') : rotary_words;
    const bool cutter = block.has_g(g_cutter) && block.g[g_cutter] != 400;
    return (block.words & others) == 0 && !block.has_m(m_tool) && !cutter;
}

bool must_stand_first(const Block& block, const Interpreter& interpreter, bool laser) {
    using namespace control::gcode;
    const ModalState& modes = interpreter.modes();
    if (stands_first(block)) return true;
    if (block.has_g(g_system) && block.g[g_system] != 540 + 10 * modes.system) return true;
    if (block.has_g(g_tool_length) && interpreter.frame().tool[2] != 0) return true;
    if (block.has_m(m_spindle) && spindle_of(block.m[m_spindle]) != modes.spindle) return !laser;
    if (block.has('S') && block['S'] != modes.speed_rpm) return !laser;
    return (block.has_m(m_mist) && !modes.mist) || (block.has_m(m_flood) && !modes.flood) ||
           (block.has_m(m_coolant_off) && (modes.mist || modes.flood));
}

bool starts_something(Interpreter& read) {
    using Kind = control::gcode::CanonCallKind;
    while (const control::gcode::CanonCall* call = read.pull())
        if ((call->kind == Kind::move && call->move.kind != control::MoveKind::dwell) ||
            (call->kind == Kind::spindle && call->spindle != control::gcode::Spindle::off) ||
            (call->kind == Kind::coolant && (call->mist || call->flood)) ||
            (call->kind == Kind::output && call->value != 0))
            return true;
    return false;
}

JogLine read_jog(const std::string& text, Interpreter reader, int axes) {
    using namespace control::gcode;
    const auto wrong = [](int error) { return JogLine{error, {}, 0}; };
    if (text.size() < 3 || text[2] != '=') return wrong(error_unknown);
    const std::string_view words = std::string_view(text).substr(3);
    Block block;
    Problem problem;
    if (!scan_line(words, {}, block, problem)) return wrong(static_cast<int>(problem.status));
    if (const int fault = fault_of_jog(block, axes); fault != error_none) return wrong(fault);
    const std::string line = fmt::format("G1G94{}", words);
    if (const auto read = reader.line(line, 0); !read) return wrong(static_cast<int>(read.error().status));
    const CanonCall* step = reader.pull();
    if (step == nullptr) return wrong(error_locked);
    return {error_none, step->move.end, step->move.feed};
}

}  // namespace motionrack::grbl
