// Home switches that break or stick temporarily during homing: a position found with them is never valid.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/test/servo_helpers.hpp>

namespace motionrack::rack {
namespace {

using testing::HasSubstr;

/// A fault of the switch, injected after homing has been in `state` for `looks` polls of 50 ms.
struct Turn {
    std::string state;
    int looks;
    std::string fault;
};

HomingOutcome homed(const std::string& text, const std::string& target, int type, std::vector<Turn> turns) {
    Rack rack(good(text));
    rack.start();
    HomingSettings settings;
    settings.method = type;
    std::size_t next = 0;
    int looks = 0;
    settings.progress = [&](const HomingProgress& p) {
        if (next == turns.size()) return;
        looks = homing_states_text(p.states) == "X " + turns[next].state ? looks + 1 : 0;
        if (looks < turns[next].looks) return;
        EXPECT_TRUE(inject_fault(rack, turns[next].fault, target));
        ++next;
        looks = 0;
    };
    HomingOutcome out = home_axes(rack, settings);
    EXPECT_EQ(next, turns.size()) << "not all that should break has broken; " << homing_text(out);
    return out;
}

/// Returns a rack file of an axis with a switch at 1 mm, a backoff velocity of 2 mm/s and a latch velocity of 0.5 mm/s.
std::string axis_from(double start_mm, const std::string& more = {}) {
    return fmt::format(
        "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = "
        "{}\n[axis.X.switches]\n"
        "limit_minus_mm = -8\nlimit_plus_mm = 302\nhome_mm = 1\n{}[axis.X.homing]\nhome_offset_mm = 0\n",
        start_mm, more);
}

void expect_refused(const HomingOutcome& out, const char* why) {
    ASSERT_FALSE(out.ended) << homing_text(out);
    EXPECT_EQ(out.ended.error().kind, ErrorKind::machine);
    EXPECT_THAT(out.ended.error().message, HasSubstr("is not sound: it became active"));
    EXPECT_THAT(out.ended.error().message, HasSubstr(why)) << homing_text(out);
    EXPECT_THAT(out.ended.error().message, HasSubstr("not valid"));
    EXPECT_FALSE(out.all_homed());
}

class HomeSwitch : public testing::TestWithParam<int> {
  protected:
    bool twice() const { return GetParam() % 2 == 0; }
    const char* approach() const { return twice() ? "SLOW_WAIT" : "SEARCH_WAIT"; }
};
INSTANTIATE_TEST_SUITE_P(Types, HomeSwitch, testing::Values(1, 2, 3, 4));

TEST_P(HomeSwitch, ThatBreaksDuringTheReleaseAndRecoversIsNotHome) {
    expect_refused(
        homed(axis_from(0), "X", GetParam(),
              {{"BACK_WAIT", 4, "home.stuck_open"}, {approach(), twice() ? 10 : 2, "home.stuck_open=0"}}),
        "beyond the position at which it was released in this search; a sound switch deviates by at most 0.07");
}

class HomeSwitchComingTwice : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, HomeSwitchComingTwice, testing::Values(2, 4));

TEST_P(HomeSwitchComingTwice, ThatBreaksAfterTheSearchApproachIsNotHome) {
    expect_refused(homed(axis_from(7), "X", GetParam(),
                         {{"BACK_WAIT", 1, "home.stuck_open"}, {"SLOW_WAIT", 10, "home.stuck_open=0"}}),
                   "beyond the position at which it");
}

TEST_P(HomeSwitchComingTwice, ThatBreaksBeforeTheLatchApproachIsNotHome) {
    expect_refused(homed(axis_from(0), "X", GetParam(),
                         {{"SLOW_WAIT", 1, "home.stuck_open"}, {"SLOW_WAIT", 14, "home.stuck_open=0"}}),
                   "beyond the position at which it was released");
}

TEST_P(HomeSwitchComingTwice, ThatSticksDuringTheReleaseIsNotHome) {
    expect_refused(homed(axis_from(0), "X", GetParam(),
                         {{"BACK_WAIT", 4, "home.stuck_closed"}, {"BACK_WAIT", 20, "home.stuck_closed=0"}}),
                   "beyond the position at which it was released");
}

TEST_P(HomeSwitchComingTwice, ThatClosesDuringTheLatchApproachIsNotHome) {
    expect_refused(homed(axis_from(0) + "backoff_mm = 1\n", "X", GetParam(), {{"SLOW_WAIT", 12, "home.stuck_closed"}}),
                   "before the position at which it was released");
    expect_refused(
        homed(axis_from(7, "hysteresis_mm = 1\n"), "X", GetParam(), {{"SLOW_WAIT", 12, "home.stuck_closed"}}),
        "before the position at which it became active in this search");
}

TEST_P(HomeSwitchComingTwice, ThatClosesFarBeforeItsPositionForAWhileIsNotHome) {
    expect_refused(homed(axis_from(20), "X", GetParam(),
                         {{"SEARCH_WAIT", 3, "home.stuck_closed"}, {"BACK_WAIT", 1, "home.stuck_closed=0"}}),
                   "beyond the position at which it was released");
}

TEST_P(HomeSwitchComingTwice, ThatIsSoundAgainBeforeTheNextApproachIsHome) {
    const HomingOutcome out = homed(axis_from(0) + "search_velocity_mm_s = 2\nbackoff_mm = 0.4\n", "X", GetParam(),
                                    {{"BACK_WAIT", 4, "home.stuck_open"}, {"CLEAR_WAIT", 1, "home.stuck_open=0"}});
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_NEAR(out.axes[0].machine_position, GetParam() == 2 ? 1 : 0, 1e-9);
}

TEST(SoundHomeSwitch, OfAnyKindIsHome) {
    for (const double start : {0.0, 0.9, 1.02, 1.3, 7.0, 60.0})
        for (const char* more : {"hysteresis_mm = 0\n", "hysteresis_mm = 0.4\n", "bounce_ms = 0\n", "bounce_ms = 4\n"})
            for (const char* keys : {"", "search_velocity_mm_s = 100\n", "search_direction = \"plus\"\n"})
                for (int type = 1; type <= 2; ++type) {
                    const HomingOutcome out = homed(axis_from(start, more) + keys, "X", type, {});
                    EXPECT_TRUE(out.ended)
                        << start << ' ' << more << keys << "type " << type << ": " << homing_text(out);
                    EXPECT_EQ(out.axes[0].lost_pulses, 0) << "where it turned";
                }
}

// ---- a card that positions by itself: its reference is active where the wire is broken

std::string carriage_from(double start_mm) {
    std::string out =
        carriage("",
                 "[axis.X.homing]\nsearch_direction = \"plus\"\nsearch_velocity_mm_s = 10\nlatch_velocity_mm_s = 2\n"
                 "backoff_mm = 3\nhome_offset_mm = 128\n");
    const std::string_view before = "initial_position_mm = 100";
    return out.replace(out.find(before), before.size(), fmt::format("initial_position_mm = {}", start_mm));
}

class HomeReference : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, HomeReference, testing::Values(1, 2, 3, 4));

TEST_P(HomeReference, ThatSticksDuringTheReleaseIsNotHome) {
    expect_refused(
        homed(carriage_from(127), "board", GetParam(), {{"BACK", 1, "ref.broken"}, {"BACK", 8, "ref.broken=0"}}),
        "beyond the position at which it was released");
}

TEST_P(HomeReference, ThatActsBeforeItsPositionIsNotHome) {
    expect_refused(
        homed(carriage_from(127), "board", GetParam(), {{GetParam() % 2 == 0 ? "SLOW" : "SEARCH", 2, "ref.broken"}}),
        "before the position at which it was released");
}

TEST(HomeReferenceTwice, ThatActedFarBeforeItsPositionIsNotHome) {
    expect_refused(homed(carriage_from(110), "board", 2, {{"SEARCH", 3, "ref.broken"}, {"BACK", 1, "ref.broken=0"}}),
                   "beyond the position at which it was released");
}

}  // namespace
}  // namespace motionrack::rack
