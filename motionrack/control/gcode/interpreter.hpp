// The G-code interpreter: converts each line (words and modal state) to moves in machine coordinates and events.
//
// The dialect is Grbl 1.1 with extensions of LinuxCNC: paths, cycles, tool tables, rotated work systems, parameters.
// Differences between the two, and deviations from both:
// - At the start no motion mode is active (LinuxCNC); Grbl starts in G0: Settings::start_in_g0.
// - F0 or no F on a feed move is an error (both); in G93 every feed line needs its F (both); G93 <-> G94 clears the
//   feed rate (both).
// - Arcs: offsets without axis words make full turns, P repeats them, a third-axis word alone makes a helix
//   (LinuxCNC; Grbl's errors 26 and 32). Offset words outside the plane, and R together with I J K, are errors
//   (LinuxCNC; Grbl ignores them silently). R arcs may be 0.005 mm too short for half a turn (LinuxCNC).
// - M7 and M8 may share a line (Grbl); LinuxCNC refuses it.
// - G53 targets machine coordinates without the tool length (both). G43.1 of a sender accepts Z only (Grbl).
// - G61 is exact path, G61.1 exact stop, G64 P blends (LinuxCNC); G64 without P or with P0 uses the tolerance of the
//   settings (LinuxCNC: no limit). Q of G64 (naive cam) is refused.
// - G80 may share a line with another motion word, which then applies (LinuxCNC; CAM programs begin with G0 G40 G80);
//   Grbl refuses it.
// - G53 ignores G91 (Grbl); LinuxCNC refuses the combination.
// - Cycles start in G98 (LinuxCNC's interpreter starts in G99). In G91, R is relative to the level before the
//   first hole (LinuxCNC). Between holes the drill stays at the height where it left the last one, after a retract
//   to R if that is higher; after a change from G99 to G98, LinuxCNC rises to the first level on a slant. A peck
//   thinner than the clearance never makes a rapid above R.
// - With cutter compensation a move waits for the next one, which determines its end (cutter_compensation.cpp,
//   compensation_queue.hpp); G40 and the end of the program release it. A junction that is tangent within 0.001 mm
//   gets no arc; LinuxCNC: within 2.9 degrees.
// - A probing move of any length is accepted (LinuxCNC: 0.254 mm); the next line starts at the final position.
// - M56 is refused with an explanation. M0, M1, M2 and M30 are events.
// - A program may end without M2 (Grbl); LinuxCNC requires M2 or %.
// - Targets and arc bulges outside the axis limits are errors of the line (Grbl raises alarm 2).
#pragma once

#include <motionrack/control/gcode/interpreter_state.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode {

/// Give it lines and pull the calls of each: `if (auto done = interpreter.line(text, 7); done) while (auto* step =
/// interpreter.pull()) ...`
class Interpreter {
  public:
    /// `settings` must pass check_settings.
    explicit Interpreter(const Settings& settings);

    /// Checks one line (without its line end) and prepares its calls; drops calls of the previous line that were not
    /// pulled. On an error the line has no effect. Texts of the calls point into `text`. A line with an O word
    /// (block().has_o_word) has no calls; ProgramFlow interprets it.
    Outcome<void> line(std::string_view text, std::int32_t number, Language language = Language::words);

    /// Returns true if the last line set offsets: G10, G92, G28.1, G30.1, G43, G49.
    bool changes_offsets() const { return state_.offsets.is_frame_edited(); }
    /// Restores work offsets, rotations, G92, G28 and G30 of an earlier frame(), because the lines since then are not
    /// executed.
    void restore_offsets(const WorkFrame& earlier) { state_.offsets.restore(earlier, modes().system); }

    /// Returns the next call of the last line, valid until the next pull(); null if there is none.
    const CanonCall* pull() { return state_.pull(); }

    /// Completes a move that cutter compensation holds back at the end of the program, and the calls behind it; pull
    /// them as after a line. Compensation is off afterwards. An error belongs to the line that waited.
    Outcome<void> finish();
    /// Returns true if the last pulled call belongs to an earlier line and was held back.
    bool was_held() const { return state_.steps.was_held(); }

    /// Returns the machine coordinates after the last line; with cutter compensation, the cutter centre if it stops
    /// here.
    const Point& position() const {
        return state_.cutter.is_off_path() ? state_.cutter.at() : state_.travel.position();
    }
    Point program_position() const;  ///< position in the active work system, mm and degrees
    std::int32_t line_number() const { return state_.words.number(); }  ///< number of the last line
    /// Stores the result of the probing move of the last line (CanonCall::probe): the edge `at`, valid if `hit`, and
    /// the final position `stopped_at`. The next line starts there. Without this call the move counts as complete and
    /// successful. #5061 .. #5070 return the result.
    void set_probe_result(bool hit, const Point& at, const Point& stopped_at);
    /// Continues from a position after other motion of the machine; the next line starts there without cutter
    /// compensation.
    void resync_position(const Point& position);
    /// Sets the coolant state after manual switching.
    void set_coolant(bool mist, bool flood) { state_.modes.set_coolant(mist, flood); }
    const ModalState& modes() const { return state_.modes.now(); }
    const WorkFrame& frame() const { return state_.offsets.frame(); }
    const Block& block() const { return state_.words.block(); }  ///< words of the last line
    const Parameters& parameters() const { return state_.parameters; }
    Parameters& parameters() { return state_.parameters; }
    const ToolTable& tools() const { return state_.offsets.tools(); }
    /// Ends a subprogram: drops its parameters and restores the modes that M73 saved. Returns false, with unchanged
    /// modes, if active cutter compensation prevents it.
    bool end_call(std::optional<double> returned);
    /// Returns true if the last line is a lathe cycle (G70 .. G72.2). It needs its contour: the moves of the sub
    /// `label`, which contour_interpreter() reads. Until turn() gets it, the line has only its comments and events.
    bool is_lathe_cycle() const { return state_.contour.cycle.has_value(); }
    const std::string& contour_label() const { return state_.contour.label; }
    /// Returns an interpreter for a contour: a copy without limits and with a feed rate, at the start of the cycle.
    Interpreter contour_interpreter() const;
    /// Makes the moves of the lathe cycle from its contour. On an error the line has no moves.
    Outcome<void> turn(std::vector<ContourSegment> contour);
    /// Resets the rotation of all work systems and enables the overrides.
    void reset_after_program();

  private:
    bool evaluate();
    bool read_words();
    bool assign();
    void commit();
    void store_probe_result(bool hit, const Point& at);
    void show_values();
    std::string substitute_values(std::string_view text) const;

    InterpreterState state_;
};

}  // namespace motionrack::control::gcode
