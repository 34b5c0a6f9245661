// SVG pictures of a run: the path from above or in perspective, and values over time.
//
//    plan:  Y ^  wide pale line = planned, dashed = rapid            chart:  ^ ---- limit
//             |  thin dark line = actual, o start, [] end, x worst           |  /~~\__
//              +----> X                                                       +---------> s
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/trace/report.hpp>
#include <span>
#include <string>
#include <vector>

namespace motionrack::trace {

struct SvgStyle {
    int width = 720;          ///< px, 100 .. 10000
    int height = 540;         ///< px, 100 .. 10000
    bool standalone = false;  ///< a separate file with its own style; else uses the style of the page
};

enum class PathView { plan, perspective };

/// Bounds of X, Y, Z. `some` is false until a point was added.
struct BoundingBox {
    Xyz low{};
    Xyz high{};
    bool some = false;
    void add(const Xyz& point);  ///< skips non-finite points
    double diagonal() const;
};

BoundingBox extent_of_path(const ReportData& data);    ///< planned and actual path
BoundingBox extent_of_travel(const ReportData& data);  ///< travel limits; path if unlimited
/// Visible region of a path picture: includes the travel, unless the path would be too small in it.
BoundingBox frame_of(const ReportData& data);

/// Colours the actual path by value, with a scale.
struct SvgShade {
    std::span<const float> values;  ///< one per point of the actual path; 0 .. max_value; empty: one colour
    double max_value = 1;
    std::string unit;  ///< "mm/s"
};

/// Planned and actual path (at most 4,000 points each), travel, start, end, point of maximum deviation, stop.
std::string svg_path(const ReportData& data, PathView view, const SvgStyle& style = {}, const SvgShade& shade = {});

struct SvgSeries {
    std::string name;                 ///< empty: not labelled
    std::string style;                ///< class of the line: "x", "y", "z", "a", "b", "c" or "d"
    std::span<const double> seconds;  ///< the data must outlive the picture
    std::span<const float> values;    ///< as long as seconds
};

struct SvgLimit {
    double value = 0;
    std::string name;
};

struct SvgChart {
    std::string title;  ///< "X position", with the unit: "X position, mm"
    std::vector<SvgSeries> series;
    std::vector<SvgLimit> limits;
};

/// Value range of a chart: the range of the series, zero if near, and each limit unless the values use less than a
/// quarter of the range to it. Never empty.
struct ChartRange {
    double low = 0;
    double high = 1;
};
ChartRange range_of(const SvgChart& chart);

/// Values over time, decimated without losing extremes.
std::string svg_chart(const SvgChart& chart, const SvgStyle& style = {});

/// A named time span.
struct SvgSpan {
    std::string name;
    double from_s = 0;
    double to_s = 0;
};

/// Charts of the same time span below each other, and below them a band of named spans. `style.height` is the total
/// height. All series must have the same first and last second.
std::string svg_timeline(const std::string& title, std::span<const SvgChart> charts, std::span<const SvgSpan> spans,
                         const SvgStyle& style = {});

/// A picture made without `standalone`, as wide as a column.
struct SvgPart {
    std::string svg;
    int height = 0;  ///< px
};

/// Pictures below each other under a title, as a standalone file.
std::string svg_column(const std::string& title, std::span<const SvgPart> parts, int width);

/// Pictures side by side, each `width` px wide, as one picture without `standalone` with the height of the first.
/// Reserves `heading` px above them for the title.
std::string svg_row(const std::string& title, std::span<const SvgPart> parts, int width, int heading);

/// Step of 1, 2 or 5 times a power of ten that divides `span` into about `parts`; 1 if no step does.
double nice_step(double span, int parts);

/// Writes a text (an SVG, a page) to a file and replaces an existing one. Errors: io.
Result<void> write_text(const std::string& text, const std::string& path);

}  // namespace motionrack::trace
