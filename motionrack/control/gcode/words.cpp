// The table of G and M codes. Within a group, messages list the codes in the order of the rows.
#include <array>
#include <bit>
#include <motionrack/control/gcode/arc_words.hpp>
#include <motionrack/control/gcode/cutter_compensation.hpp>
#include <motionrack/control/gcode/drill_words.hpp>
#include <motionrack/control/gcode/io_words.hpp>
#include <motionrack/control/gcode/lathe_words.hpp>
#include <motionrack/control/gcode/machine_words.hpp>
#include <motionrack/control/gcode/mode_words.hpp>
#include <motionrack/control/gcode/nonmodal_words.hpp>
#include <motionrack/control/gcode/offset_words.hpp>
#include <motionrack/control/gcode/spline_words.hpp>
#include <motionrack/control/gcode/straight_words.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

namespace {

consteval std::uint32_t letter_bits(std::string_view text) {
    std::uint32_t bits = 0;
    for (const char letter : text) bits |= letter_bit(letter);
    return bits;
}

consteval WordRule after_motion(WordRule rule) {
    rule.stands_first = true;
    return rule;
}

consteval WordRule not_for_senders(WordRule rule, std::string_view why) {
    rule.refusal = why;
    return rule;
}

consteval WordRule refused_code(std::int16_t tenths, std::string_view why) {
    return not_for_senders({tenths, g_refused}, why);
}

/// Handlers: a function of a reader, without or with the code, or a value of the modal state.
template <class Reader, bool (Reader::*read)()>
bool call(InterpreterState& state, std::int16_t) {
    return (Reader(state).*read)();
}

template <class Reader, bool (Reader::*read)(std::int16_t)>
bool call_with(InterpreterState& state, std::int16_t code) {
    return (Reader(state).*read)(code);
}

template <auto mode, auto value>
bool set_mode(InterpreterState& state, std::int16_t) {
    state.modes.next().*mode = value;
    return true;
}

// Handlers of several codes.
constexpr WordHandler read_straight_word = call_with<StraightWords, &StraightWords::read>;
constexpr WordHandler read_arc_word = call_with<ArcWords, &ArcWords::read>;
constexpr WordHandler read_curve_word = call_with<SplineWords, &SplineWords::read>;
constexpr WordHandler read_drilling_word = call_with<DrillWords, &DrillWords::read>;
constexpr WordHandler read_turning_word = call_with<LatheWords, &LatheWords::read>;
constexpr WordHandler select_cutter_word = call<CutterCompensation, &CutterCompensation::select>;
constexpr WordHandler set_tool_length_word = call<OffsetWords, &OffsetWords::tool_length>;
constexpr WordHandler set_system_word = call_with<ModeWords, &ModeWords::set_system>;
constexpr WordHandler set_path_word = call_with<ModeWords, &ModeWords::set_path>;
constexpr WordHandler stop_program_word = call_with<MachineWords, &MachineWords::stop>;
constexpr WordHandler set_spindle_word = call_with<MachineWords, &MachineWords::set_spindle>;
constexpr WordHandler set_coolant_word = call_with<MachineWords, &MachineWords::set_coolant>;
constexpr WordHandler set_overrides_word = call_with<MachineWords, &MachineWords::overrides>;
constexpr WordHandler save_modes_word = call_with<MachineWords, &MachineWords::save_modes>;
constexpr WordHandler use_port_word = call<IoWords, &IoWords::read>;
constexpr WordHandler call_program_word = call<MachineWords, &MachineWords::check_program>;

constexpr std::string_view no_contour = ": lines from a sender have no contour to turn; run the program as a file";
constexpr std::string_view no_table =
    ": lines from a sender have no tool table; write the tool's length itself, e.g. G43.1 Z12.5";
constexpr std::string_view six_systems = ": lines from a sender have six work systems, G54 to G59";
constexpr std::string_view no_nurbs =
    ": NURBS are not supported; let the CAM program write G5 (cubic) or G5.1 (quadratic) curves, or arcs";
constexpr std::string_view no_spindle_angle =
    " needs the angle of the spindle, which this machine does not measure; use G94 (mm/min) or G93";

constexpr std::uint32_t letters_of_arc = axis_words | offset_words | letter_bits("PR");

constexpr WordRule table_of_g[] = {
    {0, g_motion, WordPhase::motion, read_straight_word, axis_words, "rapid"},
    {10, g_motion, WordPhase::motion, read_straight_word, axis_words, "straight move at the feed rate"},
    {20, g_motion, WordPhase::motion, read_arc_word, letters_of_arc, "arc, clockwise"},
    {30, g_motion, WordPhase::motion, read_arc_word, letters_of_arc, "arc, counter-clockwise"},
    {50, g_motion, WordPhase::motion, read_curve_word, letter_bits("XYIJPQ"), "cubic curve in X and Y"},
    {51, g_motion, WordPhase::motion, read_curve_word, letter_bits("XYIJ"), "quadratic curve in X and Y"},
    {800, g_motion, WordPhase::motion, nullptr, 0, "ends the cycle: no motion is active"},
    {730, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRQL"),
     "drilling with short retracts that break the chip"},
    {740, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRPL"), "left-hand tapping"},
    {840, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRPL"), "right-hand tapping"},
    {850, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRL"), "boring, out at the feed rate"},
    {860, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRPL"),
     "boring, out with the spindle stopped"},
    {890, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRPL"),
     "boring with a dwell, out at the feed rate"},
    not_for_senders(
        {700, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDEP"), "finishes a turned contour"},
        no_contour),
    not_for_senders({710, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDIR"),
                     "roughs a turned contour along Z, with its pockets"},
                    no_contour),
    not_for_senders(
        {711, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDIR"), "as G71, without pockets"},
        no_contour),
    not_for_senders(
        {712, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDIR"), "as G71, pockets only"},
        no_contour),
    not_for_senders({720, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDIR"),
                     "roughs a turned contour along X, with its pockets"},
                    no_contour),
    not_for_senders(
        {721, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDIR"), "as G72, without pockets"},
        no_contour),
    not_for_senders(
        {722, g_motion, WordPhase::motion, read_turning_word, letter_bits("XZQDIR"), "as G72, pockets only"},
        no_contour),
    {810, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRL"), "drilling"},
    {820, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRPL"), "drilling with a dwell"},
    {830, g_motion, WordPhase::motion, read_drilling_word, letter_bits("XYZRQL"), "drilling in pecks"},
    {382, g_motion, WordPhase::motion, read_straight_word, axis_words, "probes until contact; an error without one"},
    {383, g_motion, WordPhase::motion, read_straight_word, axis_words, "probes until contact"},
    {384, g_motion, WordPhase::motion, read_straight_word, axis_words,
     "probes until the contact ends; an error if it does not"},
    {385, g_motion, WordPhase::motion, read_straight_word, axis_words, "probes until the contact ends"},

    after_motion({40, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::dwell>, letter_bits("P"),
                  "dwell of P seconds"}),
    after_motion({100, g_nonmodal, WordPhase::once, call<OffsetWords, &OffsetWords::set_offsets>,
                  axis_words | letter_bits("LPRIJQ"), "sets offsets (L2, L20) or a tool (L1, L10, L11)"}),
    {280, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::move_to_reference>, axis_words,
     "rapid to the first reference position, by way of the words"},
    after_motion({281, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::store_first_reference>, 0,
                  "stores the first reference position"}),
    {300, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::move_to_reference>, axis_words,
     "rapid to the second reference position, by way of the words"},
    after_motion({301, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::store_second_reference>, 0,
                  "stores the second reference position"}),
    {530, g_nonmodal, WordPhase::once, nullptr, axis_words, "the words of this line are machine coordinates"},
    after_motion({920, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::shift>, axis_words,
                  "shifts the program so that the position reads as the words"}),
    after_motion({921, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::forget_shift>, 0,
                  "ends the shift of G92 and forgets it"}),
    after_motion({922, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::suspend_shift>, 0,
                  "ends the shift of G92"}),
    after_motion({923, g_nonmodal, WordPhase::once, call<NonmodalWords, &NonmodalWords::restore_shift>, 0,
                  "restores the shift of G92"}),

    {170, g_plane, WordPhase::modes, set_mode<&ModalState::plane, 0>, 0, "plane XY"},
    {180, g_plane, WordPhase::modes, set_mode<&ModalState::plane, 1>, 0, "plane XZ"},
    {190, g_plane, WordPhase::modes, set_mode<&ModalState::plane, 2>, 0, "plane YZ"},
    {900, g_distance, WordPhase::modes, set_mode<&ModalState::incremental, false>, 0, "words are positions"},
    {910, g_distance, WordPhase::modes, set_mode<&ModalState::incremental, true>, 0, "words are distances"},
    {901, g_arc_distance, WordPhase::modes, set_mode<&ModalState::arc_absolute, true>, 0, "I J K are positions"},
    {911, g_arc_distance, WordPhase::modes, set_mode<&ModalState::arc_absolute, false>, 0,
     "I J K are distances from the start"},
    {930, g_feed_mode, WordPhase::modes, call_with<ModeWords, &ModeWords::set_feed_mode>, 0, "F is inverse time"},
    {940, g_feed_mode, WordPhase::modes, call_with<ModeWords, &ModeWords::set_feed_mode>, 0, "F is units per minute"},
    {200, g_units, WordPhase::modes, set_mode<&ModalState::inch, true>, 0, "inch"},
    {210, g_units, WordPhase::modes, set_mode<&ModalState::inch, false>, 0, "mm"},

    {400, g_cutter, WordPhase::modes, select_cutter_word, 0, "ends cutter compensation"},
    {410, g_cutter, WordPhase::modes, select_cutter_word, letter_bits("D"),
     "cutter compensation on the left, with tool D"},
    {411, g_cutter, WordPhase::modes, select_cutter_word, letter_bits("D"),
     "cutter compensation on the left, with diameter D"},
    {420, g_cutter, WordPhase::modes, select_cutter_word, letter_bits("D"),
     "cutter compensation on the right, with tool D"},
    {421, g_cutter, WordPhase::modes, select_cutter_word, letter_bits("D"),
     "cutter compensation on the right, with diameter D"},

    after_motion({431, g_tool_length, WordPhase::modes, set_tool_length_word, axis_words, "tool length as written"}),
    {490, g_tool_length, WordPhase::modes, set_tool_length_word, 0, "no tool length"},
    not_for_senders({430, g_tool_length, WordPhase::modes, set_tool_length_word, letter_bits("H"), "length of tool H"},
                    no_table),
    not_for_senders({432, g_tool_length, WordPhase::modes, set_tool_length_word, axis_words | letter_bits("H"),
                     "adds a tool length"},
                    no_table),

    {980, g_retract, WordPhase::modes, set_mode<&ModalState::retract_to_r, false>, 0,
     "cycles retract to the level before them"},
    {990, g_retract, WordPhase::modes, set_mode<&ModalState::retract_to_r, true>, 0, "cycles retract to R"},

    {540, g_system, WordPhase::modes, set_system_word, 0, "work system 1"},
    {550, g_system, WordPhase::modes, set_system_word, 0, "work system 2"},
    {560, g_system, WordPhase::modes, set_system_word, 0, "work system 3"},
    {570, g_system, WordPhase::modes, set_system_word, 0, "work system 4"},
    {580, g_system, WordPhase::modes, set_system_word, 0, "work system 5"},
    {590, g_system, WordPhase::modes, set_system_word, 0, "work system 6"},
    not_for_senders({591, g_system, WordPhase::modes, set_system_word, 0, "work system 7"}, six_systems),
    not_for_senders({592, g_system, WordPhase::modes, set_system_word, 0, "work system 8"}, six_systems),
    not_for_senders({593, g_system, WordPhase::modes, set_system_word, 0, "work system 9"}, six_systems),

    {610, g_path, WordPhase::modes, set_path_word, 0, "exact path"},
    {611, g_path, WordPhase::modes, set_path_word, 0, "exact stop"},
    {640, g_path, WordPhase::modes, set_path_word, letter_bits("P"), "blends corners within P"},

    not_for_senders({970, g_spindle, WordPhase::modes, nullptr, 0, "S is rev/min"},
                    ": spindle speed is always in rev/min; leave it out"),

    refused_code(52, no_nurbs),
    refused_code(53, no_nurbs),
    refused_code(70, ": X is a radius here, never a diameter; let the CAM program write radii, and leave G7 out"),
    refused_code(80, ": X is always a radius here; leave it out"),
    refused_code(870,
                 ": back boring needs an oriented spindle stop, which this machine does not have; use G85, G86 or G89"),
    refused_code(880, ": a manual retract of the tool is not possible here; use G86 or G89"),
    refused_code(950, no_spindle_angle),
    refused_code(330, no_spindle_angle),
    refused_code(331, no_spindle_angle),
    refused_code(760, no_spindle_angle),
    refused_code(960, ": spindle speed is always in rev/min here (G97); leave it out"),
};

constexpr WordRule table_of_m[] = {
    after_motion({0, m_stop, WordPhase::machine, stop_program_word, 0, "stops until the operator resumes"}),
    after_motion({1, m_stop, WordPhase::machine, stop_program_word, 0, "as M0, if the operator has enabled it"}),
    after_motion({2, m_stop, WordPhase::machine, stop_program_word, 0, "end of the program"}),
    after_motion({30, m_stop, WordPhase::machine, stop_program_word, 0, "end of the program"}),
    after_motion({60, m_stop, WordPhase::machine, stop_program_word, 0, "as M0"}),
    {6, m_tool, WordPhase::machine, call<MachineWords, &MachineWords::change_tool>, 0, "changes to tool T"},
    {61, m_tool, WordPhase::machine, call<MachineWords, &MachineWords::set_tool>, letter_bits("Q"),
     "tool Q is in the spindle"},
    {3, m_spindle, WordPhase::machine, set_spindle_word, 0, "spindle clockwise"},
    {4, m_spindle, WordPhase::machine, set_spindle_word, 0, "spindle counter-clockwise"},
    {5, m_spindle, WordPhase::machine, set_spindle_word, 0, "spindle off"},
    {7, m_mist, WordPhase::machine, set_coolant_word, 0, "mist on"},
    {8, m_flood, WordPhase::machine, set_coolant_word, 0, "flood on"},
    {9, m_coolant_off, WordPhase::machine, set_coolant_word, 0, "mist and flood off"},
    {48, m_override, WordPhase::machine, set_overrides_word, 0, "enables the overrides"},
    {49, m_override, WordPhase::machine, set_overrides_word, 0, "disables the overrides"},
    {50, m_override, WordPhase::machine, set_overrides_word, letter_bits("P"),
     "enables (P1) or disables (P0) the feed override"},
    {51, m_override, WordPhase::machine, set_overrides_word, letter_bits("P"),
     "enables (P1) or disables (P0) the spindle override"},
    {52, m_override, WordPhase::machine, set_overrides_word, letter_bits("P"), "disables (P0) adaptive feed"},
    {53, m_override, WordPhase::machine, set_overrides_word, letter_bits("P"),
     "enables (P1) or disables (P0) the feed stop"},
    {70, m_state, WordPhase::saving, save_modes_word, 0, "saves the modes"},
    {71, m_state, WordPhase::saving, save_modes_word, 0, "discards saved modes"},
    {72, m_state, WordPhase::machine, call<MachineWords, &MachineWords::restore_saved>, 0, "restores saved modes"},
    {73, m_state, WordPhase::saving, save_modes_word, 0, "saves the modes until the sub ends"},
    {62, m_io, WordPhase::io, use_port_word, letter_bits("P"), "sets digital output P with the next move"},
    {63, m_io, WordPhase::io, use_port_word, letter_bits("P"), "clears digital output P with the next move"},
    {64, m_io, WordPhase::io, use_port_word, letter_bits("P"), "sets digital output P at once"},
    {65, m_io, WordPhase::io, use_port_word, letter_bits("P"), "clears digital output P at once"},
    {66, m_io, WordPhase::io, use_port_word, letter_bits("PELQ"),
     "reads digital input P or analog input E; waits as L says for Q seconds"},
    {67, m_io, WordPhase::io, use_port_word, letter_bits("EQ"), "sets analog output E to Q with the next move"},
    {68, m_io, WordPhase::io, use_port_word, letter_bits("EQ"), "sets analog output E to Q at once"},
    {98, m_program, WordPhase::program, call_program_word, letter_bits("PL"), "calls program P, L times"},
    {99, m_program, WordPhase::program, call_program_word, 0, "ends a called program"},
    not_for_senders({56, m_unknown}, " (parking override) is not supported: this machine does not park; leave it out"),
};

constexpr WordRule unknown_g = {-1, g_unknown};
constexpr WordRule unknown_m = {-1, m_unknown};

/// For each code the number of its row, from 1; 0: it has none.
template <std::size_t codes, std::size_t rows>
consteval std::array<std::uint8_t, codes> rows_of(const WordRule (&table)[rows]) {
    static_assert(rows < 256);
    std::array<std::uint8_t, codes> numbers = {};
    for (std::size_t row = 0; row < rows; ++row) {
        auto& number = numbers[static_cast<std::size_t>(table[row].code)];
        if (number != 0) throw "a code has two rows";
        number = static_cast<std::uint8_t>(row + 1);
    }
    return numbers;
}

constexpr auto rows_of_g = rows_of<1000>(table_of_g);
constexpr auto rows_of_m = rows_of<100>(table_of_m);

constexpr std::size_t phase_count = static_cast<std::size_t>(WordPhase::saving) + 1;

/// For each phase the groups that have codes in it, as bits.
template <std::size_t rows>
consteval std::array<std::uint32_t, phase_count> groups_of(const WordRule (&table)[rows]) {
    std::array<std::uint32_t, phase_count> groups = {};
    for (const WordRule& rule : table)
        if (rule.phase != WordPhase::none) groups[static_cast<std::size_t>(rule.phase)] |= 1u << rule.group;
    return groups;
}

constexpr auto groups_of_g = groups_of(table_of_g);
constexpr auto groups_of_m = groups_of(table_of_m);

bool run_word(InterpreterState& state, WordPhase phase, const WordRule& rule) {
    return rule.phase != phase || rule.handler == nullptr || rule.handler(state, rule.code);
}

}  // namespace

std::span<const WordRule> words_g() {
    return table_of_g;
}

std::span<const WordRule> words_m() {
    return table_of_m;
}

const WordRule& rule_of_g(int tenths) {
    const std::size_t row = tenths < 0 || tenths >= 1000 ? 0 : rows_of_g[static_cast<std::size_t>(tenths)];
    return row == 0 ? unknown_g : table_of_g[row - 1];
}

const WordRule& rule_of_m(int code) {
    const std::size_t row = code < 0 || code >= 100 ? 0 : rows_of_m[static_cast<std::size_t>(code)];
    return row == 0 ? unknown_m : table_of_m[row - 1];
}

bool run_words(InterpreterState& state, WordPhase phase) {
    const Block& block = state.words.block();
    const auto index = static_cast<std::size_t>(phase);
    for (std::uint32_t left = block.g_groups & groups_of_g[index]; left != 0; left &= left - 1)
        if (!run_word(state, phase, rule_of_g(block.g[static_cast<std::size_t>(std::countr_zero(left))]))) return false;
    for (std::uint32_t left = block.m_groups & groups_of_m[index]; left != 0; left &= left - 1)
        if (!run_word(state, phase, rule_of_m(block.m[static_cast<std::size_t>(std::countr_zero(left))]))) return false;
    return true;
}

bool stands_first(const Block& block) {
    for (std::uint32_t left = block.g_groups; left != 0; left &= left - 1)
        if (rule_of_g(block.g[static_cast<std::size_t>(std::countr_zero(left))]).stands_first) return true;
    for (std::uint32_t left = block.m_groups; left != 0; left &= left - 1)
        if (rule_of_m(block.m[static_cast<std::size_t>(std::countr_zero(left))]).stands_first) return true;
    return false;
}

}  // namespace motionrack::control::gcode
