// Tests of marking jobs, from the text of the job to the marks on the part.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/mark/test/helpers.hpp>

namespace motionrack::mark {
namespace {

using testing::HasSubstr;

/// Reference job: a square of 10 mm starting at its corner, at 500 mm/s on a belt at 100 mm/s.
const std::string mark_belt_job =
    "[drawing]\nsvg = 'square.svg'\nanchor = 'origin'\n[pace]\nmark_speed_mm_s = 500\n[belt]\nvelocity_mm_s = 100\n";

/// Returns true if a point within `near_mm` was marked as the end of a segment.
bool has_corner(const Marked& marked, Spot corner, double near_mm) {
    for (const parts::MarkedPoint& p : marked.points)
        if (std::hypot(p.at.x - corner.x, p.at.y - corner.y) <= near_mm) return true;
    return false;
}

TEST(MarkJob, TheReferenceSquareIsRightWithCorrectionAndShearedWithout) {
    const MarkingOutcome out = run(job_of(mark_belt_job + "[fly]\nmode = 'encoder'\n"));
    EXPECT_EQ(out.strokes, 1u);
    EXPECT_NEAR(out.drawing_mm, 40, 1e-9);
    EXPECT_LE(out.on.deviation.max_mm, 0.0025) << "one count and one tick";
    EXPECT_EQ(out.on.deviation.missing_mm, 0);
    EXPECT_TRUE(out.on.overflows.empty());
    ASSERT_TRUE(out.off);
    for (const Spot corner : {Spot{0, 0}, Spot{8, 0}, Spot{6, 10}, Spot{-6, 10}, Spot{-8, 0}})
        EXPECT_TRUE(has_corner(*out.off, corner, 0.005)) << corner.x << ' ' << corner.y;
    EXPECT_NEAR(out.on.seconds, 0.08, 0.006);
    EXPECT_NEAR(out.on.duty, 0.08 / out.on.seconds, 0.01);
    EXPECT_NEAR(out.on.energy_j, 20 * 0.08, 0.01);
}

TEST(MarkJob, RecordsTheUsedFieldAndThePathOfTheSpot) {
    const MarkingOutcome out = run(job_of(mark_belt_job + "[fly]\nmode = 'encoder'\n"));
    EXPECT_NEAR(out.field.high.x, 60.57, 0.01);
    // At 100 mm/s the corners are marked after 20, 40, 60 and 80 ms: the second at X 10 + 4 mm, the last at X 8 mm.
    EXPECT_NEAR(out.on.reach.high.x, 14, 0.05);
    EXPECT_NEAR(out.on.reach.low.x, 0, 0.01);
    EXPECT_NEAR(out.off->reach.high.x, 10, 1e-9);
    ASSERT_GT(out.on.course.size(), 5000u);
    double max_x = 0, open_s = 0;
    for (std::size_t i = 0; i < out.on.course.size(); ++i) {
        max_x = std::max(max_x, out.on.course[i].at.x);
        if (i > 0) open_s += out.on.course[i].gate * (out.on.course[i].at_s - out.on.course[i - 1].at_s);
    }
    EXPECT_NEAR(max_x, out.on.reach.high.x, 0.01);
    EXPECT_NEAR(open_s, out.on.duty * out.on.seconds, 1e-5);
}

TEST(MarkJob, EveryTrackingMethodGivesTheSquare) {
    for (const char* mode : {"encoder", "simulated", "mcbsp"})
        for (const char* direction : {"0", "90", "180", "270", "30"}) {
            MarkingJob job =
                job_of(mark_belt_job + "direction_deg = " + direction + "\n[fly]\nmode = '" + mode + "'\n");
            EXPECT_LE(run(job).on.deviation.max_mm, std::string(mode) == "mcbsp" ? 0.0045 : 0.003)
                << mode << ' ' << direction;
        }
    for (const char* mode : {"encoder", "simulated", "mcbsp"}) {
        const MarkingOutcome out = run(
            job_of(std::string("[drawing]\nsvg = 's'\n[table]\nvelocity_deg_s = 60\ncentre_x_mm = -30\ncounts_per_deg "
                               "= 10000\n[sender]\nbits_per_unit = 10000\n[fly]\nmode = '") +
                   mode + "'\n"));
        EXPECT_LE(out.on.deviation.max_mm, 0.003) << mode;
        EXPECT_GT(out.off->deviation.max_mm, 0.1);
    }
}

TEST(MarkJob, TheMaximumBeltVelocityFitsAndASlightlyHigherOneDoesNot) {
    MarkingJob job = job_of(mark_belt_job + "[fly]\nmode = 'encoder'\n");
    const MarkingOutcome out = run(job);
    ASSERT_TRUE(out.fits_factor);
    // The last corner is marked slightly more than 0.08 s after the start, at the belt travel; the field ends at 60.57
    // mm.
    EXPECT_GT(*out.fits_factor, 6);
    EXPECT_LT(*out.fits_factor, 9);
    job.belt.velocity = 100 * *out.fits_factor;
    EXPECT_TRUE(run(job).on.overflows.empty());
    job.belt.velocity *= 1.001;
    const MarkingOutcome over = run(job);
    ASSERT_EQ(over.on.overflows.size(), 1u);
    EXPECT_EQ(over.on.overflows[0].name, "FLY_X_OVERFLOW");
    EXPECT_NEAR(*over.fits_factor * job.belt.velocity, 100 * *out.fits_factor, 0.2);
    EXPECT_THAT(outcome_text(job, over), HasSubstr("FLY_X_OVERFLOW at 0.0"));
}

TEST(MarkJob, AWrongScaleAndALateSourceDeviateAsTheirFormulasState) {
    const MarkingOutcome wrong = run(job_of(mark_belt_job + "[fly]\nmode = 'encoder'\nscale_factor = 1.01\n"));
    EXPECT_NEAR(wrong.on.deviation.max_mm, 0.01 * 100 * wrong.on.seconds, 0.01);
    const MarkingOutcome late = run(job_of(mark_belt_job + "[sender]\ndelay_us = 2000\n[fly]\nmode = 'mcbsp'\n"));
    EXPECT_NEAR(late.on.deviation.max_mm, 0.2, 0.005) << "2 ms at 100 mm/s";
}

TEST(MarkJob, ALensIsCorrectedByItsTableAndNotWithoutOne) {
    const std::string lens = "[drawing]\nsvg = 's'\nscale = 6\n[lens]\n";
    EXPECT_LT(run(job_of(lens)).on.deviation.max_mm, 0.002);
    EXPECT_GT(run(job_of(lens + "[optics]\ncorrection = false\n")).on.deviation.max_mm, 0.2);
}

TEST(MarkJob, CirclesTextAndGcodeAreMarkedAsDrawn) {
    const MarkingOutcome circle =
        run(job_of("[drawing]\nsvg = 's'\nx_mm = 3\n"), "<svg><circle cx='5' cy='5' r='4'/></svg>");
    EXPECT_EQ(circle.elements, 2u) << "arcs of the card";
    EXPECT_LE(circle.on.deviation.max_mm, 0.001);
    EXPECT_EQ(circle.on.deviation.missing_mm, 0);
    const MarkingOutcome text = run(job_of("[drawing]\ntext = 'SN 0042 g'\nheight_mm = 3\n"));
    EXPECT_LE(text.on.deviation.max_mm, 0.001);
    EXPECT_EQ(text.on.deviation.missing_mm, 0);
    const MarkingOutcome gcode = run(job_of("[drawing]\ngcode = 'p'\nanchor = 'origin'\n"),
                                     "G21 G90 G0 X5 Y0\nG1 X10 F100\nG3 X10 Y10 I0 J5\nG0 X0 Y0\nM2\n");
    EXPECT_EQ(gcode.strokes, 1u);
    EXPECT_NEAR(gcode.drawing_mm, 5 + 5 * 3.14159265, 1e-6);
    EXPECT_LE(gcode.on.deviation.max_mm, 0.001);
}

TEST(MarkJob, WrongJobsAreRefusedWithTheirLocations) {
    const auto first = [](const std::string& text) {
        const JobRead read = read_job(text, "j.toml");
        return read.errors.empty() ? std::string() : read.errors[0].text();
    };
    EXPECT_THAT(first("[drawing]\n"), HasSubstr("j.toml:1:"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\nsvg = 'b'\n"), HasSubstr("but has 2"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\n[pace]\nmark_speed_mm_s = nan\n"), HasSubstr("j.toml:4:"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\n[pace]\njump_delay_us = 55\n"), HasSubstr("steps of 10 us"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\n[bolt]\n"),
                ::testing::EndsWith("Unknown section 'bolt'; did you mean 'belt'?"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\n[belt]\nprofile = [[0, 1], [0, 2]]\n"), HasSubstr("j.toml:4:"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\n[fly]\nmode = 'simulated'\n"), HasSubstr("constant velocity"));
    EXPECT_THAT(first("[drawing]\ntext = "), HasSubstr("j.toml:2:"));
    EXPECT_THAT(first("[drawing]\ntext = 'A'\n[parts]\nat_mm = [0, 40]\n"),
                HasSubstr("'at_mm' is now 'part_positions_mm'."));
    const Result<Prepared> strange = prepare(job_of("[drawing]\ntext = 'A^'\n"), one_file(""));
    EXPECT_THAT(strange.error().text(), HasSubstr("Character 2"));
    const MarkingJob fast = job_of("[drawing]\ntext = 'A'\n[pace]\nmark_speed_mm_s = 200000\n");
    EXPECT_THAT(run_job(fast, *prepare(fast, one_file(""))).error().text(), HasSubstr("bits/ms"));
    EXPECT_THAT(prepare(job_of("[drawing]\nsvg = 's'\n"), one_file("<svg><circle r='1e7'/></svg>")).error().text(),
                HasSubstr("100000 mm"));
    EXPECT_FALSE(prepare(job_of("[drawing]\ntext = 'A'\n[optics]\nct5 = 'x.ct5'\n"), one_file("no table")));
}

TEST(MarkJob, ChecksACorrectionFileAndReportsItsUnknownParts) {
    const MarkingJob job = job_of("[drawing]\ntext = 'A'\n[optics]\nct5 = 'x.ct5'\n");
    rtc5::CorrectionFile table = rtc5::one_to_one();
    const auto file = [&](std::int32_t k, std::int32_t program, std::initializer_list<std::size_t> turned) {
        table.header[1] = k, table.header[10] = program;
        std::vector<std::uint8_t> bytes = rtc5::written_ct5(table);
        for (const std::size_t location : turned) bytes[location] ^= 8;
        return one_file(std::string(bytes.begin(), bytes.end()));
    };
    const auto notes = [&](const Load& load) { return prepare(job, load)->notes; };
    const auto why_not = [&](const Load& load) { return prepare(job, load).error().text(); };
    EXPECT_THAT(notes(file(5184, 403, {})), testing::Not(testing::Contains(HasSubstr("checksum"))));
    EXPECT_THAT(notes(file(5184, 310, {rtc5::ct5_bytes - 1, rtc5::ct5_bytes - 4})),
                testing::Contains("x.ct5 is from an older program, whose checksum is unknown; it was not checked."));
    for (const std::size_t turned : {std::size_t{4}, std::size_t{41}, std::size_t{99'996}, rtc5::ct5_bytes - 1})
        for (const std::int32_t program : {403, 310})
            EXPECT_THAT(why_not(file(5184, program, {turned})), HasSubstr("is damaged. The file was not loaded"));
    EXPECT_THAT(why_not(file(0, 403, {})), HasSubstr("0 bits/mm in its header"));
    for (std::size_t i = 0; i < table.x.size(); ++i) table.x[i] = table.y[i];
    EXPECT_THAT(why_not(file(5184, 403, {})), HasSubstr("its table cannot be inverted"));
}

TEST(MarkJob, StopsOnRequest) {
    const MarkingJob job = job_of("[drawing]\ntext = 'AAAAAAAAAAAA'\n[pace]\nmark_speed_mm_s = 10\n");
    const Result<MarkingOutcome> out = run_job(job, *prepare(job, one_file("")), {{}, [] { return true; }});
    ASSERT_FALSE(out);
    EXPECT_EQ(out.error().kind, ErrorKind::stopped);
}

}  // namespace
}  // namespace motionrack::mark
