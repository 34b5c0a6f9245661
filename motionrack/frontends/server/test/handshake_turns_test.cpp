// Order of TLS handshakes, without connections.
#include <gmock/gmock.h>

#include <deque>
#include <motionrack/frontends/server/handshake_turns.hpp>
#include <vector>

namespace motionrack::server {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class HandshakeTurnsTest : public testing::Test {
  protected:
    void wait(const std::string& network, const std::string& name, bool ended = false) {
        turns.wait(network, [this, name, ended] {
            if (!ended) begun.push_back(name);
            return !ended;
        });
    }
    /// Executes the work that was posted before this call.
    void work() {
        for (const auto& one : std::exchange(posted, {})) one();
    }

    std::deque<std::function<void()>> posted;
    std::vector<std::string> begun;
    HandshakeTurns turns{
        std::make_shared<NetworkExecutor>([this](std::function<void()> work) { posted.push_back(std::move(work)); })};
};

TEST_F(HandshakeTurnsTest, BeginOneAtATimeBetweenOtherWork) {
    wait("a", "a1");
    wait("a", "a2");
    EXPECT_EQ(posted.size(), 1u);
    EXPECT_THAT(begun, IsEmpty());
    work();
    EXPECT_THAT(begun, ElementsAre("a1"));
    work();
    EXPECT_THAT(begun, ElementsAre("a1", "a2"));
    EXPECT_THAT(posted, IsEmpty());
    wait("a", "a3");
    work();
    EXPECT_THAT(begun, ElementsAre("a1", "a2", "a3"));
}

TEST_F(HandshakeTurnsTest, GiveEachNetworkItsTurn) {
    for (int i = 1; i <= 100; ++i) wait("flood", "f" + std::to_string(i));
    work();
    wait("operator", "STOP");
    wait("another", "page");
    work();
    work();
    work();
    EXPECT_THAT(begun, ElementsAre("f1", "STOP", "page", "f2"));
}

TEST_F(HandshakeTurnsTest, SkipConnectionsThatHaveEnded) {
    for (int i = 0; i < 100; ++i) wait("flood", "f", true);
    wait("flood", "last");
    work();
    EXPECT_THAT(begun, ElementsAre("last"));
    EXPECT_THAT(posted, IsEmpty());
}

}  // namespace
}  // namespace motionrack::server
