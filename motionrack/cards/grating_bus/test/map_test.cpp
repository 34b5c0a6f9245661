// Compares the map with the pages and with the behaviour of the cards.
#include <gtest/gtest.h>

#include <motionrack/base/describe.hpp>
#include <motionrack/cards/grating_bus/model/moment.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::grating_bus {
namespace {

std::string stored(const std::string& page) {
    return text_of(source_root / "docs/reference" / page);
}

/// Returns a cell of a table with its closing bar; an empty text gives a blank cell.
std::string cell(std::string_view text) {
    return text.empty() ? " |" : " " + std::string(text) + " |";
}

std::string volts(double value) {
    const int tenths = static_cast<int>(value * 10 + 0.5);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " V";
}

TEST(GratingBusMap, TheReferencePagesAreCurrent) {
    EXPECT_EQ(stored("grating_bus.md"), describe_markdown(card_map()))
        << "make it anew: motionrack describe grating_bus --markdown > docs/reference/grating_bus.md";
    EXPECT_EQ(stored("grating_decoder.md"), describe_markdown(decoder_map()))
        << "make it anew: motionrack describe grating_decoder --markdown > docs/reference/grating_decoder.md";
}

TEST(GratingBusMap, TheReadmeHasEveryPinOfTheConnector) {
    const std::string page = text_of(source_root / "motionrack/cards/grating_bus/README.md");
    int addresses = 0;
    for (const map::ConnectorPin& pin : map::connector_pins) {
        const std::string row = "\n|" + cell("`" + std::string(pin.printed) + "`") + cell(pin.likely) +
                                cell(pin.or_else) + cell(pin.line) + cell(pin.doubt) + "\n";
        EXPECT_NE(page.find(row), std::string::npos) << "missing:" << row;
        addresses += pin.line == "addr";
    }
    EXPECT_EQ(addresses, 7);
    EXPECT_NE(page.find("every reading in this table is a guess"), std::string::npos);
}

TEST(GratingBusMap, TheReadmeHasTheLevelsAndWhyThereAreShifters) {
    const std::string page = text_of(source_root / "motionrack/cards/grating_bus/README.md");
    for (const map::SignalLevels& side : map::signal_levels) {
        const std::string row = "\n|" + cell(side.side) + cell(side.family) + cell(volts(side.supply_v)) +
                                cell(volts(side.max_low_in_v)) + cell(volts(side.min_high_in_v)) + "\n";
        EXPECT_NE(page.find(row), std::string::npos) << "missing:" << row;
    }
    EXPECT_EQ(map::signal_levels[0].supply_v, 5.0);
    EXPECT_EQ(map::signal_levels[1].supply_v, 3.3);
    EXPECT_NE(page.find("no card without level shifters may be put on the bus"), std::string::npos);
}

TEST(GratingBusMap, TheReadmeCallsTheLostDigitAGuess) {
    const std::string page = text_of(source_root / "motionrack/cards/grating_bus/README.md");
    EXPECT_NE(page.find("prints 1 ns in [0076]. That a digit was lost there, and 10 ns were meant, is a guess"),
              std::string::npos);
}

TEST(GratingBusMap, TheSequenceTakesTheDeclaredSteps) {
    const DeclarationError flaw = transitions_flaw(map::machines[0], [](std::size_t from, std::size_t to) {
        const auto state = static_cast<State>(from);
        return after(state, false) == static_cast<State>(to) || after(state, true) == static_cast<State>(to);
    });
    EXPECT_EQ(flaw.text(), "");
    EXPECT_EQ(after(State::S5, true), State::S6);
    EXPECT_EQ(after(State::S5, false), State::S11);
}

TEST(GratingBusMap, AnyInstantOfAFrameHasTheStateThatItsStepsGive) {
    for (const int words : {1, 2, 7, 128}) {
        const BusTiming timing{nanoseconds(17), nanoseconds(29), Duration{3}, nanoseconds(8)};
        State state = State::S1;
        int word = 0;
        Duration at{};
        while (state != State::S0) {
            const Duration end = at + time_in(timing, state);
            for (const Duration t : {at, end - Duration{1}}) {
                const Moment m = moment_of(timing, words, t);
                ASSERT_EQ(m.state, state);
                ASSERT_EQ(m.word, word);
                ASSERT_EQ(m.until, end);
            }
            state = after(state, word + 1 < words);
            word += state == State::S7;
            at = end;
        }
        EXPECT_EQ(at, timing.frame_time(words));
    }
}

}  // namespace
}  // namespace motionrack::grating_bus
