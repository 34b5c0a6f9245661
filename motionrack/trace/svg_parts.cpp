// Shared parts of the pictures.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/trace/decimated_path.hpp>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr const char* style_sheet =
    "<style>svg{background:#fff;font:11px system-ui,sans-serif}text{fill:#3c4a57}polyline,path{fill:none}"
    ".grid{stroke:#e3e8ed}.box{stroke:#8a97a3;stroke-dasharray:2 3}.planned{stroke:#b9cbe0;stroke-width:5;"
    "stroke-linejoin:round}.planned.traverse{stroke-dasharray:7 7}.driven{stroke:#0b5cab;"
    "stroke-width:1.5}.mark *{stroke:#fff;stroke-width:1.5}.start *{fill:#1a7f37}.end *{fill:#1f2933}"
    ".worst *{stroke:#b3261e;stroke-width:3}.stop "
    "*{fill:#b3261e;stroke-width:2}.arrow{fill:#0b5cab}.limit{stroke:#b3261e;stroke-dasharray:6 4}"
    ".line{stroke-width:1.5;stroke:#0b5cab}.line.x{stroke:#b3261e}.line.y{stroke:#1a7f37}.line.z{stroke:#0b5cab}"
    ".line.a{stroke:#7a3fb0}.line.b{stroke:#8a5a00}.line.c{stroke:#00707a}.title{font-weight:600;font-size:13px}"
    "</style>";

constexpr std::array<std::array<double, 3>, 5> shades = {
    {{246, 151, 33}, {222, 90, 96}, {177, 42, 144}, {106, 0, 168}, {13, 8, 135}}};

bool same_place(const Xyz& a, const Xyz& b) {
    return a == b;
}

}  // namespace

std::string svg_head(const SvgStyle& style, const std::string& title) {
    const char* space = style.standalone ? " xmlns=\"http://www.w3.org/2000/svg\"" : "";
    return fmt::format("<svg{} viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}\n", space, style.width,
                       style.height, escaped(title), style.standalone ? style_sheet : "");
}

std::string svg_text(double x, double y, const char* anchor, const std::string& text) {
    return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", coordinate(x), coordinate(y), anchor,
                       escaped(text));
}

std::string svg_shade(double part) {
    const double at = std::clamp(part, 0.0, 1.0) * (shades.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), shades.size() - 2);
    const double rest = at - static_cast<double>(i);
    const auto mixed = [&](std::size_t k) {
        return static_cast<int>(shades[i][k] + rest * (shades[i + 1][k] - shades[i][k]) + 0.5);
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

const char* svg_ink(double part) {
    return part < 0.3 ? "#1f2933" : "#ffffff";
}

void BoundingBox::add(const Xyz& point) {
    for (const double v : point) {
        if (!std::isfinite(v)) return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        low[i] = some ? std::min(low[i], point[i]) : point[i];
        high[i] = some ? std::max(high[i], point[i]) : point[i];
    }
    some = true;
}

double BoundingBox::diagonal() const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (high[i] - low[i]) * (high[i] - low[i]);
    return std::isfinite(sum) ? std::sqrt(sum) : 0;
}

BoundingBox extent_of_path(const ReportData& data) {
    BoundingBox extent;
    for (const ReportSegment& segment : data.planned) {
        for (const Xyz& point : segment.points) extent.add(point);
    }
    for (const Xyz& point : data.driven) extent.add(point);
    return extent;
}

BoundingBox extent_of_travel(const ReportData& data) {
    BoundingBox extent = extent_of_path(data);
    for (const ReportAxis& axis : data.axes) {
        const std::size_t i = axis.name == "X" ? 0 : axis.name == "Y" ? 1 : axis.name == "Z" ? 2 : 3;
        if (i == 3 || !(axis.min_position < axis.max_position)) continue;
        if (!std::isfinite(axis.min_position) || !std::isfinite(axis.max_position)) continue;
        extent.low[i] = axis.min_position;
        extent.high[i] = axis.max_position;
    }
    return extent;
}

BoundingBox frame_of(const ReportData& data) {
    BoundingBox path = extent_of_path(data);
    const BoundingBox travel = extent_of_travel(data);
    const double wide = path.high[0] - path.low[0], high = path.high[1] - path.low[1];
    const bool lost = wide < 0.4 * (travel.high[0] - travel.low[0]) && high < 0.4 * (travel.high[1] - travel.low[1]);
    BoundingBox frame = lost ? path : travel;
    for (std::size_t i = 0; i < 2; ++i) {  // minimum size of a picture
        const double small = std::max(1e-3, 0.02 * frame.diagonal());
        if (frame.high[i] - frame.low[i] < small) frame.low[i] -= small, frame.high[i] += small;
    }
    return frame;
}

PlannedPath thin_planned(const ReportData& data, std::size_t max_kept, double tolerance) {
    PlannedPath all;
    std::vector<bool> corner;
    for (const ReportSegment& segment : data.planned) {
        for (std::size_t i = 0; i < segment.points.size(); ++i) {
            const Xyz& point = segment.points[i];
            const bool joined = i == 0 && !all.points.empty() && same_place(all.points.back(), point);
            if (i == 0 && !corner.empty()) corner.back() = true;
            if (joined) continue;
            all.points.push_back(point);
            all.line.push_back(segment.line);
            all.rapid.push_back(segment.rapid);
            all.starts.push_back(i == 0);
            corner.push_back(i == 0);
        }
    }
    std::vector<PathPoint> points;
    points.reserve(all.points.size());
    for (const Xyz& p : all.points) points.push_back({p[0], p[1], p[2], 0});
    PlannedPath thin;
    std::size_t before = 0;
    const DecimatedPath path = thin_path(points, corner, tolerance, max_kept);
    thin.within = path.within;
    for (const std::size_t i : path.kept) {
        bool starts = all.starts[i];
        for (std::size_t k = before + 1; k < i && !thin.points.empty(); ++k) starts = starts && !all.starts[k];
        thin.points.push_back(all.points[i]);
        thin.line.push_back(all.line[i]);
        thin.rapid.push_back(all.rapid[i]);
        thin.starts.push_back(starts || thin.points.size() == 1);
        before = i;
    }
    return thin;
}

double nice_step(double span, int parts) {
    const double rough = span / parts;
    if (!(rough > 1e-12) || !(rough < 1e12)) return 1;
    double power = 1e-12;
    while (power * 10 <= rough) power *= 10;
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (power * factor >= rough * 0.999) return power * factor;
    }
    return power * 10;
}

Result<void> write_text(const std::string& text, const std::string& path) {
    const Result<void> done = disk::write_whole(path, text);
    if (done) return {};
    return fail(ErrorKind::io,
                fmt::format("The file of {} bytes could not be written: {}. Make room or choose another place.",
                            text.size(), done.error().message),
                {}, path);
}

}  // namespace motionrack::trace
