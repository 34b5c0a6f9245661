// Control lease, at times set by the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/auth/control_lease.hpp>

namespace motionrack::auth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class ControlLeaseTest : public testing::Test {
  protected:
    Moment now{};
    ControlLease lease{[this] { return now; }};
    Result<void> take(const char* user, const char* session, bool force = false, bool stands = true) {
        return lease.take(user, session, force, stands);
    }
};

TEST_F(ControlLeaseTest, IsFreeAtFirstAndGrantedToTheFirstClientThatRequestsIt) {
    EXPECT_FALSE(lease.holder());
    EXPECT_THAT(lease.check("a").error().message, HasSubstr("No user has control"));
    now += 3s;
    EXPECT_TRUE(take("anna", "a", false, false)) << "nobody is robbed of it";
    ASSERT_TRUE(lease.holder());
    EXPECT_EQ(lease.holder()->user, "anna");
    EXPECT_EQ(lease.holder()->session, "a");
    EXPECT_EQ(lease.holder()->since, 3.0);
    EXPECT_TRUE(lease.check("a"));
}

TEST_F(ControlLeaseTest, IsTakenOverByForceAtStandstillOnly) {
    ASSERT_TRUE(take("anna", "a"));
    EXPECT_THAT(take("bert", "b").error().message, HasSubstr("anna has it"));
    EXPECT_THAT(take("bert", "b", true, false).error().message, HasSubstr("has it and the machine moves"));
    EXPECT_TRUE(lease.check("a"));
    EXPECT_TRUE(take("bert", "b", true, true));
    EXPECT_THAT(lease.check("a").error().message, HasSubstr("Control is with bert"));
}

TEST_F(ControlLeaseTest, OfADisconnectedClientIsTakenOverByForceWhileTheMachineMoves) {
    lease.left("a");
    EXPECT_FALSE(lease.holder()) << "who had no control loses none";
    ASSERT_TRUE(take("anna", "a"));
    lease.left("b");
    EXPECT_FALSE(lease.holder()->left);
    lease.left("a");
    EXPECT_TRUE(lease.holder()->left);
    EXPECT_THAT(take("bert", "b", false, false).error().message, HasSubstr("anna has it"));
    EXPECT_TRUE(take("bert", "b", true, false));
    EXPECT_FALSE(lease.holder()->left);
}

TEST_F(ControlLeaseTest, OfAReconnectedClientIsNotTakenOverWhileTheMachineMoves) {
    ASSERT_TRUE(take("anna", "a"));
    lease.left("a");
    ASSERT_TRUE(lease.check("a"));
    EXPECT_FALSE(lease.holder()->left);
    EXPECT_THAT(take("bert", "b", true, false).error().message, HasSubstr("has it and the machine moves"));
}

TEST_F(ControlLeaseTest, EndsOnAStopOfAnotherClientButNotOfItsHolder) {
    ASSERT_TRUE(take("anna", "a"));
    EXPECT_FALSE(lease.revoke("anna", "a"));
    EXPECT_FALSE(lease.revoke("anna", "")) << "the same user, by HTTP";
    EXPECT_TRUE(lease.revoke("anna", "a2")) << "two pages of one user are two masters";
    EXPECT_FALSE(lease.holder());
    EXPECT_FALSE(lease.revoke("bert", "b")) << "there is nothing to end";
    ASSERT_TRUE(take("anna", "a"));
    EXPECT_TRUE(lease.revoke("", "")) << "of nobody who is known";
    EXPECT_THAT(lease.check("a").error().message, HasSubstr("Take control first"));
}

TEST_F(ControlLeaseTest, ExpiresTenSecondsAfterItsLastRenewal) {
    ASSERT_TRUE(take("anna", "a"));
    now += 9s;
    EXPECT_TRUE(lease.keep("a"));
    now += 9s;
    EXPECT_TRUE(lease.check("a")) << "whatever is ordered is a sign";
    EXPECT_FALSE(lease.check("b"));
    now += 9'999ms;
    EXPECT_TRUE(lease.holder());
    now += 1ms;
    EXPECT_FALSE(lease.holder());
    EXPECT_FALSE(lease.keep("a")) << "what is over does not come back by itself";
    EXPECT_TRUE(take("bert", "b", false, false)) << "it is nobody's, even while the machine moves";
}

TEST_F(ControlLeaseTest, IsReleasedByItsHolderOnly) {
    ASSERT_TRUE(take("anna", "a"));
    EXPECT_FALSE(lease.release("b"));
    EXPECT_TRUE(lease.release("a"));
    EXPECT_FALSE(lease.holder());
    EXPECT_FALSE(lease.release("a"));
}

TEST_F(ControlLeaseTest, ReturnsToTheUserWhoReloadsThePage) {
    ASSERT_TRUE(take("anna", "a1"));
    EXPECT_FALSE(take("anna", "a2", false, false)) << "two pages of one user are two masters";
    lease.left("a1");
    EXPECT_FALSE(take("bert", "b", false, false));
    EXPECT_TRUE(take("anna", "a2", false, false));
    EXPECT_TRUE(lease.check("a2"));
}

TEST_F(ControlLeaseTest, OfAnUnnamedUserIsNotGrantedToAnotherUnnamedUser) {
    ASSERT_TRUE(take("", "a"));
    lease.left("a");
    EXPECT_THAT(take("", "b", false, false).error().message, HasSubstr("another session"));
}

TEST_F(ControlLeaseTest, RequestedAgainByItsHolderIsKept) {
    ASSERT_TRUE(take("anna", "a"));
    now += 5s;
    ASSERT_TRUE(take("anna", "a", false, false));
    EXPECT_EQ(lease.holder()->since, 0.0);
    now += 6s;
    EXPECT_TRUE(lease.holder());
}

}  // namespace
}  // namespace motionrack::auth
