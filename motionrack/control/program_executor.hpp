// Runs a whole part program: the moves of the reader go through the look-ahead to the axes. Memory is constant for any
// program length.
//
//   text --ProgramReader--> Move --LookAheadPlanner--> PlannedMove --AxisGroup--> card
//
// Callers check the whole text before any motion (check_program), unless they stream; run then reads it a second time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/program_result.hpp>
#include <string>
#include <string_view>

namespace motionrack::control {

struct ExecutorSettings {
    gcode::Settings gcode;  ///< limits, start position, offsets
    LookAheadSettings planner;
    bool jerk_limited = false;  ///< limits jerk instead of using trapezoidal profiles
    const std::atomic<bool>* stop =
        nullptr;  ///< stop requested: a jerk-limited trajectory decelerates on the path, otherwise each axis on its own
    const std::atomic<bool>* halted = nullptr;  ///< the machine requests a stop, with the same effect
    double accel_reserve = 0;  ///< share of each axis' acceleration that the planner leaves to the card, 0 .. 0.5
};

class ProgramExecutor {
  public:
    ProgramExecutor(AxisGroup& axes, const ExecutorSettings& settings);

    /// Sets the callback for each planned move, called just before it is submitted (block numbers from 0).
    void on_planned_move(std::function<void(std::int64_t block, const PlannedMove& move)> call) {
        on_block_ = std::move(call);
    }
    /// Sets the callback for each programmed move (dwells included) and its start, called when it is read.
    void on_move(std::function<void(const Move& move, const Point& start)> call) { on_move_ = std::move(call); }

    /// Executes a program that check_program accepted. Errors: invalid_input (with line and column) if the reader still
    /// finds a problem; the axes have executed the moves before it. Errors machine and stopped: as for AxisGroup. `run`
    /// holds the results up to that point.
    Result<void> run(std::string_view text, const std::string& file, ProgramResult& run);

  private:
    bool is_stop_requested() const {
        return (settings_.stop && settings_.stop->load(std::memory_order_relaxed)) ||
               (settings_.halted && settings_.halted->load(std::memory_order_relaxed));
    }
    Result<void> submit();
    Result<void> stopped();
    Result<void> take(const gcode::CanonCall& step, ProgramResult& run);
    Move programmed(const Move& read);
    void report_move(const PlannedMove& planned);
    Result<void> probe(const gcode::CanonCall& step, gcode::ProgramReader& reader, ProgramResult& run);
    void plan_from(const Point& start);
    void remember(const gcode::CanonCall& step, ProgramResult& run);

    AxisGroup& axes_;
    ExecutorSettings settings_;
    std::unique_ptr<TrajectoryPlanner> planner_;
    PlanSummary summary_;
    std::int64_t blocks_ = 0;
    std::int64_t read_ = 0;  ///< number of moves and dwells read
    Point read_to_ = {};     ///< end of the last move read
    int line_ = 0;           ///< line of the move that was submitted last
    bool held_ = false;
    std::function<void(std::int64_t, const PlannedMove&)> on_block_;
    std::function<void(const Move&, const Point&)> on_move_;
};

}  // namespace motionrack::control
