// SVG drawings: manually computed numbers, rejections with positions, and damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/mark/stroke_font.hpp>
#include <motionrack/mark/svg.hpp>
#include <random>

namespace motionrack::mark {
namespace {

using testing::HasSubstr;

Drawing read(const std::string& text) {
    Result<Drawing> out = read_svg(text, "d.svg");
    if (!out) return ADD_FAILURE() << out.error().text(), Drawing{};
    return *out;
}
std::string refusal(const std::string& text) {
    const Result<Drawing> out = read_svg(text, "d.svg");
    return out ? "not refused" : out.error().text();
}
/// Reads a path without a size: user units are mm, and Y is mirrored about 0.
Drawing path(const std::string& d) {
    return read("<svg><path d=\"" + d + "\"/></svg>");
}

TEST(SvgReader, AbsoluteAndRelativeLinesEndAtTheirPoints) {
    const Drawing d = path("m1 2 3 4L10-5h-2v1.5e1zl.5.5-1,-1M0 0");
    ASSERT_EQ(d.strokes.size(), 2u);
    ASSERT_EQ(d.strokes[0].elements.size(), 5u);
    const Spot ends[] = {{4, 6}, {10, -5}, {8, -5}, {8, 10}, {1, 2}};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_DOUBLE_EQ(d.strokes[0].elements[i].to.x, ends[i].x);
        EXPECT_DOUBLE_EQ(d.strokes[0].elements[i].to.y, -ends[i].y);
    }
    EXPECT_DOUBLE_EQ(d.strokes[1].elements[1].to.x, 0.5);
}

TEST(SvgReader, CurvesAreWithinTheToleranceOfTheirFormula) {
    const Drawing d = path("M0 0C0 10 20 -10 20 0");
    double worst = 0;
    const auto segments = segments_of(d);
    const parts::NearestSegment nearest(segments);
    for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0, s = 1 - t;
        worst =
            std::max(worst, nearest.distance({60 * s * t * t + 20 * t * t * t, -(30 * s * s * t - 30 * s * t * t)}));
    }
    EXPECT_LE(worst, default_tolerance_mm);
    EXPECT_GT(worst, default_tolerance_mm / 50) << "not finer than it needs to be";
    const Drawing q = path("M0 0Q5 10 10 0T20 0"),
                  c = path(
                      "M0 0C3.3333333333 6.6666666667 6.6666666667 6.6666666667 10 0S16.6666666667 -6.6666666667 20 0");
    EXPECT_NEAR(length_of(q), length_of(c), 1e-6);
}

TEST(SvgReader, ArcsOfCirclesStayArcsAndThoseOfEllipsesAreOnThem) {
    const Drawing half = path("M0 0A5 5 0 0 1 10 0");
    ASSERT_EQ(half.strokes[0].elements.size(), 1u);
    EXPECT_NEAR(half.strokes[0].elements[0].centre.x, 5, 1e-9);
    EXPECT_NEAR(half.strokes[0].elements[0].sweep, -3.141592653589793, 1e-9) << "clockwise as seen, Y up";
    EXPECT_NEAR(box_of(half).high.y, 5, 1e-3) << "above";
    EXPECT_NEAR(length_of(path("M0 0A5 5 0 1 1 5 5")), 2 * 3.141592653589793 * 5 * 0.75, 1e-6);
    EXPECT_NEAR(length_of(path("M0 0a5 5 0 005 5")), 2 * 3.141592653589793 * 5 * 0.25, 1e-6) << "flags without blanks";
    EXPECT_NEAR(length_of(path("M0 0A1 1 0 0 0 10 0")), 3.141592653589793 * 5, 1e-6) << "radii that are too small grow";
    for (const parts::DrawnSegment& s : segments_of(path("M10 0A10 4 0 0 1 0 4")))
        EXPECT_NEAR(s.to.x * s.to.x / 100 + s.to.y * s.to.y / 16, 1, 1e-9);
}

TEST(SvgReader, SizesAndTransformsGiveMillimetres) {
    const Drawing d = read(
        "<svg width='2in' height='1in' viewBox='0 0 200 100'><g transform='translate(10 20) rotate(90)'><line x1='0' "
        "y1='0' x2='10' y2='0'/></g></svg>");
    EXPECT_NEAR(d.strokes[0].from.x, 10 * 0.254, 1e-9);
    EXPECT_NEAR(d.strokes[0].from.y, 80 * 0.254, 1e-9);
    EXPECT_NEAR(d.strokes[0].elements[0].to.x, 10 * 0.254, 1e-9);
    EXPECT_NEAR(d.strokes[0].elements[0].to.y, 70 * 0.254, 1e-9);
    EXPECT_NEAR(
        length_of(read(
            "<svg><rect width='10' height='6' rx='1'/><polygon points='0,0 3,0 3,4'/><ellipse rx='2' ry='2'/></svg>")),
        24 + 2 * 3.14159265359 + 12 + 4 * 3.14159265359, 1e-6);
    EXPECT_TRUE(read("<svg><defs><path d='M0 0L1 1'/></defs><title>x</title><g display='none'><text/></g></svg>")
                    .strokes.empty());
}

TEST(SvgReader, UnsupportedElementsAreRejectedWithTheirLocation) {
    EXPECT_THAT(refusal("<svg>\n <g>\n  <text>A</text></g></svg>"), HasSubstr("d.svg:3:4: the element 'text'"));
    EXPECT_THAT(refusal("<svg>\n<path id='d' d='M0 0\nL1 x'/></svg>"), HasSubstr("d.svg:3:4: d of path"));
    EXPECT_THAT(refusal("<svg><path d='L1 1'/></svg>"), HasSubstr("d.svg:1:15:"));
    EXPECT_THAT(refusal("<svg><path d='M0 0 L1e99 1'/></svg>"), HasSubstr("beyond 1e9"));
    EXPECT_THAT(refusal("<svg><path d='M0 0 A1 1 0 2 0 3 3'/></svg>"), HasSubstr("flag"));
    EXPECT_THAT(refusal("<svg><path d='M0 0 L nan 1'/></svg>"), HasSubstr("number"));
    EXPECT_THAT(refusal("<svg width='50%'/>"), HasSubstr("the unit '%'"));
    EXPECT_THAT(refusal("<svg><g transform='spin(3)'/></svg>"), HasSubstr("transform"));
    EXPECT_THAT(refusal("<svg><path stroke-dasharray='1 2' d=''/></svg>"), HasSubstr("stroke-dasharray"));
    EXPECT_THAT(refusal("<svg viewBox='0 0 0 5'/>"), HasSubstr("viewBox"));
    EXPECT_THAT(refusal("<svg>\n<g>"), HasSubstr("not XML"));
    EXPECT_THAT(refusal("<svg><g transform='scale(1e9)'><g transform='scale(1e9)'><circle r='1'/></g></g></svg>"),
                HasSubstr("too large"));
    EXPECT_THAT(refusal("<html/>"), HasSubstr("not svg"));
    EXPECT_THAT(refusal(""), HasSubstr("not XML"));
}

TEST(SvgReader, RejectsUnsupportedStylePropertiesAsTheirAttributes) {
    EXPECT_THAT(refusal("<svg><path\nstyle='fill:none; stroke-dasharray: 1,2 !important' d='M0 0L1 1'/></svg>"),
                HasSubstr("d.svg:2:8: stroke-dasharray in a style of path"));
    EXPECT_THAT(refusal("<svg><g style='clip-path:url(#c)'><path d='M0 0L1 1'/></g></svg>"),
                HasSubstr("clip-path in a style of g"));
    EXPECT_THAT(refusal("<svg><path style='transform: scale(2)' d='M0 0L1 1'/></svg>"),
                HasSubstr("transform in a style"));
    EXPECT_THAT(refusal("<svg mask='url(#m)'/>"), HasSubstr("mask of svg"));
    EXPECT_THAT(refusal("<svg><path filter='url(#f)' d='M0 0L1 1'/></svg>"), HasSubstr("filter of path"));
    EXPECT_THAT(refusal("<svg><path marker-end='url(#arrow)' d='M0 0L1 1'/></svg>"), HasSubstr("marker-end of path"));
    EXPECT_THAT(refusal("<svg><defs>\n<style>.a { fill: red } .b { stroke-dasharray: 2 }</style></defs></svg>"),
                HasSubstr("d.svg:2:2: the style sheet sets stroke-dasharray"));
    EXPECT_THAT(refusal("<svg><style>.hidden { display: none }</style></svg>"), HasSubstr("sets display"));
    EXPECT_EQ(read("<svg><style>path { fill: none; stroke: #000; display: inline }</style><path "
                   "style='stroke-dasharray:none;filter:none' mask='none' d='M0 0L3 4'/></svg>")
                  .strokes.size(),
              1u);
}

TEST(SvgReader, DrawsVisibleElementsOnly) {
    EXPECT_TRUE(read("<svg><g style='display : none'><text/></g><path visibility='hidden' d='M0 0L1 1'/></svg>")
                    .strokes.empty());
    EXPECT_EQ(
        read(
            "<svg style='visibility:hidden'><path d='M0 0L1 1'/><g><path visibility='visible' d='M0 0L1 1'/></g></svg>")
            .strokes.size(),
        1u);
    EXPECT_TRUE(read("<svg display='none'><path d='M0 0L1 1'/></svg>").strokes.empty());
}

TEST(SvgReader, ReadsSvgUnderAnyPrefixAndSkipsOtherNamespaces) {
    EXPECT_EQ(read("<s:svg xmlns:s='http://www.w3.org/2000/svg' xmlns:i='http://inkscape'><i:view/><s:path d='M0 0L1 "
                   "1'/></s:svg>")
                  .strokes.size(),
              1u);
    EXPECT_EQ(read("<svg xmlns='&ns_svg;'><path d='M0 0L1 1'/><x:path d='M0 0L1 1'/><p "
                   "xmlns='http://www.w3.org/1999/xhtml'/></svg>")
                  .strokes.size(),
              1u);
}

TEST(SvgReader, DamagedFilesAreReadOrRejected) {
    const std::string good =
        "<svg width='10mm' viewBox='0 0 10 10'><g transform='matrix(1 0 0 1 2 3)'><path d='M0 0C1 2 3 4 5 6S1 1 2 2Q3 "
        "3 4 4T1 1A5 4 10 1 0 9 9z'/><circle r='3'/></g></svg>";
    const unsigned seed = 20260;
    std::mt19937 random(seed);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = good;
        for (int k = 0; k < 1 + i % 4; ++k) text[random() % text.size()] = static_cast<char>(random() % 128);
        if (i % 7 == 0) text.resize(random() % text.size());
        const Result<Drawing> out = read_svg(text, "d.svg");
        if (!out) {
            ++refused;
            EXPECT_GT(out.error().location.line, 0) << text;
            continue;
        }
        for (const Stroke& stroke : out->strokes)
            for (const Element& e : stroke.elements)
                EXPECT_TRUE(std::isfinite(e.to.x) && std::isfinite(e.to.y)) << "seed " << seed << ": " << text;
    }
    EXPECT_GT(refused, 1000);
}

TEST(StrokeFont, EveryLetterIsInItsCell) {
    for (char c = ' '; c < 127; ++c) {
        const Result<Drawing> out = text_drawing(std::string(1, c), 6);
        if (!out) {
            EXPECT_FALSE(std::isalnum(static_cast<unsigned char>(c))) << c;
            continue;
        }
        EXPECT_EQ(out->strokes.empty(), c == ' ') << c;
        const Box box = box_of(*out);
        EXPECT_TRUE(box.low.x >= 0 && box.high.x <= 4 && box.low.y >= -2 && box.high.y <= 6) << c;
    }
    const Drawing two = *text_drawing("I\nI", 6);
    EXPECT_DOUBLE_EQ(box_of(two).low.y, -10);
}

}  // namespace
}  // namespace motionrack::mark
