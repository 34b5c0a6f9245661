// The lease of a jog: how long the jog continues, its end, and that an ended jog stays ended.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

/// A machine whose virtual time advances `rate` seconds per second of wall-clock time.
struct AtRate {
    explicit AtRate(double rate_here) : rate(rate_here), o(two_axes(), settings()) {}
    MachineSettings settings() {
        MachineSettings out;
        out.wall = [this] { return o.machine ? from_seconds(to_seconds(o.machine->now()) / rate) : Instant{}; };
        return out;
    }
    double rate;
    Operated o;
};

class JogLeaseAtARate : public testing::TestWithParam<double> {};

TEST_P(JogLeaseAtARate, EndsAQuarterOfASecondOfRealTimeAfterItsLastRenewal) {
    const double rate = GetParam(), speed = 2;  // mm/s: stops immediately
    AtRate one(rate);
    for (int n = 0; n < 10; ++n)
        one.o.at((0.1 + 0.1 * n) * rate, [&](Machine& m) { EXPECT_TRUE(m.manual().jog('X', speed)); });
    one.o.run(2 * rate);
    EXPECT_THAT(one.o.states, testing::ElementsAre("disabled", "standstill", "jogging", "standstill"));
    EXPECT_NEAR(one.o.stood_since / rate, 1.25, 0.01 + 0.004 / rate);
    EXPECT_NEAR(one.o.x() - 10, speed * 1.15 * rate, speed * (0.01 * rate + 0.006));
}

INSTANTIATE_TEST_SUITE_P(Rates, JogLeaseAtARate, testing::Values(0.1, 0.5, 1.0, 4.0, 30.0));

TEST(JogLease, EndsWithItsSessionAtOnce) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 2, {"a", 1})); });
    o.at(0.2, [](Machine& m) { m.manual().jogs().end_of("b"); });
    o.at(0.25, [](Machine& m) { m.manual().jogs().end_of("a"); });
    o.run(1);
    EXPECT_GT(o.stood_since, 0.249) << "another session that ends changes nothing";
    EXPECT_LT(o.stood_since, 0.26);
}

TEST(JogLease, OfOneSessionOutlivesTheEndOfAnother) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.manual().jog('X', 2, {"a", 1}));
        EXPECT_TRUE(m.manual().jog('Y', 2, {"b", 1}));
    });
    o.at(0.2, [](Machine& m) { m.manual().jogs().end_of("a"); });
    o.run(1);
    EXPECT_NEAR(o.x(), 10.2, 0.03);
    EXPECT_NEAR(o.y(), 0.5, 0.03);
}

TEST(JogLease, ThatEndsBeforeItsStartMovesNothing) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.manual().jog('X', 2, {"a", 1}));
        m.manual().jogs().end_of("a");
    });
    o.run(1);
    EXPECT_EQ(o.x(), 10);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

TEST(JogLease, IsNotProlongedByARenewalThatIsOlderThanTheStop) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 2, {"a", 1})); });
    o.at(0.2, [](Machine& m) {
        EXPECT_TRUE(m.manual().jogs().see({"a", 4}));
        m.cancel();
    });
    o.at(0.201, [](Machine& m) {
        EXPECT_THAT(m.manual().jog('X', 2, {"a", 2, true}).error().message,
                    HasSubstr("sequence 2, but 4 came before it"));
    });
    o.at(0.4, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_THAT(m.manual().jog('X', 2, {"a", 3}).error().message, HasSubstr("sequence 3, but 4 came before it"));
        EXPECT_TRUE(m.manual().jog('X', 2, {"a", 5})) << "a newer one begins a new jog";
    });
    o.run(0.45);
    EXPECT_NEAR(o.x(), 10.3, 0.03);
}

TEST(JogLease, IsNotProlongedByAnOlderRenewalWithAnotherSpeed) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 2, {"a", 1})); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 1, {"a", 3, true})); });
    o.at(0.3, [](Machine& m) { EXPECT_FALSE(m.manual().jog('X', 2, {"a", 2, true})); });
    o.run(1);
    EXPECT_NEAR(o.stood_since, 0.45, 0.01);
    EXPECT_NEAR(o.x(), 10.45, 0.02);
}

TEST(JogLease, ThatOnlyRenewsMovesNothingAfterAStopFromElsewhere) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 2, {"a", 1})); });
    o.at(0.15, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 2, {"a", 2, true})); });
    o.at(0.2, [](Machine& m) { m.stop(); });
    for (double t = 0.25; t < 0.9; t += 0.05)
        o.at(t, [t](Machine& m) {
            const auto sequence = static_cast<std::int64_t>(t * 1000);
            EXPECT_THAT(m.manual().jog('X', 2, {"a", sequence, true}).error().message,
                        HasSubstr("the jog of axis X has ended"));
        });
    o.run(1);
    EXPECT_NEAR(o.x(), 10.2, 0.02);
    EXPECT_EQ(o.machine->state(), MachineState::error_stop) << "until a reset";
}

TEST(JogLease, ThatOnlyRenewsMovesNothingAfterTheEndOfTheTravel) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', -20, {"a", 1})); });
    for (int n = 2; n < 20; ++n)
        o.at(0.05 * n + 0.05, [n](Machine& m) { static_cast<void>(m.manual().jog('X', -20, {"a", n, true})); });
    o.run(2);
    EXPECT_THAT(o.states, testing::ElementsAre("disabled", "standstill", "jogging", "standstill"));
    EXPECT_DOUBLE_EQ(o.x(), 0);
    EXPECT_THAT(o.machine->status().reason, HasSubstr("the - soft limit was reached. Move it the other way."));
}

TEST(JogLease, OfTwoAxesIsReleasedOneByOne) {
    Operated o(two_axes());
    for (const double t : {0.1, 0.2, 0.3})
        o.at(t, [](Machine& m) {
            EXPECT_TRUE(m.manual().jog('X', 2));
            EXPECT_TRUE(m.manual().jog('Y', 2));
        });
    o.at(0.35, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 0)); });
    o.run(1);
    EXPECT_NEAR(o.x(), 10.5, 0.02);
    EXPECT_NEAR(o.y(), 0.9, 0.02);
}

}  // namespace
}  // namespace motionrack::operate
