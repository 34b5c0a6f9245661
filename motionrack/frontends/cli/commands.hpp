// The commands of the program. Each adds itself to the command line and stores its action in `chosen`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace motionrack::cli {

/// Action that the command line selects; returns the exit code.
using Action = std::function<int()>;

void add_run(CLI::App& app, Action& chosen);
void add_trace(CLI::App& app, Action& chosen);
void add_diff(CLI::App& app, Action& chosen);
void add_replay(CLI::App& app, Action& chosen);
void add_report(CLI::App& app, Action& chosen);
void add_home(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_canon(CLI::App& app, Action& chosen);
void add_plan(CLI::App& app, Action& chosen);
void add_sweep(CLI::App& app, Action& chosen);
void add_sweep_worker(CLI::App& app, Action& chosen);
void add_decode(CLI::App& app, Action& chosen);
void add_describe(CLI::App& app, Action& chosen);
void add_registers(CLI::App& app, Action& chosen);
void add_new(CLI::App& app, Action& chosen);
void add_frames(CLI::App& app, Action& chosen);
void add_mark(CLI::App& app, Action& chosen);
void add_calibrate(CLI::App& app, Action& chosen);
void add_serve(CLI::App& app, Action& chosen);
void add_docs(CLI::App& app, Action& chosen);
void add_image(CLI::App& app, Action& chosen);
void add_bench(CLI::App& app, Action& chosen);
void add_completion(CLI::App& app, Action& chosen);
void add_manual(CLI::App& app, Action& chosen);

}  // namespace motionrack::cli
