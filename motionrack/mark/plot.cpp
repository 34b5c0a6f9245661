// Converts millimetres to pixels; clips, simplifies and draws strokes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/mark/plot.hpp>
#include <motionrack/trace/decimated_path.hpp>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::mark {

namespace {

using trace::coordinate;

constexpr double eye_px = 0.12;            // px: smaller details are dropped, because they are invisible
constexpr std::size_t max_nodes = 40'000;  // nodes per call of strokes(): about 12 bytes each
constexpr double min_width_mm = 1e-4;

/// Clips the line from `a` to `b` to the box (Liang-Barsky); returns false if it is outside.
bool clip(const Box& box, Spot& a, Spot& b) {
    double begin = 0, end = 1;
    const Spot delta{b.x - a.x, b.y - a.y};
    const auto side = [&](double along, double distance) {
        if (along == 0) return distance >= 0;
        const double at = distance / along;
        if (along < 0)
            begin = std::max(begin, at);
        else
            end = std::min(end, at);
        return begin <= end;
    };
    if (!side(-delta.x, a.x - box.low.x) || !side(delta.x, box.high.x - a.x) || !side(-delta.y, a.y - box.low.y) ||
        !side(delta.y, box.high.y - a.y))
        return false;
    const Spot from = a;
    if (begin > 0) a = {from.x + begin * delta.x, from.y + begin * delta.y};
    if (end < 1) b = {from.x + end * delta.x, from.y + end * delta.y};
    return true;
}

}  // namespace

std::vector<StrokePoint> nodes_of(std::span<const parts::DrawnSegment> segments) {
    std::vector<StrokePoint> out;
    for (const parts::DrawnSegment& s : segments) {
        if (out.empty() || s.from.x != out.back().at.x || s.from.y != out.back().at.y) out.push_back({s.from, true});
        out.push_back({s.to, false});
    }
    return out;
}

std::vector<StrokePoint> nodes_of(std::span<const parts::MarkedPoint> points) {
    std::vector<StrokePoint> out;
    out.reserve(points.size());
    for (const parts::MarkedPoint& p : points) out.push_back({p.at, p.first});
    return out;
}

Box joined(const Box& a, const Box& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

Box box_of(std::span<const StrokePoint> nodes) {
    Box out{nodes[0].at, nodes[0].at};
    for (const StrokePoint& n : nodes) out = joined(out, {n.at, n.at});
    return out;
}

std::string shown_length(double mm) {
    const double size = std::fabs(mm);
    if (size >= 0.1 || size == 0) return fmt::format("{:.4g} mm", mm);
    return size >= 1e-4 ? fmt::format("{:.3g} \xC2\xB5m", mm * 1e3) : fmt::format("{:.3g} nm", mm * 1e6);
}

Plot::Plot(const Box& box, int width, int height, double margin) : width_(width), height_(height) {
    const double wide = std::max(box.high.x - box.low.x, min_width_mm),
                 high = std::max(box.high.y - box.low.y, min_width_mm);
    scale_ = std::min((width - 2 * margin) / wide, (height - 2 * margin) / high);
    low_ = {(box.low.x + box.high.x) / 2 - width / scale_ / 2, (box.low.y + box.high.y) / 2 - height / scale_ / 2};
}

std::vector<StrokePoint> Plot::clipped(std::span<const StrokePoint> nodes) const {
    const double wide = width_ / scale_, high = height_ / scale_;
    const Box window{{low_.x - wide / 4, low_.y - high / 4}, {low_.x + wide * 1.25, low_.y + high * 1.25}};
    std::vector<StrokePoint> out;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (nodes[i].first) continue;
        Spot a = nodes[i - 1].at, b = nodes[i].at;
        if (!clip(window, a, b)) continue;
        if (nodes[i - 1].first || out.empty() || a.x != out.back().at.x || a.y != out.back().at.y)
            out.push_back({a, true});
        out.push_back({b, false});
    }
    return out;
}

std::string Plot::strokes(std::span<const StrokePoint> nodes, const char* style) const {
    const std::vector<StrokePoint> seen = clipped(nodes);
    std::vector<trace::PathPoint> points;
    std::vector<bool> ends;
    points.reserve(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        points.push_back({x(seen[i].at.x), y(seen[i].at.y), 0, 0});
        ends.push_back(seen[i].first || i + 1 == seen.size() || seen[i + 1].first);
    }
    const trace::DecimatedPath path = trace::thin_path(points, ends, eye_px, max_nodes);
    std::string data;
    std::size_t before = 0;
    for (const std::size_t i : path.kept) {
        bool first = data.empty();
        for (std::size_t k = before + 1; k <= i; ++k) first = first || seen[k].first;
        data += first ? "M" : "L";
        data += coordinate(points[i][0]) + " " + coordinate(points[i][1]);
        before = i;
    }
    return data.empty() ? std::string() : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

std::string Plot::grid() const {
    const double step = trace::nice_step(std::max(width_, height_) / scale_, 6);
    std::string out;
    for (double k = std::ceil(low_.x / step); x(k * step) <= width_; k += 1) {
        const std::string at = coordinate(x(k * step));
        out += fmt::format("<path class=\"grid\" d=\"M{} 0V{}\"/>\n", at, height_);
        if (x(k * step) > 30 && x(k * step) < width_ - 16)
            out += trace::svg_text(x(k * step), height_ - 5.0, "middle", trace::number(k * step));
    }
    for (double k = std::ceil(low_.y / step); y(k * step) >= 0; k += 1) {
        out += fmt::format("<path class=\"grid\" d=\"M0 {}H{}\"/>\n", coordinate(y(k * step)), width_);
        if (y(k * step) > 14 && y(k * step) < height_ - 22)
            out += trace::svg_text(5, y(k * step) - 3, "start", trace::number(k * step));
    }
    return out;
}

std::string Plot::outline(const Box& box, const char* style) const {
    const std::vector<StrokePoint> corners = {
        {box.low, true}, {{box.high.x, box.low.y}}, {box.high}, {{box.low.x, box.high.y}}, {box.low}};
    return strokes(corners, style);
}

std::string Plot::line(Spot from, Spot to, const char* style) const {
    const std::vector<StrokePoint> ends = {{from, true}, {to}};
    return strokes(ends, style);
}

std::string Plot::ring(Spot at) const {
    return fmt::format("<circle class=\"ring\" cx=\"{}\" cy=\"{}\" r=\"9\"/>\n", coordinate(x(at.x)),
                       coordinate(y(at.y)));
}

std::string Plot::cross(Spot at, const std::string& title) const {
    return fmt::format("<path class=\"over\" d=\"M{0} {1}m-5-5l10 10m0-10l-10 10\"><title>{2}</title></path>\n",
                       coordinate(x(at.x)), coordinate(y(at.y)), trace::escaped(title));
}

std::string Plot::scale_bar() const {
    const double bar = trace::nice_step(width_mm(), 10), left = width_ - 14 - bar * scale_, at = height_ - 24.0;
    return fmt::format("<path class=\"scale\" d=\"M{0} {1}v5h{2}v-5\"/>\n", coordinate(left), coordinate(at),
                       coordinate(bar * scale_)) +
           "<g class=\"halo\">" + trace::svg_text(left + bar * scale_ / 2, at - 1, "middle", shown_length(bar)) +
           "</g>\n";
}

}  // namespace motionrack::mark
