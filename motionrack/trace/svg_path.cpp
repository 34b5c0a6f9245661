// The path as SVG, from above and in perspective.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/trace/decimated_path.hpp>
#include <motionrack/trace/svg.hpp>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t max_points = 4000;

struct Flat {
    double x = 0;
    double y = 0;
};

/// Converts machine coordinates to pixels.
class Projection {
  public:
    Projection(const BoundingBox& frame, PathView view, const SvgStyle& style) : view_(view) {
        for (std::size_t i = 0; i < 3; ++i) centre_[i] = (frame.low[i] + frame.high[i]) / 2;
        middle_ = {style.width / 2.0, style.height / 2.0};
        const SinCos yaw = sin_cos(-0.61), tilt = sin_cos(0.55);
        turn_ = {yaw.cos, yaw.sin, tilt.cos, tilt.sin};
        far_ = std::max(frame.diagonal(), 1e-6) * 2;
        const double wide = style.width - 2 * edge, high = style.height - 2 * edge;
        double across = 1e-9, up = 1e-9;
        for (int corner = 0; corner < 8; ++corner) {
            const Flat at = (*this)({(corner & 1 ? frame.low : frame.high)[0], (corner & 2 ? frame.low : frame.high)[1],
                                     (corner & 4 ? frame.low : frame.high)[2]});
            across = std::max(across, std::abs(at.x - middle_.x));
            up = std::max(up, std::abs(at.y - middle_.y));
        }
        scale_ = std::min(wide / 2 / across, high / 2 / up);
    }

    Flat operator()(const Xyz& point) const {
        const double x = point[0] - centre_[0], y = point[1] - centre_[1], z = point[2] - centre_[2];
        if (view_ == PathView::plan) return {middle_.x + x * scale_, middle_.y - y * scale_};
        const double across = x * turn_[0] - y * turn_[1], deep = x * turn_[1] + y * turn_[0];
        const double up = z * turn_[2] + deep * turn_[3], away = deep * turn_[2] - z * turn_[3];
        const double shrink = far_ / (far_ + away);
        return {middle_.x + across * shrink * scale_, middle_.y - up * shrink * scale_};
    }

    double scale() const { return scale_; }
    const Xyz& centre() const { return centre_; }

  private:
    static constexpr double edge = 34;
    PathView view_;
    Xyz centre_{};
    Flat middle_;
    std::array<double, 4> turn_{};
    double far_ = 1;
    double scale_ = 1;
};

std::string line_through(const std::vector<Flat>& points, const char* style) {
    if (points.size() < 2) return {};
    std::string out = fmt::format("<polyline class=\"{}\" points=\"", style);
    for (const Flat& p : points) {
        out += coordinate(p.x) + ',' + coordinate(p.y) + ' ';
    }
    out.back() = '"';
    return out + "/>\n";
}

/// `floor`: height of the grid in perspective, mm.
std::string grid(const BoundingBox& frame, double floor, const Projection& at, PathView view, const SvgStyle& style) {
    const double reach_x = style.width / at.scale() / 2, reach_y = style.height / at.scale() / 2;
    const double step = nice_step(std::max(frame.high[0] - frame.low[0], frame.high[1] - frame.low[1]), 6);
    const bool plan = view == PathView::plan;
    Xyz low = frame.low, high = frame.high;
    low[2] = floor;
    if (plan) {
        low = {at.centre()[0] - reach_x, at.centre()[1] - reach_y, 0};
        high = {at.centre()[0] + reach_x, at.centre()[1] + reach_y, 0};
    }
    std::string out;
    for (const int axis : {0, 1}) {
        const auto i = static_cast<std::size_t>(axis), other = 1 - i;
        if (!((high[i] - low[i]) / step < 100)) continue;
        for (double k = std::ceil(low[i] / step); k * step <= high[i]; k += 1) {
            Xyz from = low, to = low;
            from[i] = to[i] = k * step;
            to[other] = high[other];
            out += line_through({at(from), at(to)}, "grid");
            if (!plan) continue;
            const Flat label = at(from);
            if (axis == 0 ? label.x > style.width - 60 : label.y < 30) continue;  // position of the axis name
            out += axis == 0 ? svg_text(label.x, style.height - 6.0, "middle", number(k * step))
                             : svg_text(6, label.y - 3, "start", number(k * step));
        }
    }
    return out;
}

std::string travel_box(const BoundingBox& box, const Projection& at, PathView view) {
    std::string out;
    const auto corner = [&](int bits) {
        return at({(bits & 1 ? box.high : box.low)[0], (bits & 2 ? box.high : box.low)[1],
                   (bits & 4 ? box.high : box.low)[2]});
    };
    for (int from = 0; from < (view == PathView::plan ? 4 : 8); ++from) {
        for (const int bit : {1, 2, 4}) {
            if ((from & bit) != 0 || (view == PathView::plan && bit == 4)) continue;
            out += line_through({corner(from), corner(from | bit)}, "box");
        }
    }
    return out;
}

std::string mark(const Flat& at, const char* kind, const std::string& title) {
    const std::string place = fmt::format("<g class=\"mark {}\" transform=\"translate({} {})\"><title>{}</title>", kind,
                                          coordinate(at.x), coordinate(at.y), escaped(title));
    const std::string_view which = kind;
    if (which == "start") return place + "<circle r=\"6\"/></g>\n";
    if (which == "end") return place + "<path d=\"M-5-5H5V5H-5Z\"/></g>\n";
    if (which == "stop") return place + "<path d=\"M-4-9H4L9-4V4L4 9H-4L-9 4V-4Z\"/><path d=\"M-5 0H5\"/></g>\n";
    return place + "<path d=\"M-6-6L6 6M-6 6L6-6\"/></g>\n";
}

double length_of(const std::vector<Flat>& points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double x = points[i].x - points[i - 1].x, y = points[i].y - points[i - 1].y;
        sum += std::sqrt(x * x + y * y);
    }
    return sum;
}

/// Arrows in the direction of motion; about forty at most, so that they do not hide a dense path.
std::string arrows(const std::vector<Flat>& points) {
    const double apart = std::max(90.0, length_of(points) / 40);
    if (!std::isfinite(apart)) return {};
    std::string out;
    double run = apart / 2;  // distance since the last arrow
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Flat &a = points[i - 1], &b = points[i];
        const double x = b.x - a.x, y = b.y - a.y, length = std::sqrt(x * x + y * y);
        if (!(length > 0)) continue;
        const double ux = x / length, uy = y / length;
        for (double along = apart - run; along <= length; along += apart) {
            const Flat p{a.x + ux * along, a.y + uy * along};
            out += fmt::format("<path class=\"arrow\" d=\"M{} {}L{} {} {} {}Z\"/>\n", coordinate(p.x + 6 * ux),
                               coordinate(p.y + 6 * uy), coordinate(p.x - 4 * ux - 4.5 * uy),
                               coordinate(p.y - 4 * uy + 4.5 * ux), coordinate(p.x - 4 * ux + 4.5 * uy),
                               coordinate(p.y - 4 * uy - 4.5 * ux));
        }
        run = std::fmod(run + length, apart);
    }
    return out;
}

std::string driven_line(const ReportData& data, const Projection& at) {
    std::vector<PathPoint> points;
    points.reserve(data.driven.size());
    for (const Xyz& p : data.driven) points.push_back({p[0], p[1], p[2], 0});
    std::vector<Flat> flat;
    for (const std::size_t i : thin_path(points, {}, extent_of_path(data).diagonal() / 3000, max_points).kept) {
        flat.push_back(at(data.driven[i]));
    }
    return line_through(flat, "driven") + arrows(flat);
}

constexpr int shade_steps = 20;

std::string shade_colour(int step) {
    return svg_shade(static_cast<double>(step) / (shade_steps - 1));
}

/// One line for each run of edges with the same colour.
std::string shaded_line(const ReportData& data, const Projection& at, const SvgShade& shade) {
    const double size = extent_of_path(data).diagonal();
    std::vector<PathPoint> points;
    for (std::size_t i = 0; i < data.driven.size(); ++i) {
        const Xyz& p = data.driven[i];
        points.push_back({p[0], p[1], p[2], 0.02 * size * static_cast<double>(shade.values[i]) / shade.max_value});
    }
    const auto step_at = [&](std::size_t a, std::size_t b) {
        const double part = 0.5 * static_cast<double>(shade.values[a] + shade.values[b]) / shade.max_value;
        return std::clamp(static_cast<int>(part * shade_steps), 0, shade_steps - 1);
    };
    const std::vector<std::size_t> kept = thin_path(points, {}, size / 3000, max_points).kept;
    std::string out = "<g style=\"stroke-width:2.5;stroke-linejoin:round;stroke-linecap:round\">\n";
    for (std::size_t i = 1; i < kept.size();) {
        const int step = step_at(kept[i - 1], kept[i]);
        const Flat first = at(data.driven[kept[i - 1]]);
        out += fmt::format("<polyline stroke=\"{}\" points=\"{},{}", shade_colour(step), coordinate(first.x),
                           coordinate(first.y));
        for (; i < kept.size() && step_at(kept[i - 1], kept[i]) == step; ++i) {
            const Flat p = at(data.driven[kept[i]]);
            out += ' ' + coordinate(p.x) + ',' + coordinate(p.y);
        }
        out += "\"/>\n";
    }
    return out + "</g>\n";
}

std::string shade_scale(const SvgShade& shade, const SvgStyle& style) {
    constexpr double step = 7, y = 6, high = 9;
    const double left = style.width - 12 - step * shade_steps;
    std::string out;
    for (int i = 0; i < shade_steps; ++i)
        out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                           coordinate(left + step * i), y, step + 0.3, high, shade_colour(i));
    return out + svg_text(left - 5, y + high, "end", "0") +
           svg_text(style.width - 12.0, y + high + 13, "end", number(shade.max_value) + " " + shade.unit);
}

std::string planned_lines(const ReportData& data, const Projection& at) {
    const PlannedPath path = thin_planned(data, max_points, extent_of_path(data).diagonal() / 3000);
    std::string out;
    std::vector<Flat> flat;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        if (i > 0 && path.starts[i]) {
            out += line_through(flat, path.rapid[i - 1] ? "planned traverse" : "planned");
            flat.clear();
        } else if (i > 1 && path.rapid[i] != path.rapid[i - 1]) {
            const Flat junction = flat.back();
            out += line_through(flat, path.rapid[i - 1] ? "planned traverse" : "planned");
            flat = {junction};
        }
        flat.push_back(at(path.points[i]));
    }
    if (!flat.empty()) out += line_through(flat, path.rapid.back() ? "planned traverse" : "planned");
    return out;
}

std::string position_text(const Xyz& p) {
    return "X " + number(p[0], 3) + "  Y " + number(p[1], 3) + "  Z " + number(p[2], 3) + " mm";
}

std::string marks(const ReportData& data, const Projection& at) {
    std::string out;
    const auto finite = [](const Xyz& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); };
    const std::vector<Xyz>& path = data.driven;
    if (!path.empty() && finite(path.front()))
        out += mark(at(path.front()), "start", "Start: " + position_text(path.front()));
    if (!path.empty() && finite(path.back())) out += mark(at(path.back()), "end", "End: " + position_text(path.back()));
    if (data.max_deviation && finite(data.max_deviation->at)) {
        out += mark(at(data.max_deviation->at), "worst",
                    fmt::format("Max deviation {} mm at {} s", number(data.max_deviation->mm),
                                number(data.max_deviation->seconds)));
    }
    if (data.stop && finite(data.stop->at)) out += mark(at(data.stop->at), "stop", "Stopped: " + data.stop->text);
    return out;
}

}  // namespace

std::string svg_path(const ReportData& data, PathView view, const SvgStyle& style, const SvgShade& shade) {
    const BoundingBox frame = frame_of(data);
    const Projection at(frame, view, style);
    const bool plan = view == PathView::plan;
    std::string out = svg_head(style, plan ? "The path from above: X to the right, Y up" : "The path in perspective");
    out += grid(frame, extent_of_path(data).low[2], at, view, style);
    out += travel_box(extent_of_travel(data), at, view);
    const bool shaded = !shade.values.empty() && shade.values.size() == data.driven.size() && shade.max_value > 0;
    out += planned_lines(data, at) +
           (shaded ? shaded_line(data, at, shade) + shade_scale(shade, style) : driven_line(data, at)) +
           marks(data, at);
    if (plan) {
        out += svg_text(style.width - 8.0, style.height - 6.0, "end", "X, mm") + svg_text(6, 14, "start", "Y, mm");
    }
    return out + "</svg>\n";
}

}  // namespace motionrack::trace
