// STOP and the emergency stop of a served rack: the laser switches off, belts and stages stop, and stay stopped.
#include <gmock/gmock.h>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

const char* const slow_job = "[drawing]\ntext = \"ABC\"\nheight_mm = 8\n[pace]\nmark_speed_mm_s = 20\n";

class StopOnThePage : public testing::TestWithParam<bool> {
  protected:
    StopOnThePage() : a(demonstration()) {
        a.good(0.1, "take_control");
        a.good(0.2, "mark", {{"card", "scan"}, {"job", slow_job}});
        observe(1.0, on);
        if (by_button())
            a.good(1.0, "set_estop", {{"pressed", true}});
        else
            a.at(1.0, [this] { a.panel->stop(nobody); });
        observe(1.05, off);
        if (by_button()) a.good(1.2, "set_estop", {{"pressed", false}});
    }
    bool by_button() const { return GetParam(); }
    struct Seen {
        double marked_mm = 0, belt_mm_s = 0, shown_mm_s = 0, mask_m_s = 0;
        bool laser = false, belt_waits = false, mask_waits = false;
    };
    void observe(double seconds, Seen& seen) {
        a.at(seconds, [this, &seen] {
            rack::Rack& rack = a.machine->rack();
            const Instant now = a.machine->now();
            seen.laser = *a.machine->wires().get("scan.laser_on") != 0;
            seen.belt_mm_s = rack.track("line")->track().velocity(to_seconds(now));
            seen.mask_m_s = std::fabs(rack.stage("mask_x")->motor->velocity(now));
        });
        a.at(seconds, eve, "workpiece", {{"scanner", "head"}}, [&seen](const Answer& answer) {
            seen.marked_mm = answer.body["marked_mm"];
            seen.shown_mm_s = answer.body["part"]["velocity"];
            seen.belt_waits = answer.body["part"]["stopped"];
        });
        a.at(seconds, eve, "frames", nlohmann::json::object(),
             [&seen](const Answer& answer) { seen.mask_waits = answer.body["stages"][0]["stopped"]; });
    }

    Asked a;
    Seen on, off;
};

INSTANTIATE_TEST_SUITE_P(By, StopOnThePage, testing::Bool(),
                         [](const auto& each) { return each.param ? "TheButton" : "TheOrder"; });

TEST_P(StopOnThePage, DisablesTheLaserAndStopsBeltsAndStages) {
    Seen later;
    observe(3, later);
    a.run(3.1);
    EXPECT_GT(on.marked_mm, 5);
    EXPECT_EQ(on.belt_mm_s, 50);
    EXPECT_GT(on.mask_m_s, 0.01);
    EXPECT_FALSE(off.laser);
    EXPECT_EQ(off.belt_mm_s, 0);
    EXPECT_EQ(on.shown_mm_s, 50);
    EXPECT_EQ(off.shown_mm_s, 0) << "what is told is what it does";
    EXPECT_FALSE(later.laser);
    EXPECT_LE(later.marked_mm - on.marked_mm, 20 * 0.012) << "mm after the stop";
    EXPECT_EQ(later.marked_mm, off.marked_mm);
    EXPECT_LT(later.mask_m_s, 0.001);
    EXPECT_FALSE(on.belt_waits || on.mask_waits);
    EXPECT_TRUE(later.belt_waits && later.mask_waits);
}

TEST_P(StopOnThePage, RejectsMarkingAndStartingPartsBeforeAReset) {
    const auto refused = [](const Answer& answer) {
        EXPECT_EQ(answer.status, 409);
        EXPECT_THAT(answer.body["error"]["message"].get<std::string>(), AnyOf(HasSubstr("Reset"), HasSubstr("reset")));
    };
    a.good(1.4, "take_control");  // another client's STOP has ended it
    a.at(1.5, anna, "mark", {{"card", "scan"}, {"job", slow_job}}, refused);
    a.at(1.6, anna, "start_part", {{"part", "line"}}, refused);
    a.at(1.7, anna, "inject_fault", {{"target", "line"}, {"fault", "drive.speed=50"}}, refused);
    a.good(1.8, "reset");
    Seen still, started;
    observe(2.0, still);
    a.good(2.1, "start_part", {{"part", "line"}});
    a.good(2.1, "start_part", {{"part", "mask_x"}});
    a.at(2.1, anna, "start_part", {{"part", "nobody"}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.good(2.2, "mark", {{"card", "scan"}, {"job", slow_job}});
    observe(3, started);
    a.run(3.1);
    EXPECT_EQ(still.belt_mm_s, 0) << "a reset moves nothing";
    EXPECT_LT(still.mask_m_s, 0.001);
    EXPECT_EQ(started.belt_mm_s, 50);
    EXPECT_GT(started.mask_m_s, 0.01);
    EXPECT_TRUE(still.belt_waits && still.mask_waits);
    EXPECT_FALSE(started.belt_waits || started.mask_waits);
}

/// Returns the rack of the demonstration with a door.
rack::RackConfig with_door() {
    return config_of(text_of_file("examples/15_panel/demonstration.toml") + "\n[safety]\ndoor = true\n");
}

std::string message_of(const Answer& answer) {
    return answer.body.contains("error") ? answer.body["error"]["message"].get<std::string>() : answer.body.dump();
}

TEST(DoorOnThePage, DisablesTheLaserAndStopsBeltsAndStagesUntilItIsClosed) {
    Asked a(with_door());
    const auto laser = [&] { return *a.machine->wires().get("scan.laser_on"); };
    const auto belt = [&] { return a.machine->rack().track("line")->track().velocity(to_seconds(a.machine->now())); };
    const auto refused = [](const Answer& answer) {
        EXPECT_EQ(answer.status, 409);
        EXPECT_THAT(message_of(answer), HasSubstr("the door is open"));
    };
    a.good(0.1, "take_control");
    a.good(0.2, "mark", {{"card", "scan"}, {"job", slow_job}});
    bool was_on = false;
    for (int i = 0; i < 20; ++i) a.at(0.6 + 0.01 * i, [&] { was_on = was_on || laser() != 0; });
    a.good(1.0, "set_wire", {{"name", "door"}, {"value", 0}});
    double marked_mm = 0;
    const auto see = [&](double seconds, double& mm) {
        a.at(seconds, eve, "workpiece", {{"scanner", "head"}},
             [&](const Answer& answer) { mm = answer.body["marked_mm"]; });
    };
    see(1.02, marked_mm);
    a.at(1.05, [&] {
        EXPECT_TRUE(was_on);
        EXPECT_EQ(laser(), 0);
        EXPECT_EQ(belt(), 0);
    });
    a.at(1.2, anna, "mark", {{"card", "scan"}, {"job", slow_job}}, refused);
    a.at(1.2, anna, "start_part", {{"part", "line"}}, refused);
    a.good(1.5, "set_wire", {{"name", "door"}, {"value", 1}});
    double later_mm = 0;
    see(2, later_mm);
    a.at(2, [&] { EXPECT_EQ(belt(), 0) << "closing it starts nothing"; });
    a.good(2.1, "start_part", {{"part", "line"}});
    a.at(3, [&] { EXPECT_EQ(belt(), 50); });
    a.run(3.1);
    EXPECT_EQ(later_mm, marked_mm);
}

/// A command that ends a mark command while the panel builds its list.
struct EndOfMarking {
    const char* name;
    const char* command;
    json fields;
    const char* why;
};
void PrintTo(const EndOfMarking& end, std::ostream* out) {
    *out << end.name;
}

class MarkCommand : public testing::TestWithParam<EndOfMarking> {};

TEST_P(MarkCommand, IsNotExecutedIfItEndsWhileItsListIsBuilt) {
    Asked a(with_door());
    a.good(0.1, "take_control");
    int answered = 0;
    a.at(0.2, [&] {
        a.ask(anna, "mark", {{"card", "scan"}, {"job", slow_job}}, [&](const Answer& answer) {
            ++answered;
            EXPECT_EQ(answer.status, 409);
            EXPECT_THAT(message_of(answer), HasSubstr(GetParam().why));
        });
        a.ask(anna, GetParam().command, GetParam().fields,
              [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
    });
    a.at(0.5, eve, "workpiece", {{"scanner", "head"}},
         [](const Answer& answer) { EXPECT_EQ(answer.body["marked_mm"], 0); });
    a.run(1);
    EXPECT_EQ(answered, 1);
}

TEST(DoorOnThePage, EndsAMarkCommandAlsoIfItIsClosedBeforeTheListIsBuilt) {
    Asked a(with_door());
    a.good(0.1, "take_control");
    int answered = 0;
    a.at(0.2, [&] {
        a.ask(anna, "mark", {{"card", "scan"}, {"job", slow_job}}, [&](const Answer& answer) {
            ++answered;
            EXPECT_EQ(answer.status, 409);
            EXPECT_THAT(message_of(answer), HasSubstr("the door was opened while the list was made"));
        });
        for (const int closed : {0, 1})
            a.ask(anna, "set_wire", {{"name", "door"}, {"value", closed}},
                  [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
    });
    a.at(0.5, eve, "workpiece", {{"scanner", "head"}},
         [](const Answer& answer) { EXPECT_EQ(answer.body["marked_mm"], 0); });
    a.run(1);
    EXPECT_EQ(answered, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Ends, MarkCommand,
    testing::Values(EndOfMarking{"stop", "stop", json::object(), "Stopped on request"},
                    EndOfMarking{"mark_stop", "mark_stop", {{"card", "scan"}}, "the marking was stopped"},
                    EndOfMarking{"release_control", "release_control", json::object(), "control was lost"},
                    EndOfMarking{"door", "set_wire", {{"name", "door"}, {"value", 0}}, "the door is open"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(ButtonOnThePage, ActsInSeriesWithTheContactsOfTheMachine) {
    Asked a(config_of(
        "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[safety]\nestop_channels = 2\n"));
    const auto is = [&](double seconds, operate::MachineState state) {
        a.at(seconds, [&a, state] { EXPECT_EQ(a.machine->state(), state) << operate::name_of(a.machine->state()); });
    };
    using enum operate::MachineState;
    a.good(0.1, "take_control");
    a.good(0.1, "enable", {{"on", true}});
    a.good(0.2, "set_estop", {{"pressed", true}});
    is(0.3, error_stop);
    a.good(0.3, "set_estop", {{"pressed", false}});
    a.good(0.35, "reset");
    is(0.4, standstill);
    a.good(0.4, "set_wire", {{"name", "estop1"}, {"value", 0}});
    is(0.45, error_stop);
    a.good(0.45, "set_wire", {{"name", "estop2"}, {"value", 0}});
    a.at(0.5, bert, "set_estop", {{"pressed", false}}, [](const Answer& answer) {
        EXPECT_EQ(answer.status, 409);
        EXPECT_THAT(message_of(answer), HasSubstr("stays pressed"));
    });
    a.good(0.55, "reset");
    is(0.6, error_stop);
    for (const char* contact : {"estop1", "estop2"}) a.good(0.7, "set_wire", {{"name", contact}, {"value", 1}});
    a.good(0.8, "reset");
    is(0.9, standstill);
    a.run(1);
}

}  // namespace
}  // namespace motionrack::panel
