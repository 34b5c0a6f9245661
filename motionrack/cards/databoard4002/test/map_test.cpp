// The card's map: its declarations match the card, and the reference page is generated from it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <motionrack/base/describe.hpp>
#include <motionrack/cards/databoard4002/test/host.hpp>
#include <motionrack/cards/databoard4002/trim_text.hpp>
#include <set>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::databoard4002 {
namespace {

TEST(Databoard4002Map, TheCardExecutesTheDeclaredCommandsAndNoOthers) {
    std::set<std::uint32_t> declared;
    for (const CommandInfo& command : card_map().commands) declared.insert(command.code);
    Host host;
    host.start();
    for (int code = 0; code < 256; ++code) {
        const std::size_t before = host.kernel.conditions().size();
        host.command(static_cast<char>(code));
        EXPECT_TRUE(host.wait_ready());
        EXPECT_EQ(host.kernel.conditions().size() == before, declared.count(static_cast<std::uint32_t>(code)) == 1)
            << code;
    }
}

TEST(Databoard4002Map, EveryAnswerAndArgumentHasItsDeclaredBytes) {
    for (const CommandInfo& info : card_map().commands) {
        if (info.data_bytes > 0) {
            Host host;
            host.start();
            host.command(static_cast<char>(info.code));
            for (int i = 0; i < info.data_bytes; ++i) host.out(ports::DATA, 1);
            host.wait_ready();
            EXPECT_TRUE(host.conditions().empty()) << info.name;
            host.out(ports::DATA, 1);  // one too many
            host.wait_ready();
            EXPECT_EQ(host.conditions(), std::vector{CardCondition::data_unexpected}) << info.name;
        }
        if (info.answer_bytes > 0) {
            Host host;
            host.start();
            host.out(ports::C4, 0);
            host.command(static_cast<char>(info.code));
            for (int i = 0; i < info.answer_bytes; ++i) host.in(ports::DATA);
            host.out(ports::DATA, 1);  // the answer has ended, no argument is expected
            host.wait_ready();
            EXPECT_EQ(host.conditions(), std::vector{CardCondition::data_unexpected}) << info.name;
        }
    }
}

TEST(Databoard4002Map, TheCardHasThePinsOfTheMap) {
    Host host;
    for (const PinInfo& pin : card_map().pins)
        EXPECT_NE(host.kernel.find_wire("c1." + std::string(pin.name)), sim::WireId::none) << pin.name;
    EXPECT_EQ(host.kernel.wire_count(), card_map().pins.size() + 1);  // and the bus' interrupt line
}

TEST(Databoard4002Map, ThePinsOfTheStopsAreThoseOfContact3P) {
    struct Contact {
        std::string_view pin, numbers;
    };
    for (const Contact& contact : {Contact{"ems", "contact 3P: 10 at 0 V, 23 at 5 V"},
                                   {"esl", "contact 3P: 11 at 0 V, 24 at 5 V"},
                                   {"esr", "contact 3P: 12 at 0 V, 25 at 5 V"}}) {
        const auto pin = std::find_if(std::begin(map::pins), std::end(map::pins),
                                      [&](const PinInfo& each) { return each.name == contact.pin; });
        ASSERT_NE(pin, std::end(map::pins)) << contact.pin;
        EXPECT_NE(pin->meaning.find(contact.numbers), std::string_view::npos) << pin->meaning;
    }
}

TEST(Databoard4002Map, TheReferencePageIsCurrent) {
    std::ifstream file(source_dir() + "/docs/reference/databoard4002.md");
    std::stringstream stored;
    stored << file.rdbuf();
    EXPECT_EQ(stored.str(), describe_markdown(card_map()))
        << "make it anew: motionrack describe databoard4002 --markdown > docs/reference/databoard4002.md";
}

TEST(Databoard4002Arithmetic, PositionsAreTwosComplementOf24Bits) {
    EXPECT_EQ(signed24(0x7FFFFF), 8'388'607);
    EXPECT_EQ(signed24(0x800000), -8'388'608);
    EXPECT_EQ(signed24(-8'388'609), 8'388'607);
    EXPECT_EQ(signed24(0xFFFFFF), -1);
    EXPECT_EQ(signed24(-1), -1);
}

TEST(Databoard4002Arithmetic, TheFrequencyFitsTheFourLimitsOfTheDescription) {
    EXPECT_NEAR(hz_of(13'568), 142, 0.1);
    EXPECT_DOUBLE_EQ(hz_of(16'344), 10'000);
    EXPECT_DOUBLE_EQ(hz_of(16'380), 100'000);
    EXPECT_DOUBLE_EQ(hz_of(384), 25);
    EXPECT_EQ(hz_of(0), 0);
}

TEST(Databoard4002Arithmetic, TheVoltageGoesThroughTheTrimTableAndRises) {
    for (int i = 0; i < default_trim.size; ++i) {
        const TrimRow& row = default_trim.rows[static_cast<std::size_t>(i)];
        EXPECT_EQ(microvolts_of(row.rate, default_trim), row.microvolts);
    }
    EXPECT_EQ(microvolts_of(0, default_trim), 0);
    for (int rate = 1; rate < max_rate; ++rate)
        EXPECT_LE(microvolts_of(rate, default_trim), microvolts_of(rate + 1, default_trim)) << rate;
    EXPECT_EQ(microvolts_of(max_rate, default_trim), 10'000'000);
}

TEST(Databoard4002SlopeTable, FindsTheIntervalAndWhereItEnds) {
    SlopeTable table;
    for (int i = 0; i < 24; ++i) {
        table.set(i, {1'000 + i, 100 * (i + 1)});
        table.set(24 + i, {2'000 + i, 10 * (i + 1)});
    }
    table.set(5, {999, 450});  // ends before the previous interval (500): never used
    EXPECT_EQ(table.decelerating(1).rate, 1'000);
    EXPECT_EQ(table.decelerating(100).rate, 1'000);
    EXPECT_EQ(table.decelerating(101).rate, 1'001);
    EXPECT_EQ(table.decelerating(501).rate, 1'006);
    EXPECT_EQ(table.decelerating(501).min, 501);
    EXPECT_EQ(table.decelerating(501).max, 700);
    EXPECT_EQ(table.decelerating(2'401).rate, 2'023);
    EXPECT_EQ(table.accelerating(0).rate, 2'000);
    EXPECT_EQ(table.accelerating(9).rate, 2'000);
    EXPECT_EQ(table.accelerating(10).rate, 2'001);
    EXPECT_EQ(table.accelerating(240).rate, 2'023);
    int interval = -1;
    EXPECT_EQ(table.flaw(interval), SlopeFlaw::descending);
    EXPECT_EQ(interval, 5);
    EXPECT_EQ(SlopeTable{}.flaw(interval), SlopeFlaw::speed_zero);
}

TEST(Databoard4002Settings, OutOfRangeAreRefusedWithTheNumberSeen) {
    Settings s;
    EXPECT_TRUE(check(s));
    s.first_pair = 1;
    EXPECT_FALSE(check(s));
    s.folding = sim::Edges::both_of_a;
    EXPECT_TRUE(check(s));
    s.byte_time = nanoseconds(100);
    ASSERT_FALSE(check(s));
    EXPECT_NE(check(s).error().message.find("100 ns"), std::string::npos);
    s = {};
    s.trim.rows[3].rate = 1;
    EXPECT_FALSE(check(s));
}

/// As printed, row for row; its two misprints are corrected to fit the neighbouring rows.
TEST(Databoard4002Trim, IsThePrintedTableByDefault) {
    const Trim printed = *trim_from_text(
        "0.01 13799, 0.025 14051, 0.05 14339, 0.075 14565, 0.1 14745, 0.15 15014, 0.2 15207, "
        "0.25 15351, 0.3 15463, 0.35 15547, 0.4 15628, 0.5 15750, 0.75 15921, 1 16021, "
        "1.5 16130, 2 16189, 2.5 16225, 3 16250, 3.5 16269, 4 16282, 4.5 16293, 5 16302, "
        "5.5 16310, 6 16316, 6.5 16321, 7 16325, 7.5 16330, 8 16333, 8.5 16335, 9 16338, "
        "9.5 16341, 10 16345");
    const Trim by_default = *trim_from_text(" ");
    ASSERT_EQ(printed.size, by_default.size);
    for (std::size_t i = 0; i < static_cast<std::size_t>(printed.size); ++i) {
        EXPECT_EQ(printed.rows[i].microvolts, by_default.rows[i].microvolts) << i;
        EXPECT_EQ(printed.rows[i].rate, by_default.rows[i].rate) << i;
    }
    const Trim own = *trim_from_text("0.5 15000,10 16383");
    EXPECT_EQ(own.size, 2);
    EXPECT_EQ(microvolts_of(16'383, own), 10'000'000);
    EXPECT_EQ(microvolts_of(15'000, own), 500'000);
}

TEST(Databoard4002Trim, IsRejectedWithTheInvalidRow) {
    const auto refused = [](const char* text) {
        const Result<Trim> trim = trim_from_text(text);
        return trim ? std::string() : trim.error().message;
    };
    EXPECT_THAT(refused("0.01 13799, 0.025"),
                testing::HasSubstr("Row 2 of the trim table, \" 0.025\", is not two numbers"));
    EXPECT_THAT(refused("1 2 3"), testing::HasSubstr("is not two numbers"));
    EXPECT_THAT(refused("1 100,"), testing::HasSubstr("Row 2"));
    EXPECT_THAT(refused("11 100"), testing::HasSubstr("outside 0 to 10 V"));
    EXPECT_THAT(refused("0 100"), testing::HasSubstr("outside 0 to 10 V"));
    EXPECT_THAT(refused("nan 100"), testing::HasSubstr("outside 0 to 10 V"));
    EXPECT_THAT(refused("1 16384"), testing::HasSubstr("outside 1 to 16383"));
    EXPECT_THAT(refused("1 100, 1 200"), testing::HasSubstr("does not rise"));
    EXPECT_THAT(refused("1 100, 2 100"), testing::HasSubstr("does not rise"));
    std::string many;
    for (int i = 1; i <= 65; ++i) many += (i > 1 ? "," : "") + std::to_string(0.1 * i) + " " + std::to_string(100 + i);
    EXPECT_THAT(refused(many.c_str()), testing::HasSubstr("Row 65"));
}

}  // namespace
}  // namespace motionrack::databoard4002
