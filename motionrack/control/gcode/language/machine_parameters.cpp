// Parameters of the machine from the state of the interpreter.
#include <algorithm>
#include <array>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/machine_parameters.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr int first_system = 5221, system_size = 20, turn_place = 9;

/// Returns the axis value at this index of X Y Z A B C U V W.
double of_axis(const Point& point, int place) {
    return place < axis_count ? point[static_cast<std::size_t>(place)] : 0;
}

bool between(int number, int first, int last) {
    return number >= first && number <= last;
}

double unit_of(const ModalState& modes, int axis) {
    return axis < 3 && modes.inch ? 25.4 : 1.0;
}

using Read = double (*)(const Interpreter&);
struct Known {
    std::string_view name;
    Read read;
};

/// Returns the position of an axis in the coordinates and units of the program: the parameters _x .. _c.
template <int axis>
double here(const Interpreter& in) {
    return in.program_position()[axis] / unit_of(in.modes(), axis);
}
template <int axis>
double absolute(const Interpreter& in) {
    return in.position()[axis] / unit_of(in.modes(), axis);
}

constexpr Known known[] = {
    {"_vmajor", [](const Interpreter&) { return 2.9; }},
    {"_vminor", [](const Interpreter&) { return 0.0; }},
    {"_line", [](const Interpreter& in) { return static_cast<double>(in.line_number()); }},
    {"_motion_mode", [](const Interpreter& in) { return in.modes().motion == no_motion ? 800.0 : in.modes().motion; }},
    {"_plane", [](const Interpreter& in) { return 170.0 + 10 * in.modes().plane; }},
    {"_ccomp",
     [](const Interpreter& in) {
         return in.modes().cutter == CutterSide::off ? 400.0 : in.modes().cutter == CutterSide::left ? 410.0 : 420.0;
     }},
    {"_metric", [](const Interpreter& in) { return in.modes().inch ? 0.0 : 1.0; }},
    {"_imperial", [](const Interpreter& in) { return in.modes().inch ? 1.0 : 0.0; }},
    {"_absolute", [](const Interpreter& in) { return in.modes().incremental ? 0.0 : 1.0; }},
    {"_incremental", [](const Interpreter& in) { return in.modes().incremental ? 1.0 : 0.0; }},
    {"_inverse_time", [](const Interpreter& in) { return in.modes().inverse_time ? 1.0 : 0.0; }},
    {"_units_per_minute", [](const Interpreter& in) { return in.modes().inverse_time ? 0.0 : 1.0; }},
    {"_units_per_rev", [](const Interpreter&) { return 0.0; }},
    {"_coord_system",
     [](const Interpreter& in) {
         return in.modes().system < 6 ? 540.0 + 10 * in.modes().system : 585.0 + in.modes().system;
     }},
    {"_tool_offset", [](const Interpreter& in) { return in.frame().tool != Point{} ? 1.0 : 0.0; }},
    {"_retract_r_plane", [](const Interpreter& in) { return in.modes().retract_to_r ? 1.0 : 0.0; }},
    {"_retract_old_z", [](const Interpreter& in) { return in.modes().retract_to_r ? 0.0 : 1.0; }},
    {"_spindle_rpm_mode", [](const Interpreter&) { return 1.0; }},
    {"_spindle_css_mode", [](const Interpreter&) { return 0.0; }},
    {"_ijk_absolute_mode", [](const Interpreter& in) { return in.modes().arc_absolute ? 1.0 : 0.0; }},
    {"_lathe_diameter_mode", [](const Interpreter&) { return 0.0; }},
    {"_lathe_radius_mode", [](const Interpreter&) { return 1.0; }},
    {"_spindle_on", [](const Interpreter& in) { return in.modes().spindle != Spindle::off ? 1.0 : 0.0; }},
    {"_spindle_cw", [](const Interpreter& in) { return in.modes().spindle == Spindle::clockwise ? 1.0 : 0.0; }},
    {"_mist", [](const Interpreter& in) { return in.modes().mist ? 1.0 : 0.0; }},
    {"_flood", [](const Interpreter& in) { return in.modes().flood ? 1.0 : 0.0; }},
    {"_speed_override", [](const Interpreter& in) { return in.modes().speed_override ? 1.0 : 0.0; }},
    {"_feed_override", [](const Interpreter& in) { return in.modes().feed_override ? 1.0 : 0.0; }},
    {"_adaptive_feed", [](const Interpreter&) { return 0.0; }},
    {"_feed_hold", [](const Interpreter& in) { return in.modes().feed_stop ? 1.0 : 0.0; }},
    {"_feed",
     [](const Interpreter& in) {
         return in.modes().feed * 60 / (in.modes().inverse_time ? 1 : unit_of(in.modes(), 0));
     }},
    {"_rpm", [](const Interpreter& in) { return in.modes().speed_rpm; }},
    {"_x", here<0>},
    {"_y", here<1>},
    {"_z", here<2>},
    {"_a", here<3>},
    {"_b", here<4>},
    {"_c", here<5>},
    {"_abs_x", absolute<0>},
    {"_abs_y", absolute<1>},
    {"_abs_z", absolute<2>},
    {"_abs_a", absolute<3>},
    {"_abs_b", absolute<4>},
    {"_abs_c", absolute<5>},
    {"_current_tool", [](const Interpreter& in) { return static_cast<double>(std::max(0, in.modes().tool_loaded)); }},
    {"_selected_tool", [](const Interpreter& in) { return static_cast<double>(in.modes().tool_selected); }},
    {"_value", [](const Interpreter& in) { return in.parameters().returned().value_or(0); }},
    {"_value_returned", [](const Interpreter& in) { return in.parameters().returned() ? 1.0 : 0.0; }},
    {"_call_level", [](const Interpreter& in) { return static_cast<double>(in.parameters().level()); }},
    {"_remap_level", [](const Interpreter&) { return 0.0; }},
    {"_task", [](const Interpreter&) { return 0.0; }},
};

const Known* find(std::string_view name) {
    if (!name.starts_with('_')) return nullptr;
    const auto* found =
        std::find_if(std::begin(known), std::end(known), [&](const Known& one) { return one.name == name; });
    return found == std::end(known) ? nullptr : found;
}

}  // namespace

bool MachineParameters::is_read_only(int number) {
    return between(number, 5161, 5390) || between(number, 5400, 5428);
}

bool MachineParameters::is_read_only(std::string_view name) {
    return find(name) != nullptr;
}

double MachineParameters::numbered(int number) const {
    if (!is_read_only(number)) return interpreter_.parameters().numbered(number);
    const WorkFrame& frame = interpreter_.frame();
    const ModalState& modes = interpreter_.modes();
    if (between(number, 5161, 5169)) return of_axis(frame.g28, number - 5161);
    if (between(number, 5181, 5189)) return of_axis(frame.g30, number - 5181);
    if (number == 5210) return frame.g92 != Point{} ? 1 : 0;
    if (between(number, 5211, 5219)) return of_axis(frame.g92_saved, number - 5211);
    if (number == 5220) return modes.system + 1;
    if (between(number, first_system, first_system + (work_offset_count - 1) * system_size + turn_place)) {
        const auto system = static_cast<std::size_t>((number - first_system) / system_size);
        const int place = (number - first_system) % system_size;
        return place == turn_place ? frame.rotation_deg[system] : of_axis(frame.work[system], place);
    }
    if (number == 5400) return std::max(0, modes.tool_loaded);
    if (between(number, 5401, 5409)) return of_axis(frame.tool, number - 5401);
    if (between(number, 5410, 5413)) {
        const Tool* tool = interpreter_.tools().find(modes.tool_loaded);
        if (!tool) return 0;
        const double of_tool[] = {tool->diameter_mm, tool->front_angle, tool->back_angle,
                                  static_cast<double>(tool->orientation)};
        return of_tool[number - 5410];
    }
    if (between(number, 5420, 5428)) {
        const int place = number - 5420;
        return of_axis(interpreter_.program_position(), place) / unit_of(modes, place);
    }
    return 0;
}

std::optional<double> MachineParameters::named(std::string_view name) const {
    if (const Known* one = find(name)) return one->read(interpreter_);
    return interpreter_.parameters().named(name);
}

}  // namespace motionrack::control::gcode
