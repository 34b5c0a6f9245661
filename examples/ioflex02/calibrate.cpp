#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

namespace {

void tell_positions(Flex2Pos& flex, const char* when) {
    const Reading at = flex.read();
    const auto statuses = flex.statuses();
    std::string line = fmt::format("{:<26}", when);
    for (std::size_t i = 0; i < 4; ++i)
        line += fmt::format("{:>7} {:<8}", at.axes[i].position, statuses[i] == sCal ? "sCal" : "sNotCal");
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
}

}  // namespace

motionrack::Result<void> calibrate() {
    Bench bench;
    Flex2Pos& flex = bench.flex();
    if (!flex.ok()) return fail(ErrorKind::machine, flex.why());
    for (int axis = 0; axis < 4; ++axis) bench.turn(axis, 1'000);  // an index every four seconds
    bench.run(whole_seconds(1));
    tell_positions(flex, "turning");
    flex.WriteCmd(cNop, cRes, cResNm, cResNmSig);
    tell_positions(flex, "the four commands");
    MOTIONRACK_CHECK(flex.wait_calibrated(2, whole_seconds(10)));
    tell_positions(flex, "the first index");
    bench.run(milliseconds(500));
    bench.cal(3, true);
    MOTIONRACK_CHECK(flex.wait_calibrated(3, whole_seconds(10)));
    tell_positions(flex, "the index after Cal4");
    return {};
}

}  // namespace howto
