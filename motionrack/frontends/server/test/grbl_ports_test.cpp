// Senders at the TCP port and at the pseudo-terminal of an unthrottled machine.
#include <gmock/gmock.h>
#include <termios.h>

#include <fstream>

#include "sender_ports.hpp"

namespace motionrack::server {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(SenderPorts, SendTheWelcomeLineAndExecuteLinesOverTcp) {
    start();
    EXPECT_EQ(ports_->sender(), "none");
    SenderClient client = tcp();
    EXPECT_EQ(client.receive(banner), banner);
    EXPECT_THAT(ports_->sender(), StartsWith("tcp 127.0.0.1:"));
    EXPECT_EQ(client.ask("G1 X10 F1200\n"), "ok\r\n");
    EXPECT_THAT(client.until("Idle"), HasSubstr("MPos:10.000,0.000,0.000"));
}

TEST_F(SenderPorts, ResetTheSessionForEachTerminalClient) {
    start();
    for (int i = 0; i < 3; ++i) {
        while (ports_->sender() != "none") std::this_thread::yield();
        SenderClient client = terminal();
        EXPECT_EQ(client.receive(banner), banner);
        EXPECT_EQ(ports_->sender(), "pty");
        client.say("G0 X1");  // unterminated: the next client's line must not begin with it
        client.say("?");
        EXPECT_THAT(client.receive(">\r\n"), StartsWith("<Idle|"));
        client.say("?");  // never read
    }
    while (ports_->sender() != "none") std::this_thread::yield();
    SenderClient client = terminal();
    EXPECT_EQ(client.receive(banner), banner);
    EXPECT_THAT(client.ask("$I\n"), StartsWith("[VER:1.1h"));
}

TEST_F(SenderPorts, ExecuteTheLastLineOfAClientThatDisconnectsAtOnce) {
    start();
    {
        SenderClient client = terminal();
        client.say("G1 X7 F600\n");
    }
    SenderClient client = tcp();
    EXPECT_THAT(client.until("Idle|MPos:7.000"), HasSubstr("7.000"));
}

TEST_F(SenderPorts, KeepTheTerminalRaw) {
    start();
    SenderClient client = terminal();
    client.receive(banner);
    termios line{};
    ASSERT_EQ(::tcgetattr(client.file(), &line), 0);
    EXPECT_EQ(line.c_lflag & (ICANON | ECHO | ISIG), 0u);
    EXPECT_EQ(line.c_oflag & OPOST, 0u);
    EXPECT_EQ(client.ask("\r\n", "ok\r\nok\r\n"), "ok\r\nok\r\n");  // each of the two ends a line
}

TEST_F(SenderPorts, AllowObserversToReadAndHoldButNotToWriteOrReset) {
    start();
    SenderClient writer = tcp();
    writer.receive(banner);
    SenderClient other = tcp();
    EXPECT_THAT(other.receive("]\r\n"), StartsWith("[MSG:Another sender has control."));
    other.say("G1 X50 F60\n$X\n");
    EXPECT_THAT(other.ask("?", ">\r\n"), HasSubstr("<Idle|MPos:0.000"));
    EXPECT_THAT(writer.receive(">\r\n"), HasSubstr("<Idle|MPos:0.000"));
    writer.say("G4 P100000\n");
    EXPECT_THAT(writer.until("Run"), HasSubstr("<Run"));
    EXPECT_THAT(other.ask("\x18", "machine]\r\n"), HasSubstr("[MSG:The reset of an observer"));
    EXPECT_THAT(writer.ask("?", ">\r\n"), HasSubstr("<Run|"));
    other.say("!");
    EXPECT_THAT(writer.until("Hold"), HasSubstr("<Hold"));
}

TEST_F(SenderPorts, AllowResetsOfObserversToStopTheMachineIfConfigured) {
    settings_.resets_stop_all = true;
    start();
    SenderClient writer = tcp();
    writer.say("G4 P100000\n");
    EXPECT_THAT(writer.until("Run"), HasSubstr("<Run"));
    SenderClient other = tcp();
    other.receive("]\r\n");
    other.say("\x18");
    EXPECT_THAT(writer.receive("help]\r\n"), HasSubstr("ALARM:3\r\n"));
}

TEST_F(SenderPorts, AllowTheNextClientToWriteAfterTheWriterDisconnects) {
    start();
    {
        SenderClient first = tcp();
        first.receive(banner);
    }
    std::string greeting;
    for (int i = 0; i < 100 && greeting != banner; ++i) {
        SenderClient next = tcp();
        greeting = next.receive("]\r\n");
    }
    EXPECT_EQ(greeting, banner);
}

TEST_F(SenderPorts, CloseConnectionsOfOtherProgramsWithoutAnyEffect) {
    start();
    SenderClient writer = tcp();
    EXPECT_EQ(writer.ask("G4 P100000\n", banner), banner);
    EXPECT_THAT(writer.until("Run"), StartsWith("<Run|"));
    for (const std::string& first :
         {std::string("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n\x18"), std::string("\x16\x03\x01\x02\x00\x01\x18", 7),
          std::string("SSH-2.0-OpenSSH_9.2\r\n\x18")}) {
        SenderClient stranger = tcp();
        stranger.receive("]\r\n");
        stranger.say(first);
        EXPECT_EQ(stranger.receive("ok"), "(closed)");
        EXPECT_THAT(writer.ask("?", ">\r\n"), StartsWith("<Run|"));
    }
}

TEST_F(SenderPorts, CloseASilentConnectionForASender) {
    settings_.observers = 1;
    start();
    SenderClient first = tcp(), second = tcp();
    first.receive(banner);
    second.receive("]\r\n");
    SenderClient sender = tcp();
    EXPECT_EQ(sender.receive(banner), banner) << "the oldest silent one had the port";
    EXPECT_EQ(first.receive("x"), "(closed)");
}

TEST_F(SenderPorts, EnableNoDriveBeforeALineMoves) {
    start();
    SenderClient client = tcp();
    client.receive(banner);
    EXPECT_THAT(client.ask("?", ">\r\n"), StartsWith("<Idle|"));
    client.ask("$$\n");
    EXPECT_EQ(state(), operate::MachineState::disabled);
    EXPECT_EQ(client.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_NE(state(), operate::MachineState::disabled);
}

TEST_F(SenderPorts, ReportToASenderWhichUserStoppedIt) {
    start();
    SenderClient client = tcp();
    client.say("G4 P100000\n");
    EXPECT_THAT(client.until("Run"), HasSubstr("<Run"));
    machine_->post([this] { machine_->stop({"anna", "192.168.1.5", "STOP"}); });
    EXPECT_THAT(client.receive("]\r\n"),
                AllOf(StartsWith("ALARM:3\r\n[MSG:STOP by anna (192.168.1.5): line "), EndsWith(" was stopped.]\r\n")));
    EXPECT_EQ(client.receive("\r\n"), "error:9\r\n") << "the dwell";
    EXPECT_EQ(client.ask("G0 X1\n", "\r\n"), "error:9\r\n");
    EXPECT_EQ(client.ask("$X\n"), "[MSG:Caution: Unlocked]\r\nok\r\n");
    EXPECT_EQ(client.ask("G0 X1\n"), "ok\r\n");
}

TEST_F(SenderPorts, LockASenderThatLosesControlDuringItsJob) {
    start();
    SenderClient client = tcp();
    EXPECT_EQ(client.ask("G1 X1 F600\nM0\n"), banner + "ok\r\n");
    EXPECT_THAT(client.until("Hold:0"), HasSubstr("Hold:0"));
    machine_->post([this] { EXPECT_TRUE(lease_.take("anna", "w1", true, operate::is_stationary(machine_->state()))); });
    EXPECT_EQ(client.receive("]\r\n"), "ALARM:3\r\n[MSG:anna has taken control]\r\n");
    EXPECT_EQ(client.receive("\r\n"), "error:9\r\n") << "the pause";
    EXPECT_EQ(client.ask("~G1 X0\n", "\r\n"), "error:9\r\n");
}

TEST_F(SenderPorts, AllowOnlyTheirOwnerToOpenTheTerminal) {
    start();
    EXPECT_EQ(std::filesystem::status(settings_.link).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(SenderPorts, RejectLinesOfASenderWhileAnotherClientHasControlOfAMovingMachine) {
    start();
    SenderClient first = tcp();
    first.receive(banner);
    SenderClient second = terminal();
    second.receive(banner);
    first.say("G4 P100000\n");
    EXPECT_THAT(second.until("Run"), StartsWith("<Run|"));
    EXPECT_THAT(second.ask("G1 X1 F600\n", "error:9\r\n"), AllOf(StartsWith("[MSG:"), HasSubstr("sender 127.0.0.1:")));
    EXPECT_THAT(second.ask("\x18", "ends it]\r\n"),
                AllOf(HasSubstr(banner), HasSubstr("[MSG:Only this connection was reset, because sender 127.0.0.1:")));
    EXPECT_THAT(first.ask("?", ">\r\n"), HasSubstr("<Run|"));
}

TEST_F(SenderPorts, ReportWhichSettingASenderHasChanged) {
    start();
    SenderClient client = terminal();
    client.receive(banner);
    EXPECT_EQ(client.ask("$32=1\n"), "ok\r\n");
    client.ask("$G\n");
    EXPECT_THAT(reported(), AllOf(HasSubstr("sender on"), HasSubstr("$32 is 1")));
}

TEST_F(SenderPorts, RejectALineOfAMegabyteAndContinue) {
    start();
    SenderClient client = tcp();
    client.receive(banner);
    EXPECT_EQ(client.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_EQ(client.ask("G1 X" + std::string(1 << 20, '1') + "\n", "\r\n"), "error:11\r\n");
    EXPECT_EQ(client.ask("G1 X2\n"), "ok\r\n");
    EXPECT_THAT(client.until("Idle"), HasSubstr("MPos:2.000"));
}

TEST_F(SenderPorts, DoNotOverwriteAFile) {
    std::ofstream(settings_.link) << "mine";
    const auto opened = GrblPorts::open(settings_, *machine_, lease_);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("is not a symbolic link"));
}

TEST_F(SenderPorts, DoNotReplaceALinkToAnotherTarget) {
    std::filesystem::create_symlink("/etc/passwd", settings_.link);
    const auto opened = GrblPorts::open(settings_, *machine_, lease_);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("leads to /etc/passwd"));
    EXPECT_EQ(std::filesystem::read_symlink(settings_.link), "/etc/passwd");
}

TEST_F(SenderPorts, DoNotReplaceTheLinkOfAnotherRunningProgram) {
    start();
    const std::filesystem::path leads_to = std::filesystem::read_symlink(settings_.link);
    auto machine = *operate::Machine::make(
        *rack::read_rack_text("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n").config, {});
    GrblPortSettings same;
    same.link = settings_.link;
    const auto opened = GrblPorts::open(same, *machine, lease_);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("another running program has the link"));
    EXPECT_EQ(std::filesystem::read_symlink(settings_.link), leads_to);
}

TEST_F(SenderPorts, ReplaceAStaleLinkAndRemoveTheirOwnAtTheEnd) {
    std::filesystem::create_symlink("/dev/pts/of-yesterday", settings_.link);
    start();
    EXPECT_THAT(std::filesystem::read_symlink(settings_.link).string(), StartsWith("/dev/pts/"));
    ports_.reset();
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(settings_.link)));
}

TEST_F(SenderPorts, ReportAPortThatIsInUse) {
    start();
    GrblPortSettings same;
    same.port = ports_->port();
    auto machine = *operate::Machine::make(
        *rack::read_rack_text("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n").config, {});
    const auto opened = GrblPorts::open(same, *machine, lease_);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("Choose another port"));
}

}  // namespace
}  // namespace motionrack::server
