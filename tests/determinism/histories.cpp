// Runs programs and racks and returns the hashes of their event traces.
#include <fmt/format.h>

#include <motionrack/rack/job.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/template.hpp>
#include <stdexcept>
#include <tests/determinism/histories.hpp>
#include <tests/text_of.hpp>

namespace motionrack {

namespace {

rack::RackConfig config_of(const rack::RackReading& reading) {
    if (!reading.config) throw std::runtime_error(reading.errors.front().text());
    return *reading.config;
}

struct History {
    std::uint64_t state_hash = 0, trace_hash = 0;
    Duration time{};
};

/// Runs a program on a rack to its end.
History run(const rack::RackConfig& config, const std::string& program) {
    rack::Rack rack(config);
    rack::JobSettings settings;
    settings.program = program;
    rack::Job job(rack, settings);
    rack.start();
    const rack::JobOutcome outcome = job.run();
    if (!outcome.ended) throw std::runtime_error(outcome.ended.error().text());
    return {rack.kernel().state_hash(), outcome.trace_hash, outcome.time};
}

/// Runs a rack without a program for half a second.
History run(const std::filesystem::path& file) {
    auto session = rack::Session::open(file.string());
    if (!session) throw std::runtime_error(session.error().text());
    if (const Result<void> done = (*session)->advance(500'000'000); !done)
        throw std::runtime_error(done.error().text());
    const sim::Kernel& kernel = (*session)->rack().kernel();
    return {(*session)->state_hash(), kernel.trace_hash(), kernel.now()};
}

}  // namespace

std::string example_histories(const std::filesystem::path& root) {
    std::string out;
    const rack::RackConfig router = config_of(rack::read_rack_text(*rack::rack_template("router")));
    for (const char* name : {"01_first_move/first_move.ngc", "02_part/part.ngc", "03_helix/helix.ngc"}) {
        const History history = run(router, text_of(root / "examples" / name));
        out += fmt::format("{} {:016x} {}\n", name, history.trace_hash, history.time.count());
    }
    return out;
}

std::string rack_histories(const std::filesystem::path& root) {
    struct Run {
        const char* rack;
        const char* program;  ///< empty: the rack runs without a program
    };
    std::string out;
    for (const Run& one :
         {Run{"racks/router.toml", "02_part/part.ngc"}, Run{"racks/single.toml", "01_first_move/first_move.ngc"},
          Run{"racks/stage.toml", ""}, Run{"racks/carriage.toml", ""}, Run{"racks/marking.toml", ""},
          Run{"04_s_curve/s_curve.toml", "04_s_curve/move.ngc"},
          Run{"11_carriage/machine.toml", "11_carriage/carriage.ngc"}, Run{"13_stage/machine.toml", ""},
          Run{"15_panel/demonstration.toml", ""}, Run{"16_probe/machine.toml", "16_probe/probe.ngc"},
          Run{"grating_bus/crate.toml", ""}, Run{"grating_bus/three_hosts.toml", ""}}) {
        const std::filesystem::path file = root / "examples" / one.rack;
        const History history = one.program[0] == '\0' ? run(file)
                                                       : run(config_of(rack::read_rack_file(file.string())),
                                                             text_of(root / "examples" / one.program));
        out += fmt::format("{} {:016x} {:016x} {}\n", one.rack, history.state_hash, history.trace_hash,
                           history.time.count());
    }
    return out;
}

}  // namespace motionrack
