// Service commands that meet in one slice, or other commands.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <motionrack/operate/service.hpp>
#include <motionrack/rack/faults.hpp>
#include <utility>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A machine, and the answers to requests for its card's services.
struct ServiceTalk : Operated {
    ServiceTalk() : Operated(two_axes()) {}
    void begin(Machine& m) {
        EXPECT_TRUE(m.service().begin("m", {"anna", "", ""}, "w1", [this](const Result<std::string>& reported) {
            said.push_back(reported ? "in service" : reported.error().message);
        }));
    }
    void call(Machine& m, const std::string& function, const char* argument, std::int64_t value) {
        const Result<void> taken =
            m.service().call({"m", function, {{argument, value}}}, {}, "w1", [this](const Result<CallAnswer>& answer) {
                said.push_back(answer ? answer->text : answer.error().message);
            });
        if (!taken) said.push_back("refused: " + taken.error().message);
    }
    std::vector<std::string> said;
};

/// A library whose axes are at standstill after `moves_for` polls, on a host whose time advances only by waiting.
struct SlowCard final : FunctionLibrary, Interrupt {
    std::span<const FunctionInfo> functions() const override { return {}; }
    Result<void> begin() override { return {}; }
    Result<CallAnswer> call(std::size_t, std::span<const std::int64_t>) override { return CallAnswer{}; }
    bool moving() override { return ++looks <= moves_for; }
    void stop_now() override { ++stops; }
    bool wait(Duration timeout) override { return pass(timeout), false; }
    void pass(Duration duration) override { passed += duration; }
    Instant now() const override { return Instant{passed}; }

    int moves_for = 0, looks = 0, stops = 0;
    Duration passed{0};
};

TEST(StopAtOnce, WaitsUntilTheAxesStandForATenthOfASecondAtMost) {
    for (const auto& [moves_for, waits] : {std::pair(0, 0), std::pair(7, 7), std::pair(1000, 100)}) {
        SlowCard card;
        card.moves_for = moves_for;
        stop_at_once(card, card);
        EXPECT_EQ(card.stops, 1);
        EXPECT_EQ(card.passed, milliseconds(waits));
    }
}

TEST(ServiceOrder, OneThatIsStoppedBeforeItsStartTakesNoCard) {
    for (const bool stops : {true, false}) {
        SCOPED_TRACE(stops);
        ServiceTalk o;
        o.at(0.1, [&](Machine& m) {
            o.begin(m);
            o.call(m, "SetRange", "data", 800'000);
            if (stops)
                m.stop();
            else
                EXPECT_TRUE(m.service().end([&](const Result<std::string>& reported) { o.said.push_back(*reported); }));
        });
        o.at(0.2, [&](Machine& m) {
            EXPECT_FALSE(m.service().on());
            EXPECT_EQ(m.state(), stops ? MachineState::error_stop : MachineState::standstill);
            EXPECT_TRUE(m.status().axes[0].position_valid);
            m.reset();
        });
        o.at(0.3, [](Machine& m) { EXPECT_TRUE(m.line("G1 X12 F600", 1)); });
        o.run(1);
        EXPECT_NEAR(o.x(), 12, 1e-9);
        std::vector<std::string> expected = {"Not called. The service of card m was not started.",
                                             "The service of card m was not started."};
        if (!stops) expected.push_back(expected.back());
        EXPECT_EQ(o.said, expected);
    }
}

TEST(ServiceOrder, OneCallAtATimeAndNoneAfterTheEnd) {
    ServiceTalk o;
    o.at(0.05, [&](Machine& m) { o.begin(m); });
    o.at(0.1, [&](Machine& m) {
        o.call(m, "SetRange", "data", 800'000);
        o.call(m, "ReadLPS", "axis", 1);
    });
    o.at(0.2, [&](Machine& m) {
        EXPECT_TRUE(m.service().end({}));
        o.call(m, "ReadLPS", "axis", 1);
    });
    o.run(0.3);
    EXPECT_THAT(o.said, ElementsAre("in service",
                                    "refused: ReadLPS was not called: SetRange still runs. Wait until it ends, or end "
                                    "the service.",
                                    "Written.", "refused: ReadLPS was not called: the service ends."));
}

TEST(ServiceOrder, EveryCommandThatEndsTheServiceIsAnswered) {
    ServiceTalk o;
    o.at(0.05, [&](Machine& m) { o.begin(m); });
    o.at(0.1, [&](Machine& m) {
        for (const char* const who : {"anna", "bert"})
            EXPECT_TRUE(m.service().end([&o, who](const Result<std::string>& reported) {
                o.said.push_back(fmt::format("{}: {}", who, reported ? *reported : reported.error().message));
            }));
    });
    o.run(0.2);
    EXPECT_THAT(o.said, ElementsAre("in service", HasSubstr("anna: The service of card m has ended"),
                                    HasSubstr("bert: The service of card m has ended")));
}

TEST(ServiceOrder, ProgramsCanBeStoppedAfterAService) {
    for (const char* const card : {"free", "m"})
        for (const std::string profile : {"trapezoid", "jerk_limited"}) {
            SCOPED_TRACE(card + (' ' + profile));
            Operated o(two_axes("[card.free]\ntype = \"mcx314\"\n[controller]\nprofile = \"" + profile + "\"\n"));
            o.at(0.05, [=](Machine& m) { EXPECT_TRUE(m.service().begin(card, {}, "", {})); });
            o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.service().end({})); });
            o.at(0.3, [](Machine& m) {
                EXPECT_TRUE(m.manual().set_position('X', 10));
                EXPECT_TRUE(m.manual().set_position('Y', 0));
            });
            o.at(0.4, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X200\nM2\n", "p")); });
            o.at(1, [](Machine& m) { m.cancel(); });
            o.run(1.5);
            EXPECT_LT(o.stood_since, 1.2);
            EXPECT_GT(o.x(), 15);
        }
}

/// The start of the service resets the card, which does not answer meanwhile.
TEST(ServiceOrder, AStopAtAnyInstantOfTheStartEndsTheService) {
    for (const double delay : {0.0005, 0.002, 0.01, 0.05, 0.2}) {
        SCOPED_TRACE(delay);
        MachineSettings settings;
        settings.slice = microseconds(100);
        Operated o(carriage(), std::move(settings));
        int reported = 0;
        o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
        o.at(0.2, [&](Machine& m) {
            EXPECT_TRUE(m.service().begin("board", {}, "", [&](const Result<std::string>&) { ++reported; }));
        });
        o.at(0.2 + delay, [](Machine& m) { m.stop({"anna", "", "STOP"}); });
        o.run(4);
        EXPECT_EQ(reported, 1);
        EXPECT_FALSE(o.machine->service().on());
        EXPECT_EQ(o.machine->state(), MachineState::error_stop);
        EXPECT_FALSE(o.machine->status().axes[0].position_valid) << "the service had taken its card";
    }
}

/// A card whose service ends at 0.5 s, and that hangs from about then on until its watchdog has reset it.
struct HangAtTheEnd {
    int answers = 0;  ///< to the command that ends the service
    std::string answer;
    std::vector<std::string> alarms;  ///< their texts
    double x = 0;
    MachineState state = MachineState::disabled;
};

HangAtTheEnd hang_at(double hangs_at) {
    Operated o(carriage());
    HangAtTheEnd seen;
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.service().begin("board", {}, "", {})); });
    o.at(0.5, [&](Machine& m) {
        EXPECT_TRUE(m.service().end([&](const Result<std::string>& reported) {
            ++seen.answers;
            seen.answer = reported ? *reported : reported.error().message;
        }));
    });
    o.at(hangs_at, [&o](Machine& m) {
        EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang", "board"));
        o.watch->invariants().hung();
    });
    o.at(hangs_at + 0.3, [](Machine& m) { m.reset(); });
    o.at(hangs_at + 0.35, [](Machine& m) { static_cast<void>(m.manual().jog('X', 10)); });
    o.at(hangs_at + 2, [](Machine& m) { m.reset(); });
    o.at(hangs_at + 2.2, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)) << m.status().reason; });
    o.at(hangs_at + 2.5, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 5, 20)) << m.status().reason; });
    o.run(hangs_at + 4);
    for (const Alarm& alarm : o.machine->status().alarms) seen.alarms.push_back(alarm.text);
    seen.x = o.x();
    seen.state = o.machine->state();
    return seen;
}

TEST(ServiceOrder, ACardThatIsNotTakenBackIsAnAlarmAndIsUsableOnceItAnswers) {
    int not_taken = 0;
    for (double at = 0.5; at < 0.54; at += 0.004) {
        SCOPED_TRACE(testing::Message() << "it hangs at " << at << " s");
        const HangAtTheEnd seen = hang_at(at);
        EXPECT_EQ(seen.answers, 1) << "the end of the service is answered once";
        EXPECT_EQ(seen.state, MachineState::standstill);
        EXPECT_NEAR(seen.x, 105, 0.3);
        if (seen.answer.find("was not Ready") == std::string::npos) continue;
        ++not_taken;
        EXPECT_THAT(seen.alarms, testing::Contains(HasSubstr("was not Ready")));
    }
    EXPECT_GT(not_taken, 0) << "it hung while it was initialised for the controller";
}

/// Work that was queued at the machine's parts, not by a command of the machine.
TEST(ServiceOrder, NoServiceAndNoAccessWhileWorkIsQueuedAtStandstill) {
    Operated o(two_axes());
    const auto begin = [](Machine& m) { return refusal_of(m.service().begin("m", {}, "", {})); };
    o.at(0.1, [=](Machine& m) {
        m.manual().jogs().hold('X', 5, "w1");
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_THAT(begin(m), HasSubstr("a command is still being executed"));
        m.manual().jogs().let_go();
        EXPECT_TRUE(m.programs().line("G21 G90 G1 X20 F600", 1, m.now()));
        EXPECT_THAT(begin(m), HasSubstr("a command is still being executed"));
        EXPECT_THAT(refusal_of(m.manual_access().request({"m", 16, 0, {}}, [](const auto&) {})),
                    HasSubstr("The card was not accessed"));
        m.cancel();
    });
    o.run(0.5);
    EXPECT_EQ(o.x(), 10);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

TEST(ServiceOrder, NoServiceBeforeAPendingStopIsOver) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        m.cancel();
        EXPECT_THAT(refusal_of(m.service().begin("m", {}, "", {})),
                    HasSubstr("a command is still being executed. Nothing was changed; try again at once."));
        EXPECT_TRUE(m.manual().set_position('X', 20));
    });
    o.at(0.2, [](Machine& m) {
        EXPECT_TRUE(m.service().begin("m", {}, "", {}));
        EXPECT_EQ(m.status().reason, "card m is in service by this program");
    });
    o.at(0.3, [](Machine& m) { m.service().end_of(""); });
    o.run(0.4);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

}  // namespace
}  // namespace motionrack::operate
