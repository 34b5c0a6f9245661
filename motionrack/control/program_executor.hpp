// Runs a part program: the reader's moves go through look-ahead to the axes, in constant memory, whatever the program's
// length.
//
//   text --ProgramReader--> Move --LookAheadPlanner--> PlannedMove --AxisGroup--> card
//
// Callers check the whole text before anything moves (check_program), unless they stream; run then reads it a second
// time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control {

/// Something the program asked for beside motion, in order, with the planned move that was last handed out before it.
struct ProgramEvent {
    int line = 0;
    std::int64_t after_block = -1;
    std::string text;  ///< "spindle clockwise at 12000 rpm", "message: clamp the part"
};

/// A probing move of the program.
struct ProgramProbe {
    int line = 0;
    gcode::Probe probe = gcode::Probe::none;
    ProbeResult outcome;
};

struct ExecutorSettings {
    gcode::Settings gcode;  ///< limits, start position, offsets
    LookAheadSettings planner;
    bool jerk_limited = false;  ///< not trapezoids, but within each axis' jerk
    const std::atomic<bool>* stop =
        nullptr;  ///< somebody wishes to stop: with limited jerk the ride slows down, else the axes on their own
    const std::atomic<bool>* halted = nullptr;  ///< the machine must stop: the same
    double accel_reserve = 0;        ///< part of each axis' acceleration that the planner leaves to the card, 0 .. 0.5
    std::size_t event_limit = 2000;  ///< events kept; later ones are counted only
};

/// What came of a program.
struct ProgramResult {
    PlanSummary plan;
    std::int64_t lines = 0;  ///< lines read
    std::int64_t moves = 0;  ///< read, without dwells
    std::vector<ProgramEvent> events;
    std::int64_t events_left_out = 0;
    std::vector<ProgramProbe> probes;  ///< as many as events are kept
    bool ended = false;                ///< by M2 or M30
};

class ProgramExecutor {
  public:
    ProgramExecutor(AxisGroup& axes, const ExecutorSettings& settings);

    /// Called with each planned move just before the axes get it (block numbers from 0).
    void on_planned_move(std::function<void(std::int64_t block, const PlannedMove& move)> call) {
        on_block_ = std::move(call);
    }
    /// Called with each move as the program has it (dwells, too), and where it starts, long before it is driven.
    void on_move(std::function<void(const Move& move, const Point& start)> call) { on_move_ = std::move(call); }

    /// Drives a program that check_program found nothing wrong with. Errors: invalid_input (with place) if the reader
    /// finds a problem all the same: the axes then finish what was read before and stand; machine and stopped as
    /// AxisGroup says. `run` is filled as far as it went.
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
    void tell(const PlannedMove& planned);
    Result<void> probe(const gcode::CanonCall& step, gcode::ProgramReader& reader, ProgramResult& run);
    void plan_from(const Point& start);
    void note(ProgramEvent event, ProgramResult& run);
    void remember(const gcode::CanonCall& step, ProgramResult& run);

    AxisGroup& axes_;
    ExecutorSettings settings_;
    std::unique_ptr<TrajectoryPlanner> planner_;
    PlanSummary summary_;
    std::int64_t blocks_ = 0;
    std::int64_t read_ = 0;  ///< moves and dwells
    Point read_to_ = {};     ///< where the last of them ends
    int line_ = 0;           ///< of the move that was handed over last
    bool held_ = false;
    std::function<void(std::int64_t, const PlannedMove&)> on_block_;
    std::function<void(const Move&, const Point&)> on_move_;
};

}  // namespace motionrack::control
