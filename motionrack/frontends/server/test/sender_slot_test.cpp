// Writer's slot of the TCP port: which client receives it when the writer disconnects or stays silent.
#include <gmock/gmock.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "sender_ports.hpp"

namespace motionrack::server {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST_F(SenderPorts, GrantTheSlotToASpeakingClientIfItsHolderIsSilent) {
    settings_.silence = std::chrono::milliseconds(0);
    start();
    SenderClient silent = tcp();
    silent.receive(banner);
    SenderClient sender = tcp();
    sender.receive("]\r\n");
    EXPECT_EQ(sender.ask("$I\n", "\r\nok\r\n").substr(0, banner.size()), banner);
    EXPECT_EQ(sender.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_THAT(silent.receive("accepted]\r\n"), StartsWith("[MSG:Another sender has control."));
}

TEST_F(SenderPorts, GrantTheSlotToAKnownSenderWhenASilentConnectionCloses) {
    start();
    auto silent = std::make_unique<SenderClient>(tcp());
    silent->receive(banner);
    SenderClient sender = tcp();
    sender.receive("]\r\n");
    EXPECT_THAT(sender.ask("?", ">\r\n"), StartsWith("<Idle|"));
    sender.say("G1 X1 F600\n");
    EXPECT_THAT(sender.ask("?", ">\r\n"), HasSubstr("MPos:0.000")) << "it only observes, though it is known";
    silent.reset();
    EXPECT_EQ(sender.receive(banner), banner);
    EXPECT_EQ(sender.ask("G1 X2 F600\n"), "ok\r\n");
    EXPECT_THAT(sender.until("Idle|MPos:2.000"), HasSubstr("MPos:2.000"));
}

TEST_F(SenderPorts, GrantTheSlotToAKnownSenderWhenItsHolderIsSilentForTooLong) {
    settings_.silence = std::chrono::seconds(1);
    start();
    SenderClient silent = tcp();
    silent.receive(banner);
    SenderClient sender = tcp();
    sender.receive("]\r\n");
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    std::string heard;
    while (heard.find(banner) == std::string::npos && std::chrono::steady_clock::now() < until)
        heard += sender.ask("?", ">\r\n");
    EXPECT_THAT(heard, HasSubstr(banner));
    EXPECT_EQ(sender.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_THAT(silent.receive("accepted]\r\n"), HasSubstr("[MSG:Another sender has control."));
}

TEST_F(SenderPorts, DiscardTheRemainderOfALineWhoseBeginningWasIgnored) {
    start();
    auto silent = std::make_unique<SenderClient>(tcp());
    silent->receive(banner);
    SenderClient sender = tcp();
    sender.receive("]\r\n");
    EXPECT_THAT(sender.ask("?", ">\r\n"), StartsWith("<Idle|"));
    EXPECT_THAT(sender.ask("G1 F600 X5?", ">\r\n"), StartsWith("<Idle|"));
    silent.reset();
    EXPECT_EQ(sender.receive(banner), banner);
    sender.say("0 Y30\n");
    EXPECT_EQ(sender.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_THAT(sender.until("Idle|MPos:1.000"), HasSubstr("MPos:1.000,0.000"));
}

TEST_F(SenderPorts, ExecuteAResetInALineWhoseBeginningWasIgnoredAndTheLineBehindIt) {
    start();
    auto silent = std::make_unique<SenderClient>(tcp());
    silent->receive(banner);
    SenderClient sender = tcp();
    sender.receive("]\r\n");
    EXPECT_THAT(sender.ask("?", ">\r\n"), StartsWith("<Idle|"));
    EXPECT_THAT(sender.ask("G1 F600 X5?", ">\r\n"), StartsWith("<Idle|"));
    silent.reset();
    EXPECT_EQ(sender.receive(banner), banner);
    EXPECT_EQ(sender.ask("\x18", banner), banner);
    EXPECT_EQ(sender.ask("G1 X1 F600\n"), "ok\r\n");
    EXPECT_THAT(sender.until("Idle|MPos:1.000"), HasSubstr("MPos:1.000,0.000"));
}

TEST_F(SenderPorts, KeepTheSlotOfASenderThatReconnectsFreeOfObservers) {
    start();
    auto sender = std::make_unique<SenderClient>(tcp());
    sender->receive(banner);
    EXPECT_THAT(sender->ask("?", ">\r\n"), StartsWith("<Idle|"));
    SenderClient observer = tcp();
    observer.receive("]\r\n");
    EXPECT_THAT(observer.ask("?", ">\r\n"), StartsWith("<Idle|"));
    sender.reset();
    while (ports_->sender() != "none") std::this_thread::yield();
    EXPECT_THAT(observer.ask("?", ">\r\n"), StartsWith("<Idle|"));
    EXPECT_EQ(ports_->sender(), "none");
    SenderClient back = tcp();
    EXPECT_EQ(back.receive(banner), banner);
}

}  // namespace
}  // namespace motionrack::server
