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
        look(1.0, on);
        if (by_button())
            a.good(1.0, "set_estop", {{"pressed", true}});
        else
            a.at(1.0, [this] { a.panel->stop(nobody); });
        look(1.05, off);
        if (by_button()) a.good(1.2, "set_estop", {{"pressed", false}});
    }
    bool by_button() const { return GetParam(); }
    struct Seen {
        double marked_mm = 0, belt_mm_s = 0, shown_mm_s = 0, mask_m_s = 0;
        bool laser = false, belt_waits = false, mask_waits = false;
    };
    void look(double seconds, Seen& seen) {
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

TEST_P(StopOnThePage, PutsOutTheLaserAndStopsBeltsAndStages) {
    Seen later;
    look(3, later);
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

TEST_P(StopOnThePage, RefusesToMarkAndToStartPartsBeforeAReset) {
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
    look(2.0, still);
    a.good(2.1, "start_part", {{"part", "line"}});
    a.good(2.1, "start_part", {{"part", "mask_x"}});
    a.at(2.1, anna, "start_part", {{"part", "nobody"}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.good(2.2, "mark", {{"card", "scan"}, {"job", slow_job}});
    look(3, started);
    a.run(3.1);
    EXPECT_EQ(still.belt_mm_s, 0) << "a reset moves nothing";
    EXPECT_LT(still.mask_m_s, 0.001);
    EXPECT_EQ(started.belt_mm_s, 50);
    EXPECT_GT(started.mask_m_s, 0.01);
    EXPECT_TRUE(still.belt_waits && still.mask_waits);
    EXPECT_FALSE(started.belt_waits || started.mask_waits);
}

}  // namespace
}  // namespace motionrack::panel
