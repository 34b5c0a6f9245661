// Invariants of the validator on a lossy, reordering network with several sources, and of the pacer.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <motionrack/dds/frame_pacer.hpp>
#include <motionrack/dds/test/samples.hpp>
#include <set>

namespace motionrack::dds {
namespace {

RC_GTEST_PROP(FrameValidatorProperty, EveryNumberIsUsedLateOrLost, ()) {
    // Frames as they arrive from a network that loses, duplicates and slightly reorders them.
    const int frames = *rc::gen::inRange(1, 200);
    const auto start = *rc::gen::arbitrary<std::uint32_t>();
    struct Arrival {
        int place, number;
    };
    std::vector<Arrival> arrivals;
    for (int i = 0; i < frames; ++i) {
        const int copies = *rc::gen::element(0, 1, 1, 1, 1, 2);
        for (int c = 0; c < copies; ++c) arrivals.push_back({i + *rc::gen::element(0, 0, 0, 1, 5, 30), i});
    }
    RC_PRE(!arrivals.empty());
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const Arrival& a, const Arrival& b) { return a.place < b.place; });
    FrameValidator judge;
    const PublisherIdentity source = source_named(1);
    Instant now{};
    std::set<int> seen;
    int newest = arrivals.front().number;
    const int oldest = newest;
    std::uint64_t duplicates = 0;
    for (const Arrival& arrival : arrivals) {
        Sample sample = sample_of(source, start + static_cast<std::uint32_t>(arrival.number));
        sample.frame.time = (arrival.number + 1) * period.count();
        seal(sample);
        const Validation verdict = judge.take(sample, now += period);
        // The validator started after such a frame was sent, so the frame is late each time it arrives.
        const bool known = arrival.number >= oldest, again = known && !seen.insert(arrival.number).second;
        duplicates += again ? 1 : 0;
        const Validation expected = again                                                     ? Validation::duplicate
                                    : arrival.number > newest || judge.counts().received == 1 ? Validation::used
                                                                                              : Validation::late;
        RC_ASSERT(verdict == expected);
        newest = std::max(newest, arrival.number);
        RC_ASSERT(judge.frame().sequence == start + static_cast<std::uint32_t>(newest));
    }
    const Counts& counts = judge.counts();
    RC_ASSERT(counts.lost == static_cast<std::uint64_t>(newest - oldest + 1) - seen.size());
    RC_ASSERT(counts.duplicates == duplicates);
    RC_ASSERT(counts.used + counts.late + counts.duplicates == arrivals.size());
}

RC_GTEST_PROP(FrameValidatorProperty, OnlySoundFramesOfTheSourceThatHasTheBusAreUsed, ()) {
    FrameValidator judge;
    Instant now{};
    std::uint32_t number = 0;
    const int steps = *rc::gen::inRange(1, 300);
    for (int i = 0; i < steps; ++i) {
        const auto id = *rc::gen::element<std::uint8_t>(1, 1, 1, 2, 3);
        Sample sample =
            sample_of(source_named(id), number += *rc::gen::element<std::uint32_t>(1, 1, 1, 0, 3, 0xFFFF'FFFD));
        const bool damaged = *rc::gen::element(false, false, true);
        if (damaged) sample.frame.counts[*rc::gen::inRange<std::size_t>(0, 6)] ^= 1U << *rc::gen::inRange(0, 32);
        now += *rc::gen::element(period, period, Duration{0}, milliseconds(700));
        const PublisherIdentity before = judge.source();
        const bool had = judge.joined();
        const std::uint64_t followed = judge.counts().restarts + judge.counts().takeovers;
        const Validation verdict = judge.take(sample, now);
        if (damaged) RC_ASSERT(verdict == Validation::wrong_crc);
        if (verdict == Validation::used) {
            RC_ASSERT(same(judge.frame(), sample.frame));
            RC_ASSERT(judge.source() == sample.source);
            RC_ASSERT(!judge.stale());
        }
        if (had && !(judge.source() == before))
            RC_ASSERT(judge.counts().restarts + judge.counts().takeovers == followed + 1);
    }
    const Counts& c = judge.counts();
    RC_ASSERT(c.used + c.duplicates + c.late + c.jumps + c.wrong_crc + c.foreign + c.malformed + c.wrong_words +
                  c.other_source ==
              c.received);
}

TEST(FramePacer, AccumulatesNoRoundingErrors) {
    FramePacer pacer(1, period);
    const Instant begin = whole_seconds(77);
    for (int i = 0; i < 100'000; ++i)
        ASSERT_EQ(pacer.due(milliseconds(1) + i * period, begin + (i == 0 ? Duration{0} : i * period + Duration{3})),
                  begin + i * period);
    EXPECT_EQ(pacer.late(), 0u);
    EXPECT_EQ(pacer.max_lateness(), Duration{3});
}

TEST(FramePacer, ScalesTimeAndCatchesUpAfterADelay) {
    FramePacer slow(0.1, 10 * period);
    slow.due(Instant{0}, whole_seconds(1));
    EXPECT_EQ(slow.due(milliseconds(1), whole_seconds(1)), whole_seconds(1) + milliseconds(10));
    FramePacer quick(4, period / 4);
    quick.due(Instant{0}, whole_seconds(1));
    EXPECT_EQ(quick.due(milliseconds(4), whole_seconds(1)), whole_seconds(1) + milliseconds(1));
}

TEST(FramePacer, CountsLateFramesAndDoesNotCatchUpAfterASecond) {
    FramePacer pacer(1, period);
    pacer.due(Instant{0}, Instant{0});
    EXPECT_EQ(pacer.due(period, 3 * period), period) << "at once, and the schedule stands";
    EXPECT_EQ(pacer.late(), 1u);
    EXPECT_EQ(pacer.due(2 * period, whole_seconds(9)), whole_seconds(9));
    EXPECT_EQ(pacer.slips(), 1u);
    EXPECT_EQ(pacer.due(3 * period, whole_seconds(9)), whole_seconds(9) + period);
    EXPECT_EQ(pacer.late(), 2u);
}

TEST(BusName, IsShortAndPlain) {
    for (const char* good : {"stage", "A-1_b", "7"}) EXPECT_TRUE(check_bus_name(good)) << good;
    EXPECT_TRUE(check_bus_name(std::string(64, 'x')));
    for (const char* bad : {"", "a b", "*", "st?ge", "a/b", "a,b", "\xc3\xa4"})
        EXPECT_FALSE(check_bus_name(bad)) << bad;
    const auto long_name = check_bus_name(std::string(65, 'x'));
    ASSERT_FALSE(long_name);
    EXPECT_EQ(long_name.error().message,
              "The bus name has 65 characters, but must have 1 to 64. Nothing was opened; choose another name.");
    EXPECT_EQ(
        check_bus_name("ab*d").error().message,
        "Character 3 of the bus name is not one of letters, digits, '_' and '-'. Nothing was opened; choose another "
        "name.");
}

TEST(Domain, Is0To232) {
    EXPECT_TRUE(check_domain(0));
    EXPECT_TRUE(check_domain(232));
    EXPECT_FALSE(check_domain(-1));
    EXPECT_FALSE(check_domain(233));
}

TEST(NewSource, HasAUniqueIdentity) {
    const PublisherIdentity a = new_source(), b = new_source();
    EXPECT_FALSE(a == b);
    EXPECT_EQ(a.id_text().size(), 32u);
    EXPECT_FALSE(a.host_name().empty());
}

}  // namespace
}  // namespace motionrack::dds
