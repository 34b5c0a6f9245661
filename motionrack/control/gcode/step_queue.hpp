// The canonical calls of the last line that were not pulled yet, in their order of execution.
//
// Words of a line add calls; each call is made when it is pulled, because a cycle, a curve or a contour has many.
#pragma once

#include <motionrack/control/gcode/biarc_approximator.hpp>
#include <motionrack/control/gcode/compensation_queue.hpp>
#include <motionrack/control/gcode/drill_cycle.hpp>
#include <motionrack/control/gcode/lathe_cycle.hpp>
#include <motionrack/control/gcode/line_words.hpp>
#include <motionrack/control/gcode/modal_state.hpp>
#include <motionrack/control/gcode/offsets.hpp>
#include <motionrack/control/gcode/travel.hpp>
#include <string>
#include <vector>

namespace motionrack::control::gcode {

class StepQueue {
  public:
    /// Calls of a line, in their order of execution.
    enum Todo : std::uint32_t {
        todo_held = 1,  ///< those that cutter compensation held back and that are final
        todo_comments = 2,
        todo_spindle_speed = 4,
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
    /// The state from which calls are made.
    struct StepSources {
        const LineWords& words;
        Modes& modes;      ///< changed by the end of the program
        Offsets& offsets;  ///< changed by the end of the program
        const Travel& travel;
        CompensationQueue& held;
    };

    void begin_line() {
        todo_ = 0;
        moving_.kind = CanonCallKind::move;
    }
    void clear() { todo_ = 0; }
    bool empty() const { return todo_ == 0; }
    bool has(std::uint32_t todo) const { return (todo_ & todo) != 0; }
    bool has_only(std::uint32_t todo) const { return (todo_ & ~todo) == 0; }
    bool is_motion_next() const { return (todo_ & (0 - todo_)) == todo_motion; }
    /// Removes the calls that do not wait for a move: comments and the end of the program. Returns them for add().
    std::uint32_t set_aside();

    void add(std::uint32_t todo) { todo_ |= todo; }
    void add_comments();
    void add_dwell(double seconds);
    /// Adds the wait of M66 for an input, which ends by its timeout of `seconds`.
    void add_wait(double seconds);
    void add_port(double value);
    void add_stop(std::int16_t code);
    /// Adds the move in moving() as it is.
    void add_move() { add_motion(Motion::single); }
    /// Adds the move in moving() as two, to `via` and to its end.
    void add_move_via(const Point& via);
    void add_cycle(const DrillCycle& plan);
    /// Adds a curve with the fields of the move in moving().
    void add_spline(const CubicBezier& curve);
    void add_turning(std::vector<LatheMove> moves);
    /// Returns the move of the line, for the words to fill.
    CanonCall& moving() { return moving_; }
    /// Returns a text for each comment of the line: with values inserted for DEBUG and PRINT, otherwise empty.
    std::vector<std::string>& shown() { return shown_; }
    double port_value() const { return port_value_; }

    /// Returns true if M2 or M30 is on the line.
    bool ends_program() const { return has(todo_stop) && (stop_code_ == 2 || stop_code_ == 30); }
    bool is_end_pending() const { return end_pending_; }
    bool is_probing() const { return has(todo_motion) && moving_.probe != Probe::none; }
    /// Completes a valid line. `position`: the position before it; `overridable`: its move is subject to the overrides.
    void commit(const Point& position, bool overridable);
    /// Applies the end of the program, unless that was done. Runs when the end is pulled, so that the moves before it
    /// on the line keep their frame.
    void apply_end(Modes& modes, Offsets& offsets);

    /// Returns the next call, valid until the next one; null if there is none.
    const CanonCall* next(const StepSources& from) { return todo_ == 0 ? nullptr : make_next(from); }
    /// Returns true if the last call was held back.
    bool was_held() const { return was_held_; }

  private:
    enum class Motion : std::uint8_t { single, via_point, cycle, spline, turning };

    void add_motion(Motion motion);
    const CanonCall* make_next(const StepSources& from);
    const CanonCall* make_motion(const StepSources& from);
    const CanonCall* make_comment(const StepSources& from);
    void fill_event(std::uint32_t what, const StepSources& from);
    void fill_dwell(double seconds, const StepSources& from);
    void fill_port(const Block& block);
    void fill_overrides(int code, const ModalState& modes);
    void fill_turning();
    bool fill_spline(const Travel& travel);

    std::uint32_t todo_ = 0;
    bool was_held_ = false;
    Motion motion_ = Motion::single;
    bool via_point_done_ = false;
    std::size_t comments_pulled_ = 0;
    std::vector<std::string> shown_;
    double dwell_seconds_ = 0;
    double wait_seconds_ = 0;  ///< timeout of M66, s
    double port_value_ = 0;    ///< value of M62 .. M68
    Point dwell_at_ = {};
    std::int16_t stop_code_ = 0;
    bool end_pending_ = false;
    Point via_ = {};
    CanonCall event_;
    CanonCall moving_;
    DrillCycleMoves cycle_;
    BiarcApproximator spline_;
    std::vector<LatheMove> turned_;
    std::size_t turned_pulled_ = 0;
};

}  // namespace motionrack::control::gcode
