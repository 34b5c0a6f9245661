#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

motionrack::Result<void> broken_line() {
    const struct {
        const char* name;
        double value;
    } faults[] = {{"broken_a", 1}, {"broken_b", 1}, {"dirt", 12}, {"missing_index", 1}, {"noise", 20'000}};
    for (const auto& fault : faults) {
        Bench bench;
        if (!bench.flex().ok()) return fail(ErrorKind::machine, bench.flex().why());
        bench.turn(0, 8'000);  // two turns a second
        EncoderCheck check({.counts_per_index = 4'000});
        fmt::print("{}:\n", fault.name);
        int told = 0;
        for (int ms = 0; ms < 4'000 && told == 0; ms += 20) {
            bench.run(milliseconds(20));
            if (ms == 1'400) bench.fault(0, fault.name, fault.value);
            const AxisDetail now = bench.flex().read_details()[0];
            for (const Finding& finding : check.update(now)) {
                fmt::print("  {}\n", describe(finding, now, "spindle"));
                ++told;
            }
        }
        if (told == 0) fmt::print("  nothing was found\n");
    }
    return {};
}

}  // namespace howto
