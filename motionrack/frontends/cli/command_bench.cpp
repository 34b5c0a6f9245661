// bench: measures how fast this computer runs a rack; the full benchmarks are in bench/.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/job.hpp>
#include <nlohmann/json.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

struct BenchOptions {
    std::string program, rack;
    int runs = 5;
    bool json = false;
};

double seconds_since(std::chrono::steady_clock::time_point from) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

int bench(const BenchOptions& options) {
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    const Result<ProgramText> program = load_program(options.program);
    if (!program) return report(program.error());
    const auto& [text, name] = *program;
    const control::gcode::Settings settings = program_settings(*config, name);
    std::vector<double> reading, running;
    double simulated = 0;
    std::uint64_t events = 0;
    std::int64_t lines = 0;
    for (int i = 0; i < options.runs; ++i) {
        auto begin = std::chrono::steady_clock::now();
        const control::gcode::ProgramCheck check =
            control::gcode::check_program(text, settings, max_problems_of_run, name);
        reading.push_back(seconds_since(begin));
        if (const int bad = print_problems(check, name); bad != exit_done) return bad;
        lines = check.lines;
        rack::Rack rack(*config);
        rack::JobSettings job_settings;
        job_settings.program = text;
        job_settings.program_name = name;
        job_settings.reading = settings;
        rack::Job job(rack, job_settings);
        rack.start();
        begin = std::chrono::steady_clock::now();
        const rack::JobOutcome outcome = job.run();
        running.push_back(seconds_since(begin));
        if (!outcome.ended) return report(outcome.ended.error());
        simulated = to_seconds(outcome.time);
        events = outcome.events;
    }
    std::sort(reading.begin(), reading.end());
    std::sort(running.begin(), running.end());
    const double read = reading[reading.size() / 2], ran = running[running.size() / 2];
    if (options.json) {
        nlohmann::ordered_json json = {{"program", name},
                                       {"runs", options.runs},
                                       {"lines_read_per_second", static_cast<double>(lines) / read},
                                       {"simulated_seconds", simulated},
                                       {"wall_seconds", ran},
                                       {"simulated_per_wall", simulated / ran},
                                       {"kernel_events_per_second", static_cast<double>(events) / ran}};
        fmt::print("{}\n", json.dump(2));
        return exit_done;
    }
    fmt::print("{}, median of {} runs\n", name, options.runs);
    fmt::print("  reading and checking   {:>12.0f} lines/s ({} lines)\n", static_cast<double>(lines) / read, lines);
    fmt::print("  read, plan and run     {:>12.0f} simulated seconds a second ({:.3f} s in {:.4f} s)\n",
               simulated / ran, simulated, ran);
    fmt::print("  kernel                 {:>12.0f} events/s\n", static_cast<double>(events) / ran);
    return exit_done;
}

}  // namespace

void add_bench(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command = app.add_subcommand("bench", "Measure how fast this machine reads and runs a program");
    command->add_option("PROGRAM", options->program, "part program (default: the built-in example)");
    command->add_option("--rack", options->rack, "rack file (default: the built-in router)");
    command->add_option("--runs", options->runs, "how often")->check(CLI::Range(1, 1000))->capture_default_str();
    command->add_flag("--json", options->json, "print the numbers as JSON");
    command->footer("Example: motionrack bench --runs 20");
    command->callback([options, &chosen] { chosen = [options] { return bench(*options); }; });
}

}  // namespace motionrack::cli
