// Functions that the source mentions without listing them: homed axes, stops, status, contours, bit patterns.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/library/arguments.hpp>
#include <motionrack/cards/mcx314/library/calls.hpp>

namespace motionrack::mcx314::functions {

namespace own {
namespace {

constexpr std::string_view motion = "Stops and status", contours = "Continuous interpolation",
                           patterns = "Bit patterns";

// ---- arguments

constexpr std::array some_axes = {axes};
constexpr std::array wait_data = {axes, number("milliseconds", 0, 60'000, "ms", "maximum time", 10'000)};
constexpr std::array asymmetric_data = {axes, one_of("on", off_on, "decelerations use D instead of A")};
constexpr std::array output_data = {axes, number("output", 0, 7, "", "OUT0 to OUT7", 0),
                                    one_of("level", low_high, "level")};
constexpr ArgumentInfo a_or_constant = number("A", 0, param::A.max, ramp_unit, "0: constant speed V", 0);
constexpr std::array contour_data = {sv_of("SV"), v_of("V"), a_or_constant, d_or_a};
constexpr ArgumentInfo v_from_here = number("V", 0, param::V.max, speed_unit, "velocity from here on; 0: unchanged", 0);
constexpr std::string_view of_segment = "from the segment's start";
constexpr ArgumentInfo path_axes{"axis", 3, 14, {}, "two or three axes", 3, axis_values, true};
constexpr ArgumentInfo px = finish_of("PX", of_segment, 1000), py = finish_of("PY", of_segment, 1000),
                       pz = finish_of("PZ", of_segment, 0), pu = finish_of("PU", of_segment, 0),
                       cx = finish_of("CX", of_segment, 1000), cy = finish_of("CY", of_segment, 0),
                       cz = finish_of("CZ", of_segment, 0), cu = finish_of("CU", of_segment, 0);
constexpr std::array ways = {ValueInfo{0, "counterclockwise"}, ValueInfo{1, "clockwise"}};
constexpr std::array contour_line_data = {path_axes, px, py, pz, pu, v_from_here};
constexpr std::array contour_arc_data = {
    two, px, py, pz, pu, cx, cy, cz, cu, one_of("clockwise", ways, "direction"), v_from_here};
constexpr std::array pattern_data = {sv_of("SV"), v_of("V"), a_or_constant,
                                     number("DecPoint", 0, 268'435'455, "steps", "then it decelerates; with A", 0),
                                     path_axes};
constexpr ArgumentInfo word_of(std::string_view name, std::string_view meaning) {
    return number(name, 0, 0xFFFF, "", meaning, 0);
}
constexpr std::string_view plus = "16 steps in + direction, the lowest bit first",
                           minus = "16 steps in - direction; a bit in both: the drive ends here";
constexpr std::array steps_data = {word_of("plus1", plus),   word_of("minus1", minus), word_of("plus2", plus),
                                   word_of("minus2", minus), word_of("plus3", plus),   word_of("minus3", minus)};

// ---- calls

Result<CallAnswer> home_axes(LibraryChip& chip, Values v) {
    chip.home_axes = axes_of(v[0]);
    return CallAnswer{{}, fmt::format("HomeType1 to HomeType4 home {}.", axes_text(chip.home_axes))};
}
template <StopKind kind>
Result<CallAnswer> stop(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.stop(axes_of(v[0]), kind));
    return CallAnswer{{}, fmt::format("{} was stopped.", axes_text(axes_of(v[0])))};
}
Result<CallAnswer> wait(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.wait_until_done(axes_of(v[0]), milliseconds(v[1])));
    return CallAnswer{{}, fmt::format("{} is at standstill, as commanded.", axes_text(axes_of(v[0])))};
}
Result<CallAnswer> moving(LibraryChip& chip, Values v) {
    std::int64_t out = 0;
    for (const int i : channels_of(axes_of(v[0])))
        if (chip.driver.moving(1u << i)) out |= std::int64_t{1} << i;
    return CallAnswer{out, out == 0 ? "None of the axes drives." : axes_text(axes_of(out)) + " drives."};
}
Result<CallAnswer> at_limit(LibraryChip& chip, Values v) {
    std::int64_t out = 0;
    for (const int i : channels_of(axes_of(v[0])))
        if (chip.driver.axis_status(i).at_limit()) out |= std::int64_t{1} << i;
    return CallAnswer{out, out == 0 ? "None of the axes is at a limit." : axes_text(axes_of(out)) + " is at a limit."};
}
Result<CallAnswer> report(LibraryChip& chip, Values v) {
    CallAnswer out;
    for (const int i : channels_of(axes_of(v[0])))
        out.text += (out.text.empty() ? "" : "\n") + chip.driver.report(i).text();
    return out;
}
Result<CallAnswer> asymmetric(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SetAsymmetric(axes_of(v[0]), v[1] == 1));
    return written();
}
Result<CallAnswer> set_output(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SetOutput(axes_of(v[0]), static_cast<int>(v[1]), v[2] == 1));
    return written();
}
Result<CallAnswer> contour_begin(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.ContStart({v[0], v[1], v[2], v[3]}));
    return CallAnswer{{}, "The contour is open; add its lines and arcs."};
}
Result<CallAnswer> contour_line(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.ContLine(axes_of(v[0]), four(v.subspan(1)), v[5]));
    return CallAnswer{{}, "The line was accepted."};
}
Result<CallAnswer> contour_arc(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.ContArc(axes_of(v[0]), four(v.subspan(1)), four(v.subspan(5)), v[9] == 1, v[10]));
    return CallAnswer{{}, "The arc was accepted."};
}
Result<CallAnswer> contour_end(LibraryChip& chip, Values) {
    MOTIONRACK_TRY(const ContOutcome outcome, chip.driver.ContEnd());
    return CallAnswer{outcome.segments, fmt::format("The contour of {} segments has ended.", outcome.segments)};
}
Result<CallAnswer> pattern_begin(LibraryChip& chip, Values v) {
    const BPDATA speeds{v[0], v[1], v[2], v[3]};
    const unsigned mask = axes_of(v[4]);
    MOTIONRACK_CHECK(channels_of(mask).count == 3 ? chip.driver.BP3D(speeds, mask) : chip.driver.BP2D(speeds, mask));
    return CallAnswer{{}, "The pattern is open; stack its steps, then start it."};
}
Result<CallAnswer> pattern_steps(LibraryChip& chip, Values v) {
    BPWORD word;
    for (std::size_t i = 0; i < 3; ++i) {
        word.plus[i] = static_cast<std::uint16_t>(v[2 * i]);
        word.minus[i] = static_cast<std::uint16_t>(v[2 * i + 1]);
    }
    MOTIONRACK_CHECK(chip.driver.BPStack(word));
    return CallAnswer{{}, "Sixteen steps were stacked."};
}
Result<CallAnswer> pattern_start(LibraryChip& chip, Values) {
    MOTIONRACK_CHECK(chip.driver.BPStart());
    return CallAnswer{{}, "The pattern runs."};
}
Result<CallAnswer> pattern_end(LibraryChip& chip, Values) {
    MOTIONRACK_CHECK(chip.driver.BPEnd());
    return CallAnswer{{}, "The pattern has ended."};
}

constexpr std::string_view mask = "mask of axes";

constexpr std::array rows = {
    FunctionRow{{"home_axes",
                 motion,
                 "The axes that HomeType1 to HomeType4 home, all at once; X at first.",
                 some_axes,
                 {},
                 false,
                 true},
                home_axes},
    FunctionRow{{"stop",
                 motion,
                 "Stops axes, decelerating, with everything that is interpolated with them.",
                 some_axes,
                 {},
                 false,
                 true},
                stop<StopKind::slow>},
    FunctionRow{{"stop_now", motion, "Stops axes at once.", some_axes, {}, false, true}, stop<StopKind::quick>},
    FunctionRow{{"wait", motion, "Waits until none of the axes drives.", wait_data, {}, true, true}, wait},
    FunctionRow{{"moving", motion, "Mask of the axes that drive.", some_axes, mask, false, true}, moving},
    FunctionRow{{"at_limit", motion, "Mask of the axes at a limit switch or beyond a software limit.", some_axes, mask,
                 false, true},
                at_limit},
    FunctionRow{{"report", motion, "Reports state, position and stop reason of axes.", some_axes, {}, false, true},
                report},
    FunctionRow{{"asymmetric", motion, "Selects D instead of A for decelerations.", asymmetric_data, {}, false, true},
                asymmetric},
    FunctionRow{{"set_output", motion, "Sets a general output: servo on, brakes.", output_data, {}, false, true},
                set_output},

    FunctionRow{{"contour_begin", contours, "Opens a contour with its speeds.", contour_data, {}, false, true},
                contour_begin},
    FunctionRow{{"contour_line",
                 contours,
                 "Adds the next line; waits until the chip accepts it.",
                 contour_line_data,
                 {},
                 true,
                 true},
                contour_line},
    FunctionRow{{"contour_arc",
                 contours,
                 "Adds the next arc; waits until the chip accepts it.",
                 contour_arc_data,
                 {},
                 true,
                 true},
                contour_arc},
    FunctionRow{
        {"contour_end", contours, "Executes the last segment and waits for the end.", {}, "segments", true, true},
        contour_end},

    FunctionRow{{"pattern_begin", patterns, "Opens a bit pattern of two or three axes.", pattern_data, {}, false, true},
                pattern_begin},
    FunctionRow{{"pattern_steps",
                 patterns,
                 "Adds sixteen steps of each axis; three words fit before the start.",
                 steps_data,
                 {},
                 true,
                 true},
                pattern_steps},
    FunctionRow{{"pattern_start", patterns, "Starts the pattern.", {}, {}, false, true}, pattern_start},
    FunctionRow{{"pattern_end", patterns, "Waits for the end.", {}, {}, true, true}, pattern_end},
};

}  // namespace
}  // namespace own

std::span<const FunctionRow> own_rows() {
    return own::rows;
}

}  // namespace motionrack::mcx314::functions
