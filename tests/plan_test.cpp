// `motionrack plan` and its page.
#include <gmock/gmock.h>

#include <cstdio>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "ran.hpp"

namespace motionrack {
namespace {

using testing::HasSubstr;

class PlanCommand : public InFolder {};

TEST_F(PlanCommand, PageShowsWhatItPrints) { EXPECT_EQ(run_page("docs/howto/plan.md").size(), 1u); }

/// Each shape: the page's row is what is planned, no axis is asked too much, and it takes no longer than with exact stops.
TEST_F(PlanCommand, KeepsTheLimitsOfTheShapesOfItsPage) {
    const std::string page = text_of(root / "docs/howto/plan.md");
    int shapes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(root / "examples/plan")) {
        const Ran ran = motionrack("plan --json examples/plan/" + entry.path().filename().string());
        ASSERT_EQ(ran.code, 0) << ran.out;
        const auto plan = nlohmann::json::parse(ran.out);
        const double stopping = plan["stopping"]["seconds"], trapezoids = plan["trapezoids"]["seconds"], limited = plan["jerk_limited"]["seconds"];
        EXPECT_LE(limited, stopping) << entry.path();
        for (const auto& axis : plan["axes"])
            for (const char* part : {"of_speed", "of_accel", "of_jerk"}) EXPECT_LE(axis[part].get<double>(), 1 + 1e-6) << entry.path() << part;
        std::array<char, 200> row{};
        std::snprintf(row.data(), row.size(), "| %.3f s | %.3f s | %.3f s |", stopping, trapezoids, limited);
        EXPECT_THAT(page, HasSubstr(row.data())) << entry.path();
        ++shapes;
    }
    EXPECT_EQ(shapes, 6);
}

TEST_F(PlanCommand, OfNothingTakesNoTime) {
    const Ran ran = motionrack("plan /dev/null --json");
    ASSERT_EQ(ran.code, 0) << ran.out;
    EXPECT_EQ(nlohmann::json::parse(ran.out)["jerk_limited"]["seconds"], 0);
}

TEST_F(PlanCommand, RefusesWhatCannotBePlannedWithTheReason) {
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
