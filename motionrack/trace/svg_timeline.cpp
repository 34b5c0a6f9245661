// Charts over a common time axis, with a band of names below.
//
//   position  /~~\__      chart
//  velocity  |~|__|~     chart
//             [a][ b ]    band
//             a   b      names, read downwards, with lines to their spans
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr double heading = 24, band = 16, leader = 18, spacing = 14;

struct Stretch {
    double begin = std::numeric_limits<double>::infinity();
    double end = -std::numeric_limits<double>::infinity();
};

Stretch stretch_of(std::span<const SvgChart> charts) {
    Stretch out;
    for (const SvgChart& chart : charts) {
        for (const SvgSeries& series : chart.series) {
            for (const double t : series.seconds) {
                if (!std::isfinite(t)) continue;
                out.begin = std::min(out.begin, t);
                out.end = std::max(out.end, t);
            }
        }
    }
    if (!(out.end > out.begin))
        out = {std::isfinite(out.begin) ? out.begin : 0, (std::isfinite(out.begin) ? out.begin : 0) + 1};
    return out;
}

/// Positions of the names: at the middle of their spans, moved apart until none overlap.
std::vector<double> spread(std::vector<double> at, double left, double right) {
    for (std::size_t i = 1; i < at.size(); ++i) at[i] = std::max(at[i], at[i - 1] + spacing);
    double max_at = right;
    for (std::size_t i = at.size(); i-- > 0; max_at -= spacing) at[i] = std::max(left, std::min(at[i], max_at));
    return at;
}

}  // namespace

std::string svg_timeline(const std::string& title, std::span<const SvgChart> charts, std::span<const SvgSpan> spans,
                         const SvgStyle& style) {
    const Stretch stretch = stretch_of(charts);
    std::size_t max_length = 0;
    for (const SvgSpan& span : spans) max_length = std::max(max_length, span.name.size());
    const double names = spans.empty() ? 0 : band + leader + letter_width * static_cast<double>(max_length) + 6;
    const double each = (style.height - heading - names) / std::max<double>(1, static_cast<double>(charts.size()));
    std::string out = svg_head(style, title);
    out += fmt::format("<text class=\"title\" x=\"{}\" y=\"15\">{}</text>\n", chart_left, escaped(title));
    out += svg_text(style.width - chart_right, 15, "end", "time in s");
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const double y = heading + each * static_cast<double>(i);
        out += fmt::format("<svg x=\"0\" y=\"{}\" width=\"{}\" height=\"{}\">\n", coordinate(y), style.width,
                           coordinate(each));
        out +=
            svg_text(chart_left, 16, "start", charts[i].title) + series_names(charts[i], style.width - chart_right, 16);
        out += svg_chart(charts[i], {style.width, static_cast<int>(each), false}) + "</svg>\n";
    }
    const double left = chart_left, right = style.width - chart_right, top = style.height - names;
    const auto x = [&](double t) {
        return left + (std::clamp(t, stretch.begin, stretch.end) - stretch.begin) / (stretch.end - stretch.begin) *
                          (right - left);
    };
    std::vector<double> middles;
    for (const SvgSpan& span : spans) middles.push_back((x(span.from_s) + x(span.to_s)) / 2);
    const std::vector<double> at = spread(middles, left + 4, right - 4);
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const double from = x(spans[i].from_s), to = x(spans[i].to_s), below = top + band + leader;
        out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", coordinate(from),
                           coordinate(top), coordinate(std::max(0.5, to - from)), coordinate(band),
                           i % 2 == 0 ? "#9dbbdc" : "#d9a441");
        out +=
            fmt::format("<polyline class=\"line\" style=\"stroke:#8a97a3;stroke-width:.7\" points=\"{},{} {},{}\"/>\n",
                        coordinate(middles[i]), coordinate(top + band), coordinate(at[i]), coordinate(below));
        out += fmt::format("<text transform=\"translate({} {}) rotate(90)\">{}</text>\n", coordinate(at[i] - 4),
                           coordinate(below + 3), escaped(spans[i].name));
    }
    return out + "</svg>\n";
}

std::string svg_column(const std::string& title, std::span<const SvgPart> parts, int width) {
    constexpr int heading_height = 24;
    int height = heading_height;
    for (const SvgPart& part : parts) height += part.height;
    std::string out = svg_head({width, height, true}, title);
    out += fmt::format("<text class=\"title\" x=\"{}\" y=\"16\">{}</text>\n", chart_left, escaped(title));
    int y = heading_height;
    for (const SvgPart& part : parts) {
        out += fmt::format("<svg x=\"0\" y=\"{}\" width=\"{}\" height=\"{}\">\n", y, width, part.height) + part.svg +
               "</svg>\n";
        y += part.height;
    }
    return out + "</svg>\n";
}

std::string svg_row(const std::string& title, std::span<const SvgPart> parts, int width, int heading_height) {
    const int height = parts.empty() ? 0 : parts.front().height;
    std::string out = svg_head({width * static_cast<int>(parts.size()), height + heading_height, false}, title);
    if (heading_height > 0) out += svg_text(chart_left, heading_height - 8, "start", title);
    int x = 0;
    for (const SvgPart& part : parts) {
        out +=
            fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n", x, heading_height, width, part.height) +
            part.svg + "</svg>\n";
        x += width;
    }
    return out + "</svg>\n";
}

}  // namespace motionrack::trace
