// A STOP discards the pending lines of a sender at a port.
#include <gmock/gmock.h>

#include "sender_ports.hpp"

namespace motionrack::server {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Parameter: true: sender at the pseudo-terminal; false: at the TCP port.
class StoppedSenderPort : public SenderPorts, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Over, StoppedSenderPort, testing::Bool(),
                         [](const auto& each) { return each.param ? "TheTerminal" : "Tcp"; });

TEST_P(StoppedSenderPort, ExecutesNoFurtherLineAfterAStop) {
    start();
    const auto pulses = [this] {
        std::promise<std::int64_t> out;
        machine_->post([&] { out.set_value(machine_->status().axes[0].pulses); });
        return out.get_future().get();
    };
    SenderClient client = GetParam() ? terminal() : tcp();
    client.receive(banner);
    client.say("G91 G1 X5 F600\nG4 P100000\nG1 X5\nG1 X5\n");
    EXPECT_THAT(client.until("Run|MPos:5.000"), HasSubstr("<Run|MPos:5.000"));
    machine_->post([this] { machine_->stop({"anna", "192.168.1.5", "STOP"}); });
    EXPECT_THAT(client.receive("]\r\n"), StartsWith("ALARM:3\r\n[MSG:STOP by anna (192.168.1.5): line "));
    while (state() != operate::MachineState::error_stop) std::this_thread::yield();
    const std::int64_t stood = pulses();
    client.say("G1 X5\n~G1 X5\n");
    for (int line = 0; line < 5; ++line)
        EXPECT_EQ(client.receive("error:9\r\n"), "error:9\r\n") << "the dwell, and the lines behind it";
    EXPECT_THAT(client.ask("?", ">\r\n"), StartsWith("<Alarm|MPos:5.000,0.000"));
    EXPECT_EQ(pulses(), stood);
}

}  // namespace
}  // namespace motionrack::server
