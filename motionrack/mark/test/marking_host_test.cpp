// Consecutive parts: starts, track delay, numbers, lost parts.
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/mark/marking_host.hpp>
#include <motionrack/mark/stroke_font.hpp>
#include <motionrack/mark/test/helpers.hpp>

namespace motionrack::mark {
namespace {

using testing::HasSubstr;

/// A job of squares of 10 mm, each marked in slightly more than 80 ms, on parts at 200 mm/s.
std::string squares(const std::string& parts, const std::string& fly = "mode = 'encoder'") {
    return "[drawing]\nsvg = 's'\nanchor = 'origin'\n[pace]\nmark_speed_mm_s = 500\n[belt]\nvelocity_mm_s = "
           "200\ncounts_per_mm "
           "= 1000\n[fly]\n" +
           fly + "\n[parts]\n" + parts;
}

TEST(MarkingHostTest, EachPartIsMarkedATrackDelayBehindItsEdge) {
    const MarkingOutcome out = run(job_of(squares("count = 5\nspacing_mm = 60\ntrack_delay_mm = 33.3\n")));
    ASSERT_EQ(out.on.parts.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        const PartMarked& part = out.on.parts[i];
        EXPECT_EQ(part.fate, PartOutcome::marked);
        EXPECT_NEAR(part.begin_s, (static_cast<double>(i) * 60 + 33.3) / 200, 2e-5);
        EXPECT_LE(part.deviation.max_mm, 0.005) << "a tick at the edge, one at the start, a count";
        EXPECT_NEAR(part.marked_mm, 40, 0.05);
        EXPECT_EQ(part.deviation.missing_mm, 0);
    }
    EXPECT_LE(out.on.deviation.max_mm, 0.005);
    // Without correction a corner marked 20 ms after another is 200 mm/s * 20 ms = 4 mm off, the last one 16 mm.
    ASSERT_TRUE(out.off);
    for (const PartMarked& part : out.off->parts) EXPECT_NEAR(part.deviation.max_mm, 16, 0.1);
}

TEST(MarkingHostTest, EveryTrackingMethodMarksPartsWithinTheTolerance) {
    for (const char* mode : {"encoder", "simulated"})
        for (const char* direction : {"0", "90", "180", "30"})
            for (const char* counts : {"1000", "-1000"})
                for (const char* velocity : {"200", "-200"}) {
                    const std::string job = std::string("[drawing]\nsvg = 's'\n[belt]\nvelocity_mm_s = ") + velocity +
                                            "\ndirection_deg = " + direction + "\ncounts_per_mm = " + counts +
                                            "\n[fly]\nmode = '" + mode +
                                            "'\n[parts]\ncount = 3\nspacing_mm = 50\ntrack_delay_mm = 20\n";
                    const MarkingOutcome out = run(job_of(job));
                    EXPECT_LE(out.on.deviation.max_mm, 0.0065) << job;
                    EXPECT_EQ(out.on.deviation.missing_mm, 0) << job;
                }
}

TEST(MarkingHostTest, PartsAroundATableAreMarkedInMotion) {
    for (const char* start : {"track_delay_deg = 15", "start = 'equidistant'"}) {
        const MarkingOutcome out =
            run(job_of(std::string("[drawing]\nsvg = 's'\n[table]\nvelocity_deg_s = 60\ncentre_y_mm = "
                                   "-40\ncounts_per_deg = 2000\n[fly]\nmode = 'encoder'\n"
                                   "[parts]\ncount = 8\nspacing_deg = 45\n") +
                       start + "\n"));
        ASSERT_EQ(out.on.parts.size(), 8u);
        for (const PartMarked& part : out.on.parts) {
            EXPECT_EQ(part.fate, PartOutcome::marked);
            EXPECT_LE(part.deviation.max_mm, 0.003) << start;
            EXPECT_EQ(part.deviation.missing_mm, 0) << start;
        }
    }
}

TEST(MarkingHostTest, AStartWhileAListRunsIsLostWithItsInstant) {
    // The parts are 10 mm apart, which takes 50 ms: every second part arrives while the previous square is being
    // marked.
    const MarkingJob job = job_of(squares("count = 6\nspacing_mm = 10\ntrack_delay_mm = 20\n"));
    const MarkingOutcome out = run(job);
    ASSERT_EQ(out.on.parts.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        const PartMarked& part = out.on.parts[i];
        EXPECT_EQ(part.fate, i % 2 == 0 ? PartOutcome::marked : PartOutcome::lost_busy) << i;
        EXPECT_NEAR(part.begin_s, (static_cast<double>(i) * 10 + 20) / 200, 2e-5) << i;
        EXPECT_NEAR(part.deviation.missing_mm, i % 2 == 0 ? 0 : 40, 1e-9);
    }
    EXPECT_NEAR(out.on.deviation.missing_mm, 120, 1e-9);
    EXPECT_THAT(outcome_text(job, out), HasSubstr("part 2: its start at 0.1500"));
    // All parts are marked if moving by the spacing of the parts takes longer than marking a square.
    ASSERT_TRUE(out.fits_factor);
    EXPECT_TRUE(out.starts_limit);
    EXPECT_NEAR(*out.fits_factor * 200, 10 / (out.on.parts[0].end_s - out.on.parts[0].begin_s), 4)
        << "the way back to the middle is shorter on a slower belt";
}

TEST(MarkingHostTest, OfMoreThanEightPendingStartsTheLatestIsLost) {
    const MarkingOutcome out = run(job_of(squares("count = 10\nspacing_mm = 20\ntrack_delay_mm = 170\n")));
    // At 160 mm the ninth edge arrives; the first part is due at 170 mm.
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_EQ(out.on.parts[i].fate, i == 8 ? PartOutcome::lost_too_many : PartOutcome::marked) << i;
    EXPECT_NEAR(out.on.parts[8].begin_s, 160.0 / 200, 2e-5);
}

TEST(MarkingHostTest, TheCardStartsItselfAtEvenDistances) {
    // 0.0123 mm are 12.3 counts: the card counts 60012 from start to start, without cumulative loss.
    const MarkingOutcome out = run(job_of(squares("count = 6\nspacing_mm = 60.0123\nstart = 'equidistant'\n")));
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(out.on.parts[i].fate, PartOutcome::marked);
        EXPECT_NEAR(out.on.parts[i].begin_s, static_cast<double>(i) * 60.012 / 200, 2.1e-5) << i;
        EXPECT_LE(out.on.parts[i].deviation.max_mm, 0.006) << i;
    }
    const MarkingOutcome lost = run(job_of(squares("count = 3\nspacing_mm = 10\nstart = 'equidistant'\n")));
    EXPECT_EQ(lost.on.parts[0].fate, PartOutcome::marked);
    EXPECT_EQ(lost.on.parts[1].fate, PartOutcome::lost_busy);
    EXPECT_EQ(lost.on.parts[2].fate, PartOutcome::not_started);
}

TEST(MarkingHostTest, EachPartHasItsSerialNumber) {
    const MarkingJob job = job_of(
        "[drawing]\ntext = 'N{n:03}'\nheight_mm = 3\n[belt]\nvelocity_mm_s = 150\n[fly]\nmode = 'encoder'\n"
        "[parts]\npart_positions_mm = [0, 40, 75, 130, 190]\ntrack_delay_mm = 50\nfirst_number = 98\nnumber_step = "
        "7\n");
    const MarkingOutcome out = run(job);
    ASSERT_EQ(out.on.parts.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(out.on.parts[i].number, 98 + 7 * static_cast<std::int64_t>(i));
        EXPECT_EQ(out.on.parts[i].drawing, i);
        EXPECT_LE(out.on.parts[i].deviation.max_mm, 0.004) << i;
        EXPECT_EQ(out.on.parts[i].deviation.missing_mm, 0) << i;
    }
    // The third part got its own drawing, not that of the second.
    const Prepared prepared = *prepare(job, one_file(""));
    const PartMarked& third = out.on.parts[2];
    const auto points = std::span(out.on.points).subspan(third.first_point, third.points);
    EXPECT_GT(parts::compare(points, prepared.of(1).segments).max_mm, 0.3);
    EXPECT_LE(parts::compare(points, prepared.of(2).segments).max_mm, 0.004);
}

TEST(MarkingHostTest, NumbersContinueWithTheNextPartThatIsMarked) {
    const MarkingOutcome out =
        run(job_of("[drawing]\ntext = '{n}'\nheight_mm = 6\n[pace]\nmark_speed_mm_s = 200\n[belt]\nvelocity_mm_s = "
                   "200\n[fly]\nmode = 'encoder'\n"
                   "[parts]\npart_positions_mm = [0, 5, 60, 65, 120]\ntrack_delay_mm = 5\n"));
    const std::vector<PartOutcome> fates = {PartOutcome::marked, PartOutcome::lost_busy, PartOutcome::marked,
                                            PartOutcome::lost_busy, PartOutcome::marked};
    std::int64_t number = 0;
    for (std::size_t i = 0; i < fates.size(); ++i) {
        EXPECT_EQ(out.on.parts[i].fate, fates[i]) << i;
        if (fates[i] != PartOutcome::marked) {
            EXPECT_EQ(out.on.parts[i].drawing, static_cast<std::size_t>(number)) << "it would have been the next";
        } else {
            EXPECT_EQ(out.on.parts[i].number, ++number);
            EXPECT_LE(out.on.parts[i].deviation.max_mm, 0.005);
        }
    }
}

TEST(MarkingHostTest, OverflowsAreOnTheirPartInItsCoordinates) {
    const MarkingOutcome out = run(job_of(squares("count = 3\nspacing_mm = 200\ntrack_delay_mm = 20\n",
                                                  "mode = 'encoder'\n[optics]\nbits_per_mm = 40000")));
    ASSERT_FALSE(out.on.overflows.empty());
    std::vector<std::size_t> seen;
    for (const Overflow& o : out.on.overflows) {
        seen.push_back(o.part_no);
        EXPECT_NEAR(o.part.x, 5, 5.01);
        EXPECT_NEAR(o.part.y, 5, 5.01);
        EXPECT_GE(o.from_s, out.on.parts[o.part_no].begin_s);
        EXPECT_LE(o.to_s, out.on.parts[o.part_no].end_s);
    }
    EXPECT_EQ(seen.front(), 0u);
    EXPECT_EQ(seen.back(), 2u);
}

TEST(MarkingHostTest, ADistanceThatNoPartTravelsIsRejected) {
    const MarkingJob job = job_of(
        "[drawing]\nsvg = 's'\n[belt]\nprofile = [[0, 100], [1, 0]]\n[fly]\nmode = 'encoder'\n[parts]\ncount = "
        "4\nspacing_mm = 20\n");
    EXPECT_THAT(
        refusal(job),
        HasSubstr("Part 4 does not reach the sensor within 1000 s: the belt moves 50 until then, the part is 60 away"));
}

TEST(MarkingHostTest, InvalidPartsAreReportedTogetherWithTheirLocations) {
    const std::string all = errors_of(
        "[drawing]\ntext = 'N{m}'\n[belt]\nvelocity_mm_s = 100\n[fly]\nmode = 'mcbsp'\ntracking_error_us = "
        "50\n[parts]\ncount = 3\nstart = 'equidistant'\ntrack_delay_mm = 5\n");
    EXPECT_THAT(all, HasSubstr("j.toml:2:8: Character 2 of the text: braces"));
    EXPECT_THAT(all, HasSubstr("j.toml:7:21: The card compensates tracking errors of encoders only"));
    EXPECT_THAT(all, HasSubstr("j.toml:8:2: 3 parts need a 'spacing_mm'"));
    EXPECT_THAT(all, HasSubstr("j.toml:8:2: McBSP words have absolute positions"));
    EXPECT_THAT(all, HasSubstr("j.toml:10:9: Equidistant parts need no sensor"));
    EXPECT_THAT(errors_of("[drawing]\ntext = 'A'\n[parts]\ncount = 2\nspacing_mm = 5\n"),
                HasSubstr("a moving belt or table"));
    EXPECT_THAT(errors_of("[drawing]\ntext = 'A'\n[belt]\nvelocity_mm_s = 1\n[parts]\npart_positions_mm = [0, 7, 5]\n"),
                HasSubstr("j.toml:6:28: 'part_positions_mm' must be"));
    EXPECT_THAT(
        errors_of("[drawing]\ntext = 'A'\n[belt]\nvelocity_mm_s = 1\n[parts]\ncount = 2\npart_positions_mm = [0, 7]\n"),
        HasSubstr("leave 'count' out"));
    EXPECT_THAT(errors_of("[drawing]\ntext = 'A'\n[belt]\nvelocity_mm_s = 1\n[parts]\nspacing_deg = 2\n"),
                HasSubstr("j.toml:6:1: "));
    EXPECT_THAT(errors_of("[drawing]\ntext = '{n:02}'\n[belt]\nvelocity_mm_s = 1\n[parts]\ncount = 5\nspacing_mm = "
                          "5\nfirst_number = 96\n"),
                HasSubstr("The number 100 has more than the 2 digits"));
    EXPECT_THAT(errors_of("drawing = [1]\n"), HasSubstr("j.toml:1:"));
}

TEST(MarkingHostTest, SeveralDrawingsAreMarkedOnOnePart) {
    const MarkingOutcome out =
        run(job_of("[[drawing]]\nsvg = 's'\n[[drawing]]\ntext = 'A{n}'\nheight_mm = 3\ny_mm = 12\n"));
    EXPECT_EQ(out.on.deviation.missing_mm, 0);
    EXPECT_GT(out.drawing_mm, 50);
    EXPECT_THAT(errors_of("[[drawing]]\nsvg = 's'\n[[drawing]]\n"), HasSubstr("j.toml:3:"));
}

TEST(Numbered, PadsWithZerosAndRejectsOtherBraces) {
    EXPECT_EQ(*numbered("SN {n:04}/{n}", 42), "SN 0042/42");
    EXPECT_EQ(*numbered("none", 42), "none");
    EXPECT_EQ(*numbered("{n:03}", -4), "-04");
    for (const char* bad : {"{", "}", "{}", "{m}", "{n:4}", "{n:0}", "{n:00}", "{n:019}", "{n:0004}", "a{n", "{{n}}"})
        EXPECT_FALSE(numbered(bad, 1)) << bad;
    EXPECT_FALSE(numbered("{n:02}", 100));
}

}  // namespace
}  // namespace motionrack::mark
