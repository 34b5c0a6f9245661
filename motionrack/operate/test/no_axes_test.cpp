// A rack without axes: its cards are operated, and everything that would move an axis is refused.
#include <gmock/gmock.h>

#include <motionrack/operate/journal_writer.hpp>
#include <motionrack/operate/service.hpp>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string bench = "[card.bench]\ntype = \"mcx314\"\n[card.glass]\ntype = \"ioflex02\"\n";

rack::RackConfig cards_alone(const std::string& text) {
    const rack::RackReading reading = rack::read_rack_text(text);
    EXPECT_TRUE(reading.config) << (reading.errors.empty() ? "" : reading.errors[0].text());
    return *reading.config;
}

TEST(MachineWithoutAxes, RunsForEachCardAlone) {
    for (const char* const type : {"mcx314", "databoard4002", "ioflex02", "grating_bus", "rtc5"}) {
        SCOPED_TRACE(type);
        Operated o(cards_alone(std::string("[card.one]\ntype = \"") + type + "\"\n"));
        o.at(0.2, [](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::standstill);
            EXPECT_TRUE(m.status().axes.empty());
        });
        o.run(0.3);
        EXPECT_THAT(o.states, ElementsAre("disabled", "standstill"));
        EXPECT_GE(o.machine->now(), Instant{} + milliseconds(300));
    }
}

TEST(MachineWithoutAxes, RejectsProgramsLinesJogsAndHoming) {
    Operated o(cards_alone(bench));
    std::vector<std::string> said;
    o.at(0.1, [&](Machine& m) {
        const auto say = [&](const Result<void>& done) { said.push_back(done ? "done" : done.error().message); };
        say(m.begin_program("G1 X1 F100\n", "one.ngc"));
        const auto line = m.line("M3 S1000", 1);
        said.push_back(line ? "done" : line.error().message);
        say(m.manual().jog('X', 1));
        say(m.manual().jog_by('X', 1, 1));
        say(m.manual().jog_to({1}, 1));
        say(m.manual().home(""));
        say(m.manual().set_position('X', 0));
    });
    o.run(0.2);
    const auto none = HasSubstr("the rack has no axes. Nothing was moved; add an [axis.X] section"),
               unknown = HasSubstr("the machine has no axis X");
    EXPECT_THAT(said, ElementsAre(none, none, unknown, unknown, none, none, unknown));
}

TEST(MachineWithoutAxes, StopsAndIsReset) {
    Operated o(cards_alone(bench));
    o.at(0.1, [](Machine& m) { m.stop({"anna", "127.0.0.1", "STOP"}); });
    o.at(0.2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        m.reset();
    });
    o.at(0.25, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::disabled) << "no axis is enabled";
        EXPECT_TRUE(m.enable(true));
        EXPECT_EQ(m.state(), MachineState::standstill);
    });
    o.run(0.3);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "error stop", "disabled", "standstill"));
}

TEST(MachineWithoutAxes, DrivesACardInService) {
    Operated o(cards_alone(bench));
    std::vector<std::string> said;
    const auto call = [&](Machine& m, const std::string& function,
                          const std::map<std::string, std::int64_t, std::less<>>& arguments) {
        const Result<void> taken = m.service().call(
            {"bench", function, arguments}, {"anna", "127.0.0.1", ""}, "w1",
            [&](const Result<CallAnswer>& answer) { said.push_back(answer ? answer->text : answer.error().message); });
        if (!taken) said.push_back(taken.error().message);
    };
    o.at(0.05, [&](Machine& m) { call(m, "SetRange", {{"data", 800'000}}); });
    o.at(0.1, [&](Machine& m) {
        call(m, "TCurve_F", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}, {"m_Pulse", 640}});
    });
    o.run(1);
    EXPECT_EQ(*o.machine->rack().card("bench")->inspect("x.LP"), 640);
    EXPECT_THAT(said, ElementsAre("Written.", HasSubstr("X drives")));
}

TEST(MachineWithoutAxes, NeedsNoPositionsAfterItsLastRun) {
    const rack::RackConfig config = cards_alone(bench);
    journal::LastRun last;
    last.clean = true;
    EXPECT_EQ(read_last(last, config).sentence, "");
    last.clean = false;
    EXPECT_THAT(read_last(last, config).sentence, HasSubstr("The previous run was interrupted"));
    EXPECT_THAT(read_last(last, config).sentence, ::testing::Not(HasSubstr("home the machine")));
}

}  // namespace
}  // namespace motionrack::operate
