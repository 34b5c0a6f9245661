// Edges of sound and faulty switches.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/base/switch_edges.hpp>

namespace motionrack {
namespace {

std::string words(const std::optional<EdgeConflict>& conflict) {
    return conflict ? conflict->text([](double distance) { return fmt::format("{:.2f}", distance); }) : std::string();
}

SwitchEdges edges(std::optional<double> hysteresis = 5) {
    SwitchEdges out;
    out.begin(hysteresis, 2);
    return out;
}

TEST(SwitchEdges, OfASoundSwitchAreWithinTolerance) {
    SwitchEdges search = edges();
    EXPECT_FALSE(search.acted(109, 12)) << "the first one has nothing to agree with";
    search.released(95, 0);
    EXPECT_FALSE(search.acted(100, 0));
    search.released(93, 3);
    EXPECT_FALSE(search.acted(104, 3)) << "as far apart as looks, hysteresis and contacts explain";
}

TEST(SwitchEdges, FarBeyondOrBeforeTheReleaseAreReported) {
    SwitchEdges search = edges();
    search.released(95, 0);
    EXPECT_EQ(words(search.acted(102.5, 0)),
              "it became active 7.50 beyond the position at which it was released in this search; a sound switch "
              "deviates by at most 7.00");
    search = edges();
    search.released(95, 3);
    EXPECT_EQ(words(search.acted(92, 0)),
              "it became active 3.00 before the position at which it was released in this search; a sound switch "
              "deviates by at most 2.00");
}

TEST(SwitchEdges, AreComparedWithThePreviousApproach) {
    for (const double second : {96.5, 103.5}) {
        SwitchEdges search = edges();
        EXPECT_FALSE(search.acted(101, 2));
        search.released(95, 0);
        EXPECT_EQ(search.acted(second, 0).has_value(), second < 98 || second > 103) << second;
    }
    SwitchEdges search = edges(20);
    EXPECT_FALSE(search.acted(100, 0));
    search.released(80, 0);
    EXPECT_EQ(words(search.acted(90, 0)),
              "it became active 10.00 before the position at which it became active in this search; a sound switch "
              "deviates by at most 2.00");
}

TEST(SwitchEdges, OfALongBounceAreReleasedFromItsFirstToItsLastPosition) {
    for (const double acts : {100.0, 88.0, 92.0}) {
        SwitchEdges search = edges();
        search.released(95, 0);
        search.released(90, 0);
        EXPECT_FALSE(search.acted(acts, 0)) << acts;
    }
}

TEST(SwitchEdges, AreNotComparedIfTheHysteresisIsUnknown) {
    SwitchEdges search = edges(std::nullopt);
    search.released(95, 0);
    EXPECT_FALSE(search.acted(1000, 0));
}

}  // namespace
}  // namespace motionrack
