// Drives a part program so that orders can come while it runs: hold, resume, overrides, stop.
//
//   text ──Walk──► Stream ──► PathObserver ──► card's axes          CommandSchedule ──between runs──► Stream
//                                 │
//                                 └──► who hears of planned moves, and of their starts
#pragma once

#include <functional>
#include <motionrack/control/program_executor.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <motionrack/rack/command_schedule.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// Passes a path on to the axes. Blocks count from 0 over the whole job, not over each path between two holds.
class PathObserver final : public control::AxisGroup {
  public:
    using OnBlock = std::function<void(std::int64_t block, const control::PlannedMove& move)>;
    PathObserver(control::AxisGroup& axes, OnBlock on_planned_move)
        : axes_(axes), on_block_(std::move(on_planned_move)) {}

    Result<void> begin() override;
    const control::DriveConstraints* drive_constraints() const override { return axes_.drive_constraints(); }
    Result<void> follow(const control::PlannedMove& move) override;
    Result<void> finish() override { return axes_.finish(); }
    Result<control::ProbeResult> probe(const control::PlannedMove& move, bool release) override;
    void stop(bool immediate) override { axes_.stop(immediate); }
    control::Point commanded_position() override { return axes_.commanded_position(); }
    std::vector<control::PathWarning> take_path_warnings() override { return axes_.take_path_warnings(); }
    std::vector<control::MoveStart> take_move_starts() override;

    /// For those who hear: starts since the last call, by the job's numbers.
    std::vector<control::MoveStart> heard();

  private:
    void pull();

    control::AxisGroup& axes_;
    OnBlock on_block_;
    std::int64_t blocks_ = 0, first_ = 0;  ///< of the job; of the present path
    std::vector<control::MoveStart> starts_, heard_;
};

using OnProgrammedMove = std::function<void(const control::Move& move, const control::Point& start)>;

/// Drives a program that was checked, or a problem of it ends the job where it stands. Errors: as ProgramExecutor::run.
/// The stream's stop flag must be the axes', and `orders` be attached to it. `on_move`: hears of each move as it was
/// read.
Result<void> drive_live(control::StreamExecutor& stream, Interrupt& host, const CommandSchedule& orders,
                        std::string_view text, const control::gcode::Settings& settings, const std::string& file,
                        control::ProgramResult& run, const OnProgrammedMove& on_move);

}  // namespace motionrack::rack
