// Tests of addresses: the seven lines, the lists of scales, and the roles of host and slaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "rig.hpp"

namespace motionrack::grating_bus {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr Duration frame_period = microseconds(200);

TEST(GratingBus, SevenLinesAddress128Scales) {
    Crate crate(crew(1, 128), 128);
    EXPECT_NE(crate.kernel.find_wire("bus.addr6"), sim::WireId::none);
    EXPECT_EQ(crate.kernel.find_wire("bus.addr7"), sim::WireId::none);
    EXPECT_EQ(crate.kernel.level(crate.kernel.find_wire("bus.addr")), 0x7F) << "at rest";
    crate.run(2 * frame_period - nanoseconds(1));
    for (const std::size_t card : {0, 1}) {
        ASSERT_EQ(crate.heard(card).size(), 2u);
        for (int k = 0; k < 128; ++k)
            ASSERT_EQ(crate.heard(card)[1].frame.counts[static_cast<std::size_t>(k)],
                      static_cast<std::uint32_t>(crate.truth(k, crate.heard(card)[1].frame.instant())));
    }
    EXPECT_FALSE(check(host_settings(129)));
}

TEST(GratingBus, AnyListOfAddressesIsReadInItsOrder) {
    const std::vector<int> list = {5, 2, 9, 127};
    for (const bool watched : {false, true}) {
        std::vector<CardSettings> settings = crew(2);
        for (CardSettings& s : settings) s.addresses = list;
        Crate crate(settings, 128);
        if (watched) crate.watch_wires();
        crate.run(frame_period + nanoseconds(20) + BusTiming{}.word_time());
        for (const int address : {2, 9, 127}) {
            EXPECT_EQ(crate.kernel.level(crate.kernel.find_wire("bus.addr")), address);
            crate.run(BusTiming{}.word_time());
        }
        EXPECT_EQ(crate.cards[2]->peek(list_at), 5);
        EXPECT_EQ(crate.cards[2]->peek(list_at + 6), 127);
        EXPECT_EQ(crate.cards[2]->peek(offset("FIRST")), 5);
        crate.run(10 * frame_period);
        for (std::size_t card = 0; card < 3; ++card) {
            ASSERT_GE(crate.heard(card).size(), 11u);
            for (const Heard& heard : crate.heard(card))
                for (std::size_t k = 0; k < list.size(); ++k) {
                    ASSERT_EQ(heard.frame.addresses[k], list[k]);
                    ASSERT_EQ(heard.frame.counts[k],
                              static_cast<std::uint32_t>(crate.truth(list[k], heard.frame.instant())));
                }
        }
        EXPECT_TRUE(crate.sentences().empty());
    }
}

TEST(GratingBus, SynchronousHostsWithDifferentAddressListsContendForTheAddress) {
    std::vector<CardSettings> settings(2, host_settings(2));
    settings[0].addresses = {1, 2}, settings[1].addresses = {2, 1};
    for (CardSettings& s : settings) s.verify_lines = false;
    Crate crate(settings);
    crate.run(10 * frame_period - nanoseconds(1));
    for (const Line line : {Line::clk, Line::hold, Line::read_n})
        EXPECT_EQ(crate.bus.lines().conflicts(line), 0u) << "their clocks are one";
    EXPECT_EQ(crate.bus.lines().conflicts(Line::addr), 10u);
    const Conflict& first = crate.bus.lines().conflict(0);
    EXPECT_EQ(first.begin, nanoseconds(20)) << "with the first address";
    EXPECT_THAT(crate.sentences(), Contains(HasSubstr("two cards drive addr at once, c0 high and c1 low")));
    for (const Heard& heard : crate.heard(0))
        for (const std::size_t k : {0, 1})
            EXPECT_EQ(heard.frame.counts[k], static_cast<std::uint32_t>(crate.truth(0, heard.frame.instant())))
                << "1 and 2 give 0: a scale that neither wants";
    for (CardSettings& s : settings) s.verify_lines = true;
    Crate careful(settings);
    careful.run(10 * frame_period);
    EXPECT_TRUE(careful.heard(0).empty() && careful.heard(1).empty());
    EXPECT_GE(careful.cards[0]->counter(Card::alien), 18);
}

TEST(GratingBus, AListOfAddressesIsReadFromTextOrRefusedWithItsLocation) {
    EXPECT_EQ(*addresses_from_text("5, 2, 9"), (std::vector<int>{5, 2, 9}));
    EXPECT_EQ(*addresses_from_text(" 127 ,0 "), (std::vector<int>{127, 0}));
    const auto wrong = [](std::string_view text) { return addresses_from_text(text).error().message; };
    EXPECT_THAT(wrong(""), HasSubstr("Character 1 of the list begins no whole number"));
    EXPECT_THAT(wrong("5, 2,"), HasSubstr("Character 6 of the list begins no whole number"));
    EXPECT_THAT(wrong("5 2"), HasSubstr("Character 3 of the list must be a comma"));
    EXPECT_THAT(wrong("5; 2"), HasSubstr("Character 2 of the list must be a comma"));
    EXPECT_THAT(wrong("3, 128"), HasSubstr("Address 128 of the list is out of range; it must be 0 to 127"));
    EXPECT_THAT(wrong("-1"), HasSubstr("Address -1 of the list is out of range"));
    EXPECT_THAT(wrong("99999999999"), HasSubstr("Character 1"));
    EXPECT_THAT(wrong("3, 4, 3"), HasSubstr("the address 3 twice"));
    std::string many = "0";
    for (int n = 1; n <= 128; ++n) many += "," + std::to_string(n);
    EXPECT_THAT(wrong(many), HasSubstr("129 addresses, more than the 128 of a frame"));
    CardSettings s = host_settings(3);
    s.addresses = {5, 2, 9};
    EXPECT_TRUE(check(s));
    DecoderSettings nine;
    nine.scales = 9;
    EXPECT_THAT(check(s, nine).error().message, HasSubstr("the scales 5, 2, 9, but the decoder has 9 (0 to 8)"));
    s.scales = 4;
    EXPECT_THAT(check(s).error().message, HasSubstr("3 addresses, but a frame has 4 scales"));
    s = host_settings(2);
    s.addresses = {4, 4};
    EXPECT_THAT(check(s).error().message, HasSubstr("twice"));
}

TEST(GratingBus, TheHostDrivesTheAddressOnlyAfterReadIsLow) {
    for (const int level : {1, 0}) {
        Crate crate(crew(1));
        crate.watch_wires();
        crate.run(frame_period - microseconds(1));
        crate.kernel.force(crate.kernel.find_wire("bus.read_n"), level);
        crate.kernel.settle();
        std::set<int> addresses;
        while (crate.kernel.now() < frame_period + microseconds(1)) {
            crate.run(nanoseconds(10));
            addresses.insert(crate.kernel.level(crate.kernel.find_wire("bus.addr")));
        }
        if (level == 1) {
            EXPECT_EQ(addresses, std::set<int>{0x7F}) << "READ that stays high leaves the address at rest";
        } else {
            EXPECT_EQ(addresses, (std::set<int>{0, 1, 2, 3, 0x7F}));
        }
        EXPECT_EQ(crate.heard(0).size(), 1u);
        EXPECT_EQ(crate.cards[0]->counter(Card::missed_words), level == 1 ? 4 : 0);
        crate.kernel.release(crate.kernel.find_wire("bus.read_n"));
        crate.kernel.settle();
        crate.run(frame_period);
        EXPECT_EQ(crate.heard(0).size(), 2u);
        EXPECT_TRUE(same(crate.heard(1)[1].frame, crate.heard(0)[1].frame));
    }
}

TEST(GratingBus, AHostThatHasSampledReadHighDoesNotDriveTheAddressLater) {
    Crate crate(crew(1));
    crate.run(frame_period - microseconds(1));
    crate.kernel.force(crate.kernel.find_wire("bus.read_n"), 1);
    crate.kernel.settle();
    crate.run_to(frame_period + nanoseconds(45));  // 5 ns before the sample: too late for the decoder
    crate.kernel.release(crate.kernel.find_wire("bus.read_n"));
    crate.kernel.settle();
    EXPECT_EQ(crate.kernel.level(crate.kernel.find_wire("bus.read_n")), 0);
    EXPECT_EQ(crate.kernel.level(crate.kernel.find_wire("bus.addr")), 0x7F);
    crate.run(microseconds(2));
    EXPECT_EQ(crate.heard(0).size(), 1u);
    EXPECT_EQ(crate.cards[0]->counter(Card::alien), 1);
}

TEST(GratingBus, ASlaveUsesTheAddressesOfTheHostRegardlessOfItsOwnList) {
    std::vector<CardSettings> settings = crew(2, 3);
    settings[0].addresses = {5, 2, 9};
    settings[1].addresses = {9, 2, 5};
    Crate crate(settings, 10);
    crate.run(5 * frame_period - nanoseconds(1));
    for (const std::size_t card : {0, 1, 2}) {
        ASSERT_EQ(crate.heard(card).size(), 5u);
        for (std::size_t i = 0; i < 5; ++i) {
            const Frame& frame = crate.heard(card)[i].frame;
            EXPECT_TRUE(same(frame, crate.heard(0)[i].frame));
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(frame.addresses[k], settings[0].addresses[k]);
                EXPECT_EQ(frame.counts[k],
                          static_cast<std::uint32_t>(crate.truth(settings[0].addresses[k], frame.instant())));
            }
        }
    }
    EXPECT_EQ(crate.cards[1]->counter(Card::alien), 10) << "2 of 3 words are not where its own list has them";
    EXPECT_EQ(crate.cards[2]->counter(Card::alien), 15);
    EXPECT_EQ(crate.cards[2]->counter(Card::broken), 0);
    EXPECT_EQ(crate.sentences().size(), 2u) << "each tells it once";
    EXPECT_THAT(crate.sentences(),
                Contains(AllOf(HasSubstr("card c2"), HasSubstr("word 0 of a frame is that of scale 5"),
                               HasSubstr("own list has 0 there"))));
    crate.cards[1]->write(offset("CONTROL"), 1);
    EXPECT_EQ(crate.cards[1]->read(addresses_at), 5) << "the registers tell which scales the frame has";
    EXPECT_EQ(crate.cards[1]->read(addresses_at + 4), 9);
    EXPECT_EQ(crate.cards[1]->read(list_at), 9);
}

TEST(GratingBus, AnAddressThatComesTwiceInAFrameMakesItBad) {
    std::vector<CardSettings> settings = crew(1, 2);
    Crate crate(settings, 4);
    crate.kernel.force(crate.kernel.find_wire("bus.addr0"), 1);
    crate.kernel.settle();
    crate.run(3 * frame_period);
    EXPECT_TRUE(crate.heard(1).empty()) << "scale 1 twice: a line is stuck";
    EXPECT_EQ(crate.cards[1]->counter(Card::broken), 3);
    EXPECT_EQ(crate.cards[1]->counter(Card::alien), 6);
    for (const std::string& sentence : crate.sentences()) EXPECT_THAT(sentence, Not(HasSubstr("own list")));
}

}  // namespace
}  // namespace motionrack::grating_bus
