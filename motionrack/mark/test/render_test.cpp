// Tests of the pictures, tables and the report page of a marking job.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/mark/plot.hpp>
#include <motionrack/mark/render.hpp>
#include <pugixml.hpp>

namespace motionrack::mark {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* shown_square =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm" viewBox="0 0 10 10">)"
    R"(<path d="M0 10 H10 V0 H0 Z"/></svg>)";
const std::string belt_job = "[drawing]\nsvg = 'square.svg'\nanchor = 'origin'\n[belt]\nvelocity_mm_s = 100\n";

struct Shown {
    MarkingJob job;
    Prepared prepared;
    MarkingOutcome out;
    std::string text;
};

Shown shown(const std::string& text, const std::string& svg = shown_square) {
    Shown s;
    s.text = text;
    JobRead read = read_job(text, "job.toml");
    for (const Error& error : read.errors) ADD_FAILURE() << error.text();
    s.job = read.job.value_or(MarkingJob{});
    Result<Prepared> prepared = prepare(s.job, [&](const std::string&) -> Result<std::string> { return svg; });
    if (!prepared) return ADD_FAILURE() << prepared.error().text(), s;
    s.prepared = *prepared;
    Result<MarkingOutcome> out = run_job(s.job, s.prepared);
    if (!out) return ADD_FAILURE() << out.error().text(), s;
    s.out = std::move(*out);
    return s;
}

std::vector<std::string> titles(const Shown& s) {
    std::vector<std::string> out;
    for (const trace::ReportPicture& p : pictures_of(s.prepared, s.out)) out.push_back(p.title);
    return out;
}

/// Checks that the SVG is well-formed and every number in it is finite.
void expect_drawable(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str())) << svg;
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(MarkPicture, ShowsTheDrawingBothPartsTheFieldAndTheMaximumDeviation) {
    const Shown s = shown(belt_job + "[fly]\nmode = 'encoder'\n");
    EXPECT_THAT(titles(s), ElementsAre("As drawn", "With correction", "Without correction", "In the field",
                                       "Maximum deviation with correction"));
    const std::string sheet = picture_svg(s.prepared, s.out);
    expect_drawable(sheet);
    for (const char* seen : {"class=\"planned\"", "class=\"driven\"", "class=\"without\"", "class=\"ring\"",
                             "class=\"box\"", ">5 mm<", "worst 8.001 mm at -8.001", "46.57 mm left at the right edge"})
        EXPECT_THAT(sheet, HasSubstr(seen));
    EXPECT_THAT(pictures_of(s.prepared, s.out)[0].svg, HasSubstr("<path class=\"drawn\" d=\"M"));
}

TEST(MarkPicture, WithoutCorrectionShowsTheUncorrectedPartOnly) {
    const Shown s = shown("[drawing]\nsvg = 's'\n");
    EXPECT_THAT(titles(s), ElementsAre("As drawn", "Without correction", "In the field"))
        << "all marks are on the drawing";
    expect_drawable(picture_svg(s.prepared, s.out));
}

TEST(MarkPicture, IsValidForVeryWideVeryHighAndFlatDrawings) {
    for (const char* path : {"M0 0H60V1", "M0 0V60H1", "M0 0H10", "M0 0V10", "M0 0h0.0001"}) {
        const Shown s =
            shown(belt_job + "[fly]\nmode = 'encoder'\n", std::string("<svg><path d='") + path + "'/></svg>");
        expect_drawable(picture_svg(s.prepared, s.out));
        for (const trace::ReportPicture& p : pictures_of(s.prepared, s.out)) expect_drawable(p.svg);
    }
}

TEST(MarkPicture, OfManyStrokesStaysSmall) {
    std::string path;
    for (int i = 0; i < 3000; ++i) path += fmt::format("M{} {}l.3 .1 .1 .3 -.2 .2 .1 .1", i % 50, i / 50);
    const Shown s = shown("[drawing]\nsvg = 's'\n", "<svg><path d='" + path + "'/></svg>");
    EXPECT_LT(picture_svg(s.prepared, s.out).size(), 2'000'000u);
}

TEST(Plot, PutsTheMiddleOfTheBoxInItsMiddleAtOneScale) {
    const Plot plot({{-10, 0}, {10, 10}}, 380, 200, 20);
    EXPECT_DOUBLE_EQ(plot.x(0), 190);
    EXPECT_DOUBLE_EQ(plot.y(5), 100);
    EXPECT_DOUBLE_EQ(plot.x(1) - plot.x(0), 16) << "the height decides";
    EXPECT_DOUBLE_EQ(plot.y(0) - plot.y(1), 16) << "Y is up";
}

TEST(Plot, DecimatesInvisibleDetailsAndClipsAtTheEdge) {
    const Plot plot({{0, 0}, {10, 10}}, 200, 200, 0);
    std::vector<StrokePoint> line = {{{-1e6, 5}, true}};
    for (int i = 0; i <= 1000; ++i) line.push_back({{i * 0.01, 5 + 1e-4 * (i % 2)}, false});
    EXPECT_EQ(plot.strokes(line, "x"), "<path class=\"x\" d=\"M-50 100L200 100\"/>\n");
    EXPECT_EQ(plot.strokes(std::vector<StrokePoint>{{{20, 20}, true}, {{30, 30}, false}}, "x"), "");
    const std::vector<StrokePoint> apart = {{{1, 1}, true}, {{2, 1}, false}, {{3, 1}, true}, {{4, 1}, false}};
    EXPECT_EQ(plot.strokes(apart, "x"), "<path class=\"x\" d=\"M20 180L40 180M60 180L80 180\"/>\n");
}

TEST(MarkWarning, IsRaisedBeforeTheFieldOverflowsAndReportsTheMargin) {
    EXPECT_TRUE(warnings_of(shown(belt_job + "[fly]\nmode = 'encoder'\n").out).empty());
    const Shown near =
        shown("[drawing]\nsvg = 's'\nanchor = 'origin'\n[belt]\nvelocity_mm_s = 720\n[fly]\nmode = 'encoder'\n");
    EXPECT_TRUE(near.out.on.overflows.empty());
    ASSERT_EQ(warnings_of(near.out).size(), 1u);
    EXPECT_THAT(warnings_of(near.out)[0], HasSubstr("mm are left at the right edge of the field"));
    EXPECT_THAT(outcome_text(near.job, near.out), HasSubstr("mm to the right edge of the field"));
    const Shown over =
        shown("[drawing]\nsvg = 's'\nanchor = 'origin'\n[belt]\nvelocity_mm_s = 900\n[fly]\nmode = 'encoder'\n");
    ASSERT_FALSE(over.out.on.overflows.empty());
    EXPECT_LT(margin_of(over.out, over.out.on).mm, 0);
    EXPECT_TRUE(warnings_of(over.out).empty()) << "it is no warning any more";
}

TEST(MarkReport, HasPicturesTablesChartsAndTheJobInOneFile) {
    const Shown s = shown(belt_job + "# <b>written so</b>\n[fly]\nmode = 'encoder'\n");
    const std::string page = trace::report_html(report_of(s.job, s.prepared, s.out, s.text));
    for (const char* seen : {"Job <b>job.toml</b>", "Marked within", "With correction", "<h2>Deviations</h2>",
                             "X of the spot in the field, mm", "Laser on, %", "# &lt;b&gt;written so&lt;/b&gt;\n[fly]",
                             "It just fits at", "field -60.569", "class=\"ring\""})
        EXPECT_THAT(page, HasSubstr(seen));
    EXPECT_THAT(page, Not(HasSubstr("<h2>Overflows</h2>")));
    for (const char* fetched : {"src=", "href=\"http", "url(", "@import"}) EXPECT_THAT(page, Not(HasSubstr(fetched)));
}

TEST(MarkReport, ReportsEveryOverflow) {
    const Shown s =
        shown("[drawing]\nsvg = 's'\nanchor = 'origin'\n[belt]\nvelocity_mm_s = 900\n[fly]\nmode = 'encoder'\n");
    const trace::ReportData data = report_of(s.job, s.prepared, s.out, s.text);
    EXPECT_FALSE(data.verdict.ok);
    EXPECT_THAT(data.verdict.text, HasSubstr("FLY_X_OVERFLOW"));
    ASSERT_GE(data.tables.size(), 2u);
    EXPECT_EQ(data.tables[1].title, "Overflows");
    EXPECT_EQ(data.tables[1].rows.size(), s.out.on.overflows.size());
}

}  // namespace
}  // namespace motionrack::mark
