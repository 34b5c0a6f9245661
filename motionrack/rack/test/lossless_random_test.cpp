// Random programs of the daily tests; more of them in deep/lossless_deep_test.cpp.
#include "lossless_random.hpp"

namespace motionrack::rack {
namespace {

constexpr std::uint64_t shares = 8;
class LosslessAtRandom : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Share, LosslessAtRandom, testing::Range<std::uint64_t>(0, shares));

TEST_P(LosslessAtRandom, NoAxisExceedsItsMaxVelocityStepWhateverIsCommandedOnTheWay) {
    drive_share(GetParam(), shares, 200, drive_disturbed);
}

TEST_P(LosslessAtRandom, ALateHostCostsTimeAndNoPulse) {
    drive_share(GetParam(), shares, 40, drive_late);
}

// Rounding may leave one pulse of a segment of two pulses that is cut for a deceleration. That pulse is over before the
// next segment arrives, so the planner does not cut such a move.
TEST(LosslessAtRandom, NoAxisExceedsItsMaxVelocityStepWhereASegmentHasFewPulses) {
    for (const std::uint64_t seed : {732885138, 732887488}) drive_one(seed);
}

// A segment of the chip that is longer than one merged line ends on the next line. The following moves count from the
// line that the machine has reached.
TEST(LosslessAtRandom, TheMachineIsOnItsPathWhereSegmentsAreLongerThanMergedLines) {
    drive_one(900001341);
}

// The velocity of an axis in the chord differs from that in the previous one.
TEST(LosslessAtRandom, AStopAtTheBeginOfAChordKeepsThePosition) {
    drive_one(864005568);
}

// A line after an arc may move more axes and so have a higher velocity at the pulse rate of the arc.
TEST(LosslessAtRandom, AnArcSlowsEnoughForALineOfMoreAxes) {
    drive_one(771007604, Arcs::some);
}

// A short arc or line has fewer pulses than its length suggests if both its ends are rounded, or if an arc before it
// ends beside its target.
TEST(LosslessAtRandom, NoSegmentIsLateWhereAMoveHasFewPulses) {
    for (const std::uint64_t seed : {658757350, 658759820}) drive_one(seed, Arcs::some);
}

// After a resume on an arc, the acceleration raises the velocity slightly above that of the plan.
TEST(LosslessAtRandom, AStopSlowsWhereAMotionAcceleratesOnAnArc) {
    drive_one(658757033, Arcs::some);
}

// A segment with one pulse of an axis gives this axis a high rate for a fraction of a millisecond; the next segment has
// no pulse of it.
TEST(LosslessAtRandom, AStopInAShallowChordKeepsThePosition) {
    for (const std::uint64_t seed : {445961594, 771004124}) drive_one(seed, Arcs::some);
}

// After a restart within a decelerating segment, the whole segment must not run at the low velocity of its end.
TEST(LosslessAtRandom, ALateHostDoesNotCreepThroughASegmentThatBrakes) {
    drive_late(990003636);
}

}  // namespace
}  // namespace motionrack::rack
