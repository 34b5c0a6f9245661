// A limit breach during a run, as of `motionrack run`: the summary, its JSON and the headline of the report state it,
// and the outcome is not good (exit code 4).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/trace/report.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <tests/journey.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Returns a spiral in chords of 0.2 mm, each of 2 ms at F6000.
std::string short_chords() {
    std::string out = "G21 G90 G64 P0.01\nG0 X170 Y100\nG1 F6000\n";
    double angle = 0;
    for (double s = 0; s < 200; s += 0.2) {
        const double radius = 20 + s / 100;
        angle += 0.2 / radius;
        out += fmt::format("X{:.4f} Y{:.4f}\n", 150 + radius * std::cos(angle), 100 + radius * std::sin(angle));
    }
    return out + "M2\n";
}

/// A run whose host pauses for 20 ms: its motors lose steps, and the following-error supervision is off.
class RunWithABreach : public testing::Test {
  protected:
    void SetUp() override {
        request.config = router();
        for (RackAxis& axis : request.config.axes) axis.following_error_alarm = 0;
        request.program = short_chords();
        request.program_name = "chords.ngc";
        auto made = RecordedJob::create(request, {});
        ASSERT_TRUE(made) << made.error().message;
        job = std::move(*made);
        bool late = false;
        outcome = job->run(nullptr, [&](const JobProgress&) {
            if (late || job->rack().kernel().now() < milliseconds(2500)) return;
            late = true;
            job->rack().cards().front()->host().pass(milliseconds(20));
        });
        ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
        ASSERT_FALSE(outcome.breaches.all().empty());
    }
    JobRequest request;
    std::unique_ptr<RecordedJob> job;
    JobOutcome outcome;
};

TEST_F(RunWithABreach, HasARedHeading) {
    EXPECT_FALSE(job->report().verdict.ok);
    const std::string page = trace::report_html(job->report());
    EXPECT_THAT(page, HasSubstr("<p class=\"verdict wrong\">"));
    EXPECT_THAT(page, Not(HasSubstr("<p class=\"verdict good\">")));
}

TEST_F(RunWithABreach, IsNotGoodEvenIfItsPositionsAreTrue) {
    outcome.position_valid = true;
    EXPECT_FALSE(outcome.good());
    EXPECT_THAT(summary_of(request.config, outcome), StartsWith("The program ended, but motors may have lost steps: "));
    const nlohmann::json json = nlohmann::json::parse(summary_json(request.config, outcome));
    EXPECT_EQ(json["ok"], false);
    ASSERT_EQ(json["breaches"].size(), outcome.breaches.all().size());
    EXPECT_EQ(json["breaches"][0]["kind"], name_of(outcome.breaches.all()[0].kind));
    outcome.breaches = {};
    EXPECT_TRUE(outcome.good());
    EXPECT_EQ(nlohmann::json::parse(summary_json(request.config, outcome))["ok"], true);
}

TEST_F(RunWithABreach, ThatEndsEarlyCallsMovesAndPathPlanned) {
    EXPECT_THAT(summary_of(request.config, outcome), Not(HasSubstr(" mm planned,")));
    outcome.ended = fail(ErrorKind::machine, "The motion was stopped.");
    const std::string summary = summary_of(request.config, outcome);
    EXPECT_THAT(summary, HasSubstr(" s with 1002 moves, 0 dwells, "));
    EXPECT_THAT(summary, HasSubstr(" mm planned,"));
}

}  // namespace
}  // namespace motionrack::rack
