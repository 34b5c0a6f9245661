// Tests of the twin against the numbers of the source and against RULES.md.
#include <gtest/gtest.h>

#include <iostream>
#include <motionrack/cards/grating_bus/test/random_bus.hpp>

namespace motionrack::grating_bus::twin {
namespace {

constexpr Ticks ns = 10;

/// Returns the count of a scale that moves one count in each 50 ns (20 MHz); the scales are 1,000,000 counts apart.
std::uint32_t moving(int scale, Ticks at) {
    return static_cast<std::uint32_t>(1'000'000 * scale + at / (50 * ns));
}

CardSettings host(int words) {
    CardSettings settings;
    settings.host = settings.clock_out = settings.address_out = true;
    settings.words = words;
    return settings;
}
CardSettings slave(int words) {
    CardSettings settings;
    settings.words = words;
    return settings;
}
DecoderSettings decoder(int scales) {
    DecoderSettings settings;
    settings.scales = scales;
    settings.count = moving;
    return settings;
}

/// Returns the instants at which the card entered one of the two states.
std::vector<Ticks> entered(const Twin& twin, int card, int state, int other) {
    std::vector<Ticks> out;
    for (const StateChange& change : twin.states(card))
        if (change.state == state || change.state == other) out.push_back(change.at);
    return out;
}

TEST(GratingTwin, FramesHaveTheDurationThatTheSourceStates) {
    for (const auto& [words, lasts] :
         std::vector<std::pair<int, Ticks>>{{1, 120}, {4, 450}, {8, 890}, {16, 1770}, {128, 14'090}}) {
        Twin twin({host(words)}, {decoder(128)});
        twin.run_to(150'000 * ns);
        EXPECT_EQ(twin.states(0)[1].at, 0);
        EXPECT_EQ(twin.states(0)[1].state, 1);
        EXPECT_EQ(twin.states(0).back().at, lasts * ns) << words;
        EXPECT_EQ(twin.states(0).back().state, 0);
        const std::vector<Ticks> samples = entered(twin, 0, 3, 9);
        ASSERT_EQ(samples.size(), static_cast<std::size_t>(words));
        for (int k = 0; k < words; ++k) EXPECT_EQ(samples[static_cast<std::size_t>(k)], (k * 110 + 50) * ns);
        ASSERT_EQ(twin.frames(0).size(), 1u);
        EXPECT_EQ(twin.frames(0)[0].at, (lasts - 10) * ns);
        EXPECT_TRUE(sound(twin.frames(0)[0].frame));
        for (int k = 0; k < words; ++k)
            EXPECT_EQ(twin.frames(0)[0].frame.counts[static_cast<std::size_t>(k)], moving(k, 0));
    }
}

TEST(GratingTwin, PassesTheStatesInTheOrderOfTheSource) {
    Twin twin({host(2)}, {decoder(2)});
    twin.run_to(1000 * ns);
    std::vector<std::pair<Ticks, int>> walked;
    for (const StateChange& change : twin.states(0)) walked.emplace_back(change.at / ns, change.state);
    EXPECT_EQ(walked, (std::vector<std::pair<Ticks, int>>{{0, 0},
                                                          {0, 1},
                                                          {20, 2},
                                                          {50, 3},
                                                          {80, 4},
                                                          {90, 5},
                                                          {100, 6},
                                                          {110, 7},
                                                          {130, 8},
                                                          {160, 9},
                                                          {190, 10},
                                                          {200, 5},
                                                          {210, 11},
                                                          {220, 12},
                                                          {230, 0}}));
}

TEST(GratingTwin, HostAndTenSlavesHoldTheCountsOfHold) {
    for (int slaves = 0; slaves <= 10; ++slaves) {
        std::vector<CardSettings> cards(static_cast<std::size_t>(slaves) + 1, slave(8));
        cards[0] = host(8);
        Twin twin(cards, {decoder(8)});
        twin.run_to(1'000'000 * ns);
        for (int card = 0; card <= slaves; ++card) {
            ASSERT_EQ(twin.frames(card).size(), 5u);
            for (std::size_t n = 0; n < 5; ++n) {
                const Frame& frame = twin.frames(card)[n].frame;
                EXPECT_EQ(frame.time, static_cast<Ticks>(n) * 200'000 * ns);
                EXPECT_EQ(frame.sequence, n);
                EXPECT_EQ(frame.counts[7], moving(7, frame.time));
                EXPECT_TRUE(same(frame, twin.frames(0)[n].frame));
            }
            EXPECT_EQ(twin.counters(card).broken, 0u);
        }
        EXPECT_TRUE(twin.conflicts().empty());
    }
}

TEST(GratingTwin, SamplesTheLinesAsTheyWereJustBeforeTheSample) {
    DecoderSettings slow = decoder(4);
    slow.output = 30 * ns;  // the data is output exactly at the instant of the sample
    Twin twin({host(4)}, {slow});
    twin.run_to(1000 * ns);
    const Frame& frame = twin.frames(0).at(0).frame;
    EXPECT_EQ(frame.counts[0], 0u);
    for (int k = 1; k < 4; ++k) EXPECT_EQ(frame.counts[static_cast<std::size_t>(k)], moving(k - 1, 0));
}

TEST(GratingTwin, SeveralHostsConflictAndTheLowLevelDominates) {
    CardSettings second = host(2);
    second.offset = 35 * ns;
    Twin twin({host(2), second}, {decoder(4)});
    twin.run_to(1000 * ns);
    ASSERT_FALSE(twin.conflicts().empty());
    const Conflict& conflict = twin.conflicts()[0];
    EXPECT_EQ(conflict.begin, 0);
    EXPECT_EQ(conflict.end, 35 * ns);
    EXPECT_EQ(conflict.line, clk);
    EXPECT_EQ(conflict.high, std::set<int>{0});
    EXPECT_EQ(conflict.low, std::set<int>{1});
    for (const LevelChange& change : twin.changes())
        if (change.line == clk && change.level == 1) {
            EXPECT_EQ(change.at, 35 * ns);
        }
    EXPECT_EQ(twin.counters(0).broken, 1u);
}

TEST(GratingTwin, AMissedEdgeCountsAndTheSequenceContinues) {
    Twin twin({host(1), slave(1)}, {decoder(1)});
    twin.run_to(100'000 * ns);
    twin.set_miss_edges(1, 3);
    twin.run_to(900'000 * ns);
    ASSERT_EQ(twin.frames(1).size(), 2u);
    EXPECT_EQ(twin.frames(1)[1].frame.sequence, 4u);
    EXPECT_TRUE(same(twin.frames(1)[1].frame, twin.frames(0)[4].frame));
    EXPECT_EQ(twin.counters(1).missed_edges, 3u);
    std::vector<std::pair<Ticks, bool>> stale;
    for (const StaleChange& change : twin.stale_changes(1)) stale.emplace_back(change.at / ns, change.stale);
    EXPECT_EQ(stale, (std::vector<std::pair<Ticks, bool>>{{110, false}, {400'000, true}, {800'110, false}}));
}

TEST(GratingTwin, AClaimedFrameIsNotOverwritten) {
    Twin twin({host(1)}, {decoder(1)});
    twin.claim(0);
    EXPECT_FALSE(twin.claimed(0));
    twin.run_to(300'000 * ns);
    twin.claim(0);
    EXPECT_EQ(twin.claimed_frame(0).sequence, 1u);
    twin.run_to(800'050 * ns);
    EXPECT_EQ(twin.claimed_frame(0).sequence, 1u);
    twin.claim(0);  // the twin is filling the other buffer
    EXPECT_EQ(twin.claimed_frame(0).sequence, 1u);
    twin.run_to(900'000 * ns);
    twin.claim(0);
    EXPECT_EQ(twin.claimed_frame(0).sequence, 4u);
}

TEST(GratingTwin, GivesTheSameResultsIfIdleInstantsAreSkipped) {
    constexpr std::uint64_t seed = 20'261'121;
    std::cout << "seed " << seed << std::endl;
    std::size_t published = 0, conflicts = 0, changes = 0, programs = 0;
    Counters sum;
    for (std::uint64_t number = 0; programs < 60; ++number) {
        const Program program = Maker(seed + number).make();
        if (program.end > 70'000) continue;
        ++programs;
        Twin twins[2] = {twin_of(program), twin_of(program, true)};
        for (Twin& twin : twins)
            for (const Op& op : program.ops) carry_out(twin, op);
        SCOPED_TRACE("program " + std::to_string(number) + "\n" + listing_of(program));
        for (int card = 0; card < static_cast<int>(program.cards.size()); ++card) {
            ASSERT_EQ(twins[0].frames(card), twins[1].frames(card));
            ASSERT_EQ(twins[0].states(card), twins[1].states(card));
            ASSERT_EQ(twins[0].stale_changes(card), twins[1].stale_changes(card));
            ASSERT_EQ(twins[0].counters(card), twins[1].counters(card));
            published += twins[0].frames(card).size();
            sum.broken += twins[0].counters(card).broken, sum.missed_words += twins[0].counters(card).missed_words;
            sum.alien += twins[0].counters(card).alien, sum.lines += twins[0].counters(card).lines;
            sum.missed_edges += twins[0].counters(card).missed_edges, sum.overrun += twins[0].counters(card).overrun;
        }
        ASSERT_EQ(twins[0].changes(), twins[1].changes());
        ASSERT_EQ(twins[0].conflicts(), twins[1].conflicts());
        conflicts += twins[0].conflicts().size();
        changes += twins[0].changes().size();
    }
    std::cout << published << " frames, " << conflicts << " conflicts, " << changes << " changes of lines; broken "
              << sum.broken << ", missed words " << sum.missed_words << ", alien " << sum.alien << ", lines "
              << sum.lines << ", missed edges " << sum.missed_edges << ", overrun " << sum.overrun << std::endl;
    EXPECT_GT(published, 100u);
    EXPECT_GT(conflicts, 100u);
    EXPECT_TRUE(sum.broken && sum.missed_words && sum.alien && sum.lines && sum.missed_edges && sum.overrun);
}

}  // namespace
}  // namespace motionrack::grating_bus::twin
