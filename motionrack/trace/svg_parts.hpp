// What the pictures of this room share: the head with its style, texts, and the thinned planned path.
#pragma once

#include <motionrack/trace/svg.hpp>
#include <string>
#include <vector>

namespace motionrack::trace {

/// What a chart leaves free for its scale, left and right of the plot, in px.
inline constexpr double chart_left = 56, chart_right = 12;
/// Of a letter in the pictures' small type, in px.
inline constexpr double letter_width = 6.2;

/// The opening tag, with `title` for those who cannot see the picture.
std::string svg_head(const SvgLook& look, const std::string& title);

/// `anchor`: "start", "middle" or "end". The text is escaped here.
std::string svg_text(double x, double y, const char* anchor, const std::string& text);

/// The colour of a value, 0 .. 1, from bright to dark: "#f69721"; apart from each other for every eye.
std::string svg_shade(double part);
/// What is written upon such a colour.
const char* svg_ink(double part);

/// The names of a chart's series with the looks of their lines, leftwards from `right`; `baseline` is that of the text.
/// Series without a name are left out.
std::string series_names(const SvgChart& chart, double right, double baseline);

/// The planned segments as one row of points; the edge that ends in points[i] has line[i] and traverse[i].
struct PlannedPath {
    std::vector<Xyz> points;
    std::vector<int> line;
    std::vector<bool> rapid;
    std::vector<bool> starts;  ///< the path begins anew here: no edge ends in this point
    double within = 0;         ///< what was left out lies no farther than this from the edges, mm; < 0: not known
};

/// The planned path with at most `most` points, ends of segments kept where they fit.
PlannedPath thin_planned(const ReportData& data, std::size_t most, double tolerance);

}  // namespace motionrack::trace
