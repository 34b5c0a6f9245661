// Shared parts of the pictures: the head with its style, texts, and the simplified planned path.
#pragma once

#include <motionrack/trace/svg.hpp>
#include <string>
#include <vector>

namespace motionrack::trace {

/// Margins for the scale, left and right of the plot, px.
inline constexpr double chart_left = 56, chart_right = 12;
/// Width of a letter in the small type, px.
inline constexpr double letter_width = 6.2;

/// Returns the opening tag, with `title` for screen readers.
std::string svg_head(const SvgStyle& style, const std::string& title);

/// `anchor`: "start", "middle" or "end". Escapes the text.
std::string svg_text(double x, double y, const char* anchor, const std::string& text);

/// Returns the colour of a value, 0 .. 1, from bright to dark ("#f69721"); distinguishable with any colour vision.
std::string svg_shade(double part);
/// Returns the text colour to use on svg_shade(part).
const char* svg_ink(double part);

/// Series names with their line styles, placed leftwards from `right`; `baseline`: that of the text. Skips series
/// without a name.
std::string series_names(const SvgChart& chart, double right, double baseline);

/// Planned segments as one row of points; the edge that ends in points[i] has line[i] and rapid[i].
struct PlannedPath {
    std::vector<Xyz> points;
    std::vector<int> line;
    std::vector<bool> rapid;
    std::vector<bool> starts;  ///< a new part of the path starts here: no edge ends in this point
    double within = 0;         ///< maximum distance of dropped points from the edges, mm; < 0: unknown
};

/// Simplifies the planned path to at most `max_kept` points; keeps the ends of segments as far as possible.
PlannedPath thin_planned(const ReportData& data, std::size_t max_kept, double tolerance);

}  // namespace motionrack::trace
