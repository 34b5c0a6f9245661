// The moves and events that an executor has read and the machine has not passed yet, in program order.
//
//   Interpreter ──► │ read │ planned │ submitted │ ──► passed
//                     long moves in slices            events are reported then
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/path_limits.hpp>
#include <motionrack/control/split_move.hpp>
#include <optional>
#include <string>
#include <utility>

namespace motionrack::control {

/// A move or a slice of one, or an event.
struct QueueEntry {
    gcode::CanonCall step;
    std::string text;
    Point start = {};
    double seconds = 0;       ///< duration of a submitted move
    std::int64_t number = 0;  ///< number of a move in its plan, if the plan counts them
    bool last = true;         ///< last slice of its move
    bool by_hand = false;     ///< the move does not come from a line
    /// The offsets until here, if a line behind the entry changes them.
    std::shared_ptr<const gcode::WorkFrame> earlier_offsets = nullptr;
    bool is_probe() const { return step.probe != gcode::Probe::none; }
    bool is_overridable() const { return !by_hand && step.overridable; }
    bool is_move() const { return step.kind == gcode::CanonCallKind::move && !is_probe(); }
    /// Sets the feed rate and the rapid override of `move`, which belongs to this entry.
    void override_feed(Move& move, double feed, double rapid) const {
        if (is_overridable()) move.feed = step.move.feed * feed;
        if (step.overridable) move.rapid_override = rapid;
    }
};

struct MoveQueueSettings {
    MachineLimits limits = {};
    Point start = {};             ///< position of the axes
    std::size_t max_entries = 0;  ///< moves, slices and events; 16 or more
    double slice_s = 0;           ///< duration of a slice of a long move at its velocity; 0: moves stay whole
};

class MoveQueue {
  public:
    using OnMove = std::function<void(const Move& move, const Point& start)>;
    using OnEvent = std::function<void(const gcode::CanonCall& event, std::int64_t after_move)>;
    explicit MoveQueue(const MoveQueueSettings& settings);

    // ---- reading
    /// Returns true if another line can be read. After a probing line only when its move has ended.
    bool has_room() const { return entries_.size() < settings_.max_entries && !unpulled_ && !probe_waits_; }
    /// Reads the calls of a new line, as far as there is room. `earlier`: the offsets before the line, if it changes
    /// them.
    void read_line(gcode::Interpreter& interpreter, const gcode::WorkFrame* earlier = nullptr);
    /// Reads further calls of the last line, as far as there is room.
    void pull(gcode::Interpreter& interpreter);
    /// Adds a move that does not come from a line.
    void add_by_hand(const Move& move);
    /// Sets the position at which the next entry starts.
    void set_position(const Point& position) { read_to_ = position; }
    /// Sets the callback for each move (dwells included) as it was read, before it is sliced.
    void on_move(OnMove call) { on_move_ = std::move(call); }

    // ---- content
    bool has_work() const { return !entries_.empty() || unpulled_; }
    bool empty() const { return entries_.empty(); }
    const QueueEntry& front() const { return entries_.front(); }
    QueueEntry& operator[](std::size_t i) { return entries_[i]; }
    const QueueEntry& operator[](std::size_t i) const { return entries_[i]; }
    /// Returns the number of moves and dwells, as read, that have not ended.
    std::size_t moves() const { return moves_; }
    /// Returns the number of calls read so far, without the first one of each line.
    std::int64_t further_steps() const { return further_steps_; }
    bool probe_waits() const { return probe_waits_; }

    // ---- planning
    /// Returns the number of entries that the plan has taken.
    std::size_t planned() const { return planned_; }
    bool all_planned() const { return planned_ == entries_.size(); }
    /// Returns true if no call of the last line is left to read.
    bool all_read() const { return !unpulled_ && !cutting_; }
    QueueEntry& next() { return entries_[planned_]; }
    void take_next() { ++planned_; }
    /// Returns the number of entries up to the last submitted move, if the plan counts them.
    std::size_t submitted() const { return submitted_; }
    /// Counts the next moves as submitted; together they take `seconds`.
    void submit(std::int32_t moves, double seconds);
    double submitted_seconds() const;

    // ---- passing
    /// Removes the first entry, which the machine has passed, and reports it if it is an event.
    void pop();
    /// Removes entries until this many moves are removed.
    void pop_moves(std::int64_t moves);
    /// Removes all submitted entries.
    void pop_submitted();
    /// Removes the planned entries up to the last move whose number is below `number`.
    void pop_before(std::int64_t number);
    /// Adds to the number of planned moves that the machine has passed.
    void pass_blocks(std::int64_t blocks) { passed_ += blocks; }
    /// Returns the number of planned moves that the machine has passed since the start.
    std::int64_t passed_blocks() const { return passed_; }
    /// Returns the line of the entry that was begun last; 0: none.
    std::int32_t line() const { return line_; }
    void set_line(std::int32_t line) { line_ = line; }
    /// Sets the callback for events, called in order when the machine passes them. `after_move`: see
    /// StreamExecutor::on_event.
    void on_event(OnEvent call) { on_event_ = std::move(call); }

    // ---- standstill
    /// Discards all entries and unread calls; the next entry starts at `position`. Returns the offsets before the first
    /// line that changes them and was not reached; null: there is none.
    std::shared_ptr<const gcode::WorkFrame> clear(const Point& position);
    /// Removes a probing move that has ended at `position`.
    void end_probe(const Point& position);
    /// Keeps the remaining path: removes the part before `position`, where the axes were stopped within the
    /// first `moves` submitted moves. `seconds`: elapsed time of the first of them, by which a dwell becomes shorter.
    void keep_rest(const Point& position, std::int64_t moves, double seconds);

  private:
    /// A move that is being sliced.
    struct Cutting {
        gcode::CanonCall step;
        Geometry path;
        int pieces = 1, done = 0;
        bool by_hand = false;
    };

    void begin_cut(const gcode::CanonCall& step, bool by_hand);
    int pieces_of(const Geometry& path, const Move& move) const;
    void add_piece();
    void add_whole(const gcode::CanonCall& step);
    std::size_t nearest_move(const Point& position, const PulsesPerUnit& pulses, std::int64_t moves) const;

    MoveQueueSettings settings_;
    PathLimits limits_;
    std::deque<QueueEntry> entries_;  ///< the first one is executing
    std::optional<Cutting> cutting_;
    Point read_to_;          ///< end of the last entry
    std::int64_t read_ = 0;  ///< number of moves and dwells read
    std::int64_t further_steps_ = 0;
    std::size_t moves_ = 0;  ///< number of moves and dwells, as read, in entries_ and cutting_
    std::size_t planned_ = 0, submitted_ = 0;
    std::int64_t passed_ = 0;
    std::int32_t line_ = 0;
    bool unpulled_ = false;     ///< some calls of the last line are not yet in entries_
    bool line_begins_ = false;  ///< no call of the last line is in entries_ yet
    bool probe_waits_ = false;  ///< entries_ has a probing move, followed only by events
    OnMove on_move_;
    OnEvent on_event_;
};

}  // namespace motionrack::control
