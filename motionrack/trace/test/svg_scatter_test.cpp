// Dots and maps: all data is drawn, all text is escaped, all coordinates are finite.
#include <gmock/gmock.h>

#include <limits>
#include <motionrack/trace/svg_scatter.hpp>

namespace motionrack::trace {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t out = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
    return out;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(SvgScatter, DrawsADotForEachValueAndACrossForEachFailure) {
    const std::string svg =
        svg_scatter({"time, s", "feed <b>", {}, {{"a & b", "x", {{1, 2}, {2, 3}, {3, 1, true}, {4, nan, true}}, true}}},
                    {400, 200, true});
    EXPECT_EQ(count_of(svg, "<circle"), 2u);
    EXPECT_EQ(count_of(svg, "m-4-4l8 8m-8 0l8-8"), 2u);
    EXPECT_EQ(count_of(svg, "class=\"line x\" points"), 2u) << "the line, and that of the name";
    EXPECT_THAT(svg, HasSubstr("feed &lt;b&gt;"));
    EXPECT_THAT(svg, HasSubstr("a &amp; b"));
    EXPECT_THAT(svg, Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("<b>"))));
}

TEST(SvgScatter, HasNamesInsteadOfNumbers) {
    const std::string svg = svg_scatter({"time, s",
                                         "fault",
                                         {"none", "a fault with a name that is far too long for its place"},
                                         {{"", "z", {{0, 2}, {1, 3}}, false}}},
                                        {300, 200, true});
    EXPECT_THAT(svg, HasSubstr(">none<"));
    EXPECT_THAT(svg, HasSubstr(">a fault with a n..<"));
}

TEST(SvgScatter, DrawsNoneOneAndManyValues) {
    EXPECT_THAT(svg_scatter({"t", "x", {}, {}}), testing::EndsWith("</svg>\n"));
    EXPECT_EQ(count_of(svg_scatter({"t", "x", {}, {{"", "z", {{5, 5}}, true}}}), "<circle"), 1u);
    EXPECT_THAT(svg_scatter({"t", "x", {}, {{"", "z", {{1e15, 1e300}, {1e15 + 1, -1e300}}, true}}}),
                testing::EndsWith("</svg>\n"));
    SvgDots many{"", "z", {}, false};
    for (int i = 0; i < 100'000; ++i) many.dots.push_back({static_cast<double>(i), static_cast<double>(i % 7)});
    EXPECT_LE(count_of(svg_scatter({"t", "x", {}, {many}}), "<circle"), max_dots);
}

TEST(SvgMap, DrawsCellsForACompleteGridAndDotsElsewhere) {
    SvgMap map{"time, s", "x", "y", {}};
    for (const double x : {1.0, 2.0, 10.0})
        for (const double y : {5.0, 7.0}) map.spots.push_back({x, y, x * y, x == 2});
    const std::string cells = svg_map(map, {400, 300, true});
    EXPECT_EQ(count_of(cells, "<rect"), 6u + 20u);
    EXPECT_EQ(count_of(cells, "m-4-4l8 8m-8 0l8-8"), 2u);
    EXPECT_THAT(cells, HasSubstr(">70</text>"));
    map.spots.pop_back();
    const std::string dots = svg_map(map, {400, 300, true});
    EXPECT_EQ(count_of(dots, "<circle"), 3u);
    EXPECT_THAT(svg_map({"t", "x", "y", {}}), testing::EndsWith("</svg>\n"));
    EXPECT_THAT(svg_map({"t", "x", "y", {{1, 1, nan}}}), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace motionrack::trace
