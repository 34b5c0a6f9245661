// The map against the pages and against what the cards do.
#include <gtest/gtest.h>

#include <fstream>
#include <motionrack/base/describe.hpp>
#include <motionrack/cards/grating_bus/model/moment.hpp>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::grating_bus {
namespace {

std::string stored(const std::string& page) {
    std::ifstream file(source_dir() + "/docs/reference/" + page);
    std::stringstream out;
    out << file.rdbuf();
    return out.str();
}

TEST(GratingBusMap, TheReferencePagesAreCurrent) {
    EXPECT_EQ(stored("grating_bus.md"), describe_markdown(card_map()))
        << "make it anew: motionrack describe grating_bus --markdown > docs/reference/grating_bus.md";
    EXPECT_EQ(stored("grating_decoder.md"), describe_markdown(decoder_map()))
        << "make it anew: motionrack describe grating_decoder --markdown > docs/reference/grating_decoder.md";
}

TEST(GratingBusMap, TheSequenceTakesTheDeclaredSteps) {
    const MachineInfo& machine = map::machines[0];
    for (int from = 1; from <= 12; ++from)
        for (const bool left : {false, true}) {
            const int to = static_cast<int>(after(static_cast<State>(from), left));
            bool declared = false;
            for (const TransitionInfo& t : machine.transitions)
                declared = declared || (state_index(machine, t.from) == from && state_index(machine, t.to) == to);
            EXPECT_TRUE(declared) << "S" << from << " to S" << to;
        }
}

TEST(GratingBusMap, AnyMomentOfAFrameIsWhatItsStepsComeTo) {
    for (const int words : {1, 2, 7, 255}) {
        const Timing timing{nanoseconds(17), nanoseconds(29), Duration{3}, nanoseconds(8)};
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
