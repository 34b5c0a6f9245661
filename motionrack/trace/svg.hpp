// Pictures of a run as SVG: the path seen from above or in perspective, and values over time.
//
//     plan:  Y ^  wide pale line = planned, dashed = traverse         chart:  ^ ---- limit
//              |  thin dark line = driven, o start, [] end, x worst           |  /~~\__
//              +----> X                                                       +---------> s
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/trace/report.hpp>
#include <span>
#include <string>
#include <vector>

namespace motionrack::trace {

struct SvgLook {
    int width = 720;          ///< px, 100 .. 10000
    int height = 540;         ///< px, 100 .. 10000
    bool standalone = false;  ///< a file of its own: brings its style; else it takes the style of the page it stands in
};

enum class PathView { plan, perspective };

/// Least and greatest X, Y, Z. `some` is false while nothing was added.
struct Extent {
    Xyz low{};
    Xyz high{};
    bool some = false;
    void add(const Xyz& point);  ///< points that are not finite are left out
    double diagonal() const;
};

Extent extent_of_path(const ReportData& data);    ///< of the planned and the driven path
Extent extent_of_travel(const ReportData& data);  ///< of the limits of X, Y, Z; an axis without limits: as the path
/// What a picture of the path shows: the travel, too, unless the path would be lost in it.
Extent frame_of(const ReportData& data);

/// What colours the driven path, and is explained by a scale.
struct SvgShade {
    std::span<const float> values;  ///< as many as points driven; 0 .. most; none: the path has one colour
    double most = 1;
    std::string unit;  ///< "mm/s"
};

/// The planned and the driven path (of which at most 4,000 points each are drawn), travel, start, end, worst place,
/// stop.
std::string svg_path(const ReportData& data, PathView view, const SvgLook& look = {}, const SvgShade& shade = {});

struct SvgSeries {
    std::string name;                 ///< empty: not named in the picture
    std::string look;                 ///< class of the line: "x", "y", "z", "a", "b", "c" or "d"
    std::span<const double> seconds;  ///< what it points to must outlive the picture
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

/// The range of values that a chart shows: what the series reach, zero if it is near, and each limit unless the values
/// use less than a quarter of the way to it. Never empty.
struct ChartRange {
    double low = 0;
    double high = 1;
};
ChartRange range_of(const SvgChart& chart);

/// Values over time, thinned so that extremes stay.
std::string svg_chart(const SvgChart& chart, const SvgLook& look = {});

/// A named stretch of time.
struct SvgSpan {
    std::string name;
    double from_s = 0;
    double to_s = 0;
};

/// Charts of the same stretch of time one below the other, and below them a band that names parts of it. `look.height`
/// is that of everything; the charts' series must begin and end at the same seconds.
std::string svg_timeline(const std::string& title, std::span<const SvgChart> charts, std::span<const SvgSpan> spans,
                         const SvgLook& look = {});

/// A picture that was made without `standalone`, of a column's width.
struct SvgPart {
    std::string svg;
    int height = 0;  ///< px
};

/// Pictures one below the other, under a title, in a file of their own.
std::string svg_column(const std::string& title, std::span<const SvgPart> parts, int width);

/// Pictures beside each other, each of this width, as one without `standalone`; their height is that of the first.
/// Above them is room of `heading` px for the title.
std::string svg_row(const std::string& title, std::span<const SvgPart> parts, int width, int heading);

/// A step of 1, 2 or 5 times a power of ten that divides `span` into about `parts`; 1 if there is no such step.
double nice_step(double span, int parts);

/// Writes a text (an SVG, a page) to a file, over what was there. Errors: io.
Result<void> write_text(const std::string& text, const std::string& path);

}  // namespace motionrack::trace
