// Prints canonical calls as text.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/canon.hpp>

namespace motionrack::control::gcode {

namespace {

/// Avoids -0.0000: prints 0.0000 for values that four decimals hide.
double tidy(double value) {
    return std::fabs(value) < 0.00005 ? 0.0 : value;
}

std::string six(const std::array<double, axis_count>& v) {
    return fmt::format("{:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f}", tidy(v[0]), tidy(v[1]), tidy(v[2]), tidy(v[3]),
                       tidy(v[4]), tidy(v[5]));
}

/// Converts mm and degrees to the units of the program.
Point in_units(const Point& point, bool inch) {
    Point out = point;
    for (int axis = 0; inch && axis < 3; ++axis) out[axis] /= 25.4;
    return out;
}

/// Returns true for G28 or G30 without axis words: rs274 prints a traverse to the current position before the one home.
bool straight_home(const Block& block) {
    return block.has_g(g_nonmodal) && (block.g[g_nonmodal] == 280 || block.g[g_nonmodal] == 300) &&
           (block.words & axis_words) == 0;
}

constexpr std::array<const char*, 3> canon_plane_names = {"XY", "XZ", "YZ"};

}  // namespace

void CanonPrinter::call(std::string_view text) {
    ++count_;
    if (!options_.numbered) return put_(fmt::format("{}\n", text));
    const std::string n = n_word_ < 0 ? std::string(".....") : std::to_string(n_word_);
    put_(fmt::format("{:>5} N{:<5} {}\n", count_, n, text));
}

void CanonPrinter::begin(const Interpreter& interpreter) {
    path_ = interpreter.modes().path;
    note(interpreter);
    units(interpreter.modes());
    system(interpreter);
    shift(interpreter);
    turn(interpreter);
}

void CanonPrinter::line(Interpreter& interpreter) {
    const Block& block = interpreter.block();
    n_word_ = block.has('N') ? static_cast<std::int64_t>(block['N']) : -1;
    bool fed = false;
    bool reported = false;
    const auto before = [&](CanonCallKind kind, bool dwell) {
        if (kind == CanonCallKind::comment || kind == CanonCallKind::message) return;
        if (!fed) print_restored_modes(interpreter), feed(interpreter);
        fed = true;
        const bool late = kind == CanonCallKind::pause || kind == CanonCallKind::optional_pause ||
                          kind == CanonCallKind::end || (kind == CanonCallKind::move && !dwell);
        if (late && !reported) {
            modes(interpreter);
            reported = true;
        }
    };
    std::size_t comments = 0;
    while (const CanonCall* step = interpreter.pull()) {
        if (step->kind == CanonCallKind::input || step->awaits_input) continue;  // rs274 prints neither
        late_ = interpreter.was_held();
        if (late_) {
            event(*step, interpreter);
            continue;
        }
        const bool dwell = step->kind == CanonCallKind::move && step->move.kind == MoveKind::dwell;
        before(step->kind, dwell);
        if (step->kind == CanonCallKind::move) {
            if (!dwell && straight_home(block)) here(interpreter);
            if (step->probe != Probe::none)
                probe(step->move, interpreter);
            else
                event(*step, interpreter);
        } else if (step->kind != CanonCallKind::comment || !block.comments[comments].rest_of_line) {
            event(*step, interpreter);
        }
        if (step->kind == CanonCallKind::comment || step->kind == CanonCallKind::message) ++comments;
    }
    late_ = false;
    before(CanonCallKind::move, false);
    note(interpreter);
    if (path_ != interpreter.modes().path)
        path(interpreter.modes().path, interpreter.modes().tolerance_mm, interpreter);
}

void CanonPrinter::rest(Interpreter& interpreter) {
    late_ = true;
    while (const CanonCall* step = interpreter.pull()) event(*step, interpreter);
}

void CanonPrinter::note(const Interpreter& interpreter) {
    position_ = interpreter.position();
    frame_ = interpreter.frame();
    modes_ = interpreter.modes();
}

/// Prints the modes that M72 restores on the line, or M73 at the end of a call: the line has no words for them.
void CanonPrinter::print_restored_modes(const Interpreter& interpreter) {
    const Block& block = interpreter.block();
    const bool ends_call = block.has_o_word || block.has_m(m_program);
    if (!ends_call && !(block.has_m(m_state) && block.m[m_state] == 72)) return;
    const ModalState& now = interpreter.modes();
    const auto able = [this](std::int32_t code, bool was, bool is) {
        if (was != is) overrides(code, is);
    };
    if (now.inch != modes_.inch) units(now);
    if (now.inverse_time != modes_.inverse_time) call("SET_FEED_MODE(0, 0)");
    if (now.feed != modes_.feed && !block.has('F')) feed_rate(now);
    able(50, modes_.feed_override, now.feed_override);
    able(51, modes_.speed_override, now.speed_override);
    if (now.plane != modes_.plane) plane(now);
    if (now.system != modes_.system) system(interpreter), shift(interpreter), turn(interpreter);
    able(53, modes_.feed_stop, now.feed_stop);
}

void CanonPrinter::feed(const Interpreter& interpreter) {
    const Block& block = interpreter.block();
    if (block.has_g(g_feed_mode)) {
        call("SET_FEED_MODE(0, 0)");
        if (block.g[g_feed_mode] == 940 && !block.has('F')) feed_rate(interpreter.modes());
    }
    if (block.has('F')) call(fmt::format("SET_FEED_RATE({:.4f})", block['F']));
}

void CanonPrinter::feed_rate(const ModalState& now) {
    const double scale = now.inch && !now.inverse_time ? 25.4 : 1.0;
    call(fmt::format("SET_FEED_RATE({:.4f})", now.feed * 60 / scale));
}

void CanonPrinter::modes(const Interpreter& interpreter) {
    const Block& block = interpreter.block();
    const ModalState& now = interpreter.modes();
    if (block.has_g(g_plane)) plane(now);
    if (block.has_g(g_units)) units(now);
    if (block.has_g(g_tool_length)) {
        const Point tool = in_units(interpreter.frame().tool, now.inch);
        call(fmt::format("USE_TOOL_LENGTH_OFFSET({:.4f} {:.4f} {:.4f}, {:.4f} {:.4f} {:.4f}, 0.0000 0.0000 0.0000)",
                         tidy(tool[0]), tidy(tool[1]), tidy(tool[2]), tidy(tool[3]), tidy(tool[4]), tidy(tool[5])));
    }
    const std::int16_t once = block.has_g(g_nonmodal) ? block.g[g_nonmodal] : no_motion;
    const bool shifts = once >= 920, changes = block.has_g(g_system);
    if (changes || once == 100) system(interpreter);
    if (changes || shifts) shift(interpreter);
    if (!shifts && (changes || once == 100)) turn(interpreter);
    if (block.has_g(g_path)) path(now.path, now.tolerance_mm, interpreter);
}

void CanonPrinter::units(const ModalState& now) {
    call(now.inch ? "USE_LENGTH_UNITS(CANON_UNITS_INCHES)" : "USE_LENGTH_UNITS(CANON_UNITS_MM)");
}

void CanonPrinter::plane(const ModalState& now) {
    call(fmt::format("SELECT_PLANE(CANON_PLANE_{})", canon_plane_names[now.plane]));
}

void CanonPrinter::system(const Interpreter& interpreter) {
    const ModalState& now = interpreter.modes();
    call(fmt::format("SET_G5X_OFFSET({}, {})", now.system + 1,
                     six(in_units(interpreter.frame().work[now.system], now.inch))));
}

void CanonPrinter::shift(const Interpreter& interpreter) {
    call(fmt::format("SET_G92_OFFSET({})", six(in_units(interpreter.frame().g92, interpreter.modes().inch))));
}

void CanonPrinter::turn(const Interpreter& interpreter) {
    call(fmt::format("SET_XY_ROTATION({:.4f})", tidy(interpreter.frame().rotation_deg[interpreter.modes().system])));
}

void CanonPrinter::path(PathControl path, double tolerance_mm, const Interpreter& interpreter) {
    path_ = path;
    const double tolerance = tolerance_mm / (interpreter.modes().inch ? 25.4 : 1.0);
    call(path == PathControl::exact_path ? "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)"
         : path == PathControl::exact_stop
             ? "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)"
             : fmt::format("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, {:.4f})", tolerance));
}

void CanonPrinter::event(const CanonCall& step, const Interpreter& interpreter) {
    switch (step.kind) {
        case CanonCallKind::comment:
            return call(fmt::format("COMMENT(\"{}\")", step.text));
        case CanonCallKind::message:
            return call(fmt::format("MESSAGE(\"{}\")", step.text));
        case CanonCallKind::spindle_speed:
            return call(fmt::format("SET_SPINDLE_SPEED(0, {:.4f})", step.speed_rpm));
        case CanonCallKind::spindle:
            return call(step.spindle == Spindle::clockwise           ? "START_SPINDLE_CLOCKWISE(0)"
                        : step.spindle == Spindle::counter_clockwise ? "START_SPINDLE_COUNTERCLOCKWISE(0)"
                                                                     : "STOP_SPINDLE_TURNING(0)");
        case CanonCallKind::coolant:
            if (late_ ? step.mist : interpreter.block().has_m(m_mist)) call("MIST_ON()");
            if (late_ ? step.flood : interpreter.block().has_m(m_flood)) call("FLOOD_ON()");
            if (late_ ? step.mist || step.flood : !interpreter.block().has_m(m_coolant_off)) return;
            call("MIST_OFF()");
            return call("FLOOD_OFF()");
        case CanonCallKind::tool_select:
            return call(fmt::format("SELECT_TOOL({})", step.tool));
        case CanonCallKind::tool_change:
            call("START_CHANGE()");
            return call(fmt::format("CHANGE_TOOL({})", step.tool));
        case CanonCallKind::tool_number:
            return call(fmt::format("CHANGE_TOOL_NUMBER({})", step.tool));
        case CanonCallKind::pause:
            if (!late_ && interpreter.block().m[m_stop] == 60) call("PALLET_SHUTTLE()");
            return call("PROGRAM_STOP()");
        case CanonCallKind::optional_pause:
            return call("OPTIONAL_PROGRAM_STOP()");
        case CanonCallKind::end:
            call(fmt::format("SET_G5X_OFFSET(1, {})",
                             six(in_units(interpreter.frame().work[0], interpreter.modes().inch))));
            call(fmt::format("SET_XY_ROTATION({:.4f})", tidy(interpreter.frame().rotation_deg[0])));
            call("SET_FEED_MODE(0, 0)");
            call("SET_FEED_RATE(0.0000)");
            if (!step.overridable) call("ENABLE_FEED_OVERRIDE()");
            call("STOP_SPINDLE_TURNING(0)");
            return call("PROGRAM_END()");
        case CanonCallKind::overrides:
            return overrides(step.port, step.value != 0);
        case CanonCallKind::output:
            return output(step);
        case CanonCallKind::input:
            return;
        case CanonCallKind::move:
            return step.awaits_input ? void() : move(step.move, interpreter);
    }
}

/// Prints the calls of M48 .. M53.
void CanonPrinter::overrides(std::int32_t code, bool on) {
    const char* able = on ? "ENABLE" : "DISABLE";
    if (code <= 50) call(fmt::format("{}_FEED_OVERRIDE()", able));
    if (code <= 49 || code == 51) call(fmt::format("{}_SPEED_OVERRIDE(0)", able));
    if (code == 52) call(fmt::format("{}_ADAPTIVE_FEED()", able));
    if (code == 53) call(fmt::format("{}_FEED_HOLD()", able));
}

void CanonPrinter::output(const CanonCall& step) {
    const char* when = step.with_motion ? "MOTION" : "AUX";
    if (step.analog) return call(fmt::format("SET_{}_OUTPUT_VALUE({},{:.6f})", when, step.port, step.value));
    call(fmt::format("{}_{}_OUTPUT_BIT({})", step.value != 0 ? "SET" : "CLEAR", when, step.port));
}

Point CanonPrinter::shown(const Interpreter& interpreter, const Point& machine) const {
    if (options_.coordinates == Coordinates::machine) return machine;
    return in_units((late_ ? frame_ : interpreter.frame()).to_program(machine),
                    late_ ? modes_.inch : interpreter.modes().inch);
}

void CanonPrinter::here(const Interpreter& interpreter) {
    Move still;
    still.path = path_;
    still.end = position_;
    move(still, interpreter);
}

void CanonPrinter::probe(const Move& move, const Interpreter& interpreter) {
    const Point end = shown(interpreter, move.end);
    call("TURN_PROBE_ON()");
    call(fmt::format("STRAIGHT_PROBE({})", six(end)));
    call("TURN_PROBE_OFF()");
}

void CanonPrinter::move(const Move& move, const Interpreter& interpreter) {
    if (move.kind == MoveKind::dwell) return call(fmt::format("DWELL({:.4f})", move.seconds));
    if (move.path != path_) path(move.path, move.tolerance_mm, interpreter);
    const Point end = shown(interpreter, move.end);
    if (move.kind != MoveKind::arc) {
        return call(
            fmt::format("{}({})", move.kind == MoveKind::rapid ? "STRAIGHT_TRAVERSE" : "STRAIGHT_FEED", six(end)));
    }
    const int third = 3 - move.first - move.second;
    Point centre = move.end;
    centre[move.first] = move.centre_first;
    centre[move.second] = move.centre_second;
    centre = shown(interpreter, centre);
    call(fmt::format("ARC_FEED({:.4f}, {:.4f}, {:.4f}, {:.4f}, {}, {:.4f}, {:.4f}, {:.4f}, {:.4f})",
                     tidy(end[move.first]), tidy(end[move.second]), tidy(centre[move.first]), tidy(centre[move.second]),
                     move.turns, tidy(end[third]), tidy(end[3]), tidy(end[4]), tidy(end[5])));
}

Outcome<void> print_canon(std::string_view text, const Settings& settings, CanonOptions options,
                          const CanonPrinter::Put& put, const std::string& file) {
    ProgramFlow program_flow(text, settings, file);
    Interpreter interpreter(settings);
    CanonPrinter printer(options, put);
    printer.begin(interpreter);
    std::string_view line;
    while (program_flow.next(line)) {
        if (auto done = interpreter.line(line, program_flow.number(), Language::program); !done) {
            program_flow.line_rejected(line, done.error());
            return done;
        }
        if (auto done = program_flow.line_accepted(interpreter); !done) return done;
        printer.line(interpreter);
    }
    if (program_flow.has_faults()) return tl::unexpected<Problem>(program_flow.take_fault());
    auto done = interpreter.finish();
    if (!done) done.error().file = program_flow.file();
    printer.rest(interpreter);
    return done;
}

}  // namespace motionrack::control::gcode
