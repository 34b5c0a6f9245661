#include <fmt/format.h>

#include <cmath>

#include "bench.hpp"

namespace howto {

motionrack::Result<void> lathe() {
    Bench bench;
    Flex2Pos& flex = bench.flex();
    if (!flex.ok()) return fail(ErrorKind::machine, flex.why());
    MOTIONRACK_TRY(const Units spindle, Units::degrees(4'000));
    MOTIONRACK_TRY(const Units scale, Units::mm(1'000));
    bench.turn(0, 40'000);  // 600 turns a minute
    bench.turn(1, 15'000);  // 15 mm/s: a thread of 1.5 mm
    bench.run(milliseconds(200));
    flex.WriteCmd(cRes, cRes, cNop, cNop);  // both are 0 at the same instant
    for (int i = 0; i < 4; ++i) {
        bench.run(milliseconds(250));
        const Reading at = flex.read();
        const double turns = spindle.of_counts(at.axes[0].position) / 360, mm = scale.of_counts(at.axes[1].position);
        // The same from two readings between which the host had something else to do for a millisecond.
        const double turns_then = spindle.of_counts(flex.ReadPosition0()) / 360;
        bench.run(milliseconds(1));
        const double mm_later = scale.of_counts(flex.ReadPosition1());
        fmt::print("{:7.4f} turns  {:8.4f} mm  off the thread by {:+.4f} mm; one after the other {:+.4f} mm\n", turns,
                   mm, mm - 1.5 * turns, mm_later - 1.5 * turns_then);
    }
    return {};
}

}  // namespace howto
