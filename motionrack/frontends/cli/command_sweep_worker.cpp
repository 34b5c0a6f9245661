// sweep-worker: runs points of sweeps for a coordinator on another machine.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/nats/distributed_sweep.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <thread>

namespace motionrack::cli {

namespace {

int work(nats::WorkerSettings settings) {
    if (settings.jobs == 0)
        settings.jobs = static_cast<int>(
            std::clamp(std::thread::hardware_concurrency(), 1u, static_cast<unsigned>(sweep::max_jobs)));
    stop_on_signals();
    std::int64_t count = 0;
    const Result<void> ended = nats::work(settings, stop_asked, [&count](std::int64_t done) { count = done; });
    fmt::print("{} done\n", rack::count_noun(count, "point"));
    if (ended) return exit_done;
    if (ended.error().kind != ErrorKind::stopped) return report(ended.error());
    return report({ErrorKind::stopped, "Stopped; another worker takes over the current point."});
}

}  // namespace

void add_sweep_worker(CLI::App& app, Action& chosen) {
    auto settings = std::make_shared<nats::WorkerSettings>();
    settings->jobs = 0;
    CLI::App* command = app.add_subcommand(
        "sweep-worker",
        "Run points of sweeps that motionrack sweep --nats queued; any number of workers, on any machines");
    command
        ->add_option("--nats", settings->url,
                     "the server with JetStream: nats://HOST:4222, nats://USER:PASSWORD@HOST:4222")
        ->required();
    command->add_option("--jobs", settings->jobs, "points that run at the same time (default: one for each core)")
        ->check(CLI::Range(1, sweep::max_jobs));
    command->add_option("--idle", settings->idle_s, "end after this idle time, s (default: never)")
        ->check(CLI::Range(0.0, 1e6));
    command->footer(
        "Example: motionrack sweep-worker --nats nats://bench:4222\n"
        "A point of a killed worker is reassigned after 5 s; a worker that is stopped by Ctrl-C returns its "
        "points at once. Workers take only points that their own version\n"
        "of motionrack queued.");
    command->callback([settings, &chosen] { chosen = [settings] { return work(*settings); }; });
}

}  // namespace motionrack::cli
