// The list commands of the RTC5, declared once: timing class, parameters with ranges, and the treatment of values
// outside a range.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>

namespace motionrack::rtc5 {

/// Code of a list command. The numbers are the project's own.
// clang-format off
enum class Op : std::uint32_t {
    none, set_end_of_list, list_nop, long_delay, jump_abs, jump_rel, mark_abs, mark_rel, arc_abs, arc_rel,
    timed_jump_abs, timed_jump_rel, timed_mark_abs, timed_mark_rel, micro_vector_abs, micro_vector_rel,
    set_jump_speed, set_mark_speed, set_scanner_delays, set_laser_delays,
    laser_on_list, laser_signal_on_list, laser_signal_off_list, write_io_port_list,
    set_fly_x, set_fly_y, set_fly_z, set_fly_rot, set_fly_2d, set_fly_x_pos, set_fly_y_pos, set_fly_rot_pos,
    activate_fly_xy, activate_fly_2d, fly_return, fly_return_z, set_rot_center_list,
    store_encoder, wait_for_encoder, wait_for_encoder_mode, wait_for_encoder_in_range, wait_for_mcbsp,
    set_fly_limits, set_fly_limits_z, if_fly_x_overflow, if_fly_y_overflow, if_fly_z_overflow,
    if_not_fly_x_overflow, if_not_fly_y_overflow, if_not_fly_z_overflow, clear_fly_overflow,
    park_position, park_return, set_ext_start_delay_list, simulate_ext_start, set_control_mode_list,
    set_encoder_speed, set_mcbsp_in_list, set_multi_mcbsp_in_list, get_mcbsp_list,
    set_mcbsp_x_list, set_mcbsp_y_list, set_mcbsp_rot_list, set_mcbsp_matrix_list, apply_mcbsp_list,
    set_matrix_list, set_offset_list, set_angle_list, set_scale_list, set_trigger, set_trigger4, set_wobbel,
    list_call, sub_call, list_return, count
};
// clang-format on
inline constexpr std::size_t op_count = static_cast<std::size_t>(Op::count);

/// Timing class of a command: ticks that it takes, and whether it changes or reads the processing after the path
/// position (pipeline).
enum class Timing : std::uint8_t {
    shortly,   ///< takes no tick of its own; a motion continues through it
    across,    ///< as shortly, but the command reads or changes the pipeline
    pipeline,  ///< takes no tick of its own; a polyline ends before it
    normal,    ///< takes a tick or more; reads or changes the pipeline
    motion     ///< takes a tick or more; moves or holds the position
};

/// Kind of a parameter; it determines the range.
// clang-format off
enum class Kind : std::uint8_t {
    coordinate, centre, number, count, ticks, half_us, switching, micros, speed, angle, scale, factor, head, index,
    port, signal, amplitude, frequency, place, subroutine
};
// clang-format on

struct ParamInfo {
    std::string_view name;
    Kind kind = Kind::number;
};
inline constexpr int max_params = 5;

struct ListCommandInfo {
    std::string_view name;
    Op op = Op::none;
    Timing timing = Timing::normal;
    int positions = 1;  ///< number of positions that the command takes in the list memory
    std::array<ParamInfo, max_params> params{};
    std::string_view meaning;

    constexpr int param_count() const {
        int n = 0;
        while (n < max_params && !params[static_cast<std::size_t>(n)].name.empty()) ++n;
        return n;
    }
};

/// One command in the list memory. HeadNo, or a fifth parameter, is in `head`; the other parameters are in `p` in
/// order (a double holds their integers exactly).
struct Command {
    Op op = Op::none;
    std::int32_t head = 0;
    std::array<double, 4> p{};
};
static_assert(sizeof(Command) == 40);

/// Range of a parameter; a value outside it is clipped, or the command is refused.
struct KindInfo {
    double min = 0, max = 0;
    bool clipped = false;  ///< true: a value outside is clipped; false: the command is refused
    bool whole = true;
    std::string_view unit;
};

constexpr KindInfo kind_info(Kind kind) {
    switch (kind) {
        case Kind::coordinate:
            return {-8388608, 8388607, true, true, "bits"};
        case Kind::centre:
            return {-8388608, 8388607, false, true, "bits"};
        case Kind::number:
            return {-2147483648.0, 2147483647, false, true, ""};
        case Kind::count:
            return {-2147483648.0, 2147483647, false, true, "counts"};
        case Kind::ticks:
            return {0, 4294967295.0, false, true, "times 10 us"};
        case Kind::half_us:
            return {-32768, 65535, false, true, "times 0.5 us"};
        case Kind::switching:
            return {-2147483648.0, 2147483647, false, true, "times 0.5 us"};
        case Kind::micros:
            return {0, 4294967295.0, false, false, "us"};
        case Kind::speed:
            return {1.6, 800000, true, false, "bits/ms"};
        case Kind::angle:
            return {-3600, 3600, false, false, "degrees"};
        case Kind::scale:
            return {-1e9, 1e9, false, false, ""};
        case Kind::factor:
            return {-50, 50, false, false, ""};
        case Kind::head:
            return {1, 4, false, true, ""};
        case Kind::index:
            return {0, 255, false, true, ""};
        case Kind::port:
            return {0, 65535, false, true, ""};
        case Kind::signal:
            return {0, 255, false, true, ""};
        case Kind::amplitude:
            return {0, 131071, true, true, "bits"};
        case Kind::frequency:
            return {-6000, 6000, true, false, "Hz"};
        case Kind::place:
            return {0, 1048575, false, true, ""};
        case Kind::subroutine:
            return {0, 1023, false, true, ""};
    }
    return {};
}

namespace map {

inline constexpr ParamInfo px = {"X", Kind::coordinate}, py = {"Y", Kind::coordinate}, pt = {"T", Kind::micros};
inline constexpr ParamInfo pmode = {"Mode", Kind::number}, pencoder = {"EncoderNo", Kind::index},
                           phead = {"HeadNo", Kind::head};
inline constexpr ParamInfo ponce = {"at_once", Kind::index}, pscale_x = {"ScaleX", Kind::scale},
                           pscale_y = {"ScaleY", Kind::scale};

/// All list commands, in the order of Op.
// clang-format off
inline constexpr ListCommandInfo list_commands[op_count] = {
    {"(empty)", Op::none, Timing::pipeline, 1, {},
     "an empty position: the list ends here with an error"},
    {"set_end_of_list", Op::set_end_of_list, Timing::pipeline, 1, {}, "the list ends"},
    {"list_nop", Op::list_nop, Timing::motion, 1, {}, "one tick"},
    {"long_delay", Op::long_delay, Timing::motion, 1, {{{"Delay", Kind::ticks}}}, "holds the position"},
    {"jump_abs", Op::jump_abs, Timing::motion, 1, {{px, py}}, "straight, laser off, at the jump speed"},
    {"jump_rel", Op::jump_rel, Timing::motion, 1, {{px, py}}, "as jump_abs, from the present position"},
    {"mark_abs", Op::mark_abs, Timing::motion, 1, {{px, py}}, "straight, laser on, at the mark speed"},
    {"mark_rel", Op::mark_rel, Timing::motion, 1, {{px, py}}, "as mark_abs, from the present position"},
    {"arc_abs", Op::arc_abs, Timing::motion, 1, {{px, py, {"Angle", Kind::angle}}},
     "about the centre X, Y, laser on; positive is clockwise"},
    {"arc_rel", Op::arc_rel, Timing::motion, 1, {{px, py, {"Angle", Kind::angle}}},
     "as arc_abs, the centre from the present position"},
    {"timed_jump_abs", Op::timed_jump_abs, Timing::motion, 1, {{px, py, pt}},
     "as jump_abs, in T rounded down to 10 us"},
    {"timed_jump_rel", Op::timed_jump_rel, Timing::motion, 1, {{px, py, pt}},
     "as jump_rel, in T rounded down to 10 us"},
    {"timed_mark_abs", Op::timed_mark_abs, Timing::motion, 1, {{px, py, pt}},
     "as mark_abs, in T rounded down to 10 us"},
    {"timed_mark_rel", Op::timed_mark_rel, Timing::motion, 1, {{px, py, pt}},
     "as mark_rel, in T rounded down to 10 us"},
    {"micro_vector_abs", Op::micro_vector_abs, Timing::motion, 1,
     {{px, py, {"LasOn", Kind::switching}, {"LasOff", Kind::switching}}},
     "one tick; the laser is switched at these instants of it, if they are 0 to 19"},
    {"micro_vector_rel", Op::micro_vector_rel, Timing::motion, 1,
     {{px, py, {"LasOn", Kind::switching}, {"LasOff", Kind::switching}}},
     "as micro_vector_abs, from the present position"},
    {"set_jump_speed", Op::set_jump_speed, Timing::shortly, 1, {{{"Speed", Kind::speed}}}, "speed of later jumps"},
    {"set_mark_speed", Op::set_mark_speed, Timing::shortly, 1, {{{"Speed", Kind::speed}}},
     "speed of later marks and arcs"},
    {"set_scanner_delays", Op::set_scanner_delays, Timing::shortly, 1,
     {{{"Jump", Kind::ticks}, {"Mark", Kind::ticks}, {"Polygon", Kind::ticks}}},
     "delays after jumps, polylines and corners"},
    {"set_laser_delays", Op::set_laser_delays, Timing::shortly, 1,
     {{{"LaserOnDelay", Kind::half_us}, {"LaserOffDelay", Kind::half_us}}},
     "delays of the laser at the begin and end of the path"},
    {"laser_on_list", Op::laser_on_list, Timing::motion, 1, {{{"Period", Kind::ticks}}},
     "laser on for the time, position held"},
    {"laser_signal_on_list", Op::laser_signal_on_list, Timing::pipeline, 1, {}, "laser on"},
    {"laser_signal_off_list", Op::laser_signal_off_list, Timing::pipeline, 1, {}, "laser off"},
    {"write_io_port_list", Op::write_io_port_list, Timing::pipeline, 1, {{{"Value", Kind::port}}},
     "sets the 16 digital outputs"},
    {"set_fly_x", Op::set_fly_x, Timing::normal, 1, {{pscale_x}}, "X moves with Encoder0, which becomes 0; 0 is off"},
    {"set_fly_y", Op::set_fly_y, Timing::normal, 1, {{pscale_y}}, "Y moves with Encoder1, which becomes 0; 0 is off"},
    {"set_fly_z", Op::set_fly_z, Timing::normal, 1, {{{"ScaleZ", Kind::scale}, pencoder}},
     "Z moves with the encoder, which becomes 0; 0 is off"},
    {"set_fly_rot", Op::set_fly_rot, Timing::normal, 1, {{{"Resolution", Kind::scale}}},
     "turns with Encoder0, which becomes 0; counts a turn, positive is counter-clockwise, under 100 is off"},
    {"set_fly_2d", Op::set_fly_2d, Timing::normal, 1, {{pscale_x, pscale_y}},
     "X and Y move with both encoders and the compensation table"},
    {"set_fly_x_pos", Op::set_fly_x_pos, Timing::normal, 1, {{pscale_x}}, "X moves with the McBSP word; 0 is off"},
    {"set_fly_y_pos", Op::set_fly_y_pos, Timing::normal, 1, {{pscale_y}}, "Y moves with the McBSP word; 0 is off"},
    {"set_fly_rot_pos", Op::set_fly_rot_pos, Timing::normal, 1, {{{"Resolution", Kind::scale}}},
     "turns with the McBSP word; under 100 is off"},
    {"activate_fly_xy", Op::activate_fly_xy, Timing::normal, 1, {{pscale_x, pscale_y}},
     "as set_fly_x and set_fly_y; the encoders keep their counts"},
    {"activate_fly_2d", Op::activate_fly_2d, Timing::normal, 1, {{pscale_x, pscale_y}},
     "as set_fly_2d; the encoders keep their counts"},
    {"fly_return", Op::fly_return, Timing::normal, 1, {{px, py}}, "turns all corrections off, then jumps"},
    {"fly_return_z", Op::fly_return_z, Timing::normal, 1, {{px, py, {"Z", Kind::coordinate}}},
     "as fly_return; Z changes at once"},
    {"set_rot_center_list", Op::set_rot_center_list, Timing::pipeline, 1, {{{"X", Kind::centre}, {"Y", Kind::centre}}},
     "centre of the rotary corrections"},
    {"store_encoder", Op::store_encoder, Timing::pipeline, 1, {{{"Pos", Kind::index}}},
     "stores both counts for read_encoder"},
    {"wait_for_encoder", Op::wait_for_encoder, Timing::normal, 1, {{{"Value", Kind::count}, pencoder}},
     "as wait_for_encoder_mode with Mode 0"},
    {"wait_for_encoder_mode", Op::wait_for_encoder_mode, Timing::normal, 1, {{{"Value", Kind::count}, pencoder, pmode}},
     "waits until the count is reached"},
    {"wait_for_encoder_in_range", Op::wait_for_encoder_in_range, Timing::normal, 2,
     {{{"EncXmin", Kind::count}, {"EncXmax", Kind::count}, {"EncYmin", Kind::count}, {"EncYmax", Kind::count}}},
     "waits until both counts are in range"},
    {"wait_for_mcbsp", Op::wait_for_mcbsp, Timing::normal, 1, {{{"Axis", Kind::index}, {"Value", Kind::count}, pmode}},
     "waits until the McBSP value is reached"},
    {"set_fly_limits", Op::set_fly_limits, Timing::pipeline, 1,
     {{{"Xmin", Kind::centre}, {"Xmax", Kind::centre}, {"Ymin", Kind::centre}, {"Ymax", Kind::centre}}},
     "the area monitored by bits 4 to 7"},
    {"set_fly_limits_z", Op::set_fly_limits_z, Timing::pipeline, 1, {{{"Zmin", Kind::centre}, {"Zmax", Kind::centre}}},
     "the Z range monitored by bits 24 and 25"},
    {"if_fly_x_overflow", Op::if_fly_x_overflow, Timing::pipeline, 1, {{pmode}},
     "executes the next command only if bit 4 or 5 is set; clears them"},
    {"if_fly_y_overflow", Op::if_fly_y_overflow, Timing::pipeline, 1, {{pmode}}, "the same for bits 6 and 7"},
    {"if_fly_z_overflow", Op::if_fly_z_overflow, Timing::pipeline, 1, {{pmode}}, "the same for bits 24 and 25"},
    {"if_not_fly_x_overflow", Op::if_not_fly_x_overflow, Timing::pipeline, 1, {{pmode}},
     "executes the next command only if they are not set; clears them"},
    {"if_not_fly_y_overflow", Op::if_not_fly_y_overflow, Timing::pipeline, 1, {{pmode}}, "the same for bits 6 and 7"},
    {"if_not_fly_z_overflow", Op::if_not_fly_z_overflow, Timing::pipeline, 1, {{pmode}}, "the same for bits 24 and 25"},
    {"clear_fly_overflow", Op::clear_fly_overflow, Timing::pipeline, 1, {{pmode}},
     "clears bits 4, 5 (Mode bit 0), 6, 7 (bit 1), 24, 25 (bit 2); 0: all"},
    {"park_position", Op::park_position, Timing::normal, 1, {{pmode, px, py}},
     "jumps away; with Mode 0 the correction pauses"},
    {"park_return", Op::park_return, Timing::normal, 1, {{pmode, px, py}},
     "jumps back: Mode 0 to the position before, else to X, Y"},
    {"set_ext_start_delay_list", Op::set_ext_start_delay_list, Timing::pipeline, 1,
     {{{"Delay", Kind::count}, pencoder}},
     "track delay of external starts"},
    {"simulate_ext_start", Op::simulate_ext_start, Timing::pipeline, 1, {{{"Delay", Kind::count}, pencoder}},
     "an external start with this track delay"},
    {"set_control_mode_list", Op::set_control_mode_list, Timing::pipeline, 1, {{{"Mode", Kind::port}}},
     "bits 0, 9, 10: external start, reset at start, equidistant"},
    {"set_encoder_speed", Op::set_encoder_speed, Timing::pipeline, 1,
     {{pencoder, {"Speed", Kind::scale}, {"Smooth", Kind::scale}}}, "target and smoothing of the encoder's speed"},
    {"set_mcbsp_in_list", Op::set_mcbsp_in_list, Timing::pipeline, 1, {{pmode, {"Scale", Kind::scale}}},
     "X (1), Y (2) or both (3) move with the McBSP word; 0 is off"},
    {"set_multi_mcbsp_in_list", Op::set_multi_mcbsp_in_list, Timing::pipeline, 1,
     {{{"Ctrl", Kind::index}, {"P", Kind::ticks}, pmode}},
     "McBSP words carry their type: x, y, z, laser power and parameters"},
    {"get_mcbsp_list", Op::get_mcbsp_list, Timing::pipeline, 1, {}, "stores the McBSP word in memory location 0"},
    {"set_mcbsp_x_list", Op::set_mcbsp_x_list, Timing::pipeline, 1, {{pscale_x}}, "online positioning of X; 0 is off"},
    {"set_mcbsp_y_list", Op::set_mcbsp_y_list, Timing::pipeline, 1, {{pscale_y}}, "online positioning of Y; 0 is off"},
    {"set_mcbsp_rot_list", Op::set_mcbsp_rot_list, Timing::pipeline, 1, {{{"Resolution", Kind::scale}}},
     "online positioning of the angle; under 100 is off"},
    {"set_mcbsp_matrix_list", Op::set_mcbsp_matrix_list, Timing::pipeline, 1, {},
     "online positioning of matrix coefficients"},
    {"apply_mcbsp_list", Op::apply_mcbsp_list, Timing::pipeline, 1, {{phead, ponce}},
     "applies the online positioning to a head"},
    {"set_matrix_list", Op::set_matrix_list, Timing::pipeline, 2,
     {{phead, {"Ind1", Kind::index}, {"Ind2", Kind::index}, {"Mij", Kind::factor}, ponce}},
     "one coefficient of the matrix"},
    {"set_offset_list", Op::set_offset_list, Timing::pipeline, 1,
     {{phead, {"XOffset", Kind::centre}, {"YOffset", Kind::centre}, ponce}},
     "offset behind the matrix"},
    {"set_angle_list", Op::set_angle_list, Timing::pipeline, 1, {{phead, {"Angle", Kind::angle}, ponce}},
     "rotation, counter-clockwise"},
    {"set_scale_list", Op::set_scale_list, Timing::pipeline, 1, {{phead, {"Scale", Kind::factor}, ponce}},
     "scaling, -16 to 16"},
    {"set_trigger", Op::set_trigger, Timing::across, 1,
     {{{"Period", Kind::ticks}, {"Signal1", Kind::signal}, {"Signal2", Kind::signal}}},
     "records two signals from this tick on, one sample a period; 0 ends it"},
    {"set_trigger4", Op::set_trigger4, Timing::normal, 1,
     {{{"Period", Kind::ticks}, {"Signal1", Kind::signal}, {"Signal2", Kind::signal}, {"Signal3", Kind::signal},
     {"Signal4", Kind::signal}}},
     "as set_trigger, four signals"},
    {"set_wobbel", Op::set_wobbel, Timing::shortly, 1,
     {{{"Transversal", Kind::amplitude}, {"Longitudinal", Kind::amplitude}, {"Freq", Kind::frequency}}},
     "marks are widened by an ellipse across and along the motion; amplitudes of 0 or a frequency of 0 are off"},
    {"list_call", Op::list_call, Timing::pipeline, 1, {{{"Pos", Kind::place}}}, "continues at Pos, until list_return"},
    {"sub_call", Op::sub_call, Timing::pipeline, 1, {{{"Index", Kind::subroutine}}},
     "the same with a subroutine of load_sub"},
    {"list_return", Op::list_return, Timing::pipeline, 1, {}, "continues after the call"},
};
// clang-format on

constexpr DeclarationError list_commands_flaw(std::span<const ListCommandInfo> commands) {
    if (const DeclarationError flaw = names_flaw("the list commands", "list command", commands); !flaw.empty())
        return flaw;
    for (std::size_t i = 0; i < commands.size(); ++i)
        if (commands[i].op != static_cast<Op>(i))
            return {"the list command ", commands[i].name, " is not at its place"};
    return {};
}
static_assert(declared<list_commands_flaw(list_commands)>());

}  // namespace map

constexpr const ListCommandInfo& info(Op op) {
    return map::list_commands[static_cast<std::size_t>(op)];
}

}  // namespace motionrack::rtc5
