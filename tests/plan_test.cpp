// `motionrack plan` and its page.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

#include "ran.hpp"

namespace motionrack {
namespace {

using testing::HasSubstr;

class PlanCommand : public InFolder {};

TEST_F(PlanCommand, PageShowsTheOutputOfTheCommand) {
    EXPECT_EQ(run_page("docs/howto/plan.md").size(), 1u);
}

/// For each shape: the row of the page equals the plan, no axis exceeds its limits, and exact stops would not be
/// faster.
TEST_F(PlanCommand, KeepsTheLimitsOfTheShapesOfItsPage) {
    const std::string page = text_of(source_root / "docs/howto/plan.md");
    int shapes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_root / "examples/plan")) {
        const Ran ran = motionrack("plan --json examples/plan/" + entry.path().filename().string());
        ASSERT_EQ(ran.code, 0) << ran.out;
        const auto plan = nlohmann::json::parse(ran.out);
        const double stopping = plan["stopping"]["duration_s"], trapezoids = plan["trapezoids"]["duration_s"],
                     limited = plan["jerk_limited"]["duration_s"], bound = plan["bound"]["duration_s"];
        EXPECT_LE(limited, stopping) << entry.path();
        EXPECT_GE(limited, bound) << entry.path();
        double peak = 0;
        for (const auto& axis : plan["axes"])
            for (const char* part : {"of_velocity", "of_accel", "of_jerk"})
                peak = std::max(peak, axis[part].get<double>());
        EXPECT_LE(peak, 1 + 1e-6) << entry.path();
        std::array<char, 200> row{};
        std::snprintf(row.data(), row.size(), "| %.3f s | %.3f s | %.3f s | %.3f s | %.1f %% |", stopping, trapezoids,
                      limited, bound, 100 * peak);
        EXPECT_THAT(page, HasSubstr(row.data())) << entry.path();
        ++shapes;
    }
    EXPECT_EQ(shapes, 6);
}

TEST_F(PlanCommand, DrawsThePicturesOfItsPage) {
    const std::string page = text_of(source_root / "docs/howto/plan.md");
    for (const std::string shape : {"square_wave", "zigzag", "chords", "arcs", "circles", "stadium"}) {
        const std::string name = "plan_" + shape + ".svg", command = "plan examples/plan/" + shape + ".ngc --picture ";
        ASSERT_EQ(motionrack(command + name).code, 0) << shape;
        EXPECT_THAT(page, HasSubstr("](../pictures/" + name + ")"));
        EXPECT_EQ(text_of(folder / name), text_of(source_root / "docs/pictures" / name))
            << "make it anew: motionrack " << command << "docs/pictures/" << name;
    }
}

TEST_F(PlanCommand, DrawsEveryProgramThatCanBePlanned) {
    write("rotary.ngc", "G21 G90 G94\nG1 A90 F600\nG4 P0.5\nG1 A0\n");
    write("dwell.ngc", "G4 P1\n");
    write("helix.ngc", "G21 G90 G64 P0.01\nG0 X50 Y50 Z0\nG3 X50 Y50 I10 Z20 F1200\n");
    write("nothing.ngc", "M2\n");
    for (const char* program : {"rotary", "dwell", "helix", "nothing"}) {
        const Ran ran = motionrack(std::string("plan ") + program + ".ngc --picture " + program + ".svg");
        ASSERT_EQ(ran.code, 0) << ran.out;
        EXPECT_THAT(ran.out, HasSubstr(std::string("written: ") + program + ".svg"));
        const std::string svg = text_of(folder / (std::string(program) + ".svg"));
        EXPECT_THAT(svg, testing::StartsWith("<svg xmlns="));
        EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
        EXPECT_THAT(svg, testing::Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("inf\""), HasSubstr("inf,"))))
            << program;
    }
    EXPECT_NE(motionrack("plan rotary.ngc --picture no/such/folder.svg").code, 0);
}

TEST_F(PlanCommand, OfAnEmptyPathTakesNoTime) {
    write("nothing.ngc", "G21\nM2\n");
    const Ran ran = motionrack("plan nothing.ngc --json");
    ASSERT_EQ(ran.code, 0) << ran.out;
    EXPECT_EQ(nlohmann::json::parse(ran.out)["jerk_limited"]["duration_s"], 0);
}

TEST_F(PlanCommand, RejectsUnplannableProgramsWithTheReason) {
    EXPECT_EQ(motionrack("plan nothere.ngc").code, 5);
    write("bad.ngc", "G21\nG1 X1\nG999\n");
    const Ran bad = motionrack("plan bad.ngc");
    EXPECT_EQ(bad.code, 2);
    EXPECT_THAT(bad.out, HasSubstr("bad.ngc:2:"));
    EXPECT_THAT(bad.out, HasSubstr("bad.ngc:3:"));
    write("one_by_one.toml", "[card.p]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"p\"\n");
    write("good.ngc", "G21 G90\nG1 X1 F600\n");
    const Ran alone = motionrack("plan good.ngc --rack one_by_one.toml");
    EXPECT_EQ(alone.code, 3) << alone.out;
    EXPECT_THAT(alone.out, HasSubstr("position one by one"));
}

}  // namespace
}  // namespace motionrack
