// Stops and resets by other clients, one at a time: their messages, the lines around them, and how they are released.
#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string anna_stops = "ALARM:3\r\n[MSG:STOP by anna: ", unlocked = "[MSG:Caution: Unlocked]\r\nok\r\n";

void stop_by_anna(Bench& b) {
    b.machine->stop({"anna", "", "STOP"});
}
void reset_by_anna(Bench& b) {
    b.machine->reset({"anna", "", "Reset"});
}

// ---- a stop and its reset within one slice

TEST(StoppedSender, DrivesNoLineFromBeforeAResetThatPrecedesTheExecutionOfTheStop) {
    Bench b(three_axes());
    b.ask("G21\n", 0.1);
    EXPECT_EQ(b.ask("!\nG1 X50 F600\n", 0.1), "ok\r\n");
    stop_by_anna(b);
    b.session->receive("G1 X60\n");
    reset_by_anna(b);
    EXPECT_THAT(b.ask("G1 X70\n", 0.5),
                AllOf(StartsWith(anna_stops), EndsWith("]\r\nerror:9\r\nerror:9\r\nerror:9\r\n")));
    EXPECT_EQ(b.axis(0), 0);
    EXPECT_EQ(b.ask("$X\n", 0.2), unlocked);
}

TEST(StoppedSender, DrivesNoLineThatCameBetweenTheStopAndItsReset) {
    Bench b(three_axes());
    b.ask("G21\n", 0.1);
    stop_by_anna(b);
    b.session->receive("G1 X50 F600\n");
    reset_by_anna(b);
    EXPECT_THAT(b.ask("", 0.5), AllOf(StartsWith(anna_stops), EndsWith("]\r\nerror:9\r\n")));
    EXPECT_EQ(b.axis(0), 0);
}

TEST(StoppedSender, DrivesNoLineThatHadBegunBeforeTheReset) {
    Bench b(three_axes());
    b.ask("G21\nG1 F600 X5", 0.1);
    stop_by_anna(b);
    b.pass(0.1);
    reset_by_anna(b);
    EXPECT_THAT(b.ask("0\n", 0.5), AllOf(StartsWith(anna_stops), EndsWith("]\r\nerror:9\r\n")));
    EXPECT_EQ(b.axis(0), 0);
}

TEST(StoppedSender, ContinuesAfterAResetOnceItsLinesAreAnswered) {
    Bench b(three_axes());
    b.ask("G21\n", 0.1);
    b.ask("!\nG1 X50 F600\n", 0.1);
    stop_by_anna(b);
    EXPECT_THAT(b.ask("", 0.1), AllOf(StartsWith(anna_stops), EndsWith("]\r\nerror:9\r\n")));
    reset_by_anna(b);
    EXPECT_THAT(b.ask("", 0.1), AllOf(StartsWith("[MSG:Reset by anna: "), EndsWith(". The sender may continue]\r\n")));
    EXPECT_EQ(b.ask("G1 X1 F600\n"), "ok\r\n");
    b.until_idle();
}

// ---- a stop beside other causes

TEST(StoppedSender, IsReleasedWhileAnAlarmOfAnotherCauseIsActive) {
    Bench b(three_axes("[safety]\ndoor = true\n"));
    b.ask("G21\n", 0.1);
    ASSERT_TRUE(b.machine->wires().force("door", 0));
    b.pass(0.1);
    ASSERT_TRUE(b.machine->wires().force("door", 1));
    b.pass(0.1);
    ASSERT_TRUE(b.machine->status().alarms.at(0).active);
    EXPECT_EQ(b.ask("G1 X100 F3000\n", 0.3), "ok\r\n");
    stop_by_anna(b);
    EXPECT_THAT(b.ask("G1 X0\n", 0.7), AllOf(StartsWith(anna_stops), EndsWith(" was stopped.]\r\nerror:9\r\n"),
                                             Not(HasSubstr("Reset to continue"))));
    EXPECT_EQ(b.ask("$X\n", 0.2), unlocked);
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

TEST(StoppedSender, IsToldThatTheEmergencyStopIsPressedWhenItUnlocks) {
    Bench b(three_axes());
    b.ask("G21\n", 0.1);
    stop_by_anna(b);
    b.ask("", 0.1);
    ASSERT_TRUE(b.machine->wires().force("estop", 0));
    b.ask("", 0.1);
    EXPECT_THAT(b.ask("$X\nG1 X50 F600\n", 0.2),
                AllOf(StartsWith("[MSG:Not reset: the emergency stop is still pressed."),
                      EndsWith("]\r\nerror:9\r\nerror:9\r\n")));
    ASSERT_TRUE(b.machine->wires().force("estop", 1));
    EXPECT_EQ(b.ask("$X\n", 0.2), unlocked);
    EXPECT_EQ(b.axis(0), 0);
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

TEST(StoppedSender, HasItsLinePastTheTravelAnswered) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G1 X100 F3000\n", 0.3), "ok\r\n");
    b.session->receive("G1 X999\n");
    stop_by_anna(b);
    EXPECT_THAT(b.ask("G1 X0\n", 0.7),
                AllOf(StartsWith(anna_stops), EndsWith(" was stopped.]\r\nerror:9\r\nerror:9\r\n")));
    EXPECT_EQ(b.ask("$X\n", 0.2), unlocked);
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

// ---- holds by a locked sender

/// Locks the sender: another client takes control during its jog, and the jog ends.
void lock_by_anna(Bench& b) {
    b.ask("$J=X300 F3000\n", 0.1);
    b.session->lose_control("anna");
    b.machine->cancel();
    EXPECT_EQ(b.ask("", 0.5), "ALARM:3\r\n[MSG:anna has taken control]\r\n");
    EXPECT_EQ(b.machine->state(), operate::MachineState::standstill);
}

/// Parameter: the byte of the locked sender.
class LockedSender : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(By, LockedSender, testing::Values("!", "\x84", "\x85"));

TEST_P(LockedSender, EndsAJogOfAnotherClient) {
    Bench b(three_axes());
    lock_by_anna(b);
    ASSERT_TRUE(b.machine->manual().jog_to({200, 0, 0}, 50));
    b.pass(0.3);
    ASSERT_EQ(b.machine->state(), operate::MachineState::jogging);
    EXPECT_EQ(b.ask(GetParam(), 0.5), "");
    EXPECT_EQ(b.machine->state(), operate::MachineState::standstill);
    EXPECT_LT(b.axis(0), 100);
}

TEST_P(LockedSender, HoldsAMachineThatAnotherClientMoves) {
    if (std::string_view(GetParam()) == "\x85") return;  // it cancels jogs alone
    Bench b(three_axes());
    lock_by_anna(b);
    ASSERT_TRUE(b.machine->line("G1 X200 F3000", 1));
    b.pass(0.3);
    ASSERT_EQ(b.machine->state(), operate::MachineState::moving);
    EXPECT_EQ(b.ask(GetParam(), 0.5), "");
    EXPECT_EQ(b.machine->state(), operate::MachineState::hold);
    EXPECT_THAT(b.report(), StartsWith("<Alarm|"));
    EXPECT_LT(b.axis(0), 100);
}

// ---- resets at standstill

TEST(IdleSender, IsLockedByAResetThatClearsTheModesItHasSet) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G20 G91 G1 F10\n", 0.1), "ok\r\n");
    reset_by_anna(b);
    EXPECT_EQ(b.ask("X50\n", 0.2),
              "ALARM:3\r\n[MSG:Reset by anna: the machine was in state 'standstill'.]\r\nerror:9\r\n");
    EXPECT_EQ(b.axis(0), 0);
    EXPECT_EQ(b.ask("$X\n", 0.2), unlocked);
    reset_by_anna(b);
    EXPECT_EQ(b.ask("", 0.1), "") << "it has set no mode since";
}

TEST(IdleSender, IsNotLockedByAResetBeforeItsFirstLine) {
    Bench b(three_axes());
    b.ask("$G\n");
    reset_by_anna(b);
    EXPECT_EQ(b.ask("", 0.1), "");
    EXPECT_THAT(b.report(), StartsWith("<Idle|"));
}

TEST(IdleSender, IsLockedAndNotReleasedByResetsOfAnotherSender) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask("G91\n", 0.1), "ok\r\n");
    GrblSession other(*b.machine, {});
    other.receive("\x18");
    EXPECT_THAT(b.ask("", 0.1), StartsWith("ALARM:3\r\n[MSG:^X by a sender: "));
    other.receive("\x18");
    EXPECT_EQ(b.ask("", 0.1), "");
    EXPECT_EQ(b.ask("X50\n", 0.1), "error:9\r\n");
}

// ---- permissions

TEST(SenderWithoutControl, EndsAHomingByItsHold) {
    SessionSettings settings;
    settings.may_stop = []() -> Result<void> { return fail(ErrorKind::refused, "Anna drives."); };
    Bench b(router(), settings);
    ASSERT_TRUE(b.machine->enable(true));
    ASSERT_TRUE(b.machine->manual().home(""));
    b.pass(0.5);
    ASSERT_EQ(b.machine->state(), operate::MachineState::homing);
    EXPECT_THAT(b.ask("!", 0.5), StartsWith("ALARM:6\r\n"));
    EXPECT_EQ(b.machine->state(), operate::MachineState::standstill);
}

TEST(StoppedSender, ReleasesNoStopByAResetWithoutControl) {
    SessionSettings settings;
    settings.may_stop = []() -> Result<void> { return fail(ErrorKind::refused, "Anna drives."); };
    Bench b(three_axes(), settings);
    b.ask("G21\n", 0.1);
    stop_by_anna(b);
    EXPECT_THAT(b.ask("", 0.1), StartsWith(anna_stops));
    EXPECT_THAT(b.ask("\x18", 0.2), EndsWith("help]\r\n[MSG:Anna drives.]\r\n[MSG:'$H'|'$X' to unlock]\r\n"));
    EXPECT_EQ(b.machine->state(), operate::MachineState::error_stop);
    EXPECT_TRUE(b.machine->rack().stop_latch().latched());
    EXPECT_EQ(b.ask("G1 X50 F600\n", 0.1), "error:9\r\n");
    reset_by_anna(b);
    EXPECT_THAT(b.ask("", 0.1), EndsWith(". The sender may continue]\r\n"));
    EXPECT_EQ(b.ask("G1 X1 F600\n"), "ok\r\n");
    b.until_idle();
}

}  // namespace
}  // namespace motionrack::grbl
