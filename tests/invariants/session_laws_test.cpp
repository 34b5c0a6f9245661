// Each law of sessions detects a history that violates it, and accepts the same one without the violation.
#include <gtest/gtest.h>

#include <tests/invariants/session_laws.hpp>

namespace motionrack::test {
namespace {

/// One axis with 100 pulses per mm, 100 mm/s, 1000 mm/s2 and a velocity step of 2 mm/s; a picture every 50 ms.
class Told {
  public:
    Told()
        : laws({{'X', 100, 100, 1000, 2}}, {0, {0}, {0}}, [this](const std::string& text) { said.push_back(text); }) {}

    /// Advances 50 ms: the axis receives `sent` pulses, and its counter changes by `counted`.
    SessionPicture& pass(std::int64_t sent, std::int64_t counted) {
        now.ns += 50'000'000;
        now.pulses[0] += sent;
        now.counters[0] += counted;
        return now;
    }
    SessionPicture& pass(std::int64_t sent) { return pass(sent, sent); }
    /// Runs a program that sends these pulses, one number per interval.
    void drive(const std::vector<std::int64_t>& sent, bool whole = true) {
        laws.begin_drive();
        for (const std::int64_t one : sent) laws.during_drive(pass(one));
        laws.end_drive(pass(0), true, whole);
    }

    SessionPicture now{0, {0}, {0}};
    std::vector<std::string> said;
    SessionLaws laws;
};

TEST(SessionLaws, ACounterChangesOnlyWithPulsesUnlessTheHostWroteIt) {
    Told told;
    told.laws.see(told.pass(40));
    told.laws.ordered();
    told.laws.see(told.pass(40, 5));
    EXPECT_TRUE(told.said.empty()) << told.said.front();
    told.laws.see(told.pass(40, 39));
    EXPECT_EQ(told.said,
              std::vector<std::string>{"axis X was sent 40 pulses and its counter went by 39, up to 150000000 ns"});
}

TEST(SessionLaws, ACounterOf32BitsWrapsWithItsPulses) {
    Told told;
    told.laws.see(told.pass(2'147'483'647, 2'147'483'647));
    told.laws.see(told.pass(1, -4'294'967'295));
    EXPECT_TRUE(told.said.empty()) << told.said.front();
}

TEST(SessionLaws, NothingMovesAfterAProgramUntilANewOrder) {
    Told told;
    told.drive({100, 100});
    told.laws.see(told.pass(0));
    told.laws.ordered();
    told.laws.see(told.pass(7));
    EXPECT_TRUE(told.said.empty()) << told.said.front();
    told.drive({100, 100});
    told.laws.see(told.pass(7));
    EXPECT_EQ(told.said, std::vector<std::string>{"axis X was sent 7 pulses without an order, up to 450000000 ns"});
}

TEST(SessionLaws, ARefusedProgramForbidsNoMotion) {
    Told told;
    told.laws.ordered();
    told.laws.see(told.pass(100));
    told.laws.begin_drive();
    told.laws.end_drive(told.pass(0), false, false);
    told.laws.see(told.pass(100));
    EXPECT_TRUE(told.said.empty()) << told.said.front();
}

TEST(SessionLaws, AProgramKeepsTheVelocity) {
    Told told;
    told.drive({200, 400, 500, 500, 400, 200});
    EXPECT_TRUE(told.said.empty()) << told.said.front();
    told.drive({200, 400, 560, 400, 200});
    EXPECT_EQ(told.said, std::vector<std::string>{"axis X went at 112 a second, above its 100"});
}

TEST(SessionLaws, AWholeProgramKeepsTheAccelerationAndAStoppedOneMayEndWithoutARamp) {
    Told told;
    told.drive({200, 470, 200, 0});
    told.drive({250, 500, 0}, false);
    EXPECT_TRUE(told.said.empty()) << told.said.front();
    told.drive({250, 500, 0});
    EXPECT_EQ(told.said.size(), 1u);
    EXPECT_NE(told.said.at(0).find("changed from 100 to 0 a second"), std::string::npos) << told.said.at(0);
}

TEST(SessionLaws, TimeNeverGoesBack) {
    Told told;
    told.laws.see(told.pass(0));
    told.now.ns -= 1;
    told.laws.see(told.now);
    EXPECT_EQ(told.said, std::vector<std::string>{"time went back from 50000000 ns to 49999999 ns"});
}

}  // namespace
}  // namespace motionrack::test
