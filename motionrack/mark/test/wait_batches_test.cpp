// Tests of drawings longer than the field, and of position sources that are late or assume a constant velocity.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <motionrack/mark/svg.hpp>
#include <motionrack/mark/test/helpers.hpp>
#include <motionrack/mark/wait_batches.hpp>

namespace motionrack::mark {
namespace {

using testing::HasSubstr;

/// A frame 300 mm long and 20 mm wide with a circle in it; the field is 121 mm wide.
constexpr const char* long_svg = R"(<svg><rect x='-380' y='-10' width='300' height='20'/>)"
                                 R"(<circle cx='-200' cy='0' r='8'/><path d='M-300 -5 L-160 5'/></svg>)";
std::string long_job(const std::string& belt, const std::string& fly) {
    return "[drawing]\nsvg = 's'\nanchor = 'origin'\n[pace]\nmark_speed_mm_s = 3000\njump_speed_mm_s = "
           "6000\n[belt]\ncounts_per_mm "
           "= 1000\n" +
           belt + "\n[fly]\nwait_mode = 'auto'\n" + fly + "\n";
}

TEST(WaitBatches, EverySegmentIsInTheFieldOnceItsWaitHasEnded) {
    const Drawing drawing = *read_svg(long_svg, "s");
    const Box field{{-59, -59}, {59, 59}};
    for (const Spot movement : {Spot{1, 0}, Spot{0.8, 0.6}}) {
        Drawing turned = transformed(drawing, {movement.x, movement.y, -movement.y, movement.x, 0, 0});
        const std::vector<WaitBatch> batches = *batches_of(turned, field, movement);
        EXPECT_GT(batches.size(), 10u);
        double length = 0, before = 0;
        for (const WaitBatch& batch : batches) {
            EXPECT_GE(batch.at_mm, before);
            EXPECT_GT(batch.until_mm, batch.at_mm + 118 / 2.0);
            before = batch.at_mm;
            length += length_of({batch.strokes});
            for (const double travel : {batch.at_mm, batch.until_mm})
                for (const parts::DrawnSegment& s : segments_of({batch.strokes})) {
                    EXPECT_LE(std::fabs(s.to.x + travel * movement.x), 59.01);
                    EXPECT_LE(std::fabs(s.to.y + travel * movement.y), 59.01);
                }
        }
        EXPECT_NEAR(length, length_of(drawing), 1e-6) << "nothing twice, nothing left out";
    }
}

TEST(WaitBatches, StrokesShorterThanAQuarterOfTheFieldAreNotDivided) {
    const Drawing circle = *read_svg("<svg><circle cx='-100' cy='0' r='14'/></svg>", "s");
    const std::vector<WaitBatch> batches = *batches_of(circle, {{-59, -59}, {59, 59}}, {1, 0});
    ASSERT_EQ(batches.size(), 1u);
    ASSERT_EQ(batches[0].strokes.size(), 1u);
    EXPECT_NEAR(batches[0].at_mm, 114 - 59, 1e-6);
}

TEST(WaitBatches, ADrawingLongerThanTheFieldIsMarkedInMotion) {
    for (const char* fly : {"mode = 'encoder'", "mode = 'simulated'", "mode = 'mcbsp'"})
        for (const char* belt : {"velocity_mm_s = 150", "velocity_mm_s = -150\ndirection_deg = 180"}) {
            const MarkingOutcome out = run(job_of(long_job(belt, fly)), long_svg);
            EXPECT_LE(out.on.deviation.max_mm, 0.006) << fly << belt;
            EXPECT_EQ(out.on.deviation.missing_mm, 0) << fly << belt;
            EXPECT_TRUE(out.on.overflows.empty()) << fly << belt;
            EXPECT_TRUE(out.drawing_in_field);
            ASSERT_TRUE(out.off);
            EXPECT_GT(out.off->deviation.max_mm, 1) << "pieces at their places, but sheared";
            EXPECT_LT(out.off->deviation.max_mm, 20);
        }
    // Without waits nearly all of it is outside the field.
    const MarkingOutcome none =
        run(job_of("[drawing]\nsvg = 's'\nanchor = 'origin'\n[belt]\nvelocity_mm_s = 150\n[fly]\nmode = 'encoder'\n"),
            long_svg);
    EXPECT_FALSE(none.on.overflows.empty());
    EXPECT_GT(none.on.deviation.missing_mm, 300);
}

TEST(WaitBatches, AFrameIsReadyWhenItsLastEdgeHasEnteredTheField) {
    // The trailing edge, at -380 mm, has to move by 380 - 59.57 mm into the field, at 150 mm/s.
    const MarkingOutcome out = run(job_of(long_job("velocity_mm_s = 150", "mode = 'encoder'")), long_svg);
    EXPECT_GT(out.on.seconds, (380 - 59.57) / 150);
    EXPECT_LT(out.on.seconds, (380 - 59.57) / 150 + 0.1);
}

TEST(WaitBatches, ABeltThatIsTooFastIsRefusedWithTheVelocityThatFits) {
    const std::string why = refusal(job_of(long_job("velocity_mm_s = 2500", "mode = 'encoder'")), long_svg);
    EXPECT_THAT(why, HasSubstr("The belt is too fast: at 2500 mm/s marks leave the field by up to"));
    const std::size_t at = why.find("The limit is ");
    ASSERT_NE(at, std::string::npos) << why;
    const double fits = std::stod(why.substr(at + 13));
    MarkingJob job = job_of(long_job("velocity_mm_s = 2500", "mode = 'encoder'"));
    job.belt.velocity = fits * 0.999;
    EXPECT_EQ(refusal(job, long_svg), "");
    job.belt.velocity = fits * 1.001;
    EXPECT_NE(refusal(job, long_svg), "");
    // A job with half the velocity finds the same limit.
    job.belt.velocity = fits / 2;
    const MarkingOutcome slow = run(job, long_svg);
    EXPECT_NEAR(*slow.fits_factor * job.belt.velocity, fits, 0.02 * fits);
}

TEST(WaitBatches, StrokesThatNeverEnterOrHaveLeftTheFieldAreRejectedWithMillimetres) {
    const std::string belt = "velocity_mm_s = 100", fly = "mode = 'encoder'";
    EXPECT_THAT(refusal(job_of(long_job(belt, fly)), "<svg><path d='M0 70 H10'/></svg>"),
                HasSubstr("is never inside the field"));
    EXPECT_THAT(refusal(job_of(long_job(belt, fly)), "<svg><path d='M65 0 H70'/></svg>"),
                HasSubstr("has left the field by 10.431 mm before"));
    EXPECT_THAT(refusal(job_of(long_job(belt, fly + "\nmargin_mm = 61")), long_svg),
                HasSubstr("exceeds a field of 121."));
    EXPECT_THAT(errors_of(long_job(belt, "")), HasSubstr("Waits need a correction"));
    EXPECT_THAT(errors_of(long_job("profile = [[0, 10], [1, -10]]", fly)), HasSubstr("never reverses"));
    EXPECT_THAT(errors_of(long_job(belt + "\ndirection_deg = 30", "mode = 'mcbsp'")),
                HasSubstr("two values of 16 bits"));
    EXPECT_THAT(
        errors_of("[drawing]\nsvg = 's'\n[table]\nvelocity_deg_s = 10\n[fly]\nmode = 'encoder'\nwait_mode = 'auto'\n"),
        HasSubstr("j.toml:7:13: Waits need a belt"));
}

TEST(WaitBatches, WorkWithPartsAndVelocityProfiles) {
    const MarkingOutcome parts =
        run(job_of(long_job("velocity_mm_s = 150",
                            "mode = 'encoder'\n[parts]\ncount = 2\nspacing_mm = 420\ntrack_delay_mm = 30")),
            long_svg);
    for (const PartMarked& part : parts.on.parts) {
        EXPECT_EQ(part.fate, PartOutcome::marked);
        EXPECT_LE(part.deviation.max_mm, 0.006);
        EXPECT_EQ(part.deviation.missing_mm, 0);
    }
    const MarkingOutcome profile =
        run(job_of(long_job("profile = [[0, 50], [1, 300], [2, 0], [3, 0], [4, 200]]", "mode = 'encoder'")), long_svg);
    EXPECT_LE(profile.on.deviation.max_mm, 0.008);
    EXPECT_EQ(profile.on.deviation.missing_mm, 0);
}

TEST(MarkSources, ASimulatedEncoderIsRightOnlyWhileTheBeltHasItsVelocity) {
    const std::string job =
        "[drawing]\nsvg = 's'\nanchor = 'origin'\n[belt]\nprofile = [[0, 100], [0.04, 100], [0.08, 60]]\n[fly]\n";
    const MarkingOutcome encoder = run(job_of(job + "mode = 'encoder'\n"));
    EXPECT_LE(encoder.on.deviation.max_mm, 0.003);
    const MarkingOutcome simulated = run(job_of(job + "mode = 'simulated'\nsimulated_velocity_mm_s = 100\n"));
    // The belt decelerates from 100 to 60 mm/s in 40 ms, so at 80 ms it is 0.04 s * 20 mm/s = 0.8 mm behind the assumed
    // position.
    EXPECT_NEAR(simulated.on.deviation.max_mm, 0.8, 0.08);
    EXPECT_THAT(errors_of(job + "mode = 'simulated'\n"), HasSubstr("simulated_velocity in [fly]"));
    EXPECT_THAT(errors_of(job + "mode = 'encoder'\nsimulated_velocity_mm_s = 100\n"), HasSubstr("j.toml:8:27"));
}

TEST(MarkSources, ALateMcBspSourceIsCompensatedAtConstantVelocity) {
    const auto job = [](const std::string& belt, const std::string& offset) {
        return "[drawing]\nsvg = 's'\nanchor = 'origin'\n" + belt +
               "\n[sender]\nbits_per_unit = 10000\ndelay_us = 1500\n[fly]\nmode = 'mcbsp'\n" + offset + "\n";
    };
    const std::string belt = "[belt]\nvelocity_mm_s = 200", table = "[table]\nvelocity_deg_s = 60\ncentre_y_mm = -50";
    EXPECT_NEAR(run(job_of(job(belt, ""))).on.deviation.max_mm, 0.3, 0.005) << "1.5 ms at 200 mm/s";
    EXPECT_LE(run(job_of(job(belt, "offset_us = 1500"))).on.deviation.max_mm, 0.005);
    EXPECT_GT(run(job_of(job(table, ""))).on.deviation.max_mm, 0.05);
    EXPECT_LE(run(job_of(job(table, "offset_us = 1500"))).on.deviation.max_mm, 0.004);
    // An error remains while the velocity changes: after 40 ms at 1000 mm/s2 it is 40 mm/s higher, which is 0.06 mm in
    // 1.5 ms.
    const std::string rising = "[belt]\nprofile = [[0, 200], [0.04, 200], [0.08, 240]]";
    EXPECT_NEAR(run(job_of(job(rising, "offset_us = 1500"))).on.deviation.max_mm, 0.06, 0.008);
    EXPECT_THAT(errors_of(job(belt, "tracking_error_us = 100")), HasSubstr("encoders only"));
}

}  // namespace
}  // namespace motionrack::mark
