// Pictures of a marking job, separate for a page or together on a sheet:
//
//    as drawn     with correction   without       wide and pale: the drawing; thin: the marks
//    the field    worst point       worst point   a ring: the point of maximum deviation; in the field: the spot path,
//                                                  dashed while the laser is off
//
// If the marked parts are more than 2.6 times as wide as high, the pictures of whole parts are placed below each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/mark/plot.hpp>
#include <motionrack/mark/render.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/trace/svg_parts.hpp>
#include <motionrack/trace/text.hpp>

namespace motionrack::mark {

namespace {

constexpr int column = 380, line_width = 3 * column + 2 * 16;  // px; three columns and the gaps between them
constexpr double wide_from = 2.6;  // width to height ratio above which pictures are placed below each other

/// Style sheet of the single sheet; a report page has its own.
constexpr const char* sheet_style =
    "<style>.ground{fill:#fff}.frame{fill:none;stroke:#d9e0e7}.drawn{stroke:#1f2933;stroke-width:1.2}"
    ".without{stroke:#d9480f;stroke-width:1.5;stroke-linejoin:round}.jumps{stroke:#8a97a3;stroke-dasharray:3 4}"
    ".reach{stroke:#d9480f;stroke-dasharray:1 3}.ring{fill:none;stroke:#1f2933;stroke-width:2}"
    ".off-by,.over{stroke:#b3261e;stroke-width:2.5}.scale{stroke:#1f2933;stroke-width:1.5}"
    ".halo text{paint-order:stroke;stroke:#fff;stroke-width:4px;stroke-linejoin:round;fill:#1f2933}</style>\n";

/// One picture: `body` is its SVG content without the enclosing svg element.
struct Part {
    std::string title;
    std::vector<std::string> words;
    std::string body;
    int width = column, height = 0;
};

Box grown(const Box& box, double by) {
    return {{box.low.x - by, box.low.y - by}, {box.high.x + by, box.high.y + by}};
}
double size_of(const Box& box) {
    return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

/// Returns the point of the drawing nearest to `p`.
Spot nearest_point(std::span<const parts::DrawnSegment> segments, Spot p) {
    Spot best = p;
    double min_distance2 = std::numeric_limits<double>::infinity();
    for (const parts::DrawnSegment& s : segments) {
        const Spot delta{s.to.x - s.from.x, s.to.y - s.from.y};
        const double length2 = delta.x * delta.x + delta.y * delta.y;
        const double t =
            length2 > 0 ? std::clamp(((p.x - s.from.x) * delta.x + (p.y - s.from.y) * delta.y) / length2, 0.0, 1.0) : 0;
        const Spot on{s.from.x + t * delta.x, s.from.y + t * delta.y};
        const double off = (on.x - p.x) * (on.x - p.x) + (on.y - p.y) * (on.y - p.y);
        if (off < min_distance2) min_distance2 = off, best = on;
    }
    return best;
}

constexpr std::size_t max_parts = 24;  ///< parts shown in one picture

/// Returns the strokes of all shown parts in picture coordinates: belt parts side by side, table parts around their
/// centre.
std::vector<StrokePoint> side_by_side(const Marked& marked, const auto& nodes_of_part) {
    std::vector<StrokePoint> out;
    for (std::size_t i = 0; i < std::min(marked.parts.size(), max_parts); ++i)
        for (const StrokePoint& node : nodes_of_part(marked.parts[i]))
            out.push_back({marked.parts[i].shown(node.at), node.first});
    return out;
}
std::vector<StrokePoint> marks_of(const Marked& marked, const PartMarked& part) {
    return nodes_of(std::span(marked.points).subspan(part.first_point, part.points));
}
std::vector<StrokePoint> marks_of(const Marked& marked) {
    return side_by_side(marked, [&](const PartMarked& part) { return marks_of(marked, part); });
}
std::vector<StrokePoint> drawings_of(const Prepared& prepared, const Marked& marked) {
    return side_by_side(marked, [&](const PartMarked& part) {
        return nodes_of(std::span<const parts::DrawnSegment>(prepared.of(part.drawing).segments));
    });
}
/// Returns the index of the part with the maximum deviation.
std::size_t max_deviation_part(const Marked& marked) {
    const auto part_of_max = std::max_element(
        marked.parts.begin(), marked.parts.end(),
        [](const PartMarked& a, const PartMarked& b) { return a.deviation.max_mm < b.deviation.max_mm; });
    return static_cast<std::size_t>(part_of_max - marked.parts.begin());
}
std::string of_part(const Marked& marked) {
    return marked.parts.size() > 1 ? fmt::format(" of part {}", max_deviation_part(marked) + 1) : std::string();
}

/// Shared data of all pictures of a job.
struct Scene {
    const Prepared& prepared;
    const MarkingOutcome& out;
    std::vector<StrokePoint> drawing;
    Box box{};  ///< bounds of drawing and marks

    Scene(const Prepared& p, const MarkingOutcome& o) : prepared(p), out(o), drawing(drawings_of(p, o.on)) {
        if (drawing.empty()) return;
        box = mark::box_of(std::span<const StrokePoint>(drawing));
        const Box max_box = grown(box, 3 * size_of(box));
        for (const Marked* m : {&out.on, out.off ? &*out.off : nullptr})
            if (m != nullptr && !m->points.empty()) box = joined(box, mark::box_of(marks_of(*m)));
        box = {{std::max(box.low.x, max_box.low.x), std::max(box.low.y, max_box.low.y)},
               {std::min(box.high.x, max_box.high.x), std::min(box.high.y, max_box.high.y)}};
    }
    bool wide() const { return box.high.x - box.low.x > wide_from * (box.high.y - box.low.y); }
};

/// Draws a cross for each overflow with the laser on, at most 200; `place` gives the position of an overflow in the
/// plot.
std::string crosses(const Plot& plot, const std::vector<Overflow>& overflows, const auto& place) {
    constexpr std::size_t max_crosses = 200;
    std::string out;
    std::size_t drawn = 0;
    for (const Overflow& o : overflows)
        if (o.marking && drawn++ < max_crosses)
            out += plot.cross(place(o), fmt::format("{} at {:.5f} s, by {:.3f} mm", o.name, o.from_s, o.beyond_mm));
    return out;
}

Part part_of(const Scene& scene, const Marked* marked, const char* title, const char* style) {
    Part part;
    part.title = title;
    part.width = scene.wide() ? line_width : column;
    const double shape = (scene.box.high.y - scene.box.low.y) / std::max(scene.box.high.x - scene.box.low.x, 1e-9);
    constexpr double margin = 34;
    part.height = static_cast<int>(
        std::clamp((part.width - 2 * margin) * shape + 2 * margin, scene.wide() ? 130.0 : 240.0, 460.0));
    const Plot plot(scene.box, part.width, part.height, margin);
    const std::size_t parts = scene.out.on.parts.size();
    part.body = plot.grid() + (parts > 1 ? std::string() : plot.outline(scene.out.field, "box")) +
                plot.strokes(scene.drawing, "planned");
    if (marked == nullptr) {
        part.words.push_back(
            fmt::format("{:.3f} mm in {}", scene.out.drawing_mm, rack::count_noun(scene.out.strokes, "stroke")));
        if (parts > 1)
            part.words.push_back(
                fmt::format("on each of {} parts{}", parts,
                            parts > max_parts ? fmt::format(", of which {} are shown", max_parts) : ""));
        part.body += plot.strokes(scene.drawing, "drawn");
    } else {
        const parts::Deviation& d = marked->deviation;
        part.words = {fmt::format("worst {} at {:.3f}, {:.3f} mm{}; rms {}", shown_length(d.max_mm), d.max_at.x,
                                  d.max_at.y, of_part(*marked), shown_length(d.rms_mm)),
                      d.missing_mm > 0 ? fmt::format("{} of the drawing not marked", shown_length(d.missing_mm))
                                       : "all of the drawing marked"};
        part.body += plot.strokes(marks_of(*marked), style);
        part.body +=
            crosses(plot, marked->overflows, [&](const Overflow& o) { return marked->parts[o.part_no].shown(o.part); });
        const std::size_t part_of_max = max_deviation_part(*marked);
        if (d.max_mm > 0 && part_of_max < max_parts) part.body += plot.ring(marked->parts[part_of_max].shown(d.max_at));
    }
    part.body += plot.scale_bar();
    return part;
}

/// Draws the path of the spot in the field: marks solid, jumps dashed.
Part field_of(const Scene& scene) {
    Part part;
    const MarkingOutcome& out = scene.out;
    part.title = "In the field";
    part.height = 300;
    const FieldMargin margin = margin_of(out, out.on);
    part.words = {fmt::format("{:.1f} mm wide and high", out.field.high.x - out.field.low.x),
                  margin.mm >= 0 ? fmt::format("{} left at the {} edge", shown_length(margin.mm), margin.edge)
                                 : fmt::format("{} too far over the {} edge", shown_length(-margin.mm), margin.edge)};
    const Plot plot(joined(out.field, out.on.reach), part.width, part.height, 16);
    std::vector<StrokePoint> marks, jumps;
    for (std::size_t i = 1; i < out.on.course.size(); ++i) {
        const FieldSample &a = out.on.course[i - 1], &b = out.on.course[i];
        std::vector<StrokePoint>& row = b.gate > 0 ? marks : jumps;
        const bool goes_on = !row.empty() && row.back().at.x == a.at.x && row.back().at.y == a.at.y;
        if (!goes_on) row.push_back({a.at, true});
        row.push_back({b.at, false});
    }
    part.body = plot.grid() + plot.outline(out.field, "box") + plot.strokes(jumps, "jumps") +
                plot.strokes(marks, out.off ? "driven" : "without") +
                (out.off ? plot.outline(out.on.reach, "reach") : std::string()) +
                crosses(plot, out.on.overflows, [](const Overflow& o) { return o.field; }) + plot.scale_bar();
    return part;
}

/// Draws the surroundings of the point of maximum deviation, enlarged. Returns an empty picture if the whole picture
/// already shows the deviation at this size.
Part worst_of(const Scene& scene, const Marked& marked, const char* title, const char* style) {
    Part part;
    const parts::Deviation& d = marked.deviation;
    const double reach = std::max(d.max_mm * 2, 2e-4);
    if (d.max_mm <= 0 || reach > size_of(scene.box) / 8) return part;
    const PartMarked& part_of_max = marked.parts[max_deviation_part(marked)];
    const std::vector<parts::DrawnSegment>& segments = scene.prepared.of(part_of_max.drawing).segments;
    const Spot on = nearest_point(segments, d.max_at), middle{(on.x + d.max_at.x) / 2, (on.y + d.max_at.y) / 2};
    part.height = 300;
    const Plot plot(grown({middle, middle}, reach), part.width, part.height);
    part.title = title;
    part.words = {
        fmt::format("{} off at {:.3f}, {:.3f} mm{}", shown_length(d.max_mm), d.max_at.x, d.max_at.y, of_part(marked)),
        fmt::format("marked at {:.5f} s", d.max_s)};
    part.body = plot.strokes(nodes_of(std::span<const parts::DrawnSegment>(segments)), "planned") +
                plot.strokes(marks_of(marked, part_of_max), style) + plot.line(on, d.max_at, "off-by") +
                plot.ring(d.max_at) + plot.scale_bar();
    return part;
}

struct Parts {
    std::vector<Part> whole, details;
};

Parts parts_of(const Prepared& prepared, const MarkingOutcome& out) {
    const Scene scene(prepared, out);
    Parts parts;
    parts.whole.push_back(part_of(scene, nullptr, "As drawn", ""));
    if (out.off) parts.whole.push_back(part_of(scene, &out.on, "With correction", "driven"));
    const Marked& without = out.off ? *out.off : out.on;
    parts.whole.push_back(part_of(scene, &without, "Without correction", "without"));
    parts.details.push_back(field_of(scene));
    if (out.off) parts.details.push_back(worst_of(scene, out.on, "Maximum deviation with correction", "driven"));
    parts.details.push_back(worst_of(scene, without, "Maximum deviation without correction", "without"));
    return parts;
}

}  // namespace

std::vector<trace::ReportPicture> pictures_of(const Prepared& prepared, const MarkingOutcome& out) {
    std::vector<trace::ReportPicture> pictures;
    const Parts parts = parts_of(prepared, out);
    for (const std::vector<Part>* row : {&parts.whole, &parts.details})
        for (const Part& p : *row)
            if (!p.body.empty())
                pictures.push_back({p.title, p.words,
                                    trace::svg_head({p.width, p.height, false},
                                                    fmt::format("{}: {}", p.title, fmt::join(p.words, "; "))) +
                                        p.body + "</svg>\n",
                                    p.width > column});
    return pictures;
}

std::string picture_svg(const Prepared& prepared, const MarkingOutcome& out) {
    constexpr int margin = 20, gap = 16, heading = 58, foot = 34;
    const Parts parts = parts_of(prepared, out);
    std::string body;
    int x = margin, y = margin, widest = 0;
    const auto put = [&](const Part& p) {
        body += fmt::format("<text class=\"title\" x=\"{}\" y=\"{}\">{}</text>\n", x, y + 14, p.title);
        for (std::size_t i = 0; i < p.words.size(); ++i)
            body += trace::svg_text(x, y + 31 + 15 * static_cast<int>(i), "start", p.words[i]);
        body += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">\n{}</svg>\n", x,
                            y + heading, p.width, p.height, p.width, p.height, p.body);
        body += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"6\"/>\n", x,
                            y + heading, p.width, p.height);
        widest = std::max(widest, x + p.width);
    };
    const bool wide = parts.whole.front().width > column;
    for (const Part& p : parts.whole) {
        put(p);
        if (wide)
            y += heading + p.height + gap;
        else
            x += p.width + gap;
    }
    if (!wide) y += heading + parts.whole.front().height + gap;
    x = margin;
    for (const Part& p : parts.details) {
        if (!p.body.empty()) put(p);
        x += column + gap;
    }
    y += heading + parts.details.front().height + gap;
    x = margin;
    for (const auto& [style, name] : {std::pair{"planned", "drawing"},
                                      {"driven", "marked with correction"},
                                      {"without", "marked without"},
                                      {"box", "field"},
                                      {"jumps", "laser off"}}) {
        if (style == std::string_view("driven") && !out.off) continue;
        body += fmt::format("<path class=\"{}\" d=\"M{} {}h26\"/>\n", style, x, y + 4) +
                trace::svg_text(x + 34, y + 8, "start", name);
        x += 34 + 7 * static_cast<int>(std::string_view(name).size()) + 18;
    }
    body += fmt::format("<circle class=\"ring\" cx=\"{}\" cy=\"{}\" r=\"7\"/>\n", x + 8, y + 4) +
            trace::svg_text(x + 24, y + 8, "start", "maximum deviation");
    trace::SvgStyle style;
    style.width = widest + margin, style.height = y + foot, style.standalone = true;
    return trace::svg_head(style, "The marked part") + sheet_style +
           fmt::format("<rect class=\"ground\" width=\"{}\" height=\"{}\"/>\n", style.width, style.height) + body +
           "</svg>\n";
}

}  // namespace motionrack::mark
