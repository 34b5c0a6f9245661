// Executes G-code line by line. The operator can hold, override or stop it at any time.
//
//   line ──Interpreter──► moves, in slices ──► MoveQueue ──PathPlan──► PlannedMove ──► AxisGroup
//                                                  ▲                        │
//                   hold: remaining path ──────────┴── from its standstill ─┘
//
//   running ──hold()──► feed_hold ──resume()──► running        single block or M0: paused ──resume()──► running
//   stop(), a fault: idle
//
// Long moves are submitted in slices of about 0.1 s, so that an override takes effect soon. A rapid that certainly goes
// from standstill to standstill is submitted as a whole, so that the card may drive it as one S-curve; a lower override
// makes it stop on its path and continue. Point-to-point axes get whole moves, and an override applies from the next
// one on. With each submitted move the known path ends at standstill: if the sender falls silent, the machine stops at
// the end of the last line.
//
// A plan with limited jerk holds, resumes and overrides along its own trajectory. The axes then decelerate on their own
// only when the machine stops them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/base/port.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/move_queue.hpp>
#include <motionrack/control/path_plan.hpp>
#include <motionrack/control/probing.hpp>
#include <string>
#include <string_view>

namespace motionrack::control {

struct StreamExecutorSettings {
    gcode::Settings gcode;  ///< its start is the current position of the axes
    LookAheadSettings planner;
    bool jerk_limited = false;  ///< limits jerk instead of using trapezoidal profiles
    double accel_reserve = 0;   ///< share of each axis' acceleration that the planner leaves to the card, 0 .. 0.5
    std::size_t max_entries =
        1'500;             ///< maximum number of known moves and events that are not executed yet; 16 or more
    double slice_s = 0.1;  ///< duration of a slice of a long move at its velocity
    Duration margin =
        milliseconds(30);  ///< lead time: the next move is submitted this long before the submitted path ends
};

enum class ExecutionState : std::uint8_t {
    idle,       ///< everything known is executed
    running,    ///< moves are submitted and not executed yet
    waiting,    ///< there is time for more lines before the axes need the next move
    feed_hold,  ///< standstill on the path after hold()
    paused      ///< standstill after M0, M1 or a single block, until resume()
};

/// Report of the last probing move.
struct ProbeReport {
    std::int64_t count = 0;  ///< number of probing moves that have ended, including this one
    std::int32_t line = 0;
    gcode::Probe probe = gcode::Probe::none;
    bool begun = false;  ///< false: the probe touched before the move (G38.4, G38.5: did not touch)
    bool runs = false;   ///< the move is being executed
    ProbeResult outcome;

    bool failed() const { return !begun || (!outcome.hit && gcode::probe_must(probe)); }
};

class StreamExecutor {
  public:
    /// `host`: provides the time. The stop flag of the axes must be stop_flag().
    StreamExecutor(AxisGroup& axes, Interrupt& host, const StreamExecutorSettings& settings);

    // ---- callable at any time, also from a slice of the host's time while drive() runs
    /// Returns true if line() accepts another line. After a probing line only when its move has ended, because the next
    /// lines start where it stopped.
    bool has_room() const { return queue_.has_room() && request_ != StopRequest::stop; }
    /// Checks a line and queues its moves. Requires has_room(). On an error the line has no effect.
    gcode::Outcome<void> line(std::string_view text, std::int32_t number);
    /// Checks a line of a whole program, in the complete language, and queues its moves. `program_flow`: the control
    /// flow of the program. Requires has_room().
    gcode::Outcome<void> line(std::string_view text, std::int32_t number, gcode::ProgramFlow& program_flow);
    /// Ends the program: queues the moves that wait for a following line (see gcode::Interpreter::finish). Requires
    /// has_room().
    gcode::Outcome<void> program_over();
    /// Queues a move that does not come from a line. Modes do not change, the feed override is ignored, and later lines
    /// start at its end. The move must be within the limits of the axes. Requires has_room().
    void move(const Move& move);
    /// Decelerates to a stop on the path; drive() then returns feed_hold. Without motion the state is feed_hold at
    /// once, and later lines wait. A probing move is completed first: the hold begins before the line after it, and
    /// ends if there is none.
    void hold();
    /// Resumes after a feed hold or a pause.
    void resume();
    /// Decelerates to a stop on the path and discards everything not executed, offsets included. Accepted in every
    /// state; drive() then returns idle.
    void stop();
    /// Sets the feed override and the rapid override, clamped to 0.01 .. 2 and 0.01 .. 1. A whole rapid that is faster
    /// stops on its path and continues by itself; a slower one ends as it was submitted.
    void set_overrides(double feed, double rapid);
    /// Enables single block: a pause after each line.
    void set_single_block(bool on) { single_block_ = on; }
    bool has_work() const { return queue_.has_work(); }
    /// Returns the number of calls read so far, without the first one of each line.
    std::int64_t further_steps() const { return queue_.further_steps(); }
    const ProbeReport& last_probe() const { return last_probe_; }
    /// Returns true while a probing move was read but has not ended.
    bool probe_pending() const { return queue_.probe_waits(); }
    /// Returns the number of moves and dwells, as read, that have not ended.
    std::size_t moves() const { return queue_.moves(); }
    /// Returns the line that was begun last; 0: none since reset_modal_state().
    std::int32_t current_line() const { return queue_.line(); }
    ExecutionState state() const { return state_; }
    const gcode::Interpreter& interpreter() const { return interpreter_; }
    const std::atomic<bool>* stop_flag() const { return &stop_flag_; }

    /// Sets the coolant state after manual switching; later lines continue from it.
    void set_coolant(bool mist, bool flood) { interpreter_.set_coolant(mist, flood); }

    // ---- between calls of drive()
    /// Submits the next move, or ends the path if there is none. Blocks in the host's time until the axes have room for
    /// another move. `more_may_come`: lines may follow soon, so the last move is held back while time remains. Errors:
    /// ErrorKind::machine if the machine stopped the motion; everything was discarded.
    Result<ExecutionState> drive(bool more_may_come);
    /// Continues from the current position of `axes` after other motion of the machine. Requires standstill.
    void resync_axes(AxisGroup& axes);
    /// Resets the modes for a new program or after a reset, and the current line; keeps the work offsets. Requires
    /// standstill.
    void reset_modal_state();
    /// Sets the work offsets and the G28 and G30 positions to 0. Requires standstill.
    void clear_offsets();
    /// Resets, after a program, the modes that Grbl does not have, so that a sender's lines keep their meaning.
    /// Requires standstill.
    void reset_after_program() { interpreter_.reset_after_program(); }
    /// Returns the settings for a program that starts here, as after reset_modal_state().
    gcode::Settings fresh_settings() const;

    /// Sets the callback for program events (spindle, message, tool, end), called in order when the machine passes
    /// them. `after_move`: number of the last planned move before it, of all that were submitted, from 0; -1: none.
    void on_event(std::function<void(const gcode::CanonCall& event, std::int64_t after_move)> call) {
        queue_.on_event(std::move(call));
    }
    /// Sets the callback for each move (dwells included) as it was read, before it is sliced.
    void on_move(std::function<void(const Move& move, const Point& start)> call) { queue_.on_move(std::move(call)); }

  private:
    /// replan: standstill on the path, then motion continues by itself with another override. pause: standstill before
    /// the next line, after a probing move in single block.
    enum class StopRequest : std::uint8_t { none, replan, pause, hold, stop };

    Result<void> fill_plan();
    bool stops_before(const QueueEntry& entry) const;
    bool time_left() const;
    Result<ExecutionState> submit(const PlannedMove& planned);
    Result<ExecutionState> finish_path();
    Result<ExecutionState> enter_standstill();
    Result<ExecutionState> probe();
    Result<ExecutionState> interrupted(const Error& error);
    void forget();
    void take_move_starts();
    void slow_rapid_down();

    AxisGroup* axes_;
    Interrupt& host_;
    StreamExecutorSettings settings_;
    gcode::Interpreter interpreter_;
    MoveQueue queue_;
    std::unique_ptr<PathPlan> plan_;
    std::string text_;             ///< text of the last line
    std::int64_t path_block_ = 0;  ///< number of the present path's first planned move, over all paths
    Instant block_began_ = never;  ///< start of the executing move; never: none has started
    bool path_begun_ = false;      ///< the axes have moves without a finish()
    bool single_block_ = false;
    ProbeReport last_probe_;
    double feed_ = 1, rapid_ = 1;
    StopRequest request_ = StopRequest::none;
    ExecutionState state_ = ExecutionState::idle;
    std::atomic<bool> stop_flag_{false};
};

}  // namespace motionrack::control
