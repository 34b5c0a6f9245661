// Runs a part program interactively, with commands during the run: feed hold, resume, overrides, stop.
//
//   text ──ProgramFeed──► StreamExecutor ──► PathObserver ──► card's axes
//                              ▲                  │
//   CommandSchedule ───────────┘                  └──► listener for planned moves and their starts
#pragma once

#include <functional>
#include <motionrack/control/program_result.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <motionrack/rack/command_schedule.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// Forwards a path to the axes. Numbers moves from 0 over the whole job, not per path between two feed holds.
class PathObserver final : public control::AxisGroup {
  public:
    using OnBlock = std::function<void(std::int64_t block, const control::PlannedMove& move)>;
    PathObserver(control::AxisGroup& axes, OnBlock on_planned_move)
        : axes_(axes), on_block_(std::move(on_planned_move)) {}

    Result<void> begin() override;
    const control::DriveConstraints* drive_constraints() const override { return axes_.drive_constraints(); }
    Result<void> follow(const control::PlannedMove& move) override;
    Result<void> finish() override { return note(axes_.finish()); }
    Result<control::ProbeResult> probe(const control::PlannedMove& move, bool release) override;
    void stop(bool immediate) override { axes_.stop(immediate); }
    control::Point commanded_position() override { return axes_.commanded_position(); }
    std::vector<control::PathWarning> take_path_warnings() override { return axes_.take_path_warnings(); }
    std::vector<control::MoveStart> take_move_starts() override;

    /// Returns the starts since the last call, for a listener, with the job's move numbers.
    std::vector<control::MoveStart> observed();
    /// Returns the number of planned moves so far.
    std::int64_t blocks() const { return blocks_; }
    /// Returns the axes' error if a stop request ended the last call; else nothing.
    const std::optional<Error>& stopped() const { return stopped_; }

  private:
    void pull();
    Result<void> note(Result<void> outcome);

    control::AxisGroup& axes_;
    OnBlock on_block_;
    std::int64_t blocks_ = 0, first_ = 0;  ///< moves in the job; first move of the present path
    std::vector<control::MoveStart> starts_, heard_;
    std::optional<Error> stopped_;
};

using OnProgrammedMove = std::function<void(const control::Move& move, const control::Point& start)>;

/// Executes a checked program. A program error ends the job at the present position. Errors: as ProgramExecutor::run.
/// The stream drives `path`, its stop flag must also be the axes' flag, and `commands` must be attached to it.
/// `on_move` is called with each move (dwells included) as it was read.
Result<void> drive_live(control::StreamExecutor& stream, const PathObserver& path, Interrupt& host,
                        const CommandSchedule& commands, std::string_view text,
                        const control::gcode::Settings& settings, const std::string& file, control::ProgramResult& run,
                        const OnProgrammedMove& on_move);

}  // namespace motionrack::rack
