// Programs and single lines of an operated machine: the executor, its pending lines, and the operator's settings.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/control/program_feed.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <motionrack/operate/status.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::operate {

/// Used only by the motion thread.
class ProgramRun {
  public:
    /// Creates the executor. Call once, before all other functions.
    void start(control::AxisGroup& axes, Interrupt& host, const control::StreamExecutorSettings& settings);
    control::StreamExecutor& stream() { return *stream_; }
    const control::StreamExecutor& stream() const { return *stream_; }

    // ---- a whole program, for Machine
    /// Checks a whole program, then starts it. Errors: invalid_input: its first problem with line and column.
    Result<void> begin(std::string text, std::string name);
    /// Feeds lines of the program while the executor has room. Errors: a line cannot be executed.
    control::gcode::Outcome<void> feed();
    /// Returns true until the last line of the program was fed.
    bool has_lines() const { return feed_.has_value(); }
    bool runs() const { return runs_; }
    /// Ends the program, if one runs. Call when all its lines are executed.
    void end();
    /// Drops the lines that were not fed yet.
    void drop();
    /// Name of the program that was started last.
    const std::string& name() const { return name_; }

    // ---- single lines, for Machine and manual operation
    /// Returns true if a line is accepted: no program runs, and the executor has room.
    bool has_room() const { return stream_->has_room() && !runs_; }
    /// Queues a line. Requires has_room(). On an error it has no effect.
    control::gcode::Outcome<void> line(std::string_view text, std::int32_t number, Instant now);
    /// Queues a move that does not come from a line.
    void move(const control::Move& move, Instant now);
    /// Returns true if lines may follow soon: of a program, or of a sender whose last line is less than `quiet` ago.
    bool more_may_come(Instant now, Duration quiet) const;

    // ---- settings, also from clients
    void set_overrides(double feed, double rapid) {
        stream_->set_overrides(feed_override_ = feed, rapid_override_ = rapid);
    }
    double feed_override() const { return feed_override_; }
    double rapid_override() const { return rapid_override_; }
    void set_single_block(bool on) { stream_->set_single_block(single_block_ = on); }
    /// Clears work offsets, G28 and G30. Refused while something moves.
    Result<void> clear_offsets();

    /// Writes name, lines and settings into a status.
    void report(Status& status) const;

  private:
    std::unique_ptr<control::StreamExecutor> stream_;
    std::string text_, name_;
    std::optional<control::ProgramFeed> feed_;  ///< until the last line was read
    std::int32_t line_count_ = 0;
    bool runs_ = false, single_block_ = false;
    Instant last_line_{};  ///< when the last single line or move came
    double feed_override_ = 1, rapid_override_ = 1;
};

}  // namespace motionrack::operate
