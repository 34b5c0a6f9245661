// The meaning of G-code, line by line: words and modal state become moves in machine coordinates and events.
//
// The dialect is Grbl 1.1's, with what LinuxCNC adds: paths, cycles, tool tables, turned work systems, parameters.
// Where the two differ, or neither is followed:
// - At the start no motion mode is active (LinuxCNC); Grbl starts in G0: Settings::start_in_g0.
// - F0 or no F on a feed is an error (both); in G93 every feed line needs its F (both); G93 <-> G94 forgets the feed
// (both).
// - Arcs: offsets without axis words make full turns, P turns them several times, a third-axis word alone makes a helix
//   (LinuxCNC; Grbl's errors 26 and 32). Offset words outside the plane, and R beside I J K, are errors (LinuxCNC; Grbl
//   leaves them out silently). R arcs may be 0.005 mm too short for half a turn (LinuxCNC).
// - M7 and M8 may stand on one line (Grbl); LinuxCNC refuses it.
// - G53 reaches machine coordinates without the tool length (both). G43.1 of a sender takes Z alone (Grbl).
// - G61 is exact path, G61.1 exact stop, G64 P blends (LinuxCNC); G64 without P takes the settings' tolerance, where
//   LinuxCNC takes any. G64's Q (naive cam) is refused.
// - G80 may stand beside another motion word, which then counts (LinuxCNC; CAM programs begin with G0 G40 G80); Grbl
//   refuses it.
// - G53 ignores G91 (Grbl); LinuxCNC refuses the two together.
// - Cycles begin with G98 (LinuxCNC's interpreter begins with G99). In G91, R counts from the level before the first
// hole
//   (LinuxCNC). Between holes the drill stays at the height where it left the last one, after rising to R where that is
//   higher; after a change from G99 to G98, LinuxCNC rises to the first level on the slant. A peck thinner than the
//   clearance never rapids above R.
// - With cutter compensation a move waits for the next one, on which its end depends (motion_cutter.cpp, held.hpp); G40
//   and the program's end let it go. A joint that is tangent within 0.001 mm gets no arc; LinuxCNC: within 2.9 degrees.
// - A probing move of any length is taken (LinuxCNC: 0.254 mm); the line after it begins where the machine stands.
// - M56 is refused with a sentence. M0, M1, M2 and M30 are events.
// - A program may end without M2 (Grbl); LinuxCNC wants M2 or %.
// - Ends and bulges past the axis limits are errors of the line (Grbl raises alarm 2).
#pragma once

#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/biarc_approximator.hpp>
#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/gcode/compensation_queue.hpp>
#include <motionrack/control/gcode/drill_cycle.hpp>
#include <motionrack/control/gcode/language/parameters.hpp>
#include <motionrack/control/gcode/lathe_cycle.hpp>
#include <motionrack/control/gcode/settings.hpp>
#include <motionrack/control/gcode/work_frame.hpp>

namespace motionrack::control::gcode {

/// Positions may pass a limit by this much (mm or degrees): what sums of rounded numbers can be off.
inline constexpr double limit_slack = 1e-6;

inline constexpr std::int16_t no_motion = -1;

/// Of the contour, seen along it from the positive third axis.
enum class CutterSide : std::uint8_t { off, left, right };

/// Modal state that is only numbers.
struct ModalState {
    std::int16_t motion =
        no_motion;             ///< G code in tenths: 0, 10, 20, 30, 50, 51, 382 .. 385, 730 .. 890; no_motion after G80
    std::uint8_t plane = 0;    ///< 0 G17, 1 G18, 2 G19
    std::uint8_t system = 0;   ///< 0 G54 .. 5 G59, 6 G59.1 .. 8 G59.3
    bool inch = false;         ///< G20
    bool incremental = false;  ///< G91
    bool arc_absolute = false;  ///< G90.1
    bool inverse_time = false;  ///< G93
    bool retract_to_r = false;  ///< G99
    PathControl path = PathControl::continuous;
    CutterSide cutter = CutterSide::off;  ///< G40 G41 G42
    Spindle spindle = Spindle::off;
    bool mist = false;
    bool flood = false;
    bool ended = false;               ///< after M2, M30
    bool feed_override = true;        ///< M48, M50
    bool speed_override = true;       ///< M48, M51
    bool feed_stop = true;            ///< M53
    std::int32_t tool_selected = -1;  ///< by T; -1: none yet
    std::int32_t tool_loaded = -1;    ///< by M6; -1: none yet
    double cutter_radius_mm = 0;      ///< where `cutter` is not off
    double tolerance_mm = 0;
    double feed = 0;         ///< G94: mm/s, G93: 1/s; 0: none yet
    double feed_rotary = 0;  ///< G94: degrees/s, where no linear axis moves
    double speed_rpm = 0;
    std::uint32_t cycle_words = 0;  ///< which of the next four the current cycle has had
    double cycle_r = 0;             ///< as written, mm
    double cycle_z = 0;             ///< the drilling axis' word, as written, mm
    double cycle_q = 0;             ///< mm
    double cycle_p = 0;             ///< seconds
    PlanePoint spline_end;          ///< of the last G5: P and Q, mm
    PlanePoint spline_at;           ///< and where it ended
    double cycle_level = 0;         ///< G98: machine coordinate of the drilling axis before the first hole
};

/// What a line does to the move that waits before it, and the move that waits after it.
struct CompensationPlan {
    bool joins = false;   ///< the move that waits goes along `last`
    bool around = false;  ///< then along `arc`
    bool begins = false;  ///< a move begins at `from` and waits along `path`
    CutterPath last;
    CutterPath path;
    PlanePoint from;
    Move arc;

    void clear() { joins = around = begins = false; }
};

/// Give it lines, take the steps of each: `if (auto done = interpreter.line(text, 7); done) while (auto* step =
/// interpreter.pull()) ...`
class Interpreter {
  public:
    /// `settings` must pass check_settings.
    explicit Interpreter(const Settings& settings);

    /// Reads and checks one line (without its line end) and prepares its steps; steps of the line before that were not
    /// pulled are dropped. After a problem nothing of the line has taken effect. Steps' texts point into `text`.
    /// A line with an O word (block().flow) has no steps: what it means is for who walks through the program.
    Outcome<void> line(std::string_view text, std::int32_t number, Language language = Language::words);

    /// The next step of the last line, valid until the next call; null: no more.
    const CanonCall* pull() {
        if (todo_ == 0) return nullptr;
        return pull_next();
    }

    /// After the last line: with cutter compensation a move may wait for the next one, on which its end depends. This
    /// makes it and what is behind it final; take the steps as after a line. Compensation is off then. A problem is
    /// that of the line that waited.
    Outcome<void> finish();
    /// Whether the step that was pulled last is one of a line before, which has waited.
    bool was_held() const { return has_waited_; }

    /// Machine coordinates after the last line; with cutter compensation where the cutter's centre is if it goes no
    /// further.
    const Point& position() const { return off_path_ ? at_ : position_; }
    Point program_position() const;                     ///< the same in the active work system, mm and degrees
    std::int32_t line_number() const { return line_; }  ///< of the last line
    /// The probing move of the last line (Step::probe) has stopped: the edge was at `at` if `hit`, and the machine
    /// stands at `stands`, where the next line begins. Without this call the move counts as gone to its end, where the
    /// probe did as it was meant to. #5061 .. #5070 tell of it.
    void set_probe_result(bool hit, const Point& at, const Point& stands);
    /// The machine was moved otherwise: the next line begins there, without cutter compensation.
    void resync_position(const Point& position);
    /// The operator has switched the coolant.
    void set_coolant(bool mist, bool flood) {
        modes_.mist = mist;
        modes_.flood = flood;
    }
    const ModalState& modes() const { return modes_; }
    const WorkFrame& frame() const { return frame_; }
    const Block& block() const { return block_; }  ///< the words of the last line
    const Parameters& parameters() const { return parameters_; }
    Parameters& parameters() { return parameters_; }
    const ToolTable& tools() const { return tools_; }
    /// A subprogram ends: its parameters are gone, and the modes are as M73 has kept them. False: they stay as they
    /// are, since cutter compensation is on and would not go with them.
    bool end_call(std::optional<double> returned);
    /// The last line is a turning cycle (G70 .. G72.2), which needs its contour: the moves of the sub `label`, which
    /// draws_contour() reads. Until turn() has it, the line has no steps but its comments and events.
    bool is_lathe_cycle() const { return turning_.has_value(); }
    const std::string& contour_label() const { return contour_label_; }
    /// One that reads a contour: as this one, but without limits and with a feed, from where the cycle starts.
    Interpreter contour_interpreter() const;
    /// Gives the line its moves. Errors: with nothing of them.
    Outcome<void> turn(std::vector<ContourSegment> contour);
    /// No work system is turned from now on, and overrides count.
    void reset_after_program();

  private:
    enum Todo : std::uint32_t {
        todo_held = 1,
        todo_comments = 2,
        todo_speed = 4,
        todo_tool_select = 8,
        todo_wait = 16,
        todo_port = 32,
        todo_tool_change = 64,
        todo_spindle = 128,
        todo_coolant = 256,
        todo_overrides = 512,
        todo_dwell = 1024,
        todo_motion = 2048,
        todo_stop = 4096
    };
    enum class Motion : std::uint8_t { single, via_point, cycle, spline, turning };

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
    void fill_dwell(double seconds);
    void fill_port();
    void fill_overrides();
    void apply_end();
    void commit();
    /// M2 or M30 on the line.
    bool ends_program() const { return (todo_ & todo_stop) != 0 && (stop_code_ == 2 || stop_code_ == 30); }
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
    void save_modes();
    void restore(const ModalState& saved);
    bool goes_beside(const ModalState& saved) const;
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
    bool compensates() const { return next_.cutter != CutterSide::off && next_.cutter_radius_mm > 0; }
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
    void settle_joint();
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
    bool turning_within_limits();
    void pull_turning();
    bool spline(std::int16_t code);
    bool spline_allowed(std::int16_t code);
    bool cubic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve);
    bool quadratic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve);
    PlanePoint turned_handle(PlanePoint handle) const;
    bool pull_spline();
    bool negative_handles() const;
    bool targets(bool machine_coordinates);
    bool targets_turned();
    Move& begin_move(MoveKind kind);
    bool feed_of(Move& move);
    bool reach(int axis, double value, std::size_t column) {
        return (value >= low_[axis] && value <= high_[axis]) || exceeds_travel(axis, value, column);
    }
    bool exceeds_travel(int axis, double value, std::size_t column);
    bool no_feed();
    bool unused();
    bool unused_exponent();
    const CanonCall* pull_next();
    const CanonCall* pull_motion();
    const CanonCall* pull_comment();
    void show_values();
    std::string substitute_values(std::string_view text) const;

    bool fail_at(std::size_t column, GrblStatus status, std::string message,
                 ErrorKind trouble = ErrorKind::invalid_input);
    bool fail_word(char letter, GrblStatus status, std::string message);
    bool need_integer(char letter, double low, double high, const char* use);
    std::size_t error_column() const;  ///< column of the motion word, or of the first axis or offset word
    std::string_view word_text(char letter) const;
    double scale_of(int axis) const { return axis < 3 && next_.inch ? 25.4 : 1.0; }
    double scaled(char letter) const { return next_.inch ? block_[letter] * 25.4 : block_[letter]; }
    WorkFrame& edit_frame();
    const WorkFrame& frame_now() const { return frame_edited_ ? next_frame_ : frame_; }
    static std::size_t axis_letter(int axis) { return static_cast<std::size_t>(letter_index(axis_letters[axis])); }

    Settings settings_;
    Point low_ = {};
    Point high_ = {};
    std::uint32_t present_words_ = 0;

    ModalState modes_;
    WorkFrame frame_;
    Point position_ = {};
    Parameters parameters_;
    ToolTable tools_;
    /// What M70 and M73 have kept, by the depth of calls.
    struct SavedModes {
        std::optional<ModalState> modes;
        bool comes_back = false;  ///< when the call ends (M73)
    };
    std::vector<SavedModes> kept_;

    // What the line being read will have changed when it is found good.
    ModalState next_;
    WorkFrame next_frame_;
    bool frame_edited_ = false;
    Point end_ = {};
    std::uint32_t used_ = 0;
    bool axis_words_taken_ = false;

    Language language_ = Language::words;
    std::optional<Tool> tool_edited_;  ///< by G10 L1, L10, L11

    // Cutter compensation: the move that waits, and what the line being read makes of it.
    CompensationQueue held_;
    bool has_waited_ = false;
    bool compensating_ = false;  // a move waits in held_; from the first one beside the contour to G40
    bool off_path_ = false;      // the machine is not at position_, but at at_
    Point at_ = {};
    CutterPath cutter_path_;
    PlanePoint cutter_from_;
    std::int32_t cutter_line_ = 0;
    CompensationPlan cutter_plan_;

    Block block_;
    Problem problem_;
    std::int32_t line_ = 0;

    // What is left to pull.
    std::uint32_t todo_ = 0;
    Motion motion_ = Motion::single;
    bool via_point_pending_ = false;
    std::size_t comments_pulled_ = 0;
    std::vector<std::string> shown_;  ///< of the comments with values: what they show
    double dwell_seconds_ = 0;
    double wait_seconds_ = 0;  ///< of M66
    double port_value_ = 0;    ///< of M62 .. M68
    Point dwell_at_ = {};
    std::int16_t stop_code_ = 0;
    bool end_pending_ = false;
    Point via_ = {};
    CanonCall event_;
    CanonCall moving_;
    DrillCycleMoves cycle_;
    BiarcApproximator spline_;
    std::optional<LatheCycle> turning_;  ///< of the last line
    std::string contour_label_;
    std::vector<LatheMove> turned_;
    std::size_t turned_pulled_ = 0;
};

}  // namespace motionrack::control::gcode
