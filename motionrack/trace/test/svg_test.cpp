// SVG pictures: content and value ranges.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <motionrack/trace/svg.hpp>

namespace motionrack::trace {
namespace {

ReportData corner() {
    ReportData data;
    data.planned = {{{{0, 0, 5}, {50, 20, 5}}, true, 1}, {{{50, 20, 5}, {50, 80, 5}, {10, 80, 5}}, false, 2}};
    data.driven = {{0, 0, 5}, {50, 20, 5}, {50, 80, 5}, {10, 80, 5}};
    data.max_deviation = ReportMaxDeviation{0.004, 1, 2, {50, 80, 5}};
    data.axes.resize(2);
    data.axes[0].name = std::string("X");
    data.axes[0].max_position = 100;
    data.axes[1].name = std::string("Y");
    data.axes[1].max_position = 100;
    return data;
}

TEST(SvgPath, FromAboveHasYUpAndDrawsRapidsApart) {
    SvgStyle style;
    style.width = style.height = 268;  // 100 mm become 200 px
    const std::string svg = svg_path(corner(), PathView::plan, style);
    EXPECT_NE(svg.find("<polyline class=\"planned traverse\" points=\"34,234 134,194\"/>"), std::string::npos) << svg;
    EXPECT_NE(svg.find("<polyline class=\"planned\" points=\"134,194 134,74 54,74\"/>"), std::string::npos) << svg;
    EXPECT_NE(svg.find("<polyline class=\"driven\" points=\"34,234 134,194 134,74 54,74\"/>"), std::string::npos)
        << svg;
    EXPECT_NE(svg.find("class=\"mark worst\" transform=\"translate(134 74)\""), std::string::npos) << svg;
}

TEST(SvgPath, AShadeColoursRunsAndHasAScale) {
    ReportData data = corner();
    const std::vector<float> velocity = {0, 0, 50, 50};
    const std::string svg = svg_path(data, PathView::plan, {268, 268, false}, {velocity, 50, "mm/s"});
    EXPECT_NE(svg.find("<polyline stroke=\"#f69721\" points=\"34,234 134,194\"/>"), std::string::npos) << svg;  // slow
    EXPECT_NE(svg.find("<polyline stroke=\"#0d0887\" points=\"134,74 54,74\"/>"), std::string::npos) << svg;    // fast
    EXPECT_NE(svg.find(">50 mm/s</text>"), std::string::npos);
    EXPECT_EQ(svg.find("class=\"driven\""), std::string::npos);
    EXPECT_NE(svg_path(data, PathView::plan, {268, 268, false}, {std::span(velocity).first(3), 50, "mm/s"})
                  .find("class=\"driven\""),
              std::string::npos)
        << "shades that do not fit are left out";
}

TEST(SvgPath, ArrowsShowTheDirectionAndAreLimitedInNumber) {
    SvgStyle style;
    style.width = style.height = 268;
    ReportData data = corner();
    data.driven = {{0, 50, 5}, {100, 50, 5}};
    const std::string right = svg_path(data, PathView::plan, style);
    EXPECT_NE(right.find("class=\"arrow\" d=\"M85 134L75 138.5 75 129.5Z\""), std::string::npos) << right;
    std::reverse(data.driven.begin(), data.driven.end());
    const std::string left = svg_path(data, PathView::plan, style);
    EXPECT_NE(left.find("class=\"arrow\" d=\"M183 134L193 129.5 193 138.5Z\""), std::string::npos) << left;
    data.driven.clear();
    for (int i = 0; i < 3000; ++i) data.driven.push_back({i % 2 == 0 ? 0.0 : 100.0, i / 30.0, 5});
    const std::string crowd = svg_path(data, PathView::plan, style);
    std::size_t arrows = 0;
    for (std::size_t at = 0; (at = crowd.find("class=\"arrow\"", at)) != std::string::npos; ++at) ++arrows;
    EXPECT_GE(arrows, 30U);
    EXPECT_LE(arrows, 41U);
}

TEST(SvgPath, DrawsAStopUnlikeTheMaximumDeviation) {
    ReportData data = corner();
    data.stop = ReportStop{1, 2, {10, 80, 5}, "Limit <Y+>"};
    const std::string svg = svg_path(data, PathView::plan);
    EXPECT_NE(svg.find("Stopped: Limit &lt;Y+&gt;</title><path d=\"M-4-9H4L9-4"), std::string::npos);
    EXPECT_NE(svg.find("<path d=\"M-6-6L6 6M-6 6L6-6\"/>"), std::string::npos);
}

TEST(SvgPath, StandsAloneWithStyleAndNameOnlyWhenAsked) {
    SvgStyle style;
    EXPECT_EQ(svg_path(corner(), PathView::perspective, style).find("<style>"), std::string::npos);
    style.standalone = true;
    const std::string svg = svg_path(corner(), PathView::perspective, style);
    EXPECT_EQ(svg.rfind("<svg xmlns=", 0), 0U);
    EXPECT_NE(svg.find("<style>"), std::string::npos);
}

TEST(SvgPath, OfOnePointOrNoneHasFiniteNumbersOnly) {
    ReportData data;
    for (int points = 0; points < 2; ++points) {
        for (const PathView view : {PathView::plan, PathView::perspective}) {
            const std::string svg = svg_path(data, view);
            EXPECT_EQ(svg.find("nan"), std::string::npos);
            EXPECT_EQ(svg.find("inf"), std::string::npos);
        }
        data.driven = {{1e9, -1e9, 3}};
    }
}

TEST(SvgChart, ShowsALimitOnceTheValuesUseAQuarterOfIt) {
    const std::vector<double> seconds = {0, 1};
    const std::vector<float> low = {0, 24}, high = {0, 26};
    SvgChart chart;
    chart.limits = {{100, "limit"}, {-100, "limit"}};
    chart.series = {{"X", "x", seconds, low}};
    EXPECT_LT(range_of(chart).high, 30);
    EXPECT_EQ(svg_chart(chart).find("class=\"limit\""), std::string::npos);
    chart.series = {{"X", "x", seconds, high}};
    EXPECT_GE(range_of(chart).high, 100);
    EXPECT_GT(range_of(chart).low, -100);
    EXPECT_NE(svg_chart(chart).find("class=\"limit\""), std::string::npos);
}

TEST(SvgChart, RangeOfEqualNoOrNonFiniteValuesIsNeverEmpty) {
    const std::vector<double> seconds = {0, 1, 2};
    for (const float v :
         {0.0F, 5.0F, -5.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::max()}) {
        const std::vector<float> values = {v, v, v};
        SvgChart chart;
        chart.series = {{"", "d", seconds, values}};
        const ChartRange range = range_of(chart);
        EXPECT_LT(range.low, range.high) << v;
        const std::string svg = svg_chart(chart);
        EXPECT_EQ(svg.find("nan"), std::string::npos) << v;
        EXPECT_EQ(svg.find("inf"), std::string::npos) << v;
    }
}

TEST(NiceStep, IsOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(nice_step(10, 5), 2);
    EXPECT_DOUBLE_EQ(nice_step(0.07, 5), 0.02);
    EXPECT_DOUBLE_EQ(nice_step(3000, 6), 500);
    EXPECT_DOUBLE_EQ(nice_step(0, 6), 1);
    EXPECT_DOUBLE_EQ(nice_step(std::numeric_limits<double>::infinity(), 6), 1);
}

}  // namespace
}  // namespace motionrack::trace
