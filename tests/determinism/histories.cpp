// Running what the hashes are of.
#include <fmt/format.h>

#include <motionrack/rack/job.hpp>
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

/// The program on that rack; nothing for a rack that drives none.
rack::JobOutcome run(rack::Rack& rack, const std::string& program) {
    rack::JobSettings settings;
    settings.program = program;
    rack::Job job(rack, settings);
    rack.start();
    rack::JobOutcome outcome = job.run();
    if (!outcome.ended) throw std::runtime_error(outcome.ended.error().text());
    return outcome;
}

void pass(rack::Rack& rack, Duration time) {
    const Instant end = rack.kernel().now() + time;
    while (rack.kernel().now() < end) rack.kernel().run_until(end);
}

}  // namespace

std::string example_histories(const std::filesystem::path& root) {
    std::string out;
    for (const char* name : {"01_first_move/first_move.ngc", "02_part/part.ngc", "03_helix/helix.ngc"}) {
        rack::Rack rack(config_of(rack::read_rack_text(*rack::rack_template("router"))));
        const rack::JobOutcome outcome = run(rack, text_of(root / "examples" / name));
        out += fmt::format("{} {:016x} {}\n", name, outcome.trace_hash, outcome.time.count());
    }
    return out;
}

std::string rack_histories(const std::filesystem::path& root) {
    struct Run {
        const char* rack;
        const char* program;  ///< empty: it runs by itself
    };
    std::string out;
    for (const Run& one : {Run{"racks/router.toml", "02_part/part.ngc"}, Run{"racks/single.toml", "01_first_move/first_move.ngc"}, Run{"racks/stage.toml", ""},
                           Run{"racks/carriage.toml", ""}, Run{"racks/marking.toml", ""}, Run{"04_s_curve/s_curve.toml", "04_s_curve/move.ngc"},
                           Run{"11_carriage/machine.toml", "11_carriage/carriage.ngc"}, Run{"13_stage/machine.toml", ""}, Run{"15_panel/demonstration.toml", ""},
                           Run{"16_probe/machine.toml", "16_probe/probe.ngc"}, Run{"grating_bus/crate.toml", ""}, Run{"grating_bus/three_hosts.toml", ""}}) {
        rack::Rack rack(config_of(rack::read_rack_file((root / "examples" / one.rack).string())));
        if (one.program[0] != '\0')
            run(rack, text_of(root / "examples" / one.program));
        else
            rack.start();
        pass(rack, milliseconds(500));
        out += fmt::format("{} {:016x} {:016x}\n", one.rack, rack.kernel().state_hash(), rack.kernel().trace_hash());
    }
    return out;
}

}  // namespace motionrack
