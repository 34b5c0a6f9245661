// Probing through the protocol: the contact position, and the alarms without contact.
#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(GrblProbe, ReportsTheContactPositionBeforeTheAnswer) {
    Bench b(with_probe("x_min_mm = 20.123\n"));
    // 640 pulses per mm: 20.123 mm is pulse 12879.
    EXPECT_EQ(b.ask("G38.2 X50 F600\n", 4), "[PRB:20.123,0.000,0.000:1]\r\nok\r\n");
    EXPECT_THAT(b.report(), HasSubstr("|Pn:P"));
    EXPECT_THAT(b.ask("$#\n"), HasSubstr("[PRB:20.123,0.000,0.000:1]"));
    EXPECT_THAT(b.ask("G91 G0 X-5\n", 2), EndsWith("ok\r\n"));
    EXPECT_THAT(b.report(), Not(HasSubstr("Pn")));
    const double stopped_at = b.axis(0);
    EXPECT_NEAR(stopped_at, 15.3, 0.15);
    EXPECT_EQ(b.ask("G92 X0\nG38.3 X2\n", 4),
              "ok\r\n[PRB:" + std::to_string(stopped_at + 2).substr(0, 6) + ",0.000,0.000:0]\r\nok\r\n");
}

TEST(GrblProbe, LinesAfterItWaitForItsEnd) {
    Bench b(with_probe("x_min_mm = 20\n"));
    const std::string out = b.ask("G38.2 X50 F600\nG91 G1 X-10\nG90\n", 6);
    EXPECT_EQ(out, "[PRB:20.000,0.000,0.000:1]\r\nok\r\nok\r\nok\r\n");
    EXPECT_NEAR(b.axis(0), 10.2, 0.2);
}

TEST(GrblProbe, AlarmsAreFourAndFive) {
    Bench b(with_probe("x_min_mm = 20\n"));
    EXPECT_THAT(b.ask("G38.2 X10 F600\n", 4), HasSubstr("[PRB:10.000,0.000,0.000:0]\r\nALARM:5\r\n"));
    Bench c(with_probe("x_max_mm = 20\n"));
    EXPECT_THAT(c.ask("G38.2 X10 F600\n", 4), HasSubstr("ALARM:4\r\n"));
    EXPECT_EQ(c.axis(0), 0);
}

}  // namespace
}  // namespace motionrack::grbl
