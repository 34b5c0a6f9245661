// The table of control commands.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/cards/rtc5/model/control_commands.hpp>

namespace motionrack::rtc5 {

namespace {

using Numbers = std::span<const double>;
using Answered = Result<ControlAnswer>;

constexpr std::string_view page_198 = "the RTC5 manual 1.10 d (German), page 198";
constexpr std::string_view by_header = "the maker's header of the RTC5 of 2013";
constexpr std::string_view manual_70 = "the RTC5 manual 1.9 e, pages 70 to 73";
constexpr std::string_view manual_124 = "the RTC5 manual 1.9 e, pages 124 and 125";
constexpr std::string_view manual_166 = "the RTC5 manual 1.9 e, page 166";
constexpr std::string_view manual_185 = "the RTC5 manual 1.9 e, page 185";
constexpr std::string_view manual_419 = "the RTC5 manual 1.9 e, page 419";
constexpr std::string_view manual_428 = "the RTC5 manual 1.9 e, page 428";
constexpr std::string_view manual_511 = "the RTC5 manual 1.9 e, page 511";
constexpr std::string_view rtc6_703 = "the RTC6 manual 1.0.21, page 703";
constexpr std::string_view changes_nothing = "accepted without effect: the laser is only on or off here";

constexpr double min_32 = -2147483648.0, max_32 = 2147483647, max_place = max_list_memory - 1;

constexpr ControlParam centre(std::string_view name) {
    constexpr KindInfo range = kind_info(Kind::centre);
    return {name, range.min, range.max, range.unit};
}
constexpr ControlParam scale(std::string_view name, std::string_view unit) {
    constexpr KindInfo range = kind_info(Kind::scale);
    return {name, range.min, range.max, unit, false};
}
constexpr ControlParam up_to(std::string_view name, double max, std::string_view unit = "") {
    return {name, 0, max, unit};
}

int small(double value) {
    return static_cast<int>(value);
}
std::uint32_t word(double value) {
    return static_cast<std::uint32_t>(value);
}
std::int64_t wide(double value) {
    return static_cast<std::int64_t>(value);
}
Answered answer(std::initializer_list<std::int64_t> numbers) {
    ControlAnswer out;
    for (const std::int64_t number : numbers) out.push_back(static_cast<double>(number));
    return out;
}
Answered done(const Result<void>& result) {
    MOTIONRACK_CHECK(result);
    return ControlAnswer{};
}
Answered taken(Engine&, Numbers) {
    return ControlAnswer{};
}
Answered header_word(const Engine& engine, std::int64_t table, double word_number) {
    const Table* const loaded = engine.parts().heads.table(table);
    return answer({loaded == nullptr ? 0 : loaded->header[static_cast<std::size_t>(word_number)]});
}
Answered set_delay_mode(Engine& engine, Numbers p) {
    Delays delays = engine.state().path.delays;
    delays.variable_polygon = p[0] != 0;
    delays.edge_level = wide(p[2]), delays.min_jump = wide(p[3]), delays.jump_limit = p[4];
    return done(engine.parts().path.set_delays(delays));
}
Answered set_extstartpos(Engine& engine, Numbers p) {
    MOTIONRACK_CHECK(
        check_parameter("set_extstartpos", "Pos", p[0], 0, static_cast<double>(engine.settings().list_memory - 1)));
    engine.parts().starts.set_position(wide(p[0]));
    return ControlAnswer{};
}
Answered one(const Result<std::int32_t>& result) {
    if (!result) return tl::unexpected<Error>(result.error());
    return answer({*result});
}

// clang-format off
constexpr Refusal or_busy = Refusal::busy, or_rejected = Refusal::rejected, or_wrong = Refusal::parameter;

constexpr ControlCommand commands[] = {
    {"select_cor_table", {{up_to("HeadA", table_count), up_to("HeadB", table_count)}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().heads.select_tables(small(p[0]), small(p[1]))); },
     "the tables of both heads; 0: head A 1:1, head B without output", manual_124},
    {"get_table_para", {{{"TableNo", 1, table_count}, up_to("ParaNo", 15)}}, 1, false, false, or_wrong,
     [](Engine& e, Numbers p) { return header_word(e, wide(p[0]), p[1]); },
     "a word of the header of a correction table, 1 is K in bits/mm; 0 of a 1:1 table", manual_124},
    {"get_head_para", {{{"HeadNo", 1, head_count}, up_to("ParaNo", 15)}}, 1, false, false, or_wrong,
     [](Engine& e, Numbers p) {
         return header_word(e, e.state().transforms.heads[static_cast<std::size_t>(p[0]) - 1].table, p[1]);
     },
     "the same of the table that a head has", manual_124},
    {"set_start_list_1", {}, 0, true, false, or_wrong,
     [](Engine& e, Numbers) { return done(e.set_start_list(1)); }, "list commands go to list 1 from here on",
     manual_70},
    {"set_start_list_2", {}, 0, true, false, or_wrong,
     [](Engine& e, Numbers) { return done(e.set_start_list(2)); }, "list commands go to list 2 from here on",
     manual_70},
    {"set_start_list_pos", {{{"ListNo"}, up_to("Pos", max_place)}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.set_start_list(word(p[0]), wide(p[1]))); },
     "list commands go to that position of list 1 (odd numbers) or 2 (even ones); behind its end it is 0", manual_70},
    {"get_input_pointer", {}, 1, true, false, or_wrong,
     [](Engine& e, Numbers) { return answer({e.input_pointer()}); },
     "the position of the next list command in the whole list memory", manual_70},
    {"get_list_space", {}, 1, true, false, or_wrong,
     [](Engine& e, Numbers) { return answer({e.state().lists.input_end - e.input_pointer()}); },
     "free positions in the open list", manual_70},
    {"execute_list_1", {}, 0, true, false, or_busy,
     [](Engine& e, Numbers) { return done(e.execute_list(1)); },
     "starts list 1; refused while a list runs or the card moves", manual_70},
    {"execute_list_2", {}, 0, true, false, or_busy,
     [](Engine& e, Numbers) { return done(e.execute_list(2)); },
     "starts list 2; refused while a list runs or the card moves", manual_70},
    {"execute_list_pos", {{{"ListNo"}, up_to("Pos", max_place)}}, 0, true, false, or_busy,
     [](Engine& e, Numbers p) { return done(e.execute_list(word(p[0]), wide(p[1]))); },
     "starts a list at a position of it; refused while a list runs or the card moves", manual_70},
    {"execute_at_pointer", {{up_to("Pos", max_place)}}, 0, true, false, or_busy,
     [](Engine& e, Numbers p) { return done(e.parts().execution.execute_at(wide(p[0]))); },
     "starts at a position in the whole list memory; refused while a list runs or the card moves", manual_70},
    {"set_delay_mode",
     {{{"VarPoly"}, {"DirectMove3D"}, {"EdgeLevel", 0, 4294967295.0, "times 10 us"},
       {"MinJumpDelay", 0, 4294967295.0, "times 10 us"}, up_to("JumpLengthLimit", 16777215, "bits")}},
     0, true, false, or_wrong, set_delay_mode,
     "VarPoly other than 0: polygon delays by the angle, the laser off in those above EdgeLevel; jumps shorter than "
     "JumpLengthLimit have delays down to MinJumpDelay; DirectMove3D changes nothing", by_header},
    {"set_hi",
     {{{"HeadNo", 1, 3}, {"GalvoGainX", -16, 16, "", false}, {"GalvoGainY", -16, 16, "", false},
       {"GalvoOffsetX", min_field, max_field, "bits"}, {"GalvoOffsetY", min_field, max_field, "bits"}}},
     0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().heads.set_hi(small(p[0]), {p[1], p[2]}, {p[3], p[4]})); },
     "gain and offset behind the table of head 1 (A), 2 (B), or both (3)", by_header},
    {"write_io_port", {{up_to("Value", 65535)}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) {
         e.mutable_state().io = wide(p[0]);
         return Answered(ControlAnswer{});
     },
     "sets the 16 digital outputs", by_header},
    {"get_io_status", {}, 1, true, true, or_wrong,
     [](Engine& e, Numbers) { return answer({e.state().io}); }, "the 16 digital outputs", by_header},

    {"simulate_encoder", {{up_to("EncoderNo", 3)}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().encoders.simulate(small(p[0]))); },
     "simulates encoder 0 (1), encoder 1 (2) or both (3) at 1000000 counts/s; 0 ends it", page_198},
    {"read_encoder", {}, 4, true, true, or_wrong,
     [](Engine& e, Numbers) {
         const auto first = e.parts().encoders.stored(0), second = e.parts().encoders.stored(1);
         return answer({first[0], first[1], second[0], second[1]});
     },
     "counts that store_encoder kept: encoder 0 and 1 of Pos 0, then of Pos 1", by_header},
    {"set_rot_center", {{centre("X"), centre("Y")}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().fly.set_rot_center({p[0], p[1]})); },
     "centre of the rotary corrections", by_header},
    {"set_fly_tracking_error", {{up_to("TrackingErrorX", 65535, "times 10 us"),
      up_to("TrackingErrorY", 65535, "times 10 us")}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) {
         e.parts().encoders.set_tracking_error(static_cast<std::uint16_t>(p[0]), static_cast<std::uint16_t>(p[1]));
         return Answered(ControlAnswer{});
     },
     "lag of the mirrors; encoder counts are extrapolated by it", manual_428},
    {"init_fly_2d", {{{"OffsetX", min_32, max_32, "counts"}, {"OffsetY", min_32, max_32, "counts"}}}, 0,
     true, false, or_wrong,
     [](Engine& e, Numbers p) {
         e.parts().fly.zero_2d(small(p[0]), small(p[1]));
         return Answered(ControlAnswer{});
     },
     "zeroes both encoders; these values are added to their counts in 2D corrections", manual_185},
    {"get_fly_2d_offset", {}, 2, true, true, or_wrong,
     [](Engine& e, Numbers) { return answer({wide(e.state().fly.offset_2d.x), wide(e.state().fly.offset_2d.y)}); },
     "(OffsetX, OffsetY) of init_fly_2d, counts", manual_185},
    {"set_encoder_speed_ctrl", {{up_to("EncoderNo", 3), scale("Speed", "counts/ms"), {"Smooth", 0, 1, "", false}}}, 0,
     true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().encoders.watch_speed(small(p[0]), p[1], p[2])); },
     "target (taken as 100 to 16000 counts/ms) and smoothing of the speed of encoder 0, 1, or both (2, 3)", manual_419},
    {"set_ext_start_delay", {{{"Delay", min_32, max_32, "counts"}, up_to("EncoderNo", 1)}}, 0, true, false,
     or_wrong, [](Engine& e, Numbers p) { return done(e.set_ext_start_delay(small(p[0]), small(p[1]))); },
     "the track delay of external starts", manual_511},
    {"set_extstartpos", {{up_to("Pos", max_place)}}, 0, true, false, or_wrong, set_extstartpos,
     "the position in the whole list memory at which an external start begins", manual_511},
    {"simulate_ext_start_ctrl", {}, 0, true, false, or_wrong,
     [](Engine& e, Numbers) {
         e.parts().starts.trigger();
         return Answered(ControlAnswer{});
     },
     "simulates a start signal", manual_511},
    {"simulate_ext_stop", {}, 0, true, false, or_wrong,
     [](Engine& e, Numbers) {
         e.external_stop();
         return Answered(ControlAnswer{});
     },
     "simulates a stop signal", by_header},

    {"mcbsp_init", {{up_to("XDelay", 2, "bits"), up_to("RDelay", 2, "bits")}}, 0, true, false, or_wrong, taken,
     "accepted without effect: the frame on the wire is not simulated", by_header},
    {"mcbsp_init_spi", {{up_to("ClockLevel", 1), up_to("ClockDelay", 1)}}, 0, true, false, or_wrong, taken,
     "accepted without effect: the frame on the wire is not simulated", by_header},
    {"set_mcbsp_freq", {{{"Freq", 1, 50'000'000, "Hz"}}}, 1, true, false, or_wrong,
     [](Engine&, Numbers p) { return answer({wide(p[0])}); },
     "returns Freq without effect: the frame on the wire is not simulated", by_header},
    {"get_mcbsp", {}, 1, true, true, or_rejected, [](Engine& e, Numbers) { return one(e.parts().mcbsp.store_now()); },
     "the present word, signed, which goes to memory location 0 too; refused before the first word", by_header},
    {"read_mcbsp", {{up_to("No", 3)}}, 1, true, true, or_rejected,
     [](Engine& e, Numbers p) { return one(e.parts().mcbsp.read(small(p[0]))); },
     "memory location No; refused while it is empty, with the command that fills it. Location 0 is filled "
     "from set_fly_x_pos (or _y_pos, _rot_pos, set_mcbsp_in) on. Of two axes X is the low half of the word and Y the "
     "high one, each of 16 bits with its sign. A scale is K / i, i = (end - start) / distance in bits/mm", page_198},
    {"read_multi_mcbsp", {{up_to("No", 7)}}, 1, true, true, or_wrong,
     [](Engine& e, Numbers p) { return answer({e.parts().mcbsp.typed(small(p[0]))}); },
     "the last value of a type, after set_multi_mcbsp_in", rtc6_703},
    {"set_mcbsp_in", {{up_to("Mode", 3), scale("Scale", "bits/bit")}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().fly.set_mcbsp_in(small(p[0]), p[1])); },
     "corrects X (Mode 1), Y (2) or both (3) by the McBSP word; 0 is off. The word is stored in memory location 0, in "
     "Mode 1 also in location 1, in Mode 2 also in 2; Mode 3 also stores X in 1, Y in 2 and the whole word in 3",
     page_198},
    {"set_multi_mcbsp_in", {{up_to("Ctrl", 255), {"P", 0, 4294967295.0, "/16384"},
      {"Mode", min_32, max_32}}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().fly.set_multi_mcbsp_in(small(p[0]), wide(p[1]), small(p[2]))); },
     "McBSP words carry their type: x, y, z, laser power and parameters; they go to the locations 0 to 3 in turn",
     rtc6_703},
    {"set_mcbsp_x", {{scale("ScaleX", "bits/bit")}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().fly.set_mcbsp_x(p[0])); },
     "online positioning of X; 0 is off", manual_166},
    {"set_mcbsp_y", {{scale("ScaleY", "bits/bit")}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().fly.set_mcbsp_y(p[0])); },
     "online positioning of Y; 0 is off", manual_166},
    {"set_mcbsp_rot", {{scale("Resolution", "bits a turn")}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().fly.set_mcbsp_rot(p[0])); },
     "online positioning of the angle; under 100 is off", manual_166},
    {"set_mcbsp_matrix", {}, 0, true, false, or_wrong,
     [](Engine& e, Numbers) {
         e.parts().fly.set_mcbsp_matrix();
         return Answered(ControlAnswer{});
     },
     "online positioning of matrix coefficients", manual_166},
    {"apply_mcbsp", {{{"HeadNo", 1, 4}, up_to("at_once", 3)}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.apply_mcbsp(small(p[0]), small(p[1]))); },
     "applies the online positioning to a head; at_once 2: with the next jump", manual_166},
    {"set_mcbsp_out", {{up_to("Signal1", 255), up_to("Signal2", 255)}}, 0, true, false, or_wrong,
     [](Engine& e, Numbers p) { return done(e.parts().recorder.send(std::array{word(p[0]), word(p[1])})); },
     "sends two signals of get_value in turn, one word in 10 us", by_header},

    {"measurement_status", {}, 2, true, true, or_wrong,
     [](Engine& e, Numbers) {
         const Recording& r = e.parts().recorder.recording();
         return answer({r.period != 0 ? 1 : 0, r.count - 1});
     },
     "(Busy, Pos): whether set_trigger records; Pos + 1 samples are there, none: -1", by_header},
    {"stop_trigger", {}, 0, true, false, or_wrong,
     [](Engine& e, Numbers) {
         e.parts().recorder.stop();
         return Answered(ControlAnswer{});
     },
     "ends a recording; its samples stay", by_header},

    {"set_laser_mode", {{{"Mode"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
    {"set_laser_control", {{{"Ctrl"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
    {"set_standby", {{{"HalfPeriod"}, {"PulseLength"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
    {"set_laser_pulses_ctrl", {{{"HalfPeriod"}, {"PulseLength"}}}, 0, true, false, or_wrong, taken, changes_nothing,
     by_header},
    {"set_firstpulse_killer", {{{"Length"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
    {"set_qswitch_delay", {{{"Delay"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
    {"set_laser_pulses", {{{"HalfPeriod"}, {"PulseLength"}}}, 0, true, false, or_wrong, taken, changes_nothing,
     by_header},
    {"set_laser_timing", {{{"HalfPeriod"}, {"PulseLength1"}, {"PulseLength2"}, {"TimeBase"}}}, 0, true, false, or_wrong,
     taken, changes_nothing, by_header},
    {"set_firstpulse_killer_list", {{{"Length"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
    {"set_qswitch_delay_list", {{{"Delay"}}}, 0, true, false, or_wrong, taken, changes_nothing, by_header},
};
// clang-format on

}  // namespace

std::uint32_t error_bits_of(const Error& error, Refusal refusal, const Engine& engine) {
    const bool moves = (engine.status() & (status_bit("BUSY") | status_bit("INTERNAL_BUSY"))) != 0;
    if (error.kind == ErrorKind::refused && refusal == Refusal::rejected) return error_bit("REJECTED");
    if (error.kind == ErrorKind::refused && refusal == Refusal::busy && moves) return error_bit("BUSY");
    return error_bits_of(error.kind);
}

Result<void> ControlCommand::check(std::span<const double> parameters) const {
    const std::span<const ControlParam> wanted = params();
    if (parameters.size() != wanted.size())
        return fail(ErrorKind::refused, fmt::format("{} has {} parameters, not {}; nothing was done", name,
                                                    wanted.size(), parameters.size()));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const ControlParam& param = wanted[i];
        MOTIONRACK_CHECK(check_parameter(name, param.name, parameters[i], param.min, param.max, param.unit));
        if (param.whole && parameters[i] != std::floor(parameters[i]))
            return fail(ErrorKind::refused, fmt::format("{}: {} is {}, but must be whole; nothing was changed", name,
                                                        param.name, parameters[i]));
    }
    return {};
}

std::string ControlCommand::ranges() const {
    std::string out;
    for (const ControlParam& param : params())
        out += fmt::format(" {} {:.10g} to {:.10g}{}{}.", param.name, param.min, param.max,
                           param.unit.empty() ? "" : " ", param.unit);
    return out;
}

std::span<const ControlCommand> control_commands() {
    return commands;
}

const ControlCommand* find_control_command(std::string_view name) {
    for (const ControlCommand& command : commands)
        if (command.name == name) return &command;
    return nullptr;
}

}  // namespace motionrack::rtc5
