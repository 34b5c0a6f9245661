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

// A segment of two pulses that is cut for a deceleration may have one of them by rounding. That pulse is over before
// the next segment arrives, so such a move is not cut.
TEST(LosslessAtRandom, NoAxisExceedsItsMaxVelocityStepWhereASegmentHasFewPulses) {
    for (const std::uint64_t seed : {732885138, 732887488}) drive_one(seed);
}

// A segment of the chip that is longer than one merged line ends on the next: the moves after that count from the one
// that the machine has reached.
TEST(LosslessAtRandom, TheMachineIsOnItsPathWhereSegmentsAreLongerThanMergedLines) {
    drive_one(900001341);
}

// The motion of an axis in one chord differs from the previous one.
TEST(LosslessAtRandom, AStopAtTheBeginOfAChordKeepsThePosition) {
    drive_one(864005568);
}

// A line behind an arc may have more axes, and so a higher velocity at the pulse rate of the arc.
TEST(LosslessAtRandom, AnArcSlowsEnoughForALineOfMoreAxes) {
    drive_one(771007604, Arcs::some);
}

// A short arc or line has fewer pulses than its length where both its ends are rounded, or where an arc before it ends
// beside its target.
TEST(LosslessAtRandom, NoSegmentIsLateWhereAMoveHasFewPulses) {
    for (const std::uint64_t seed : {658757350, 658759820}) drive_one(seed, Arcs::some);
}

// After a resume on an arc, the acceleration takes the motion a little above the velocities of its plan.
TEST(LosslessAtRandom, AStopSlowsWhereAMotionAcceleratesOnAnArc) {
    drive_one(658757033, Arcs::some);
}

// A segment with one pulse of an axis gives it a high rate for a fraction of a millisecond, and the next has none of
// it.
TEST(LosslessAtRandom, AStopInAShallowChordKeepsThePosition) {
    for (const std::uint64_t seed : {445961594, 771004124}) drive_one(seed, Arcs::some);
}

// A restart in a segment that brakes: the velocity at its end would be crept at along all of it.
TEST(LosslessAtRandom, ALateHostDoesNotCreepThroughASegmentThatBrakes) {
    drive_late(990003636);
}

}  // namespace
}  // namespace motionrack::rack
