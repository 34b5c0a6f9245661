// Runs a part program on a rack from C++ and prints where the machine stands.
#include <fmt/format.h>

#include <motionrack/rack/job.hpp>
#include <motionrack/rack/template.hpp>

using namespace motionrack;

int main() {
    rack::Rack rack(*rack::read_rack_text(*rack::rack_template("router")).config);
    rack::JobSettings settings;
    settings.program = "G21 G90\nG1 X10 Y5 F600\nG3 X20 Y15 I0 J10\nM2\n";
    rack::Job job(rack, settings);
    rack.start();
    const rack::JobOutcome outcome = job.run();

    fmt::print("{:.3f} s\n", to_seconds(outcome.time));
    for (const rack::AxisOutcome& axis : outcome.axes)
        fmt::print("{} {:.4f} {}, {} pulses\n", "XYZABC"[axis.index], axis.actual_end, axis.unit, axis.pulses_sent);
    return outcome.ended ? 0 : 1;
}
