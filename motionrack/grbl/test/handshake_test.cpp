// Handshakes and jobs of real senders, replayed from their documentation.
#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string idle = "<Idle|MPos:0.000,0.000,0.000|FS:0,0";

/// Universal Gcode Sender 2: status (ten tries), an empty line if locked, build, settings, modes; then a status every
/// 200 ms.
TEST(UniversalGcodeSender, FindsAGrbl) {
    Bench b(three_axes());
    b.session->greet();
    b.ask("");
    EXPECT_THAT(b.ask("?", 0.2), StartsWith(idle));
    EXPECT_THAT(b.ask("$I\n", 0.05), AllOf(StartsWith("[VER:1.1h"), EndsWith("ok\r\n")));
    EXPECT_THAT(b.ask("$$\n", 0.05), AllOf(StartsWith("$0=10\r\n"), HasSubstr("$132=300.000\r\nok\r\n")));
    EXPECT_THAT(b.ask("$G\n", 0.05), AllOf(StartsWith("[GC:G0 "), EndsWith("ok\r\n")));
    for (int i = 0; i < 5; ++i) EXPECT_THAT(b.ask("?", 0.2), StartsWith(idle));
    EXPECT_EQ(b.ask("$J=G21G91X1Y1F1000\n", 0.5), "ok\r\n");
    EXPECT_EQ(b.ask("G10 P0 L20 X0 Y0\n"), "ok\r\n");
    EXPECT_THAT(b.report(), HasSubstr("|WCO:1.000,1.000,0.000"));
}

TEST(UniversalGcodeSender, ConnectsToALockedMachineAndHomesIt) {
    Bench b(router());
    EXPECT_THAT(b.ask("?", 0.2), StartsWith("<Alarm|"));
    EXPECT_EQ(b.ask("\n", 0.05), "ok\r\n");
    EXPECT_THAT(b.ask("$I\n", 0.05), EndsWith("ok\r\n"));
    EXPECT_THAT(b.ask("$$\n", 0.05), HasSubstr("$22=1\r\n"));
    EXPECT_EQ(b.ask("$H\n", 0.05), "");
    std::string out;
    for (int i = 0; i < 600 && out.find("ok") == std::string::npos; ++i) out = b.ask("?", 0.2);
    EXPECT_EQ(answers(out), 1);
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

/// gSender: a reset, then status until an answer comes; build, settings, modes and offsets; override bytes while it
/// streams with 127 bytes pending.
TEST(GSender, StreamsByCountingCharacters) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("\x18", 0.1), "\r\nGrbl 1.1h ['$' for help]\r\n");
    for (const char* question : {"$I\n", "$$\n", "$G\n", "$#\n"})
        EXPECT_THAT(b.ask(question), EndsWith("ok\r\n")) << question;
    std::deque<std::size_t> under_way;
    std::size_t bytes = 0;
    int answered = 0;
    const auto receive = [&](const std::string& out) {
        EXPECT_EQ(out.find("error"), std::string::npos) << out;
        for (int n = answers(out); n > 0 && !under_way.empty(); --n, ++answered) {
            bytes -= under_way.front();
            under_way.pop_front();
        }
    };
    for (int i = 0; i < 200; ++i) {
        const std::string line = "G1X" + std::to_string(i % 2 * 10) + "Y" + std::to_string(i) + ".125F6000\n";
        while (bytes + line.size() > 127) receive(b.ask(i == 100 ? "\x91?" : "?", 0.02));
        under_way.push_back(line.size());
        bytes += line.size();
        receive(b.ask(line, 0.002));
    }
    while (!under_way.empty()) receive(b.ask("", 0.1));
    EXPECT_EQ(answered, 200);
    b.until_idle();
    EXPECT_NEAR(b.axis(1), 199.125, 1e-3);
}

/// LightBurn: maximum power and laser mode from the settings, M4 once, S on every G1, M5 and a park at the end.
TEST(LightBurn, EngravesInLaserMode) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("$30=1000\n$32=1\n"), "ok\r\nok\r\n");
    EXPECT_THAT(b.ask("$$\n"), AllOf(HasSubstr("$30=1000\r\n"), HasSubstr("$32=1\r\n")));
    EXPECT_EQ(answers(b.ask("G00 G17 G40 G21 G54\nG90\nM4\nM8\nG0 X5 Y5\n")), 5);
    EXPECT_EQ(answers(b.ask("G1 X20 S500 F1200\nG1 X30 S0\nG1 X40 S750\n", 0.1)), 3);
    b.ask("", 0.6);
    EXPECT_THAT(b.report(), HasSubstr(",500|"));
    b.until_idle();
    EXPECT_THAT(b.report(), HasSubstr("|FS:0,750"));
    EXPECT_EQ(b.ask("M9\nG1 S0\nM5\nG90\nG0 X0 Y0\nM2\n", 5), "ok\r\nok\r\nok\r\nok\r\nok\r\n[MSG:Pgm End]\r\nok\r\n");
}

/// bCNC at the end of a job, and when it opens a port: its bytes must not raise an alarm.
TEST(BCnc, HoldsResetsAndQueriesOffsetsAfterItsJob) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("\n\n"), "ok\r\nok\r\n");
    EXPECT_EQ(b.ask("!", 1), "");
    EXPECT_EQ(b.ask("\x18", 1), "\r\nGrbl 1.1h ['$' for help]\r\n");
    EXPECT_THAT(b.ask("$#\n"), EndsWith("ok\r\n"));
}

/// cncjs asks for the modes twice a second also while a program runs, and cancels jogs with two bytes of UTF-8.
TEST(CncJs, QueriesModesWhileStreaming) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G1 X10 F600\n$G\nG1 X20\n$G\n", 0.1),
              "ok\r\n[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 F600 S0]\r\nok\r\nok\r\n[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 "
              "F600 S0]\r\nok\r\n");
    EXPECT_EQ(b.ask("G4 P0.5\n", 1), "");
    EXPECT_EQ(answers(b.ask("", 3)), 1);
}

}  // namespace
}  // namespace motionrack::grbl
