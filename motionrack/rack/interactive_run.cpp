// Feeds lines while the stream executor has room, and runs it.
#include <fmt/format.h>

#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/geometry.hpp>
#include <motionrack/rack/interactive_run.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr std::size_t max_probes = 2000;           // reported probes
constexpr Duration poll_period = milliseconds(1);  // time step of an idle host

}  // namespace

Result<void> PathObserver::begin() {
    pull();
    first_ = blocks_;
    return axes_.begin();
}

Result<void> PathObserver::follow(const control::PlannedMove& move) {
    on_block_(blocks_++, move);
    return axes_.follow(move);
}

Result<control::ProbeResult> PathObserver::probe(const control::PlannedMove& move, bool release) {
    on_block_(blocks_++, move);
    return axes_.probe(move, release);
}

void PathObserver::pull() {
    for (control::MoveStart start : axes_.take_move_starts()) {
        starts_.push_back(start);
        if (start.block >= 0) start.block += first_;
        heard_.push_back(start);
    }
}

std::vector<control::MoveStart> PathObserver::take_move_starts() {
    pull();
    return std::exchange(starts_, {});
}

std::vector<control::MoveStart> PathObserver::observed() {
    pull();
    return std::exchange(heard_, {});
}

namespace {

/// Feeds the lines of a program to the stream executor as it accepts them.
class Feeder {
  public:
    Feeder(std::string_view text, const control::gcode::Settings& settings, const std::string& file,
           control::ProgramResult& run)
        : program_flow_(text, settings, file), run_(run) {}

    void feed(control::StreamExecutor& stream) {
        std::string_view text;
        while (more_ && stream.has_room()) {
            if (!program_flow_.next(text)) {
                more_ = false;
                if (auto over = stream.program_over(); !over) {
                    problem_ = over.error();
                    problem_->file = program_flow_.file();
                }
                break;
            }
            if (auto read = stream.line(text, program_flow_.number(), program_flow_); !read) {
                problem_ = read.error();
                more_ = false;
                return;
            }
            run_.lines = program_flow_.highest_line();
            const control::gcode::Block& block = stream.interpreter().block();
            if (block.has_m(control::gcode::m_stop))
                run_.ended =
                    run_.ended || block.m[control::gcode::m_stop] == 2 || block.m[control::gcode::m_stop] == 30;
        }
        if (!more_ && !problem_ && program_flow_.has_faults()) problem_ = program_flow_.take_fault();
    }
    bool more() const { return more_; }
    Result<void> outcome() const { return problem_ ? Result<void>(tl::unexpected<Error>(*problem_)) : Result<void>(); }

  private:
    control::gcode::ProgramFlow program_flow_;
    control::ProgramResult& run_;
    bool more_ = true;
    std::optional<Error> problem_;
};

Result<void> drive(control::StreamExecutor& stream, Interrupt& host, const CommandSchedule& commands, Feeder& feeder,
                   const std::string& file, control::ProgramResult& run) {
    using control::ExecutionState;
    std::int64_t probes = stream.last_probe().count;
    while (true) {
        if (!commands.stopped()) feeder.feed(stream);
        const Result<ExecutionState> driven = stream.drive(feeder.more());
        if (const control::ProbeReport& probe = stream.last_probe(); probe.begun && probe.count != probes) {
            probes = probe.count;
            if (run.probes.size() < max_probes) run.probes.push_back({probe.line, probe.probe, probe.outcome});
        }
        if (!driven) return tl::unexpected<Error>(driven.error());
        switch (*driven) {
            case ExecutionState::waiting:
                host.pass(poll_period);
                break;
            case ExecutionState::feed_hold:
                if (!commands.holds())
                    stream.resume();
                else if (!commands.pending())
                    return fail(ErrorKind::stopped,
                                fmt::format("The job was held in line {}, and not resumed.", stream.current_line()),
                                {stream.current_line(), 0}, file);
                else
                    host.pass(poll_period);
                break;
            case ExecutionState::paused:
                stream.resume();
                break;  // M0: no operator exists in simulated time
            case ExecutionState::running:
                break;
            case ExecutionState::idle:
                if (commands.stopped())
                    return fail(ErrorKind::stopped,
                                fmt::format("Stopped on request in line {}; the axes stopped along the path.",
                                            stream.current_line()),
                                {stream.current_line(), 0}, file);
                if (!feeder.more()) return feeder.outcome();
                break;
        }
    }
}

}  // namespace

Result<void> drive_live(control::StreamExecutor& stream, Interrupt& host, const CommandSchedule& commands,
                        std::string_view text, const control::gcode::Settings& settings, const std::string& file,
                        control::ProgramResult& run, const OnProgrammedMove& on_move) {
    // The remainder of a move is planned again after a feed hold; the programmed move counts.
    double path_mm = 0;
    stream.on_move([&](const control::Move& move, const control::Point& start) {
        on_move(move, start);
        ++run.moves;
        const bool linear = start[0] != move.end[0] || start[1] != move.end[1] || start[2] != move.end[2] ||
                            move.kind == control::MoveKind::arc;
        if (linear) path_mm += control::geometry_of(move, start).length;
    });
    Feeder feeder(text, settings, file, run);
    const Result<void> ended = drive(stream, host, commands, feeder, file, run);
    stream.on_move({});
    run.plan.moves = run.moves;
    run.plan.path_mm = path_mm;
    return ended;
}

}  // namespace motionrack::rack
