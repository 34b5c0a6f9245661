// Charts of the report page and the numbers drawn by its script.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/decimated_path.hpp>
#include <motionrack/trace/report_parts.hpp>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t all_chart_points = 90'000;  ///< total of all charts: about 10 bytes each
constexpr std::size_t max_driven = 16'000;        ///< points of the actual path: about 25 bytes each
constexpr std::size_t max_planned = 30'000;       ///< points of the planned path: about 18 bytes each

/// Returns a number as JSON; 0 for non-finite values.
std::string json_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "0";
}

/// Returns values as {"from":f,"step":s,"d":[...]}: value i is f + s * (d0 + ... + di).
std::string packed(const std::vector<double>& values, double step) {
    if (!(step > 0) || !std::isfinite(step)) step = 1;
    const double from = values.empty() ? 0 : values.front();
    std::string out = "{\"from\":" + json_number(from) + ",\"step\":" + json_number(step) + ",\"d\":[";
    long long last = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double scaled = std::clamp((values[i] - from) / step, -1e15, 1e15);
        const long long whole = std::llround(scaled);
        if (i > 0) out += ',';
        fmt::format_to(std::back_inserter(out), "{}", whole - last);
        last = whole;
    }
    return out + "]}";
}

/// Returns a step of a hundred-thousandth of the value range.
double fine_step(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return values.empty() ? 1 : (*high - *low) / 100'000;
}

double time_step(const ReportData& data) {
    double low = 0, high = 0;
    bool some = false;
    for (const double t : data.seconds) {
        if (!std::isfinite(t)) continue;
        low = some ? std::min(low, t) : t;
        high = some ? std::max(high, t) : t;
        some = true;
    }
    return (high - low) / 1e6;
}

std::string chart_json(const ReportData& data, const PageChart& entry, std::size_t buckets, double second) {
    const SvgSeries& series = entry.chart.series.front();
    std::vector<double> times, values;
    for (const std::size_t i : thin_series(series.seconds, series.values, buckets)) {
        times.push_back(series.seconds[i]);
        values.push_back(static_cast<double>(series.values[i]));
    }
    const ChartRange range = range_of(entry.chart);
    std::string limits;
    for (const SvgLimit& limit : entry.chart.limits) {
        if (!limits.empty()) limits += ',';
        limits += json_number(limit.value);
    }
    const std::string name = entry.axis < 0 ? "" : data.axes[static_cast<std::size_t>(entry.axis)].name;
    return fmt::format(
        "{{\"name\":{},\"title\":{},\"look\":\"{}\",\"range\":[{},{}],\"limits\":[{}],\"t\":{},\"v\":{}}}",
        json_string(name), json_string(entry.chart.title), series.style, json_number(range.low),
        json_number(range.high), limits, packed(times, second), packed(values, fine_step(values)));
}

std::string xyz_json(const Xyz& p) {
    return fmt::format("[{},{},{}]", json_number(p[0]), json_number(p[1]), json_number(p[2]));
}

/// Tolerance of the drawn paths: a fifth of the maximum deviation, within bounds, so that zooming in shows it.
double path_tolerance(const ReportData& data, double size) {
    const double max_deviation = data.max_deviation && data.max_deviation->mm > 0 ? data.max_deviation->mm : size;
    return std::clamp(max_deviation / 5, size / 2'000'000, size / 20'000);
}

std::string driven_json(const ReportData& data, double second) {
    const double size = extent_of_path(data).diagonal();
    const double per_second = second > 0 ? size / (second * 1e6) : 0;
    std::vector<PathPoint> points;
    const std::size_t count = std::min(data.driven.size(), data.seconds.size());
    points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Xyz& p = data.driven[i];
        points.push_back({p[0], p[1], p[2], data.seconds[i] * per_second});
    }
    const double tolerance = path_tolerance(data, size);
    const DecimatedPath path = thin_path(points, {}, tolerance, max_driven);
    std::array<std::vector<double>, 4> columns;
    for (const std::size_t i : path.kept) {
        for (std::size_t c = 0; c < 3; ++c) columns[c].push_back(points[i][c]);
        columns[3].push_back(data.seconds[i]);
    }
    const double step = tolerance / 5;
    return fmt::format("{{\"within\":{},\"x\":{},\"y\":{},\"z\":{},\"t\":{}}}", json_number(path.within),
                       packed(columns[0], step), packed(columns[1], step), packed(columns[2], step),
                       packed(columns[3], second));
}

std::string planned_json(const ReportData& data) {
    const double tolerance = path_tolerance(data, extent_of_path(data).diagonal());
    const PlannedPath path = thin_planned(data, max_planned, tolerance);
    std::array<std::vector<double>, 3> columns;
    std::vector<double> lines, kinds;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) columns[c].push_back(path.points[i][c]);
        lines.push_back(path.line[i]);
        kinds.push_back(path.starts[i] ? 2 : path.rapid[i] ? 1 : 0);
    }
    const double step = tolerance / 5;
    return fmt::format("{{\"within\":{},\"x\":{},\"y\":{},\"z\":{},\"line\":{},\"kind\":{}}}", json_number(path.within),
                       packed(columns[0], step), packed(columns[1], step), packed(columns[2], step), packed(lines, 1),
                       packed(kinds, 1));
}

std::string extent_json(const BoundingBox& extent) {
    return fmt::format("[{},{}]", xyz_json(extent.low), xyz_json(extent.high));
}

SvgChart chart(std::string title, std::string style, const ReportData& data, const std::vector<float>& values) {
    SvgChart out;
    out.title = std::move(title);
    out.series.push_back({"", std::move(style), data.seconds, values});
    return out;
}

void add_axis(const ReportData& data, std::size_t index, std::vector<PageChart>& charts) {
    const ReportAxis& axis = data.axes[index];
    const char letter = axis.name.empty() ? 'd' : axis.name[0];
    const std::string style(1, letter >= 'X' && letter <= 'Z'   ? static_cast<char>(letter - 'X' + 'x')
                               : letter >= 'A' && letter <= 'C' ? static_cast<char>(letter - 'A' + 'a')
                                                                : 'd');
    const int number_of = static_cast<int>(index);
    if (!axis.position.empty()) {
        SvgChart out = chart("Position, " + axis.unit, style, data, axis.position);
        if (axis.min_position < axis.max_position) out.limits = {{axis.min_position, ""}, {axis.max_position, ""}};
        charts.push_back({number_of, std::move(out)});
    }
    if (!axis.velocity.empty()) {
        SvgChart out = chart("Velocity, " + axis.unit + "/s", style, data, axis.velocity);
        if (axis.max_velocity > 0) out.limits = {{axis.max_velocity, ""}, {-axis.max_velocity, ""}};
        charts.push_back({number_of, std::move(out)});
    }
    if (!axis.accel.empty()) {
        SvgChart out = chart("Acceleration, " + axis.unit + "/s\xC2\xB2", style, data, axis.accel);
        if (axis.max_accel > 0) out.limits = {{axis.max_accel, ""}, {-axis.max_accel, ""}};
        charts.push_back({number_of, std::move(out)});
    }
    if (!axis.volts.empty())
        charts.push_back({number_of, chart("Voltage at the amplifier, V", style, data, axis.volts)});
}

std::string limits_as_text(const std::vector<SvgLimit>& limits) {
    if (limits.size() == 1) return "tolerance " + number(limits[0].value);
    const double first = limits[0].value, second = limits[1].value;
    if (!limits[0].name.empty()) return limits[0].name + " " + number(first) + " \xE2\x80\xA6 " + number(second);
    if (first == -second && first > 0) return "limit \xC2\xB1" + number(first);
    return "travel " + number(first) + " \xE2\x80\xA6 " + number(second);
}

/// Describes the limits, and states if they are outside the chart. `drawn`: at least one limit line is visible.
std::string limit_words(const SvgChart& chart, bool& drawn) {
    drawn = false;
    if (chart.limits.empty()) return {};
    const ChartRange range = range_of(chart);
    for (const SvgLimit& limit : chart.limits) {
        drawn = drawn || (limit.value >= range.low && limit.value <= range.high);
    }
    const std::string words = limits_as_text(chart.limits);
    return drawn ? words : words + ", off the chart";
}

std::string chart_html(const PageChart& entry, std::size_t index, int width, int height) {
    SvgStyle style;
    style.width = width;
    style.height = height;
    bool drawn = false;
    const std::string limit = limit_words(entry.chart, drawn);
    return fmt::format(
        "<figure class=\"chart\" data-chart=\"{}\"><figcaption><span class=\"name\">{}</span>"
        "<output></output><span class=\"limit-words{}\">{}</span></figcaption>\n<div "
        "class=\"plot\">{}</div></figure>\n",
        index, shown(entry.chart.title), drawn ? " drawn" : "", escaped(limit), svg_chart(entry.chart, style));
}

}  // namespace

std::vector<PageChart> charts_of(const ReportData& data) {
    std::vector<PageChart> charts;
    if (data.seconds.empty()) return charts;
    for (std::size_t i = 0; i < std::min(data.axes.size(), max_axes); ++i) add_axis(data, i, charts);
    if (!data.deviation_mm.empty()) {
        SvgChart out = chart("Deviation from the programmed path, mm", "d", data, data.deviation_mm);
        if (data.tolerance_mm > 0) out.limits = {{data.tolerance_mm, ""}};
        charts.push_back({-1, std::move(out)});
    }
    for (std::size_t i = 0; i < std::min(data.series.size(), max_axes); ++i) {
        const ReportSeries& series = data.series[i];
        if (series.values.empty()) continue;
        SvgChart out = chart(series.title, series.style, data, series.values);
        for (const double limit : series.limits) out.limits.push_back({limit, series.limits_name});
        charts.push_back({-1, std::move(out)});
    }
    return charts;
}

std::string charts_html(const ReportData& data, const std::vector<PageChart>& charts) {
    std::string out;
    int open = -1;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        if (charts[i].axis < 0) continue;
        if (charts[i].axis != open) {
            const ReportAxis& axis = data.axes[static_cast<std::size_t>(charts[i].axis)];
            if (open >= 0) out += "</article>\n";
            out += "<article class=\"card axis look-" + charts[i].chart.series.front().style + "\"><h3>Axis " +
                   shown(axis.name) + "</h3>\n";
            open = charts[i].axis;
        }
        out += chart_html(charts[i], i, 720, 150);
    }
    return open >= 0 ? out + "</article>\n" : out;
}

std::string series_html(const std::vector<PageChart>& charts) {
    std::string out;
    for (std::size_t i = 0; i < charts.size(); ++i)
        if (charts[i].axis < 0)
            out += "<article class=\"card\">" + chart_html(charts[i], i, 1440, 170) + "</article>\n";
    return out.empty() ? out : "<div class=\"series\">" + out + "</div>\n";
}

std::string drawing_json(const ReportData& data, const std::vector<PageChart>& charts) {
    const double second = time_step(data);
    const std::size_t buckets =
        std::min<std::size_t>(1500, all_chart_points / 4 / std::max<std::size_t>(1, charts.size()));
    std::string out = "{\"charts\":[";
    for (std::size_t i = 0; i < charts.size(); ++i) {
        out += (i > 0 ? ",\n" : "\n") + chart_json(data, charts[i], buckets, second);
    }
    out += "],\n\"frame\":" + extent_json(frame_of(data)) + ",\"travel\":" + extent_json(extent_of_travel(data));
    out += ",\n\"driven\":" + driven_json(data, second) + ",\n\"planned\":" + planned_json(data);
    if (data.max_deviation) {
        out += fmt::format(",\n\"worst\":{{\"at\":{},\"t\":{},\"mm\":{},\"line\":{}}}",
                           xyz_json(data.max_deviation->at), json_number(data.max_deviation->seconds),
                           json_number(data.max_deviation->mm), data.max_deviation->line);
    }
    if (data.stop) {
        out += fmt::format(",\n\"stop\":{{\"at\":{},\"t\":{},\"line\":{}}}", xyz_json(data.stop->at),
                           json_number(data.stop->seconds), data.stop->line);
    }
    out += ",\n\"moves\":[";
    for (std::size_t i = 0; i < std::min(data.moves.size(), max_moves); ++i) {
        const ReportMove& move = data.moves[i];
        out += fmt::format("{}[{},{},{}]", i > 0 ? "," : "", move.line, json_number(move.start),
                           json_number(move.start + move.duration));
    }
    return out + "]}";
}

}  // namespace motionrack::trace
