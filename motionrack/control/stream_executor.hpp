// Drives G-code that comes line by line, and can be held, slowed and stopped at any instant.
//
//   line ──Interpreter──► moves, in pieces ──► entries ──LookAheadPlanner──► PlannedMove ──► AxisGroup
//                                                ▲                       │
//                  hold: the rest of the path ───┴── from where it stands ┘
//
//   driving ──hold()──► held ──resume()──► driving        a step done or M0: paused ──resume()──► driving
//   stop(), a fault: rest
//
// Long moves go to the axes in pieces of about 0.1 s, so that an override is felt soon; to axes that position one by
// one they go whole, and an override counts from the next one on. With each move that it hands
// over, the path that is known ends at rest: a sender that falls silent leaves the machine standing at the end of its
// last line.
//
// With limited jerk a ride takes the planner's place: it holds, resumes and overrides along its own curve, and the axes
// never brake on their own but when the machine stops them.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <motionrack/base/port.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/path_limits.hpp>
#include <motionrack/control/probing.hpp>
#include <motionrack/control/trajectory/trajectory_interpolator.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::control {

struct StreamExecutorSettings {
    gcode::Settings gcode;  ///< its start is where the axes stand
    LookAheadSettings planner;
    bool jerk_limited = false;        ///< not trapezoids, but within each axis' jerk
    double accel_reserve = 0;         ///< part of each axis' acceleration that the planner leaves to the card, 0 .. 0.5
    std::size_t max_entries = 1'500;  ///< moves and events that are known and not yet done; 16 or more
    double slice_s = 0.1;             ///< of a long move at its speed
    Duration margin =
        milliseconds(30);  ///< so long before the path that was handed over ends, more of it is handed over
};

enum class ExecutionState : std::uint8_t {
    idle,       ///< all that is known is done
    running,    ///< something was handed over
    waiting,    ///< there is time for more lines before the axes need the next move
    feed_hold,  ///< stands on its path after hold()
    paused      ///< stands after M0, M1 or a step; resume() goes on
};

/// The last probing move.
struct ProbeReport {
    std::int64_t count = 0;  ///< of probing moves that have ended, this one too
    std::int32_t line = 0;
    gcode::Probe probe = gcode::Probe::none;
    bool begun = false;  ///< false: the probe touched before the move (G38.4, G38.5: did not touch)
    ProbeResult outcome;

    bool failed() const { return !begun || (!outcome.hit && gcode::probe_must(probe)); }
};

class StreamExecutor {
  public:
    /// `host`: whose time passes. The axes' stop flag must be stop_flag().
    StreamExecutor(AxisGroup& axes, Interrupt& host, const StreamExecutorSettings& settings);

    // ---- what may be called at any time, also while drive() runs, from a slice of the host's time
    /// Whether line() takes another one. After a line that probes only when it has been done: the lines after it begin
    /// where it stopped.
    bool has_room() const {
        return entries_.size() < settings_.max_entries && !unpulled_ && !probe_waits_ && wish_ != Wish::stop;
    }
    /// Reads and checks a line and puts its moves behind the others. Needs has_room(). Errors: it had no effect.
    gcode::Outcome<void> line(std::string_view text, std::int32_t number);
    /// The same of a whole program that is walked through: in its whole language.
    gcode::Outcome<void> line(std::string_view text, std::int32_t number, gcode::ProgramFlow& walk);
    /// No more lines of the program come: what waits for the next one (see gcode::Interpreter::finish) is put behind
    /// the others. Needs has_room().
    gcode::Outcome<void> program_over();
    /// Puts a move behind the others that no line has asked for: modes stay, the feed override does not count, and the
    /// lines after it begin where it ends. It must be one that the axes can do. Needs has_room().
    void move(const Move& move);
    /// Decelerates along the path; drive() returns held. Nothing if nothing is driven. A probing move goes to its end
    /// first.
    void hold();
    /// Goes on from a hold or a pause.
    void resume();
    /// Decelerates along the path and forgets everything that is not driven. In every state; drive() returns rest.
    void stop();
    /// Parts of the programmed feed and of the rapid speed: 0.01 .. 2 and 0.01 .. 1, else the nearest of these.
    void set_overrides(double feed, double rapid);
    /// Pauses after each line.
    void set_single_step(bool on) { single_step_ = on; }
    bool has_work() const { return !entries_.empty() || unpulled_; }
    std::size_t entries() const { return entries_.size(); }
    const ProbeReport& last_probe() const { return last_probe_; }
    /// A probing move was read and is not done.
    bool probe_pending() const { return probe_waits_; }
    /// Moves and dwells, as they were read, that are not done.
    std::size_t moves() const { return moves_; }
    /// 0: none since reset_modal_state().
    std::int32_t current_line() const { return line_driven_; }
    ExecutionState state() const { return state_; }
    const gcode::Interpreter& interpreter() const { return interpreter_; }
    const std::atomic<bool>* stop_flag() const { return &stop_flag_; }

    /// The coolant was switched by hand: lines go on from there.
    void set_coolant(bool mist, bool flood) { interpreter_.set_coolant(mist, flood); }

    // ---- between drives
    /// Hands over the next move, or ends the path if there is none; blocks in the host's time until the axes have room
    /// for another. `more_may_come`: lines may follow soon, so the last move is kept back while there is time. Errors:
    /// ErrorKind::machine, the motion was stopped by the machine; everything was forgotten.
    Result<ExecutionState> drive(bool more_may_come);
    /// The machine was moved otherwise, and these are its axes: programs go on from where they stand. Needs rest.
    void resync_axes(AxisGroup& axes);
    /// A new program, or after a reset: modes as at the start, no line driven, work offsets kept. Needs rest.
    void reset_modal_state();
    /// Work offsets, G28 and G30 are 0 from now on. Needs rest.
    void clear_offsets();
    /// A program is over: what Grbl does not know of is as at its start, so that a sender's lines mean what they say.
    /// Needs rest.
    void reset_after_program() { interpreter_.reset_after_program(); }
    /// What reset_modal_state() leaves: how a program that begins here is read.
    gcode::Settings fresh_settings() const;

    /// Called when the machine passes an event of the program (spindle, message, tool, end), in order.
    void on_event(std::function<void(const gcode::CanonCall&)> call) { on_event_ = std::move(call); }
    /// Called with each move as it was read, before it is cut.
    void on_move(std::function<void(const Move& move, const Point& start)> call) { on_move_ = std::move(call); }

  private:
    enum class Wish : std::uint8_t { none, hold, stop };
    /// A piece of a move, or an event.
    struct Entry {
        gcode::CanonCall step;
        std::string text;
        Point start = {};
        double seconds = 0;       ///< of a move that was handed over
        std::int64_t number = 0;  ///< of a move that the ride has had
        bool last = true;         ///< piece of its move
        bool by_hand = false;     ///< not of a line
        bool is_probe() const { return step.probe != gcode::Probe::none; }
        bool is_overridable() const { return !by_hand && step.overridable; }
        bool is_move() const { return step.kind == gcode::CanonCallKind::move && !is_probe(); }
        /// What the overrides make of its move.
        void override_feed(Move& move, double feed, double rapid) const {
            if (is_overridable()) move.feed = step.move.feed * feed;
            if (step.overridable) move.rapid_override = rapid;
        }
    };
    /// A move that is being cut.
    struct Cutting {
        gcode::CanonCall step;
        Geometry path;
        int pieces = 1, done = 0;
        bool by_hand = false;
    };

    void pull_steps();
    void begin_cut(const gcode::CanonCall& step, bool by_hand);
    void add_piece();
    Result<void> fill_planner();
    bool stops_before(const Entry& entry) const;
    bool time_left();
    Result<ExecutionState> submit(const PlannedMove& planned);
    Result<ExecutionState> finish_path();
    Result<ExecutionState> stand();
    Result<ExecutionState> probe();
    Result<ExecutionState> interrupted(const Error& error);
    void keep_rest_of_path();
    void forget();
    void take_move_starts();
    void pop();
    void new_planner(const Point& place);

    // with limited jerk
    Result<ExecutionState> drive_ride(bool more_may_come);
    Result<void> fill_ride();
    bool ride_may_wait(bool rest_follows) const;
    void pop_before_block(std::int64_t block);
    void pop_driven(std::int64_t first_pending_move);
    TrajectoryInterpolator new_ride(const Point& place) const;

    AxisGroup* axes_;
    Interrupt& host_;
    StreamExecutorSettings settings_;
    PathLimits limits_;
    gcode::Interpreter interpreter_;
    LookAheadPlanner planner_;
    std::optional<TrajectoryInterpolator> ride_;  ///< if the jerk is limited; then planner_ idles
    /// Of what the axes have had, from the one that they drive on: the numbers of its moves (ride_), or how many of
    /// entries_ it stands for.
    std::deque<std::int64_t> blocks_;
    std::int64_t first_block_ = 0;  ///< of blocks_, as the axes count
    bool ride_ends_ = true;         ///< it was told that its path ends
    Instant last_push_{};           ///< when it got a move last
    std::deque<Entry> entries_;     ///< front: being driven
    std::optional<Cutting> cutting_;
    std::string text_;             ///< of the last line
    Point read_to_ = {};           ///< where the last entry ends
    std::int64_t read_ = 0;        ///< moves and dwells
    std::size_t moves_ = 0;        ///< in entries_ and cutting_
    std::size_t planned_ = 0;      ///< entries that the planner has had
    std::size_t handed_ = 0;       ///< entries up to the last move that the axes have had
    Instant block_began_ = never;  ///< of that move; never: it has not begun
    std::int32_t line_driven_ = 0;
    bool unpulled_ = false;    ///< of the last line not everything is in entries_
    bool path_begun_ = false;  ///< the axes have moves that they were not told the end of
    bool single_step_ = false;
    bool probe_waits_ = false;  ///< entries_ has a probing move, at its end but for events
    bool probing_ = false;
    ProbeReport last_probe_;
    double feed_ = 1, rapid_ = 1, feed_wanted_ = 1, rapid_wanted_ = 1;
    Wish wish_ = Wish::none;
    ExecutionState state_ = ExecutionState::idle;
    std::atomic<bool> stop_flag_{false};
    std::function<void(const gcode::CanonCall&)> on_event_;
    std::function<void(const Move&, const Point&)> on_move_;
};

}  // namespace motionrack::control
