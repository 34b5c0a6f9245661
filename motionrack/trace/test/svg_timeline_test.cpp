// Charts above a band of names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/trace/svg.hpp>
#include <regex>

namespace motionrack::trace {
namespace {

const std::vector<double> timeline_seconds = {0, 1, 2, 3};
const std::vector<float> timeline_values = {0, 5, 5, 1};

std::string picture(const std::vector<SvgSpan>& spans) {
    const std::vector<SvgChart> charts = {{"position, mm", {{"", "z", timeline_seconds, timeline_values}}, {}},
                                          {"velocity, mm/s", {{"", "y", timeline_seconds, timeline_values}}, {}}};
    return svg_timeline("A <title>", charts, spans, {720, 500, true});
}

TEST(SvgTimeline, HasEveryChartAndEveryName) {
    const std::string out = picture({{"first 1 s", 0, 1}, {"second & last", 1, 3}});
    EXPECT_THAT(out, testing::HasSubstr("A &lt;title&gt;"));
    EXPECT_THAT(out, testing::HasSubstr("position, mm"));
    EXPECT_THAT(out, testing::HasSubstr("velocity, mm/s"));
    EXPECT_THAT(out, testing::HasSubstr("first 1 s</text>"));
    EXPECT_THAT(out, testing::HasSubstr("second &amp; last</text>"));
}

TEST(SvgTimeline, NamesOfShortSpansDoNotCoverEachOther) {
    std::vector<SvgSpan> spans;
    for (int i = 0; i < 12; ++i) spans.push_back({"state", 2.9 + i * 0.005, 2.905 + i * 0.005});
    const std::string out = picture(spans);
    const std::regex place(R"(translate\(([0-9.]+) )");
    std::vector<double> at;
    for (auto it = std::sregex_iterator(out.begin(), out.end(), place); it != std::sregex_iterator(); ++it)
        at.push_back(std::stod((*it)[1]));
    ASSERT_EQ(at.size(), 12u);
    for (std::size_t i = 1; i < at.size(); ++i) EXPECT_GE(at[i] - at[i - 1], 13.9);
    EXPECT_LE(at.back(), 720);
}

TEST(SvgTimeline, NamesTheLinesOfAChart) {
    const std::vector<SvgChart> charts = {
        {"velocity",
         {{"planned", "x", timeline_seconds, timeline_values}, {"driven", "y", timeline_seconds, timeline_values}},
         {}}};
    const std::string out = svg_timeline("A title", charts, {}, {720, 200, true});
    EXPECT_THAT(out, testing::HasSubstr(">planned</text>"));
    EXPECT_THAT(out, testing::HasSubstr(">driven</text>"));
}

TEST(SvgColumn, HasItsPartsBelowEachOther) {
    const std::vector<SvgPart> parts = {{"<g id=\"a\"/>", 100}, {"<g id=\"b\"/>", 50}};
    const std::string out = svg_column("A & B", parts, 300);
    EXPECT_THAT(out, testing::HasSubstr("viewBox=\"0 0 300 174\""));
    EXPECT_THAT(out, testing::HasSubstr("A &amp; B</text>"));
    EXPECT_THAT(out, testing::HasSubstr("y=\"24\" width=\"300\" height=\"100\">\n<g id=\"a\"/>"));
    EXPECT_THAT(out, testing::HasSubstr("y=\"124\" width=\"300\" height=\"50\">\n<g id=\"b\"/>"));
}

TEST(SvgTimeline, IsAPictureWithoutAnyChart) {
    const std::string out = svg_timeline("empty", {}, {}, {});
    EXPECT_THAT(out, testing::EndsWith("</svg>\n"));
    EXPECT_THAT(out, testing::Not(testing::HasSubstr("nan")));
    EXPECT_THAT(out, testing::Not(testing::HasSubstr("inf")));
}

}  // namespace
}  // namespace motionrack::trace
