#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

namespace {

void tell_speed(const char* how, const SpeedEstimate& estimate) {
    if (estimate.known)
        fmt::print("  {:<11} {:>14.6f} counts/s, off by at most {:.3g}\n", how, estimate.counts_s, estimate.error);
}

}  // namespace

motionrack::Result<void> speed() {
    const struct {
        double counts_s;
        Duration between;  // two readings
    } runs[] = {{0.1, whole_seconds(1)}, {1'000, milliseconds(1)}, {100'000, milliseconds(1)}};
    for (const auto& run : runs) {
        Bench bench;
        if (!bench.flex().ok()) return fail(ErrorKind::machine, bench.flex().why());
        bench.turn(0, run.counts_s);
        bench.run(milliseconds(500));
        SpeedMeter meter;
        Speed last;  // with a new edge; in between `edges` says how slow it is at most
        for (int i = 0; i < 100; ++i) {
            bench.run(run.between);
            const Reading at = bench.flex().read();
            if (const Speed now = meter.update(at.axes[0], at.ticks); now.edge_came) last = now;
        }
        fmt::print("{} counts/s, looked at every {} ms\n", run.counts_s, to_seconds(run.between) * 1e3);
        tell_speed("difference", last.difference);
        tell_speed("edges, 1/T", last.edges);
    }
    return {};
}

}  // namespace howto
