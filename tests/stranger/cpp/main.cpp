// The program of the README, built against the installed package.
#include <cstdio>
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

    for (const rack::AxisOutcome& axis : outcome.axes) std::printf("%c %.4f\n", "XYZABC"[axis.index], axis.actual_end);
    return outcome.ended ? 0 : 1;
}
