// The sender's view while the machine moves.
#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string banner = "\r\nGrbl 1.1h ['$' for help]\r\n", unlock = "[MSG:'$H'|'$X' to unlock]\r\n";

TEST(GrblPort, ReportsTheWorkOffsetFirstThenEveryTenReportsAndTheOverridesInTheNext) {
    Bench b(three_axes());
    std::vector<int> offsets, overrides;
    for (int i = 1; i <= 32; ++i) {
        const std::string report = b.report();
        if (report.find("WCO") != std::string::npos) offsets.push_back(i);
        if (report.find("Ov:") != std::string::npos) overrides.push_back(i);
    }
    EXPECT_THAT(offsets, ElementsAre(1, 11, 21, 31));
    EXPECT_THAT(overrides, ElementsAre(2, 12, 22, 32));
}

TEST(GrblPort, ReportsTheWorkOffsetEveryThirtyReportsWhileItMoves) {
    Bench b(three_axes());
    b.ask("G1 X300 F600\n");
    std::vector<int> offsets, overrides;
    for (int i = 1; i <= 62; ++i) {
        const std::string report = b.report();
        EXPECT_THAT(report, StartsWith("<Run|"));
        if (report.find("WCO") != std::string::npos) offsets.push_back(i);
        if (report.find("Ov:") != std::string::npos) overrides.push_back(i);
    }
    EXPECT_THAT(offsets, ElementsAre(1, 31, 61));
    EXPECT_THAT(overrides, ElementsAre(2, 22, 42, 62));
}

TEST(GrblPort, ReportsAChangedWorkOffsetAtOnce) {
    Bench b(three_axes());
    b.report(), b.report(), b.report();
    EXPECT_EQ(b.ask("G10 L2 P1 X5 Y-2.5\n"), "ok\r\n");
    EXPECT_EQ(b.report(), "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:5.000,-2.500,0.000>\r\n");
    EXPECT_EQ(b.ask("G92 Z1\n"), "ok\r\n");
    EXPECT_THAT(b.report(), HasSubstr("|WCO:5.000,-2.500,-1.000"));
    b.ask("$10=0\n");
    EXPECT_THAT(b.report(), StartsWith("<Idle|WPos:-5.000,2.500,1.000|"));
}

TEST(GrblPort, ExecutesALineAndAnswersOnce) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("N12 G1 X10 F1200\n"), "ok\r\n");
    EXPECT_THAT(b.ask("?", 0.2), AllOf(StartsWith("<Run|MPos:"), HasSubstr("|FS:")));
    EXPECT_THAT(b.report(), AllOf(HasSubstr("|Ln:12|FS:1200,0"), HasSubstr("Ov:100,100,100")));
    EXPECT_EQ(b.until_idle(), "");
    EXPECT_NEAR(b.axis(0), 10, 1e-3);
}

TEST(GrblPort, BuffersFifteenMovesAndDelaysTheNextLine) {
    Bench b(three_axes());
    b.ask("$10=3\n");
    std::string lines;
    for (int i = 1; i <= 20; ++i) lines += "G1X" + std::to_string(i) + "F60\n";
    for (std::size_t at = 0; at < lines.size(); at += 10) b.session->receive(std::string_view(lines).substr(at, 10));
    EXPECT_EQ(answers(b.ask("", 0.1)), 15);
    EXPECT_THAT(b.report(), HasSubstr("|Bf:0,"));
    EXPECT_EQ(answers(b.ask("", 1.2)), 1);
    b.ask("\x18");
}

TEST(GrblPort, DiscardsInputBeyondItsBufferWhileALineWaits) {
    Bench b(three_axes());
    b.ask("$10=3\nG4 P1\n");
    const std::string out = b.ask(std::string(100, '\n') + std::string(100, '\n') + "?", 0.01);
    EXPECT_THAT(out, HasSubstr("|Bf:14,0|"));
    EXPECT_EQ(answers(b.ask("", 2)), 1 + 128);
}

TEST(GrblPort, AnswersADwellAfterItAndAllMovesBeforeItHaveEnded) {
    Bench b(three_axes());
    EXPECT_EQ(answers(b.ask("G1 X10 F600\nG4 P0.5\n", 1.4)), 1);
    EXPECT_EQ(b.ask("", 0.3), "ok\r\n");
    EXPECT_EQ(b.session->state(), State::idle);
}

TEST(GrblPort, HoldsAndResumes) {
    Bench b(three_axes());
    b.ask("G1 X100 F3000\n", 0.5);
    EXPECT_THAT(b.ask("!?", 0.004), StartsWith("<Hold:1|"));
    b.ask("~");  // too early: the machine is not at standstill yet
    b.pass(0.5);
    EXPECT_THAT(b.report(), StartsWith("<Hold:0|"));
    const double place = b.axis(0);
    EXPECT_EQ(b.ask("G1 X0\n", 0.5), "");
    EXPECT_EQ(b.axis(0), place);
    EXPECT_EQ(b.ask("~", 0.1), "ok\r\n");
    EXPECT_THAT(b.report(), StartsWith("<Run|"));
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 0, 1e-3);
}

TEST(GrblPort, DiscardsPendingLinesOfAHoldAtAResetAndKeepsItsPosition) {
    Bench b(three_axes());
    b.ask("G1 X100 F3000\n", 0.5);
    b.ask("!", 0.5);
    EXPECT_EQ(b.ask("\x18", 0.1), banner);
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

TEST(GrblPort, RaisesAnAlarmAndDeceleratesOnAResetInMotion) {
    Bench b(three_axes());
    b.ask("G1 X100 F3000\n", 0.5);
    const double place = b.axis(0);
    EXPECT_EQ(b.ask("\x18", 0.3), "ALARM:3\r\n" + banner + unlock);
    EXPECT_THAT(b.report(), StartsWith("<Alarm|"));
    EXPECT_GT(b.axis(0), place);
    EXPECT_LT(b.axis(0), place + 10);
    EXPECT_EQ(b.ask("G0 X0\n$X\nG0 X0\n"), "error:9\r\n[MSG:Caution: Unlocked]\r\nok\r\nok\r\n");
    b.until_idle();
}

TEST(GrblPort, WaitsAtM0UntilItIsResumed) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G1 X5 F3000\nM0\nG1 X10\n", 1), "ok\r\n");
    EXPECT_THAT(b.report(), StartsWith("<Hold:0|MPos:5.000"));
    EXPECT_EQ(b.ask("~", 0.05), "ok\r\nok\r\n");
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 10, 1e-3);
}

// ---- jog

TEST(GrblPort, JogsWithoutChangingItsModalState) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G20 G90\n$J=G91 G21 X10 Y5 F600\n"), "ok\r\nok\r\n");
    EXPECT_THAT(b.report(), StartsWith("<Jog|"));
    EXPECT_EQ(b.ask("G0 X1\n$$\n$H\n"),
              "error:9\r\n" + settings_text(b.machine->rack().config(), b.session->own(), 3) + "ok\r\nerror:8\r\n");
    EXPECT_EQ(b.ask("$J=G91 X1 F10\n"), "ok\r\n");
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 10 + 25.4, 1e-3);
    EXPECT_NEAR(b.axis(1), 5, 1e-3);
    EXPECT_THAT(b.ask("$G\n"), StartsWith("[GC:G0 G54 G17 G20 G90 "));
}

TEST(GrblPort, JogsInMachineCoordinatesWithG53) {
    Bench b(three_axes());
    b.ask("G92 X50\n$J=G53 X3 F600\n");
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 3, 1e-3);
}

TEST(GrblPort, EnablesNoDriveBeforeALineMovesIt) {
    Bench b(three_axes());
    b.session->greet();
    EXPECT_EQ(b.ask("\x18\n$$\n$G\n?").find("Alarm"), std::string::npos);
    EXPECT_EQ(b.machine->state(), operate::MachineState::disabled);
    EXPECT_EQ(b.ask("$J=X1 F600\n"), "ok\r\n");
    EXPECT_EQ(b.machine->state(), operate::MachineState::jogging);
}

TEST(GrblPort, AResetWithoutControlAffectsTheSessionOnly) {
    SessionSettings settings;
    settings.may_stop = []() -> Result<void> { return fail(ErrorKind::refused, "Anna drives."); };
    Bench b(three_axes(), settings);
    EXPECT_EQ(b.ask("G1 X100 F3000\nG4 P1\n", 0.1), "ok\r\n");
    EXPECT_EQ(b.ask("\x18", 0.1), banner + "[MSG:Anna drives.]\r\n");
    EXPECT_EQ(b.machine->state(), operate::MachineState::moving);
    b.session->observe("\x18");
    EXPECT_THAT(b.ask("", 0.1), StartsWith("[MSG:The reset of an observer"));
    EXPECT_EQ(b.machine->state(), operate::MachineState::moving);
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 100, 1e-3);
    EXPECT_EQ(b.ask("\x18", 0.1), banner) << "of a machine that stands it is its own";
}

class JogThatIsCancelled : public testing::TestWithParam<const char*> {};
TEST_P(JogThatIsCancelled, StopsAndContinuesFromThere) {
    Bench b(three_axes());
    b.ask("$J=X300 F3000\n$J=X0 F3000\n", 0.5);
    EXPECT_THAT(b.ask(std::string(GetParam()) + "?", 0.02), StartsWith("<Jog|"));
    b.until_idle();
    const double place = b.axis(0);
    EXPECT_GT(place, 10);
    EXPECT_LT(place, 40);
    b.pass(0.5);
    EXPECT_EQ(b.axis(0), place);
    EXPECT_EQ(b.ask("G91 G1 X1 F600\n"), "ok\r\n");
    b.until_idle();
    EXPECT_NEAR(b.axis(0), place + 1, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(By, JogThatIsCancelled, testing::Values("\x85", "\xC2\x85", "!"));

TEST(GrblPort, RejectsJogsWhileItRuns) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G1 X50 F600\n$J=X1 F100\n$$\n$#\n$X\n$C\n$N\n"),
              "ok\r\nerror:8\r\nerror:8\r\nerror:8\r\nok\r\nerror:8\r\nerror:8\r\n");
}

// ---- overrides, spindle, coolant

TEST(GrblPort, ChangesOverridesInStepsWithinTheirLimits) {
    Bench b(three_axes());
    b.report(), b.report();
    const auto after = [&](const std::string& bytes) {
        std::string report = b.ask(bytes + "?");
        if (report.find("Ov:") == std::string::npos) report = b.report();  // that report had the work offset instead
        return report.substr(report.find("Ov:") + 3, report.find('>') - report.find("Ov:") - 3);
    };
    EXPECT_EQ(after("\x91"), "110,100,100");
    EXPECT_EQ(after("\x93\x93\x94\x92"), "101,100,100");
    EXPECT_EQ(after(std::string(20, '\x91')), "200,100,100");
    EXPECT_EQ(after(std::string(30, '\x92')), "10,100,100");
    EXPECT_EQ(after("\x90\x96"), "100,50,100");
    EXPECT_EQ(after("\x97"), "100,25,100");
    EXPECT_EQ(after("\x95\x9A\x9C"), "100,100,111");
    EXPECT_EQ(after("\x9B\x9D\x9D"), "100,100,99");
    EXPECT_EQ(after("\x99\x92"), "90,100,100");
}

TEST(GrblPort, ReportsSpindleAndCoolantWithTheOverrides) {
    Bench b(three_axes());
    b.report(), b.report();
    EXPECT_EQ(b.ask("M3 S500 M8\n", 0.05), "ok\r\n");
    EXPECT_EQ(b.report(), "<Idle|MPos:0.000,0.000,0.000|FS:0,500|Ov:100,100,100|A:SF>\r\n");
    EXPECT_EQ(b.ask("\x9A\xA1?"), "<Idle|MPos:0.000,0.000,0.000|FS:0,550|Ov:100,100,110|A:SFM>\r\n");
    EXPECT_EQ(b.ask("\x9E?"), "<Idle|MPos:0.000,0.000,0.000|FS:0,550>\r\n");  // 9Eh acts only during a hold
    EXPECT_EQ(b.ask("!\x9E\xA0?"), "<Hold:0|MPos:0.000,0.000,0.000|FS:0,0|Ov:100,100,110|A:M>\r\n");
    EXPECT_EQ(b.ask("~M4 S2000\n", 0.05), "ok\r\n");
    EXPECT_THAT(b.report(), HasSubstr("|FS:0,1000|Ov:100,100,110|A:CM>"));  // limited by $30
    EXPECT_EQ(b.ask("M5 M9\n", 0.05), "ok\r\n");
    EXPECT_THAT(b.report(), HasSubstr("|FS:0,0|Ov:100,100,110>"));
}

TEST(GrblPort, WaitsForTheMotionBeforeAnotherSpindleSpeedButNotInLaserMode) {
    Bench b(three_axes());
    EXPECT_EQ(answers(b.ask("M3 S100\nG1 X5 F600\nG1 X6 S200\n", 0.1)), 2);
    b.until_idle();
    EXPECT_EQ(answers(b.ask("$32=1\nG1 X5 F600\nG1 X6 S300\nM4 S10 X7\n", 0.1)), 4);
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 7, 1e-3);
}

// ---- locks and alarms

TEST(MachineWithHomeSwitches, IsLockedAtFirst) {
    Bench b(router());
    b.session->greet();
    EXPECT_EQ(b.ask(""), banner + unlock);
    EXPECT_THAT(b.report(), StartsWith("<Alarm|MPos:0.000,0.000,0.000|FS:0,0|"));
    EXPECT_EQ(b.ask("G0 X1\n$J=X1 F10\n"), "error:9\r\nerror:8\r\n");
    EXPECT_EQ(b.ask("$X\n", 0.2), "[MSG:Caution: Unlocked]\r\nok\r\n");
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

TEST(MachineWithHomeSwitches, AnswersAfterHoming) {
    Bench b(router());
    b.ask("$N0=G55\n");
    EXPECT_EQ(b.ask("$H\n", 0.5), "");
    EXPECT_THAT(b.report(), StartsWith("<Home|"));
    std::string out;
    for (int i = 0; i < 600 && out.empty(); ++i) out = b.ask("", 0.1);
    EXPECT_EQ(out, ">G55:ok\r\nok\r\n");
    EXPECT_THAT(b.report(), StartsWith("<Idle|MPos:1"));
}

TEST(MachineWithHomeSwitches, RaisesAnAlarmWhenHomingIsInterrupted) {
    Bench b(router());
    b.ask("$H\n", 0.5);
    EXPECT_EQ(b.ask("\x18", 0.5), "ALARM:6\r\nok\r\n" + banner + unlock);
    b.ask("$H\n", 0.5);
    EXPECT_EQ(b.ask("\x84", 0.5), "ALARM:7\r\nok\r\n" + banner + unlock);
    b.ask("$H\n", 0.5);
    EXPECT_EQ(b.ask("!", 0.5), "ALARM:6\r\nok\r\n" + banner + unlock);
}

TEST(MachineWithHomeSwitches, RaisesAnAlarmIfNoSwitchIsFound) {
    Bench b(router());
    ASSERT_TRUE(b.machine->wires().force("X.home", 1));
    ASSERT_TRUE(b.machine->wires().force("X.limit_minus", 1));
    b.ask("$H\n");
    std::string out;
    for (int i = 0; i < 1000 && out.empty(); ++i) out = b.ask("", 0.1);
    EXPECT_THAT(out, AllOf(StartsWith("ALARM:9\r\n[MSG:"), HasSubstr("]\r\nok\r\n" + banner)));
    b.pass(0.1);
    EXPECT_THAT(b.report(), StartsWith("<Alarm|"));
    EXPECT_EQ(b.ask("$X\n", 0.2), "[MSG:Caution: Unlocked]\r\nok\r\n");
}

const std::string with_limits = "[axis.X.switches]\nlimit_minus_mm = -2\nlimit_plus_mm = 302\n";

TEST(GrblPort, RaisesAnAlarmAtALimitSwitchAndAcceptsOnlyAReset) {
    Bench b(three_axes(with_limits));
    b.ask("G1 X100 F3000\n", 0.5);
    ASSERT_TRUE(b.machine->wires().force("X.limit_plus", 0));
    EXPECT_THAT(b.ask("", 0.5), StartsWith("ALARM:1\r\n[MSG:Reset to continue]\r\n[MSG:"));
    EXPECT_THAT(b.ask("$X\n?"), AllOf(StartsWith("<Alarm|"), HasSubstr("|Pn:X|")));
    EXPECT_EQ(b.ask("\x18", 0.1), banner + unlock);
    EXPECT_EQ(b.ask("$X\n", 0.1), "[MSG:Caution: Unlocked]\r\nok\r\n");
    EXPECT_EQ(b.ask("$J=G91 X-5 F600\n"), "ok\r\n");
    ASSERT_TRUE(b.machine->wires().force("X.limit_plus", 1));
    b.until_idle();
}

TEST(GrblPort, AlarmsAtTheEmergencyStopAndStaysInItWhileItIsPressed) {
    Bench b(three_axes());
    b.ask("G1 X100 F3000\n", 0.5);
    ASSERT_TRUE(b.machine->wires().force("estop", 0));
    EXPECT_THAT(b.ask("", 0.5), StartsWith("ALARM:3\r\n[MSG:Reset to continue]\r\n[MSG:"));
    EXPECT_THAT(b.report(), AllOf(StartsWith("<Alarm|"), HasSubstr("|Pn:R|")));
    EXPECT_THAT(b.ask("\x18", 0.1), AllOf(StartsWith(banner), HasSubstr("still pressed"), EndsWith(unlock)));
    EXPECT_EQ(b.ask("$X\n", 0.1), "");
    ASSERT_TRUE(b.machine->wires().force("estop", 1));
    EXPECT_EQ(b.ask("\x18", 0.1), banner + unlock);
    EXPECT_EQ(b.ask("$X\n", 0.1), "[MSG:Caution: Unlocked]\r\nok\r\n");
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

// ---- permissions

TEST(GrblPort, MovesNothingForASenderWithoutControlButExecutesItsStop) {
    bool mine = false;
    SessionSettings settings;
    settings.take_control = [&]() -> Result<void> {
        if (mine) return {};
        return fail(ErrorKind::refused, "Anna has control [here]\xC3\xA4.");
    };
    Bench b(three_axes(), settings);
    const std::string said = "[MSG:Anna has control ?here???.]\r\n";
    EXPECT_EQ(b.ask("G0 X5\n"), said + "error:9\r\n");
    EXPECT_EQ(b.ask("$J=X5 F100\n"), said + "error:9\r\n");
    EXPECT_EQ(b.ask("$10=3\n"), said + "error:9\r\n");
    EXPECT_EQ(b.ask("\x91"), said);
    EXPECT_EQ(b.ask("$G\n"), "[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\nok\r\n");
    ASSERT_TRUE(b.machine->enable(true));
    ASSERT_TRUE(b.machine->line("G1 X100 F3000", 1));
    b.pass(0.5);
    EXPECT_THAT(b.report(), StartsWith("<Run|"));
    b.ask("!", 0.5);
    EXPECT_THAT(b.report(), StartsWith("<Hold:0|"));
    EXPECT_EQ(b.ask("~"), said);
    EXPECT_EQ(b.ask("\x18", 0.1), banner);
    mine = true;
    EXPECT_EQ(b.ask("G0 X5\n"), "ok\r\n");
}

TEST(GrblPort, ReportsMotionCommandedByOtherClients) {
    Bench b(three_axes());
    ASSERT_TRUE(b.machine->enable(true));
    ASSERT_TRUE(b.machine->begin_program("G1 X50 F3000\nG1 X0\nM2\n", "panel.ngc"));
    b.pass(0.2);
    EXPECT_THAT(b.report(), StartsWith("<Run|"));
    EXPECT_THAT(b.ask("G0 X1\n"), EndsWith("error:9\r\n"));
    b.ask("!", 0.3);
    ASSERT_TRUE(b.machine->resume());
    b.pass(0.1);
    EXPECT_THAT(b.report(), StartsWith("<Run|"));
    b.machine->stop();
    EXPECT_THAT(b.ask("", 0.5), AllOf(StartsWith("ALARM:3\r\n"), HasSubstr("Stopped on request")));
    EXPECT_THAT(b.report(), StartsWith("<Alarm|"));
    EXPECT_EQ(b.ask("\x18", 0.1), banner + unlock);
    EXPECT_EQ(b.ask("$X\n", 0.1), "[MSG:Caution: Unlocked]\r\nok\r\n");
    ASSERT_TRUE(b.machine->enable(false));
    EXPECT_THAT(b.ask("", 0.1), AllOf(StartsWith("ALARM:3\r\n[MSG:Disabling"), EndsWith("]\r\n")));
    EXPECT_THAT(b.report(), StartsWith("<Alarm|"));
    EXPECT_EQ(b.ask("$X\n", 0.1), "[MSG:Caution: Unlocked]\r\nok\r\n");
}

TEST(GrblPort, ShowsAFourthAxisWhenAsked) {
    SessionSettings settings;
    settings.axes = 4;
    Bench b(router(), settings);
    b.ask("$X\n", 0.2);
    EXPECT_THAT(b.report(), HasSubstr("Pos:0.000,0.000,0.000,0.000|"));
    EXPECT_EQ(b.ask("G0 A10\n", 0.01), "ok\r\n");
    b.until_idle();
    EXPECT_THAT(b.ask("$$\n"), HasSubstr("$133="));
    EXPECT_THAT(b.report(), HasSubstr(",10.000|"));
}

}  // namespace
}  // namespace motionrack::grbl
