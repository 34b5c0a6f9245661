// Feeds lines while the stream executor has room, and runs it.
#include <fmt/format.h>

#include <motionrack/control/geometry.hpp>
#include <motionrack/control/program_feed.hpp>
#include <motionrack/rack/interactive_run.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr Duration poll_period = milliseconds(1);  // time step of an idle host

}  // namespace

Result<void> PathObserver::begin() {
    pull();
    first_ = blocks_;
    return note(axes_.begin());
}

Result<void> PathObserver::follow(const control::PlannedMove& move) {
    on_block_(blocks_++, move);
    return note(axes_.follow(move));
}

Result<control::ProbeResult> PathObserver::probe(const control::PlannedMove& move, bool release) {
    on_block_(blocks_++, move);
    Result<control::ProbeResult> outcome = axes_.probe(move, release);
    MOTIONRACK_CHECK(note(outcome ? Result<void>() : Result<void>(tl::unexpected<Error>(outcome.error()))));
    return outcome;
}

Result<void> PathObserver::note(Result<void> outcome) {
    stopped_.reset();
    if (!outcome && outcome.error().kind == ErrorKind::stopped) stopped_ = outcome.error();
    return outcome;
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

/// Returns the axes' own report of a stop, or that they stopped on the path.
tl::unexpected<Error> stopped_in(const control::StreamExecutor& stream, const PathObserver& path,
                                 const control::MachineLimits& limits, const std::string& file) {
    Error error =
        path.stopped()
            ? *path.stopped()
            : control::stopped_on_request(stream.current_line(), stream.interpreter().position(), limits).value();
    error.file = file;
    return tl::unexpected<Error>(std::move(error));
}

/// Runs a program with commands, and notes its probing moves.
class LiveRun {
  public:
    LiveRun(control::StreamExecutor& stream, const PathObserver& path, Interrupt& host, const CommandSchedule& commands,
            control::ProgramResult& run)
        : stream_(stream), path_(path), host_(host), commands_(commands), run_(run) {}

    Result<void> drive(control::ProgramFeed& feed, const control::gcode::Settings& settings, const std::string& file) {
        using control::ExecutionState;
        Result<void> program;  // its first error
        while (true) {
            if (!commands_.stopped() && feed.more())
                if (auto fed = feed.feed(); !fed) program = tl::unexpected<Error>(fed.error());
            const Result<ExecutionState> driven = stream_.drive(feed.more());
            note_probe();
            if (!driven) return tl::unexpected<Error>(driven.error());
            switch (*driven) {
                case ExecutionState::waiting:
                    host_.pass(poll_period);
                    break;
                case ExecutionState::feed_hold:
                    MOTIONRACK_CHECK(held(file));
                    break;
                case ExecutionState::paused:
                    stream_.resume();
                    break;  // M0: no operator exists in simulated time
                case ExecutionState::running:
                    break;
                case ExecutionState::idle:
                    if (commands_.stopped()) return stopped_in(stream_, path_, settings.limits, file);
                    if (!feed.more()) return program;
                    break;
            }
        }
    }

  private:
    void note_probe() {
        const control::ProbeReport& probe = stream_.last_probe();
        if (!probe.begun || probe.count == probes_) return;
        probes_ = probe.count;
        run_.add(control::ProgramProbe{probe.line, probe.probe, probe.outcome}, path_.blocks() - 1);
    }

    /// Continues, or waits for a command.
    Result<void> held(const std::string& file) {
        if (!commands_.holds())
            stream_.resume();
        else if (!commands_.pending())
            return fail(ErrorKind::stopped,
                        fmt::format("The job was held in line {}, and not resumed.", stream_.current_line()),
                        {stream_.current_line(), 0}, file);
        else
            host_.pass(poll_period);
        return {};
    }

    control::StreamExecutor& stream_;
    const PathObserver& path_;
    Interrupt& host_;
    const CommandSchedule& commands_;
    control::ProgramResult& run_;
    std::int64_t probes_ = stream_.last_probe().count;
};

/// Adds a programmed move to the counts of the run. Planned moves are not counted: a long move is planned in slices,
/// and its remainder again after a feed hold.
void count_programmed(const control::Move& move, const control::Point& start, control::ProgramResult& run) {
    const control::Geometry path = control::geometry_of(move, start);
    if (move.kind == control::MoveKind::dwell) {
        ++run.plan.dwells;
        return;
    }
    ++run.moves;
    run.plan.moves += path.shape != control::PathShape::nothing;
    const bool linear = start[0] != move.end[0] || start[1] != move.end[1] || start[2] != move.end[2] ||
                        move.kind == control::MoveKind::arc;
    if (linear) run.plan.path_mm += path.length;
}

}  // namespace

Result<void> drive_live(control::StreamExecutor& stream, const PathObserver& path, Interrupt& host,
                        const CommandSchedule& commands, std::string_view text,
                        const control::gcode::Settings& settings, const std::string& file, control::ProgramResult& run,
                        const OnProgrammedMove& on_move) {
    control::ProgramResult programmed;
    stream.on_move([&](const control::Move& move, const control::Point& start) {
        on_move(move, start);
        count_programmed(move, start, programmed);
    });
    stream.on_event([&](const control::gcode::CanonCall& event, std::int64_t after_move) {
        run.add(control::ProgramEvent{event.line, after_move, control::event_text(event)});
    });
    control::ProgramFeed feed(stream, text, settings, file);
    const Result<void> ended = LiveRun(stream, path, host, commands, run).drive(feed, settings, file);
    stream.on_move({});
    stream.on_event({});
    run.moves = programmed.moves;
    run.lines = feed.lines();
    run.ended = feed.ended();
    run.plan.moves = programmed.plan.moves;
    run.plan.dwells = programmed.plan.dwells;
    run.plan.path_mm = programmed.plan.path_mm;
    return ended;
}

}  // namespace motionrack::rack
