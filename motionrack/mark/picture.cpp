// Two parts side by side: marked with correction and without; grey is the drawing, a ring is the worst place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <motionrack/mark/run.hpp>

namespace motionrack::mark {

namespace {

using Out = std::back_insert_iterator<std::string>;

void widen(Box& box, Spot p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
}

/// 1, 2 or 5 times a power of ten, about a quarter of `width`.
double scale_bar(double width) {
    double power = 1;
    while (power * 10 <= width / 4) power *= 10;
    while (power > width / 4 && power > 1e-9) power /= 10;
    for (const double step : {5.0, 2.0})
        if (power * step <= width / 4) return power * step;
    return power;
}

struct Page {
    Box box;
    double line = 0.1, gap = 0;  ///< mm
    double x(double mm, int column) const { return mm - box.low.x + column * gap; }
    double y(double mm) const { return box.high.y - mm; }
};

void drawing(Out to, const Page& page, const Prepared& prepared, int column) {
    fmt::format_to(to, "<path class=\"drawing\" fill=\"none\" stroke=\"#b8b8b8\" stroke-width=\"{:.4f}\" d=\"", 2.2 * page.line);
    Spot at{1e300, 1e300};
    for (const parts::Segment& s : prepared.segments) {
        if (s.from.x != at.x || s.from.y != at.y) fmt::format_to(to, "M{:.4f} {:.4f}", page.x(s.from.x, column), page.y(s.from.y));
        fmt::format_to(to, "L{:.4f} {:.4f}", page.x(s.to.x, column), page.y(s.to.y));
        at = s.to;
    }
    fmt::format_to(to, "\"/>\n");
}

void marks(Out to, const Page& page, const Marked& marked, int column, const char* title, const char* colour) {
    fmt::format_to(to, "<path class=\"marked\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.4f}\" stroke-linecap=\"round\" d=\"", colour, page.line);
    for (const parts::MarkedPoint& p : marked.points) fmt::format_to(to, "{}{:.4f} {:.4f}", p.first ? 'M' : 'L', page.x(p.at.x, column), page.y(p.at.y));
    fmt::format_to(to, "\"/>\n");
    const parts::Deviation& d = marked.deviation;
    const double text = 9 * page.line;
    if (d.worst_mm > 0)
        fmt::format_to(to, "<circle cx=\"{:.4f}\" cy=\"{:.4f}\" r=\"{:.4f}\" fill=\"none\" stroke=\"#c00000\" stroke-width=\"{:.4f}\"/>\n", page.x(d.worst_at.x, column),
                       page.y(d.worst_at.y), 6 * page.line, page.line / 2);
    fmt::format_to(to, "<text x=\"{:.4f}\" y=\"{:.4f}\" font-size=\"{:.4f}\">{}: worst {:.4f} mm, rms {:.4f} mm</text>\n", page.x(page.box.low.x, column), -text, text,
                   title, d.worst_mm, d.rms_mm);
}

}  // namespace

std::string picture_svg(const Prepared& prepared, const Outcome& out) {
    Page page;
    page.box = box_of(prepared.drawing);
    for (const Marked* m : {&out.on, out.off ? &*out.off : nullptr})
        if (m != nullptr)
            for (const parts::MarkedPoint& p : m->points) widen(page.box, p.at);
    const double wide = std::max({page.box.high.x - page.box.low.x, 0.3 * (page.box.high.y - page.box.low.y), 0.01});
    const double high = std::max(page.box.high.y - page.box.low.y, 0.01);
    page.line = std::max(wide, high) / 300;
    page.gap = std::max(wide, 270 * page.line) * 1.08;
    const double margin = 24 * page.line;
    const int columns = out.off ? 2 : 1;
    const double total_x = page.gap * columns + 2 * margin, total_y = high + 2.2 * margin;
    std::string text;
    const Out to(text);
    fmt::format_to(to, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"{:.4f} {:.4f} {:.4f} {:.4f}\" font-family=\"sans-serif\">\n",
                   columns * 560.0, std::ceil(columns * 560.0 * total_y / total_x), -margin, -margin, total_x, total_y);
    fmt::format_to(to, "<rect x=\"{:.4f}\" y=\"{:.4f}\" width=\"{:.4f}\" height=\"{:.4f}\" fill=\"white\"/>\n", -margin, -margin, total_x, total_y);
    drawing(to, page, prepared, 0);
    marks(to, page, out.on, 0, out.off ? "with correction" : "without correction", out.off ? "#0050a0" : "#c06000");
    if (out.off) {
        drawing(to, page, prepared, 1);
        marks(to, page, *out.off, 1, "without correction", "#c06000");
    }
    const double bar = scale_bar(wide), below = high + 12 * page.line;
    fmt::format_to(to, "<path d=\"M0 {0:.4f}h{1:.4f}\" stroke=\"black\" stroke-width=\"{2:.4f}\"/>\n<text x=\"{3:.4f}\" y=\"{4:.4f}\" font-size=\"{5:.4f}\">{1:g} mm</text>\n</svg>\n",
                   below, bar, 2 * page.line, bar + 4 * page.line, below + 3 * page.line, 9 * page.line);
    return text;
}

}  // namespace motionrack::mark
