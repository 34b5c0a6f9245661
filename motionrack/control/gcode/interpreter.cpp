// Executes one line of G-code: the order of its words, and the state that they leave.
#include <fmt/format.h>

#include <motionrack/control/gcode/cutter_compensation.hpp>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/lathe_words.hpp>
#include <motionrack/control/gcode/machine_words.hpp>
#include <motionrack/control/gcode/mode_words.hpp>
#include <motionrack/control/gcode/motion_words.hpp>
#include <motionrack/control/gcode/words.hpp>
#include <utility>

namespace motionrack::control::gcode {

namespace {

/// Number of the parameter that stores the result of M66.
constexpr int input_parameter = 5399;

}  // namespace

Interpreter::Interpreter(const Settings& settings) {
    state_.settings = settings;
    state_.travel.start(settings);
    state_.modes.start(settings.path_tolerance_mm, settings.start_in_g0);
    state_.offsets.start(settings);
}

Outcome<void> Interpreter::line(std::string_view text, std::int32_t number, Language language) {
    state_.steps.begin_line();
    state_.cutter.begin_line();
    state_.words.begin_line(number, language);
    state_.steps.apply_end(state_.modes, state_.offsets);
    const MachineParameters known(*this);
    if (!state_.words.scan(text, {state_.settings.block_delete, language, &known}) || !evaluate()) {
        state_.steps.clear();
        return state_.words.problem_of(number);
    }
    return {};
}

bool Interpreter::evaluate() {
    state_.modes.begin_line();
    state_.offsets.begin_line();
    state_.cutter.begin_interpretation();
    state_.contour.cycle.reset();
    state_.words.begin_interpretation();
    state_.travel.begin_line();
    if (!read_words()) return false;
    if (!block().comments.empty()) state_.steps.add_comments();
    if (!block().assignments.empty() && !assign()) return false;
    if (!block().comments.empty()) show_values();
    (void)run_words(state_, WordPhase::saving);
    if (block().has_m(m_io) && block().m[m_io] == 66) state_.parameters.set(input_parameter, state_.steps.port_value());
    commit();
    return true;
}

/// Reads the words in their order of execution.
bool Interpreter::read_words() {
    const ModalState& next = state_.modes.next();
    if (!ModeWords(state_).check()) return false;
    if (!run_words(state_, WordPhase::program)) return false;
    MachineWords(state_).apply_letters();
    if (!run_words(state_, WordPhase::machine) || !run_words(state_, WordPhase::modes)) return false;
    if (next.cutter != CutterSide::off && !CutterCompensation(state_).allows()) return false;
    if (block().has('F')) ModeWords(state_).apply_feed();
    if (!run_words(state_, WordPhase::once)) return false;
    if (!MotionWords(state_).read()) return false;
    if (!run_words(state_, WordPhase::io)) return false;
    if (state_.steps.ends_program() && next.cutter != CutterSide::off && !CutterCompensation(state_).end_program())
        return false;
    if (state_.cutter.is_full() && !CutterCompensation(state_).may_wait()) return false;
    return state_.words.need_all_used(next.motion);
}

/// Executes all assignments, or none if a name does not fit.
bool Interpreter::assign() {
    std::size_t global = 0, local = 0;
    for (const auto& [parameter, value] : block().assignments) {
        if (parameter.number > 0 || state_.parameters.named(parameter.name)) continue;
        if (++(is_global(parameter.name) ? global : local) > state_.parameters.capacity_for(parameter.name)) {
            return state_.words.fail_at(
                block().text.find('#'), GrblStatus::unsupported,
                fmt::format("#<{}> exceeds the limit of {} named parameters; reuse one", parameter.name, max_names));
        }
    }
    for (const auto& [parameter, value] : block().assignments) {
        if (parameter.number > 0)
            state_.parameters.set(parameter.number, value);
        else
            state_.parameters.set(parameter.name, value);
    }
    return true;
}

void Interpreter::commit() {
    state_.steps.commit(position(), state_.modes.next().feed_override);
    state_.travel.commit();
    state_.modes.commit();
    state_.offsets.commit();
    if (modes().cutter != CutterSide::off || state_.cutter.is_off_path()) CutterCompensation(state_).commit();
    if (state_.steps.is_probing()) store_probe_result(true, state_.travel.position());
}

Outcome<void> Interpreter::finish() {
    return CutterCompensation(state_).finish();
}

Point Interpreter::program_position() const {
    return frame().to_program(position());
}

/// Stores #5061 .. #5066 in the coordinates and units of the probing line, and #5070.
void Interpreter::store_probe_result(bool hit, const Point& at) {
    constexpr int first = 5061, success = 5070;
    const Point place = frame().to_program(at);
    for (int axis = 0; axis < axis_count; ++axis)
        state_.parameters.set(first + axis, place[axis] / (axis < 3 && modes().inch ? 25.4 : 1.0));
    for (int other = first + axis_count; other < success; ++other) state_.parameters.set(other, 0);
    state_.parameters.set(success, hit ? 1 : 0);
}

void Interpreter::set_probe_result(bool hit, const Point& at, const Point& stopped_at) {
    state_.offsets.set_probe_result(hit, at);
    store_probe_result(hit, at);
    resync_position(stopped_at);
}

void Interpreter::resync_position(const Point& position) {
    CutterCompensation(state_).resync_position(position);
}

bool Interpreter::end_call(std::optional<double> returned) {
    const auto level = static_cast<std::size_t>(state_.parameters.level());
    state_.parameters.leave(returned);
    const std::optional<ModalState> kept = state_.modes.leave_call(level);
    if (!kept) return true;
    if (modes().cutter != CutterSide::off && !state_.modes.can_stay_beside(*kept)) return false;
    state_.modes.begin_line();
    state_.offsets.begin_line();
    MachineWords(state_).restore(*kept);
    state_.modes.commit();
    state_.offsets.commit();
    return true;
}

Interpreter Interpreter::contour_interpreter() const {
    Interpreter reader = *this;
    InterpreterState& state = reader.state_;
    state.travel.remove_limits();
    state.settings.probe = state.settings.point_to_point = false;
    state.contour.cycle.reset();
    state.steps.clear();
    Point start = state_.travel.position();
    start[2] = state_.contour.cycle->start.first;
    start[0] = state_.contour.cycle->start.second;
    state.travel.move_to(start);
    return reader;
}

Outcome<void> Interpreter::turn(std::vector<ContourSegment> contour) {
    return LatheWords(state_).turn(std::move(contour));
}

void Interpreter::reset_after_program() {
    state_.modes.enable_overrides();
    state_.offsets.reset_rotation(modes().system);
}

}  // namespace motionrack::control::gcode
