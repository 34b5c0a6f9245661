// Service of a card: its start, its end, and the state of the machine afterwards.
#include <gtest/gtest.h>

#include <motionrack/operate/service.hpp>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

const StopOrigin anna{"anna", "127.0.0.1", ""};
using Arguments = std::map<std::string, std::int64_t, std::less<>>;

const char* const second_card = "[card.free]\ntype = \"mcx314\"\n[card.glass]\ntype = \"ioflex02\"\n";

/// A machine with service requests at given instants.
struct Served : Operated {
    explicit Served(const std::string& more = second_card) : Operated(two_axes(more)) {}
    explicit Served(const rack::RackConfig& config) : Operated(config) {}
    void begin(double seconds, const std::string& card = "m") {
        at(seconds, [this, card](Machine& m) {
            const Result<void> begun = m.service().begin(card, anna, "w1", [this](const Result<std::string>& reported) {
                said.push_back(reported ? *reported : reported.error().message);
            });
            EXPECT_TRUE(begun) << begun.error().message;
        });
    }
    void call(double seconds, const std::string& function, const Arguments& arguments, const std::string& card = "m") {
        at(seconds, [=, this](Machine& m) {
            const Result<void> taken = m.service().call(
                {card, function, arguments}, anna, "w1",
                [this](Result<CallAnswer> answer) { said.push_back(answer ? answer->text : answer.error().message); });
            if (!taken) said.push_back("refused: " + taken.error().message);
        });
    }
    /// Starts an endless drive of X with a ramp of a minute, at 0.1 s.
    void drive_x() {
        begin(0.05);
        call(0.08, "SetRange", {{"data", 800'000}});
        call(0.1, "TCurve_C", {{"axis", 1}, {"m_SV", 100}, {"m_V", 8000}, {"m_A", 1}});
        at(0.3, [](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::service);
            EXPECT_GT(m.status().axes[0].velocity, 0.5);
        });
    }
    std::vector<std::string> said;
};

TEST(Service, CallsFunctionsAndReleasesTheCardWithInvalidPositions) {
    Served o;
    o.begin(0.05);
    o.call(0.1, "SetRange", {{"data", 800'000}});
    o.call(0.12, "TCurve_F", {{"axis", 2}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}, {"m_Pulse", 640}});
    o.call(0.5, "ReadLPS", {{"axis", 2}});
    o.at(0.6, [&](Machine& m) {
        EXPECT_EQ(m.status().service, "m");
        EXPECT_FALSE(m.status().axes[0].position_valid || m.status().axes[1].position_valid);
        EXPECT_NEAR(m.status().axes[1].true_position, 1, 1e-9) << "640 pulses are a millimetre";
        EXPECT_TRUE(m.service().end([&](const Result<std::string>& reported) { o.said.push_back(*reported); }));
    });
    o.at(0.7, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_EQ(m.status().service, "");
        EXPECT_FALSE(m.line("G1 X20 F600", 1)) << "not valid";
        EXPECT_TRUE(m.manual().set_position('X', 10));
        EXPECT_TRUE(m.manual().set_position('Y', 1));
    });
    o.at(0.8, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X12 Y3\nM2\n", "p")); });
    o.run(2);
    EXPECT_EQ(
        o.said,
        (std::vector<std::string>{
            "Card m is in service: it was reset, and only its functions drive it. The position of X, Y is not "
            "valid any more.",
            "Written.", "Y drives.", "640 pulses",
            "The service of card m has ended; the position of X, Y is not valid: home it, or set its position."}));
    EXPECT_NEAR(o.x(), 12, 1e-9);
    EXPECT_NEAR(o.y(), 3, 1e-9);
}

TEST(Service, OfACardThatPositionsItsAxisReleasesIt) {
    Served o(carriage());
    const auto set_up = [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 30)); };
    o.at(0.02, set_up);
    o.begin(0.05, "board");
    o.call(0.1, "version", {}, "board");
    o.call(0.15, "set_rate", {{"rate", 16'000}}, "board");
    o.call(0.2, "set_number", {{"counts", 100'000}}, "board");
    o.call(0.25, "go", {}, "board");
    o.at(0.5, [](Machine& m) { EXPECT_NE(m.status().axes[0].velocity, 0) << "by the card alone"; });
    o.at(0.6, [](Machine& m) { EXPECT_TRUE(m.service().end([](const Result<std::string>&) {})); });
    o.at(1, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_FALSE(m.status().axes[0].position_valid);
    });
    o.at(1.1, set_up);
    o.at(1.2, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 5, 20)); });
    o.run(3);
    EXPECT_NEAR(o.x(), 35, 0.1);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

TEST(Service, OfACardThatPositionsItsAxisEndsAtALimitSwitch) {
    Served o(carriage());
    o.begin(0.05, "board");
    o.call(0.15, "set_rate", {{"rate", 16'000}}, "board");
    o.call(0.2, "move_by", {{"counts", 100'000}, {"milliseconds", 60'000}}, "board");
    o.at(0.5, [](Machine& m) {
        EXPECT_NE(m.status().axes[0].velocity, 0);
        EXPECT_TRUE(m.wires().force("X.limit_plus", 0));
    });
    o.at(1, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_FALSE(m.service().on());
        EXPECT_EQ(m.status().axes[0].velocity, 0);
    });
    o.run(1.2);
    ASSERT_EQ(o.said.size(), 3U);
    EXPECT_NE(o.said[2].find("Stopped on request"), std::string::npos) << o.said[2];
}

TEST(Service, PreventsOtherMotion) {
    Served o;
    o.begin(0.05);
    o.at(0.1, [&](Machine& m) {
        const std::string why = "card m is in service; end the service first. Nothing was moved.";
        const auto refused = [&](const auto& order) {
            ASSERT_FALSE(order);
            EXPECT_NE(order.error().message.find(why), std::string::npos) << order.error().message;
        };
        refused(m.manual().jog('X', 5));
        refused(m.manual().jog_by('X', 1, 5));
        refused(m.manual().jog_to({20, 0, 0, 0, 0, 0}, 5));
        refused(m.manual().home("X"));
        refused(m.line("G1 X20 F600", 1));
        refused(m.begin_program("G0 X20\n", "p"));
        refused(m.manual().set_position('X', 0));
        EXPECT_FALSE(m.resume());
        EXPECT_FALSE(m.manual_access().request({"m", 16, 0, {}}, [](const auto&) {}));
        EXPECT_FALSE(m.service().begin("m", anna, "w1", {}));
    });
    o.run(0.2);
}

TEST(Service, CannotStartDuringMotionOrAStop) {
    Served o;
    const auto refused = [&](double seconds, const std::string& why) {
        o.at(seconds, [=](Machine& m) {
            const Result<void> begun = m.service().begin("m", anna, "w1", {});
            ASSERT_FALSE(begun) << seconds;
            EXPECT_NE(begun.error().message.find(why), std::string::npos) << begun.error().message;
            EXPECT_NE(m.state(), MachineState::service);
        });
    };
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X200\nM2\n", "p")); });
    refused(0.2, "the machine is in state 'moving'");
    o.at(0.25, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    refused(0.5, "the machine is in state 'hold'");
    o.at(0.6, [](Machine& m) { m.stop(anna); });
    refused(0.9, "Stopped on request");
    o.at(1.0, [](Machine& m) { m.reset(); });
    o.at(1.1, [](Machine& m) { EXPECT_TRUE(m.enable(false)); });
    refused(1.2, "the machine is disabled");
    o.at(1.22, [](Machine& m) { EXPECT_TRUE(m.enable(true, "X")); });
    refused(1.25, "axis Y is disabled");
    o.at(1.3, [](Machine& m) {
        const Result<void> begun = m.service().begin("glass", anna, "w1", {});
        ASSERT_FALSE(begun);
        EXPECT_NE(begun.error().message.find("no function library"), std::string::npos) << begun.error().message;
        EXPECT_FALSE(m.service().begin("nobody", anna, "w1", {}));
    });
    o.run(1.4);
}

TEST(Service, IsNeededForACardThatTheControllerDrives) {
    Served o;
    o.call(0.1, "ReadLPS", {{"axis", 1}});
    o.call(0.2, "SetV", {{"axis", 1}, {"data", 9000}});
    o.run(0.3);
    EXPECT_EQ(o.said, (std::vector<std::string>{
                          "refused: ReadLPS was not called: card m is driven by the controller. Begin its service "
                          "first.",
                          "refused: SetV: data is 9000, but must be 1 to 8000 x M pulses/s. Nothing was done."}));
}

TEST(Service, StartsOnACallToACardThatNothingDrives) {
    Served o;
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.enable(false)); });
    o.call(0.1, "SetRange", {{"data", 800'000}}, "free");
    o.call(0.15, "TCurve_F", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}, {"m_Pulse", 500}}, "free");
    o.call(0.2, "wait", {{"axis", 1}, {"milliseconds", 5000}}, "free");
    o.call(0.6, "ReadLPS", {{"axis", 1}}, "free");
    o.call(0.7, "ReadLPS", {{"axis", 1}});
    o.at(0.8, [](Machine& m) {
        EXPECT_EQ(m.status().service, "free");
        EXPECT_TRUE(m.status().axes[0].position_valid) << "it is another card's";
        EXPECT_TRUE(m.service().end({}));
    });
    o.at(0.9, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::disabled); });
    o.run(1);
    EXPECT_EQ(o.said,
              (std::vector<std::string>{"Written.", "X drives.", "X is at standstill, as commanded.", "500 pulses",
                                        "refused: ReadLPS was not called: the machine is in the service state for "
                                        "card free, not for card m. End that service first."}));
}

TEST(Service, CallsOneFunctionAtATimeAndExecutesCommandsWhileItWaits) {
    Served o;
    o.drive_x();
    o.call(0.35, "wait", {{"axis", 1}, {"milliseconds", 60'000}});
    o.call(0.5, "ReadLPS", {{"axis", 1}});
    o.at(0.6, [](Machine& m) { EXPECT_EQ(m.service().working(), "wait"); });
    double x = 0;
    o.at(0.7, [](Machine& m) { m.stop({"bert", "", "STOP"}); });
    o.at(0.705, [&](Machine& m) { x = m.status().axes[0].true_position; });
    o.at(0.9, [&](Machine& m) {
        EXPECT_EQ(m.status().axes[0].true_position, x) << "it stands within 5 ms, whatever its ramp";
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_NE(m.status().reason.find("STOP by bert"), std::string::npos) << m.status().reason;
        EXPECT_NE(m.status().reason.find("the position of X, Y is not valid: home it"), std::string::npos)
            << m.status().reason;
        EXPECT_FALSE(m.service().on());
    });
    o.run(1);
    ASSERT_EQ(o.said.size(), 5u);
    EXPECT_EQ(o.said[3], "refused: ReadLPS was not called: wait still runs. Wait until it ends, or end the service.");
    EXPECT_EQ(o.said[4], "Stopped on request; X stands still.");
}

/// A cause that ends a service, and the resulting state of the machine.
struct Ending {
    const char* name;
    void (*give)(Machine& m);
    MachineState after;
};
class ServiceWithAMovingAxis : public testing::TestWithParam<Ending> {};

TEST_P(ServiceWithAMovingAxis, StopsAtOnce) {
    Served o("");
    double x = 0;
    o.drive_x();
    o.at(0.5, GetParam().give);
    o.at(0.505, [&](Machine& m) { x = m.status().axes[0].true_position; });
    o.at(0.7, [&](Machine& m) {
        EXPECT_EQ(m.status().axes[0].true_position, x);
        EXPECT_EQ(m.state(), GetParam().after) << name_of(m.state()) << ' ' << m.status().reason;
        EXPECT_FALSE(m.service().on());
        EXPECT_FALSE(m.status().axes[0].position_valid);
        if (m.state() != MachineState::disabled) {
            EXPECT_NE(m.status().reason.find("not valid"), std::string::npos) << m.status().reason;
        }
    });
    o.run(0.8);
}

INSTANTIATE_TEST_SUITE_P(
    OfTheMachine, ServiceWithAMovingAxis,
    testing::Values(Ending{"its_end", [](Machine& m) { EXPECT_TRUE(m.service().end({})); }, MachineState::standstill},
                    Ending{"a_lost_client", [](Machine& m) { m.service().end_of("w1"); }, MachineState::standstill},
                    Ending{"disabling", [](Machine& m) { EXPECT_TRUE(m.enable(false)); }, MachineState::disabled},
                    Ending{"a_reset", [](Machine& m) { m.reset(anna); }, MachineState::standstill},
                    Ending{"a_stop", [](Machine& m) { m.stop(anna); }, MachineState::error_stop},
                    Ending{"the_emergency_stop", [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); },
                           MachineState::error_stop},
                    Ending{"an_alarm", [](Machine& m) { EXPECT_TRUE(m.wires().force("m.yalarm", 0)); },
                           MachineState::error_stop}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(Service, StopsAtALimitSwitchThatTheChipIgnores) {
    Served o("switches = { limit_minus_mm = -5, limit_plus_mm = 305 }\n");  // for Y
    o.begin(0.05);
    o.call(0.08, "SetRange", {{"data", 800'000}});
    o.call(0.09, "HLMTP", {{"n", 1}, {"axis", 2}});
    o.call(0.1, "TCurve_C", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}});
    o.at(0.5, [](Machine& m) { EXPECT_TRUE(m.wires().force("Y.limit_plus", 0)); });
    double x = 0;
    o.at(0.505, [&](Machine& m) { x = m.status().axes[0].true_position; });
    o.at(0.7, [&](Machine& m) {
        EXPECT_EQ(m.status().axes[0].true_position, x);
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_EQ(m.rack().stop_latch().cause(), rack::StopSource::limit_switch);
    });
    o.run(0.8);
}

TEST(Service, EndsWithTheProgram) {
    Served o;
    o.drive_x();
    o.run(0.5);
    EXPECT_FALSE(o.machine->service().on());
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
    EXPECT_EQ(o.machine->status().axes[0].velocity, 0);
}

TEST(Service, OfAnotherSessionContinues) {
    Served o;
    o.begin(0.05);
    o.at(0.1, [](Machine& m) { m.service().end_of("w2"); });
    o.at(0.2, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::service); });
    o.run(0.3);
}

}  // namespace
}  // namespace motionrack::operate
