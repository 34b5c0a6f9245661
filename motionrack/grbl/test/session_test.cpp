// What a sender sees, byte by byte.
#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(AGrblPort, GreetsAndReportsIdle) {
    Bench b(three_axes());
    b.session->greet();
    EXPECT_EQ(b.ask(""), "\r\nGrbl 1.1h ['$' for help]\r\n");
    EXPECT_EQ(b.report(), "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n");
    EXPECT_EQ(b.report(), "<Idle|MPos:0.000,0.000,0.000|FS:0,0|Ov:100,100,100>\r\n");
    EXPECT_EQ(b.report(), "<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n");
}

TEST(AGrblPort, DrivesALineAndAnswersOnce) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G1 X10 F1200\n"), "ok\r\n");
    EXPECT_THAT(b.ask("?", 0.2), StartsWith("<Run|MPos:"));
    EXPECT_EQ(b.until_idle(), "");
    EXPECT_NEAR(b.axis(0), 10, 1e-3);
}

}  // namespace
}  // namespace motionrack::grbl
