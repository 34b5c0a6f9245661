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
// - G61 is exact path, G61.1 exact stop, G64 P blends (LinuxCNC); G64 without P uses the tolerance of the settings
//   (LinuxCNC: no limit). Q of G64 (naive cam) is refused.
// - G80 may share a line with another motion word, which then applies (LinuxCNC; CAM programs begin with G0 G40 G80);
//   Grbl refuses it.
// - G53 ignores G91 (Grbl); LinuxCNC refuses the combination.
// - Cycles start in G98 (LinuxCNC's interpreter starts in G99). In G91, R is relative to the level before the
//   first hole (LinuxCNC). Between holes the drill stays at the height where it left the last one, after a retract
//   to R if that is higher; after a change from G99 to G98, LinuxCNC rises to the first level on a slant. A peck
//   thinner than the clearance never makes a rapid above R.
// - With cutter compensation a move waits for the next one, which determines its end (motion_compensation.cpp,
//   compensation_queue.hpp); G40 and the end of the program release it. A junction that is tangent within 0.001 mm
//   gets no arc; LinuxCNC: within 2.9 degrees.
// - A probing move of any length is accepted (LinuxCNC: 0.254 mm); the next line starts at the final position.
// - M56 is refused with an explanation. M0, M1, M2 and M30 are events.
// - A program may end without M2 (Grbl); LinuxCNC requires M2 or %.
// - Targets and arc bulges outside the axis limits are errors of the line (Grbl raises alarm 2).
#pragma once

#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/gcode/compensation_queue.hpp>
#include <motionrack/control/gcode/language/parameters.hpp>
#include <motionrack/control/gcode/lathe_cycle.hpp>
#include <motionrack/control/gcode/line_words.hpp>
#include <motionrack/control/gcode/modal_state.hpp>
#include <motionrack/control/gcode/offsets.hpp>
#include <motionrack/control/gcode/settings.hpp>
#include <motionrack/control/gcode/step_queue.hpp>
#include <motionrack/control/gcode/travel.hpp>

namespace motionrack::control::gcode {

/// Effect of a line on the move that waits before it, and the move that waits after it.
struct CompensationPlan {
    bool joins = false;   ///< the waiting move follows `last`
    bool around = false;  ///< followed by `arc`
    bool begins = false;  ///< a move starts at `from` and waits along `path`
    CutterPath last;
    CutterPath path;
    PlanePoint from;
    Move arc;

    void clear() { joins = around = begins = false; }
};

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

    /// Returns the next call of the last line, valid until the next pull(); null if there is none.
    const CanonCall* pull() { return steps_.next({words_, modes_, offsets_, travel_, held_}); }

    /// Completes a move that cutter compensation holds back at the end of the program, and the calls behind it; pull
    /// them as after a line. Compensation is off afterwards. An error belongs to the line that waited.
    Outcome<void> finish();
    /// Returns true if the last pulled call belongs to an earlier line and was held back.
    bool was_held() const { return steps_.was_held(); }

    /// Returns the machine coordinates after the last line; with cutter compensation, the cutter centre if it stops
    /// here.
    const Point& position() const { return off_path_ ? at_ : travel_.position(); }
    Point program_position() const;                               ///< in the active work system, mm and degrees
    std::int32_t line_number() const { return words_.number(); }  ///< number of the last line
    /// Stores the result of the probing move of the last line (CanonCall::probe): the edge `at`, valid if `hit`, and
    /// the final position `stopped_at`. The next line starts there. Without this call the move counts as complete and
    /// successful. #5061 .. #5070 return the result.
    void set_probe_result(bool hit, const Point& at, const Point& stopped_at);
    /// Continues from a position after other motion of the machine; the next line starts there without cutter
    /// compensation.
    void resync_position(const Point& position);
    /// Sets the coolant state after manual switching.
    void set_coolant(bool mist, bool flood) { modes_.set_coolant(mist, flood); }
    const ModalState& modes() const { return modes_.now(); }
    const WorkFrame& frame() const { return offsets_.frame(); }
    const Block& block() const { return words_.block(); }  ///< words of the last line
    const Parameters& parameters() const { return parameters_; }
    Parameters& parameters() { return parameters_; }
    const ToolTable& tools() const { return offsets_.tools(); }
    /// Ends a subprogram: drops its parameters and restores the modes that M73 saved. Returns false, with unchanged
    /// modes, if active cutter compensation prevents it.
    bool end_call(std::optional<double> returned);
    /// Returns true if the last line is a lathe cycle (G70 .. G72.2). It needs its contour: the moves of the sub
    /// `label`, which contour_interpreter() reads. Until turn() gets it, the line has only its comments and events.
    bool is_lathe_cycle() const { return turning_.has_value(); }
    const std::string& contour_label() const { return contour_label_; }
    /// Returns an interpreter for a contour: a copy without limits and with a feed rate, at the start of the cycle.
    Interpreter contour_interpreter() const;
    /// Makes the moves of the lathe cycle. On an error it has none.
    Outcome<void> turn(std::vector<ContourSegment> contour);
    /// Resets the rotation of all work systems and enables the overrides.
    void reset_after_program();

  private:
    bool evaluate();
    bool check_values();
    bool assign();
    bool apply_modes();
    void apply_feed();
    bool apply_machine_words();
    bool overrides();
    bool program_words();
    bool ports();
    bool port_number(char letter, char other);
    bool claim_words(std::uint32_t words);
    bool read_input();
    void commit();
    bool nonmodal();
    bool dwell();
    bool set_offsets();
    bool set_work_offset(int system, bool from_position);
    bool tool_length();
    bool tool_length_of_words(bool adds);
    bool tool_length_of_table(bool adds);
    const Tool* tool_of_table(std::int32_t number, char letter, GroupG code);
    bool set_tool();
    bool require_tool(char letter, std::int32_t number);
    Point shift_to_words(const WorkFrame& frame) const;
    void shift_turned(WorkFrame& frame, int system);
    bool edit_tool(int what);
    bool edit_tool_shape(Tool& tool);
    void restore(const ModalState& saved);
    bool shift();
    bool reference();
    bool motion();
    bool motion_needs(std::int16_t code, bool wants_motion);
    bool straight(std::int16_t code);
    void store_probe_result(bool hit, const Point& at);
    bool may_probe(std::int16_t code);
    bool probing(std::int16_t code);
    bool by_itself(std::int16_t code);
    bool arc(std::int16_t code);
    bool in_turned_plane(std::int16_t code);
    bool arc_centre(bool counter_clockwise, PlanePoint& centre);
    bool arc_centre_of_radius(PlanePoint start, PlanePoint end, bool closed, bool counter_clockwise,
                              PlanePoint& centre);
    bool arc_centre_of_offsets(PlanePoint start, PlanePoint& centre);
    bool arc_radii_agree(PlanePoint start, PlanePoint end, PlanePoint centre);
    bool arc_within_limits(PlanePoint start, PlanePoint end, PlanePoint centre, std::int32_t turns);
    bool cutter();
    bool cutter_diameter(double& diameter);
    bool cutter_allows();
    bool compensates() const { return next().cutter != CutterSide::off && next().cutter_radius_mm > 0; }
    bool compensate();
    bool path_beside(PlanePoint from, PlanePoint to, CutterPath& path);
    bool join(PlanePoint corner);
    bool end_waiting_path();
    bool end_cutter();
    bool may_wait();
    bool gouges(std::int32_t line);
    bool off_limits();
    bool reaches_contour();
    bool leaves_straight(std::int16_t code);
    void commit_cutter();
    void hold_steps();
    void settle_junction();
    bool cycle(std::int16_t code);
    bool cycle_words(std::int16_t code);
    bool spindle_turns(std::int16_t code);
    bool pecks_go(const DrillCycle& plan);
    bool cycle_within_limits(DrillCycle& plan);
    bool cycle_places(DrillCycle& plan);
    bool cycle_places_turned(DrillCycle& plan);
    bool turning(std::int16_t code);
    bool turning_allowed(std::int16_t code);
    bool turning_words(std::int16_t code, LatheCycle& plan);
    bool turning_within_limits(const std::vector<LatheMove>& moves);
    bool spline(std::int16_t code);
    bool spline_allowed(std::int16_t code);
    bool cubic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve);
    bool quadratic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve);
    PlanePoint turned_handle(PlanePoint handle) const;
    bool negative_handles() const;
    bool targets(bool machine_coordinates);
    bool targets_turned();
    Move& begin_move(MoveKind kind);
    bool feed_of(Move& move);
    bool reach(int axis, double value, std::size_t column) {
        return travel_.contains(axis, value) || exceeds_travel(axis, value, column);
    }
    bool exceeds_travel(int axis, double value, std::size_t column);
    bool no_feed();
    void show_values();
    std::string substitute_values(std::string_view text) const;

    double scale_of(int axis) const { return axis < 3 && next().inch ? 25.4 : 1.0; }
    double scaled(char letter) const { return next().inch ? block()[letter] * 25.4 : block()[letter]; }
    ModalState& next() { return modes_.next(); }
    const ModalState& next() const { return modes_.next(); }
    WorkFrame& edit_frame() { return offsets_.edit_frame(); }
    const WorkFrame& frame_now() const { return offsets_.next_frame(); }
    static std::size_t axis_letter(int axis) { return static_cast<std::size_t>(letter_index(axis_letters[axis])); }

    Settings settings_;
    LineWords words_;
    Modes modes_;
    Offsets offsets_;
    Travel travel_;
    Parameters parameters_;

    // Cutter compensation: the waiting move, and the effect of the current line on it.
    CompensationQueue held_;
    bool compensating_ = false;  // a move waits in held_; from the first compensated move to G40
    bool off_path_ = false;      // the machine is at at_, not at the programmed position
    Point at_ = {};
    CutterPath cutter_path_;
    PlanePoint cutter_from_;
    std::int32_t cutter_line_ = 0;
    CompensationPlan cutter_plan_;

    std::optional<LatheCycle> turning_;  ///< lathe cycle of the last line
    std::string contour_label_;
    StepQueue steps_;
};

}  // namespace motionrack::control::gcode
