// Senders at the TCP port and at the pseudo-terminal of an unthrottled machine.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <motionrack/frontends/server/grbl_ports.hpp>
#include <motionrack/frontends/server/pseudo_terminal.hpp>
#include <motionrack/rack/config.hpp>
#include <mutex>
#include <thread>

namespace motionrack::server {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string banner = "\r\nGrbl 1.1h ['$' for help]\r\n";

/// Client end: sends text and reads until an expected text arrives (10 s at most).
class Client {
  public:
    static Client tcp(std::uint16_t port) {
        Client out(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port = htons(port);
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(::connect(out.file_.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
        return out;
    }
    static Client terminal(const std::string& path) {
        return Client(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    }

    void say(const std::string& text) {
        ASSERT_EQ(::write(file_.number(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    /// Reads up to and including `end`; keeps the rest.
    std::string hear(const std::string& end) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (heard_.find(end) == std::string::npos) {
            pollfd ready{file_.number(), POLLIN, 0};
            std::array<char, 4096> in{};
            if (std::chrono::steady_clock::now() > until) return std::exchange(heard_, {}) + "(nothing more)";
            if (::poll(&ready, 1, 1000) <= 0) continue;
            const ssize_t got = ::read(file_.number(), in.data(), in.size());
            if (got <= 0) return std::exchange(heard_, {}) + "(closed)";
            heard_.append(in.data(), static_cast<std::size_t>(got));
        }
        const std::size_t at = heard_.find(end) + end.size();
        std::string out = heard_.substr(0, at);
        heard_.erase(0, at);
        return out;
    }
    std::string ask(const std::string& text, const std::string& end = "ok\r\n") {
        say(text);
        return hear(end);
    }
    /// Queries the status until it contains `state`.
    std::string until(const std::string& state) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        std::string report;
        while (report.find("<" + state) == std::string::npos && std::chrono::steady_clock::now() < end)
            report = ask("?", ">\r\n");
        return report;
    }
    int file() const { return file_.number(); }

  private:
    explicit Client(int file) : file_(file) { EXPECT_GE(file, 0); }
    OpenFile file_;
    std::string heard_;
};

class SenderPorts : public testing::Test {
  protected:
    void SetUp() override {
        if (OpenFile(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)).number() < 0)
            GTEST_SKIP() << "There are no pseudo-terminals here: /dev/pts is not mounted.";
        const std::string axes =
            "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[axis.Y]\ncard = \"m\"\nchannel = "
            "\"y\"\n";
        machine_ = *operate::Machine::make(*rack::read_rack_text(axes).config, {});
        settings_.port = 0;
        settings_.link = (folder_ / "grbl").string();
        settings_.on_setting = [this](const std::string& sender, const std::string& text) {
            const std::lock_guard lock(told_mutex_);
            told_ = sender + ": " + text;
        };
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        if (machine_ == nullptr) return;
        machine_->quit();
        if (thread_.joinable()) thread_.join();
        ports_.reset();
        std::filesystem::remove_all(folder_);
    }
    void start() {
        auto opened = GrblPorts::open(settings_, *machine_, lease_);
        ASSERT_TRUE(opened) << opened.error().message;
        ports_ = std::move(*opened);
        thread_ = std::thread([this] { machine_->run(); });
    }
    /// Last setting changed by a sender; the ports report it on their own thread.
    std::string told() {
        const std::lock_guard lock(told_mutex_);
        return told_;
    }
    operate::MachineState state() {
        std::promise<operate::MachineState> out;
        machine_->post([&] { out.set_value(machine_->state()); });
        return out.get_future().get();
    }
    Client tcp() { return Client::tcp(ports_->port()); }
    Client terminal() { return Client::terminal(settings_.link); }

    const std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("motionrack-ports-" + std::to_string(::getpid()));
    GrblPortSettings settings_;
    auth::ControlLease lease_;
    std::unique_ptr<operate::Machine> machine_;
    std::unique_ptr<GrblPorts> ports_;
    std::thread thread_;
    std::mutex told_mutex_;
    std::string told_;
};

TEST_F(SenderPorts, GreetAndDriveOverTcp) {
    start();
    EXPECT_EQ(ports_->sender(), "none");
    Client client = tcp();
    EXPECT_EQ(client.hear(banner), banner);
    EXPECT_THAT(ports_->sender(), StartsWith("tcp 127.0.0.1:"));
    EXPECT_EQ(client.ask("G1 X10 F1200\n"), "ok\r\n");
    EXPECT_THAT(client.until("Idle"), HasSubstr("MPos:10.000,0.000,0.000"));
}

TEST_F(SenderPorts, GiveEachTerminalClientAFreshStart) {
    start();
    for (int i = 0; i < 3; ++i) {
        while (ports_->sender() != "none") std::this_thread::yield();
        Client client = terminal();
        EXPECT_EQ(client.hear(banner), banner);
        EXPECT_EQ(ports_->sender(), "pty");
        client.say("G0 X1");  // unterminated: the next client's line must not begin with it
        client.say("?");
        EXPECT_THAT(client.hear(">\r\n"), StartsWith("<Idle|"));
        client.say("?");  // never read
    }
    while (ports_->sender() != "none") std::this_thread::yield();
    Client client = terminal();
    EXPECT_EQ(client.hear(banner), banner);
    EXPECT_THAT(client.ask("$I\n"), StartsWith("[VER:1.1h"));
}

TEST_F(SenderPorts, HearALineOfWhoHasGoneAtOnce) {
    start();
    {
        Client client = terminal();
        client.say("G1 X7 F600\n");
    }
    Client client = tcp();
    EXPECT_THAT(client.until("Idle|MPos:7.000"), HasSubstr("7.000"));
}

TEST_F(SenderPorts, KeepTheTerminalRaw) {
    start();
    Client client = terminal();
    client.hear(banner);
    termios line{};
    ASSERT_EQ(::tcgetattr(client.file(), &line), 0);
    EXPECT_EQ(line.c_lflag & (ICANON | ECHO | ISIG), 0u);
    EXPECT_EQ(line.c_oflag & OPOST, 0u);
    EXPECT_EQ(client.ask("\r\n", "ok\r\nok\r\n"), "ok\r\nok\r\n");  // each of the two ends a line
}

TEST_F(SenderPorts, LetOthersLookOnAndHoldButNotWriteNorReset) {
    start();
    Client writer = tcp();
    writer.hear(banner);
    Client other = tcp();
    EXPECT_THAT(other.hear("]\r\n"), StartsWith("[MSG:Another sender has control."));
    other.say("G1 X50 F60\n$X\n");
    EXPECT_THAT(other.ask("?", ">\r\n"), HasSubstr("<Idle|MPos:0.000"));
    EXPECT_THAT(writer.hear(">\r\n"), HasSubstr("<Idle|MPos:0.000"));
    writer.say("G4 P100000\n");
    EXPECT_THAT(writer.until("Run"), HasSubstr("<Run"));
    EXPECT_THAT(other.ask("\x18", "machine]\r\n"), HasSubstr("[MSG:The reset of an observer"));
    EXPECT_THAT(writer.ask("?", ">\r\n"), HasSubstr("<Run|"));
    other.say("!");
    EXPECT_THAT(writer.until("Hold"), HasSubstr("<Hold"));
}

TEST_F(SenderPorts, LetResetsOfOnlookersStopTheMachineWhereThatIsChosen) {
    settings_.resets_stop_all = true;
    start();
    Client writer = tcp();
    writer.say("G4 P100000\n");
    EXPECT_THAT(writer.until("Run"), HasSubstr("<Run"));
    Client other = tcp();
    other.hear("]\r\n");
    other.say("\x18");
    EXPECT_THAT(writer.hear("help]\r\n"), HasSubstr("ALARM:3\r\n"));
}

TEST_F(SenderPorts, LetTheNextOneWriteWhenTheWriterHasGone) {
    start();
    {
        Client first = tcp();
        first.hear(banner);
    }
    std::string greeting;
    for (int i = 0; i < 100 && greeting != banner; ++i) {
        Client next = tcp();
        greeting = next.hear("]\r\n");
    }
    EXPECT_EQ(greeting, banner);
}

TEST_F(SenderPorts, CloseWhatIsNoSenderAndLetItTouchNothing) {
    start();
    Client writer = tcp();
    EXPECT_EQ(writer.ask("G4 P100000\n", banner), banner);
    EXPECT_THAT(writer.until("Run"), StartsWith("<Run|"));
    for (const std::string& first :
         {std::string("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n\x18"), std::string("\x16\x03\x01\x02\x00\x01\x18", 7),
          std::string("SSH-2.0-OpenSSH_9.2\r\n\x18")}) {
        Client stranger = tcp();
        stranger.hear("]\r\n");
        stranger.say(first);
        EXPECT_EQ(stranger.hear("ok"), "(closed)");
        EXPECT_THAT(writer.ask("?", ">\r\n"), StartsWith("<Run|"));
    }
}

TEST_F(SenderPorts, GiveThePortToWhoSpeaksWhereItsHolderIsSilent) {
    settings_.silence = std::chrono::milliseconds(0);
    start();
    Client silent = tcp();
    silent.hear(banner);
    Client sender = tcp();
    sender.hear("]\r\n");
    EXPECT_EQ(sender.ask("$I\n", "\r\nok\r\n").substr(0, banner.size()), banner);
    EXPECT_EQ(sender.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_THAT(silent.hear("accepted]\r\n"), StartsWith("[MSG:Another sender has control."));
}

TEST_F(SenderPorts, MakeRoomForASenderAmongSilentConnections) {
    settings_.observers = 1;
    start();
    Client first = tcp(), second = tcp();
    first.hear(banner);
    second.hear("]\r\n");
    Client sender = tcp();
    EXPECT_EQ(sender.hear(banner), banner) << "the oldest silent one had the port";
    EXPECT_EQ(first.hear("x"), "(closed)");
}

TEST_F(SenderPorts, EnableNoDriveBeforeALineMoves) {
    start();
    Client client = tcp();
    client.hear(banner);
    EXPECT_THAT(client.ask("?", ">\r\n"), StartsWith("<Idle|"));
    client.ask("$$\n");
    EXPECT_EQ(state(), operate::MachineState::disabled);
    EXPECT_EQ(client.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_NE(state(), operate::MachineState::disabled);
}

TEST_F(SenderPorts, TellASenderWhoStoppedIt) {
    start();
    Client client = tcp();
    client.say("G4 P100000\n");
    EXPECT_THAT(client.until("Run"), HasSubstr("<Run"));
    machine_->post([this] { machine_->stop({"anna", "192.168.1.5", "STOP"}); });
    EXPECT_THAT(client.hear("]\r\n"),
                AllOf(StartsWith("ALARM:3\r\n[MSG:STOP by anna (192.168.1.5): line "), EndsWith(" was stopped.]\r\n")));
    EXPECT_EQ(client.hear("\r\n"), "error:9\r\n") << "the dwell";
    EXPECT_EQ(client.ask("G0 X1\n", "\r\n"), "error:9\r\n");
    EXPECT_EQ(client.ask("$X\n"), "[MSG:Caution: Unlocked]\r\nok\r\n");
    EXPECT_EQ(client.ask("G0 X1\n"), "ok\r\n");
}

TEST_F(SenderPorts, LockASenderThatLosesControlInItsWork) {
    start();
    Client client = tcp();
    EXPECT_EQ(client.ask("G1 X1 F600\nM0\n"), banner + "ok\r\n");
    EXPECT_THAT(client.until("Hold:0"), HasSubstr("Hold:0"));
    machine_->post([this] { EXPECT_TRUE(lease_.take("anna", "w1", true, operate::is_stationary(machine_->state()))); });
    EXPECT_EQ(client.hear("]\r\n"), "ALARM:3\r\n[MSG:anna has taken control]\r\n");
    EXPECT_EQ(client.hear("\r\n"), "error:9\r\n") << "the pause";
    EXPECT_EQ(client.ask("~G1 X0\n", "\r\n"), "error:9\r\n");
}

TEST_F(SenderPorts, LetOnlyTheirOwnerOpenTheTerminal) {
    start();
    EXPECT_EQ(std::filesystem::status(settings_.link).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(SenderPorts, RefuseLinesOfASenderWhileAnotherHoldsControlOfAMachineThatMoves) {
    start();
    Client first = tcp();
    first.hear(banner);
    Client second = terminal();
    second.hear(banner);
    first.say("G4 P100000\n");
    EXPECT_THAT(second.until("Run"), StartsWith("<Run|"));
    EXPECT_THAT(second.ask("G1 X1 F600\n", "error:9\r\n"), AllOf(StartsWith("[MSG:"), HasSubstr("sender 127.0.0.1:")));
    EXPECT_THAT(second.ask("\x18", "ends it]\r\n"),
                AllOf(HasSubstr(banner), HasSubstr("[MSG:Only this connection was reset, because sender 127.0.0.1:")));
    EXPECT_THAT(first.ask("?", ">\r\n"), HasSubstr("<Run|"));
}

TEST_F(SenderPorts, TellWhichSettingASenderHasChanged) {
    start();
    Client client = terminal();
    client.hear(banner);
    EXPECT_EQ(client.ask("$32=1\n"), "ok\r\n");
    client.ask("$G\n");
    EXPECT_THAT(told(), AllOf(HasSubstr("sender on"), HasSubstr("$32 is 1")));
}

TEST_F(SenderPorts, TakeALineOfAMegabyteWithoutHarm) {
    start();
    Client client = tcp();
    client.hear(banner);
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

TEST_F(SenderPorts, DoNotReplaceALinkThatLeadsElsewhere) {
    std::filesystem::create_symlink("/etc/passwd", settings_.link);
    const auto opened = GrblPorts::open(settings_, *machine_, lease_);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("leads to /etc/passwd"));
    EXPECT_EQ(std::filesystem::read_symlink(settings_.link), "/etc/passwd");
}

TEST_F(SenderPorts, LeaveTheLinkToTheProgramThatHasIt) {
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

TEST_F(SenderPorts, ReplaceAnOldLinkAndTakeTheirOwnAway) {
    std::filesystem::create_symlink("/dev/pts/of-yesterday", settings_.link);
    start();
    EXPECT_THAT(std::filesystem::read_symlink(settings_.link).string(), StartsWith("/dev/pts/"));
    ports_.reset();
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(settings_.link)));
}

TEST_F(SenderPorts, SayThatThePortIsTaken) {
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
