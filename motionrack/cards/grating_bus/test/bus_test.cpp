// Tests of a host and slaves on one bus: they hold the same data, and faults have the documented effects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig.hpp"

namespace motionrack::grating_bus {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr Duration period = microseconds(200);
constexpr std::uint16_t stale_bit = 4;

/// Checks that the frames of all cards are equal, that each period has one, and that their counts are those of their
/// instants.
void expect_true_frames(const Crate& crate, std::size_t frames, int scales) {
    for (std::size_t card = 0; card < crate.cards.size(); ++card) {
        ASSERT_EQ(crate.heard(card).size(), frames) << "card " << card;
        for (std::size_t i = 0; i < frames; ++i) {
            const Frame& frame = crate.heard(card)[i].frame;
            ASSERT_TRUE(sound(frame));
            ASSERT_TRUE(same(frame, crate.heard(0)[i].frame)) << "card " << card << ", frame " << i;
            ASSERT_EQ(frame.sequence, i);
            ASSERT_EQ(frame.instant(), static_cast<std::int64_t>(i) * period);
            for (int k = 0; k < scales; ++k)
                ASSERT_EQ(frame.counts[static_cast<std::size_t>(k)],
                          static_cast<std::uint32_t>(crate.truth(k, frame.instant())))
                    << k;
        }
    }
}

class GratingBusOf : public testing::TestWithParam<int> {};

TEST_P(GratingBusOf, ManySlavesHaveTheFramesOfTheHostWhichAreTrueAtHold) {
    for (const bool watched : {false, true}) {
        Crate crate(crew(GetParam(), 6), 6);
        if (watched) crate.watch_wires();
        crate.run(20 * period - nanoseconds(1));
        expect_true_frames(crate, 20, 6);
        EXPECT_TRUE(crate.sentences().empty()) << crate.sentences()[0];
        EXPECT_EQ(crate.heard(0)[3].at, 3 * period + BusTiming{}.frame_time(6) - nanoseconds(10))
            << "complete on entering S12";
    }
}
INSTANTIATE_TEST_SUITE_P(Slaves, GratingBusOf, testing::Values(0, 1, 2, 5, 10, 30));

TEST(GratingBus, AFrameIsTheSameWithAndWithoutObservers) {
    for (const int scales : {1, 8, 128}) {
        Crate fast(crew(2, scales), scales), slow(crew(2, scales), scales), turning(crew(2, scales), scales);
        slow.watch_wires();
        for (int i = 0; i < 500; ++i) {
            const Duration step = nanoseconds(7'777);
            fast.run(step), slow.run(step), turning.run(step);
            turning.cards[0]->fault("miss_edge", 0, turning.kernel.now());  // a host refuses it: no effect
            turning.cards[1]->fault("late", 0, turning.kernel.now());       // the present frame continues
            for (const char* wire : {"bus.clk", "bus.hold", "bus.read_n", "bus.addr", "bus.data", "bus.data3",
                                     "c0.state", "c2.state", "c1.frame_done"})
                for (const Crate* crate : {&fast, &turning})
                    ASSERT_EQ(crate->kernel.level(crate->kernel.find_wire(wire)),
                              slow.kernel.level(slow.kernel.find_wire(wire)))
                        << wire << " at " << fast.kernel.now().count();
        }
        ASSERT_EQ(fast.heard(2).size(), slow.heard(2).size());
        ASSERT_EQ(turning.heard(2).size(), slow.heard(2).size());
        for (std::size_t i = 0; i < slow.heard(2).size(); ++i) {
            ASSERT_TRUE(same(fast.heard(2)[i].frame, slow.heard(2)[i].frame));
            ASSERT_TRUE(same(turning.heard(2)[i].frame, slow.heard(2)[i].frame));
            ASSERT_EQ(fast.heard(2)[i].at, slow.heard(2)[i].at);
        }
        EXPECT_LT(fast.kernel.events(), slow.kernel.events() / 3);
    }
}

TEST(GratingBus, ThreeHostsDisturbEachOtherAndTheBusReportsWhich) {
    std::vector<CardSettings> settings(3, host_settings());
    settings[1].offset = nanoseconds(37);
    settings[2].offset = nanoseconds(1'300);
    for (CardSettings& s : settings) s.verify_lines = false;
    Crate crate(settings);
    crate.run(10 * period);
    int wrong = 0, different = 0;
    for (std::size_t card = 0; card < 3; ++card)
        for (std::size_t i = 0; i < 10; ++i) {
            const Frame& frame = crate.heard(card)[i].frame;
            for (int k = 0; k < 4; ++k)
                wrong += frame.counts[static_cast<std::size_t>(k)] !=
                         static_cast<std::uint32_t>(crate.truth(k, frame.instant()));
            different += !std::equal(frame.positions().begin(), frame.positions().end(),
                                     crate.heard(0)[i].frame.positions().begin());
        }
    EXPECT_GT(wrong, 30);
    EXPECT_GT(different, 10);
    EXPECT_GT(crate.bus.lines().conflicts(Line::clk), 10u);
    EXPECT_GT(crate.bus.lines().conflicts(Line::addr), 10u);
    const Conflict& first = crate.bus.lines().conflict(0);
    EXPECT_EQ(first.begin, Instant{0});
    EXPECT_EQ(first.high & 2u, 2u) << "driver 1 is c0: the decoder was plugged first";
    EXPECT_EQ(first.low & 12u, 12u);
    EXPECT_EQ(first.end, nanoseconds(1'300)) << "when the last host's clk has risen, too";
    EXPECT_THAT(crate.sentences(),
                Contains(AllOf(HasSubstr("bus: at 0.0000000 s two cards drive clk at once, c0 high and c1 low"),
                               HasSubstr("one host"))));
}

TEST(GratingBus, HostsThatVerifyTheLinesPublishNoInvalidFrame) {
    std::vector<CardSettings> settings(3, host_settings());
    settings[1].offset = nanoseconds(37);
    settings[2].offset = nanoseconds(90);
    Crate crate(settings);
    crate.run(10 * period);
    for (std::size_t card = 0; card < 3; ++card)
        for (const Heard& heard : crate.heard(card))
            for (int k = 0; k < 4; ++k)
                EXPECT_EQ(heard.frame.counts[static_cast<std::size_t>(k)],
                          static_cast<std::uint32_t>(crate.truth(k, heard.frame.instant())));
    EXPECT_EQ(crate.heard(0).size(), 0u);
    EXPECT_GE(crate.cards[0]->counter(Card::broken), 9);
    EXPECT_TRUE(crate.status(0) & stale_bit);
}

TEST(GratingBus, ReadsTheSameFrameOnASlightlyLateSlaveAndNoneOnAVeryLateOne) {
    Crate crate(crew(2));
    crate.run(period);
    ASSERT_TRUE(crate.cards[1]->fault("late", 25, crate.kernel.now()));
    ASSERT_TRUE(crate.cards[2]->fault("late", 45, crate.kernel.now()));
    crate.run(10 * period);
    ASSERT_EQ(crate.heard(1).size(), crate.heard(0).size());
    const Frame &host = crate.heard(0)[5].frame, &late = crate.heard(1)[5].frame;
    EXPECT_TRUE(std::equal(host.positions().begin(), host.positions().end(), late.positions().begin()));
    EXPECT_EQ(late.instant(), host.instant() + nanoseconds(25)) << "by its time one sees that it is late";
    EXPECT_EQ(crate.heard(2).size(), 2u) << "the frame that was under way is the last one";
    EXPECT_GE(crate.cards[2]->counter(Card::missed_words), 36);
    EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c2"), HasSubstr("read_n was high"))));
    EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c2"), HasSubstr("stale"))));
}

TEST(GratingBus, ASlaveThatIsOneWordLateDetectsForeignAddresses) {
    Crate crate(crew(1));
    ASSERT_TRUE(crate.cards[1]->fault("late", 110, crate.kernel.now()));
    crate.run(5 * period);
    EXPECT_EQ(crate.heard(1).size(), 0u);
    EXPECT_EQ(crate.cards[1]->counter(Card::alien), 15);
    EXPECT_EQ(crate.cards[1]->counter(Card::missed_words), 5);
}

TEST(GratingBus, ASlaveThatMissesEdgesStaysSynchronousAndReportsThem) {
    Crate crate(crew(1));
    crate.run(5 * period - microseconds(50));
    ASSERT_TRUE(crate.cards[1]->fault("miss_edge", 3, crate.kernel.now()));
    crate.run(5 * period);
    ASSERT_EQ(crate.heard(1).size(), crate.heard(0).size() - 3);
    EXPECT_TRUE(same(crate.heard(1).back().frame, crate.heard(0).back().frame));
    EXPECT_EQ(crate.cards[1]->counter(Card::missed_edges), 3);
    EXPECT_THAT(crate.sentences(),
                Contains(HasSubstr("card c1: at 0.0012000 s no good frame for two periods since frame 4")));
    EXPECT_THAT(crate.sentences(), Contains(HasSubstr("3 edges of clk before frame 8 were missed")));
}

TEST(GratingBus, SlavesMarkTheirDataStaleWithinTwoPeriodsAfterTheHostStops) {
    Crate crate(crew(3));
    crate.run(5 * period + microseconds(30));
    ASSERT_TRUE(crate.cards[0]->fault("off", 1, crate.kernel.now()));
    const Instant gone = crate.kernel.now();
    crate.run_to(7 * period - Duration{1});
    for (const std::size_t slave : {1, 2, 3}) EXPECT_FALSE(crate.status(slave) & stale_bit);
    crate.run(Duration{1});
    EXPECT_LE(crate.kernel.now() - gone, 2 * period);
    for (const std::size_t slave : {1, 2, 3}) {
        EXPECT_TRUE(crate.status(slave) & stale_bit);
        EXPECT_TRUE(same(*crate.cards[slave]->last(), crate.heard(0).back().frame)) << "the last good frame is kept";
    }
    EXPECT_THAT(
        crate.sentences(),
        Contains(HasSubstr("card c3: at 0.0014000 s no good frame for two periods since frame 5 of 0.0010000 s")));
    ASSERT_TRUE(crate.cards[0]->fault("off", 0, crate.kernel.now()));
    crate.run(period + microseconds(10));
    for (const std::size_t slave : {1, 2, 3})
        EXPECT_FALSE(crate.status(slave) & stale_bit) << "in again with the next frame";
    EXPECT_EQ(crate.heard(1).back().frame.sequence, 8u) << "slaves count on";
    EXPECT_EQ(crate.heard(0).back().frame.sequence, 0u) << "the host begins anew";
}

TEST(GratingBus, AHostThatIsResetWithinAFrameLeavesNoHalfFrameAnywhere) {
    Crate crate(crew(2));
    crate.run(3 * period + nanoseconds(200));
    ASSERT_TRUE(crate.cards[0]->fault("reset", 1, crate.kernel.now()));
    crate.run(period - nanoseconds(200));
    for (const std::size_t card : {0, 1, 2}) EXPECT_EQ(crate.heard(card).size(), 3u);
    EXPECT_EQ(crate.cards[1]->counter(Card::broken), 1);
    crate.run(period);
    for (const std::size_t card : {0, 1, 2}) EXPECT_EQ(crate.heard(card).size(), 4u);
    EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c2"), HasSubstr("frame 3 was not published"))));
}

struct Stuck {
    const char* wire;
    int level;
    const char* says;
};
class GratingBusStuck : public testing::TestWithParam<Stuck> {};

TEST_P(GratingBusStuck, NoCardPublishesAWrongFrameAndCardsWithoutAFrameReportIt) {
    const Stuck& stuck = GetParam();
    Crate crate(crew(2));
    crate.run(4 * period + nanoseconds(100));
    crate.kernel.force(crate.kernel.find_wire(stuck.wire), stuck.level);
    crate.kernel.settle();
    crate.run(4 * period);
    const bool deaf = stuck.wire == std::string_view("bus.clk") && stuck.level == 1;  // only slaves need a rising clk
    for (std::size_t card = 0; card < 3; ++card) {
        for (const Heard& heard : crate.heard(card))
            for (std::size_t k = 0; k < 4; ++k)
                EXPECT_EQ(heard.frame.counts[k],
                          static_cast<std::uint32_t>(crate.truth(heard.frame.addresses[k], heard.frame.instant())));
        if (deaf && card == 0) continue;
        EXPECT_LE(crate.heard(card).size(), 5u);
        EXPECT_TRUE(crate.status(card) & stale_bit) << card;
        EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c" + std::to_string(card)), HasSubstr("stale"))));
    }
    if (*stuck.says) {
        EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c0"), HasSubstr(stuck.says))));
    }
    crate.kernel.release(crate.kernel.find_wire(stuck.wire));
    crate.kernel.settle();
    crate.run(3 * period);
    for (std::size_t card = 0; card < 3; ++card) {
        EXPECT_FALSE(crate.status(card) & stale_bit);
        EXPECT_TRUE(same(crate.heard(card).back().frame, crate.heard(0).back().frame));
    }
}
INSTANTIATE_TEST_SUITE_P(
    Lines, GratingBusStuck,
    testing::Values(Stuck{"bus.clk", 0, "clk, hold or read_n"}, Stuck{"bus.clk", 1, ""},
                    Stuck{"bus.hold", 0, "clk, hold or read_n"}, Stuck{"bus.read_n", 1, "read_n was high"},
                    Stuck{"bus.read_n", 0, "clk, hold or read_n"}, Stuck{"bus.addr0", 1, "another address"},
                    Stuck{"bus.addr1", 0, "another address"}, Stuck{"bus.addr", 2, "another address"}),
    [](const auto& one) {
        return std::string(one.param.wire).substr(4).append("_at_").append(std::to_string(one.param.level));
    });

TEST(GratingBus, AShifterTheWrongWayIsReportedAtTheStart) {
    std::vector<CardSettings> settings = crew(2);
    settings[2].clock_shifter = Shifter::out;
    Crate crate(settings);
    crate.run(5 * period);
    EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c2: at 0.0000000 s the card is set as a slave"),
                                                  HasSubstr("outwards"))));
    EXPECT_THAT(crate.sentences(), Contains(HasSubstr("two cards drive clk at once, c0 high and c2 low")));
    EXPECT_TRUE(crate.status(2) & 8);
    EXPECT_EQ(crate.heard(1).size(), 0u) << "clk cannot rise";
}

TEST(GratingBus, TheJitterOfTheClockIsInTheTimesAndNotInTheAgreement) {
    Crate crate(crew(3));
    ASSERT_TRUE(crate.cards[0]->fault("jitter", 20'000, crate.kernel.now()));
    crate.run(50 * period);
    std::int64_t min_delay = 1'000'000, max_delay = 0;
    for (std::size_t i = 0; i < 49; ++i) {
        const Frame& frame = crate.heard(0)[i].frame;
        const std::int64_t late = frame.time - static_cast<std::int64_t>(i) * period.count();
        min_delay = std::min(min_delay, late), max_delay = std::max(max_delay, late);
        for (std::size_t card = 1; card < 4; ++card) EXPECT_TRUE(same(crate.heard(card)[i].frame, frame));
        for (int k = 0; k < 4; ++k)
            EXPECT_EQ(frame.counts[static_cast<std::size_t>(k)],
                      static_cast<std::uint32_t>(crate.truth(k, frame.instant())));
    }
    EXPECT_GE(min_delay, 0);
    EXPECT_LE(max_delay, 200'000);
    EXPECT_GT(max_delay - min_delay, 100'000);
}

TEST(GratingBus, ADecoderThatDoesNotLatchGivesEveryWordAnInstantOfItsOwn) {
    Crate crate(crew(1));
    ASSERT_TRUE(crate.decoder->fault("no_latch", 1, crate.kernel.now()));
    crate.run(3 * period);
    const Frame& frame = crate.heard(1).back().frame;
    const BusTiming timing;
    for (int k = 0; k < 4; ++k) {
        const Instant out = frame.instant() + timing.sample_at(k) - timing.t2 + nanoseconds(20);
        EXPECT_EQ(frame.counts[static_cast<std::size_t>(k)], static_cast<std::uint32_t>(crate.truth(k, out))) << k;
    }
}

TEST(GratingBus, ARemoteCardHoldsOnlyFramesFromOutside) {
    std::vector<CardSettings> settings = crew(1);
    settings.push_back(slave_settings());
    settings[2].role = CardRole::remote;
    Crate crate(settings);
    crate.run(3 * period + microseconds(50));
    EXPECT_EQ(crate.heard(0).size(), 4u) << "it disturbs nobody";
    EXPECT_EQ(crate.heard(2).size(), 0u);
    EXPECT_EQ(crate.cards[2]->peek(offset("STATE")), 0);
    Frame frame;
    frame.words = 4;
    frame.sequence = 77;
    frame.time = 5;
    frame.counts = {1, 2, 3, 4};
    frame.crc = crc_of(frame);
    crate.cards[2]->take(frame, crate.kernel.now());
    EXPECT_TRUE(same(*crate.cards[2]->last(), frame));
    EXPECT_FALSE(crate.status(2) & stale_bit);
    Frame damaged = frame;
    damaged.counts[1] = 9;
    crate.cards[2]->take(damaged, crate.kernel.now());
    damaged.words = 3;
    damaged.crc = crc_of(damaged);
    crate.cards[2]->take(damaged, crate.kernel.now());
    EXPECT_TRUE(same(*crate.cards[2]->last(), frame)) << "neither is ever a position";
    EXPECT_EQ(crate.cards[2]->counter(Card::broken), 2);
    crate.run(2 * period - Duration{1});
    EXPECT_FALSE(crate.status(2) & stale_bit);
    crate.run(Duration{1});
    EXPECT_TRUE(crate.status(2) & stale_bit);
    EXPECT_THAT(crate.sentences(), Contains(AllOf(HasSubstr("card c2"), HasSubstr("CRC"))));
}

TEST(GratingBus, RejectsInconsistentTimingAndScaleCountsWithTheValues) {
    CardSettings s = host_settings(128);
    s.period = microseconds(10);
    EXPECT_THAT(check(s).error().message,
                AllOf(HasSubstr("14090.0 ns"), HasSubstr("128 scales"), HasSubstr("10000.0 ns")));
    DecoderSettings decoder;
    EXPECT_THAT(check(host_settings(5), decoder).error().message, HasSubstr("scales 0 to 4, but the decoder has 4"));
    decoder.latch = nanoseconds(21);
    EXPECT_THAT(check(host_settings(), decoder).error().message, HasSubstr("21.0 ns to latch"));
    decoder = {};
    decoder.output = nanoseconds(30);
    EXPECT_THAT(check(host_settings(), decoder).error().message, HasSubstr("T2 = 30.0 ns"));
    s = host_settings(0);
    EXPECT_FALSE(check(s));
    s = host_settings(129);
    EXPECT_THAT(check(s).error().message, HasSubstr("is 129; it must be 1 to 128"));
    s = host_settings(100);
    s.first = 29;
    EXPECT_FALSE(check(s));
    EXPECT_TRUE(check(host_settings(128))) << "14.09 us of 200 us";
}

}  // namespace
}  // namespace motionrack::grating_bus
