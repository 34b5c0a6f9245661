// Values over time as SVG.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/decimated_path.hpp>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr double plot_left = chart_left, plot_right = chart_right, plot_top = 24, plot_bottom = 22;
constexpr std::size_t buckets = 220;

/// Converts seconds and values to pixels.
struct Frame {
    double begin = 0;
    double end = 1;
    ChartRange range;
    SvgStyle style;

    double x(double seconds) const {
        return plot_left + (seconds - begin) / (end - begin) * (style.width - plot_left - plot_right);
    }
    double y(double value) const {
        return style.height - plot_bottom -
               (value - range.low) / (range.high - range.low) * (style.height - plot_top - plot_bottom);
    }
};

Frame frame_for(const SvgChart& chart, const SvgStyle& style) {
    Frame frame;
    frame.style = style;
    frame.range = range_of(chart);
    bool some = false;
    for (const SvgSeries& series : chart.series) {
        for (const double t : series.seconds) {
            if (!std::isfinite(t)) continue;
            frame.begin = some ? std::min(frame.begin, t) : t;
            frame.end = some ? std::max(frame.end, t) : t;
            some = true;
        }
    }
    if (!(frame.end > frame.begin)) frame.end = frame.begin + 1;
    return frame;
}

std::string straight(double x1, double y1, double x2, double y2, const char* kind) {
    return fmt::format("<polyline class=\"{}\" points=\"{},{} {},{}\"/>\n", kind, coordinate(x1), coordinate(y1),
                       coordinate(x2), coordinate(y2));
}

std::string scales(const Frame& frame) {
    std::string out;
    const double width = frame.style.width, height = frame.style.height;
    const double step = nice_step(frame.range.high - frame.range.low,
                                  std::max(2, static_cast<int>((height - plot_top - plot_bottom) / 22)));
    for (int i = 0; i < 100; ++i) {
        const double value = (std::ceil(frame.range.low / step - 1e-9) + i) * step;
        if (value > frame.range.high + step * 1e-9) break;
        out += straight(plot_left, frame.y(value), width - plot_right, frame.y(value), "grid");
        out += svg_text(plot_left - 6, frame.y(value) + 4, "end", number(value));
    }
    const double second = nice_step(frame.end - frame.begin, std::max(2, static_cast<int>(width / 90)));
    for (int i = 0; i < 100; ++i) {
        const double value = (std::ceil(frame.begin / second - 1e-9) + i) * second;
        if (value > frame.end + second * 1e-9) break;
        out += straight(frame.x(value), plot_top, frame.x(value), height - plot_bottom, "grid");
        out += svg_text(frame.x(value), height - 6, "middle", number(value, 6));
    }
    return out;
}

std::string limit_lines(const SvgChart& chart, const Frame& frame) {
    std::string out;
    for (const SvgLimit& limit : chart.limits) {
        if (!(limit.value >= frame.range.low && limit.value <= frame.range.high)) continue;
        out += straight(plot_left, frame.y(limit.value), frame.style.width - plot_right, frame.y(limit.value), "limit");
        if (!limit.name.empty()) {
            out += svg_text(frame.style.width - plot_right - 4, frame.y(limit.value) + 12, "end", limit.name);
        }
    }
    return out;
}

std::string line_of(const SvgSeries& series, const Frame& frame) {
    const std::vector<std::size_t> kept = thin_series(series.seconds, series.values, buckets);
    if (kept.empty()) return {};
    std::string out = fmt::format("<polyline class=\"line {}\" points=\"", escaped(series.style));
    for (const std::size_t i : kept) {
        out += coordinate(frame.x(series.seconds[i])) + ',' +
               coordinate(frame.y(static_cast<double>(series.values[i]))) + ' ';
    }
    out.back() = '"';
    out += "/>\n";
    return out;
}

/// Title, series names with their line styles, and the label of the time axis.
std::string chart_heading(const SvgChart& chart, const SvgStyle& style) {
    return fmt::format("<text class=\"title\" x=\"{}\" y=\"15\">{}</text>\n", plot_left, escaped(chart.title)) +
           series_names(chart, style.width - plot_right - 64, 15) +
           svg_text(style.width - plot_right, 15, "end", "time in s");
}

}  // namespace

std::string series_names(const SvgChart& chart, double right_end, double baseline) {
    std::string out;
    double x = right_end;
    for (auto series = chart.series.rbegin(); series != chart.series.rend(); ++series) {
        if (series->name.empty()) continue;
        out += svg_text(x, baseline, "end", series->name);
        x -= 6.0 * static_cast<double>(series->name.size()) + 7;
        out += straight(x - 20, baseline - 4, x, baseline - 4, ("line " + escaped(series->style)).c_str());
        x -= 36;
    }
    return out;
}

ChartRange range_of(const SvgChart& chart) {
    double low = 0, high = 0;
    bool some = false;
    for (const SvgSeries& series : chart.series) {
        for (const float value : series.values) {
            if (!std::isfinite(value)) continue;
            low = some ? std::min(low, static_cast<double>(value)) : static_cast<double>(value);
            high = some ? std::max(high, static_cast<double>(value)) : static_cast<double>(value);
            some = true;
        }
    }
    if (low > 0 && low < 0.4 * high) low = 0;
    if (high < 0 && high > 0.4 * low) high = 0;
    const double data_low = low, data_high = high;
    for (const SvgLimit& limit : chart.limits) {
        if (!std::isfinite(limit.value)) continue;
        const double reach = limit.value >= 0 ? data_high : -data_low;
        if (some && reach < 0.25 * std::abs(limit.value)) continue;
        low = std::min(low, limit.value);
        high = std::max(high, limit.value);
    }
    const double span = high - low;
    const double air = span > 0 ? 0.06 * span : std::max(1e-3, 0.1 * std::abs(high));
    return {low == 0 && span > 0 ? 0 : low - air, high == 0 && span > 0 ? 0 : high + air};
}

std::string svg_chart(const SvgChart& chart, const SvgStyle& style) {
    const Frame frame = frame_for(chart, style);
    std::string out = svg_head(style, chart.title + " over time");
    out += scales(frame) + limit_lines(chart, frame);
    for (const SvgSeries& series : chart.series) out += line_of(series, frame);
    if (style.standalone) out += chart_heading(chart, style);
    return out + "</svg>\n";
}

}  // namespace motionrack::trace
