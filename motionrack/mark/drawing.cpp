// Converts curves to lines and arcs.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/drawing.hpp>

namespace motionrack::mark {

namespace {

double distance(Spot a, Spot b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/// Returns the number of chords of an arc of radius `r` mm that keeps it within the tolerance (mm).
int chords(double sweep, double r, double tolerance) {
    const double n = std::ceil(std::fabs(sweep) * std::sqrt(std::max(r, 0.0) / (8 * tolerance)));
    return static_cast<int>(std::clamp(n, 1.0, 100'000.0)) + 1;
}

}  // namespace

Affine Affine::after(const Affine& first) const {
    return {a * first.a + c * first.b, b * first.a + d * first.b,     a * first.c + c * first.d,
            b * first.c + d * first.d, a * first.e + c * first.f + e, b * first.e + d * first.f + f};
}

bool Affine::keeps_circles() const {
    const double first = a * a + b * b, second = c * c + d * d, mixed = a * c + b * d;
    return std::fabs(first - second) <= 1e-9 * first && std::fabs(mixed) <= 1e-9 * first;
}

double Affine::max_scale() const {
    return std::sqrt(a * a + b * b + c * c + d * d);
}

void Pen::add(const Element& element) {
    if (++elements_ > max_elements) return;
    if (!down_) drawing_.strokes.push_back({to_mm_(begin_), {}});
    down_ = true;
    drawing_.strokes.back().elements.push_back(element);
}

void Pen::move_to(Spot p) {
    at_ = begin_ = p;
    down_ = false;
}

void Pen::line_to(Spot p) {
    const Spot from = to_mm_(at_), to = to_mm_(p);
    at_ = p;
    if (from.x != to.x || from.y != to.y) add({to});
}

void Pen::quadratic_to(Spot control, Spot p) {
    const Spot from = at_;
    cubic_to({from.x + 2 * (control.x - from.x) / 3, from.y + 2 * (control.y - from.y) / 3},
             {p.x + 2 * (control.x - p.x) / 3, p.y + 2 * (control.y - p.y) / 3}, p);
}

void Pen::cubic_to(Spot control1, Spot control2, Spot p) {
    const Spot q[4] = {to_mm_(at_), to_mm_(control1), to_mm_(control2), to_mm_(p)};
    // A chord over 1/n of the curve deviates from it by at most an eighth of the maximum second derivative, over n
    // squared.
    double second_difference = 0;
    for (int i = 0; i < 2; ++i)
        second_difference = std::max(
            second_difference, distance({q[i].x + q[i + 2].x, q[i].y + q[i + 2].y}, {2 * q[i + 1].x, 2 * q[i + 1].y}));
    const int n =
        static_cast<int>(std::clamp(std::ceil(std::sqrt(0.75 * second_difference / tolerance_)), 1.0, 100'000.0));
    for (int i = 1; i < n && complete(); ++i) {
        const double t = static_cast<double>(i) / n, s = 1 - t;
        const double w[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        add({{w[0] * q[0].x + w[1] * q[1].x + w[2] * q[2].x + w[3] * q[3].x,
              w[0] * q[0].y + w[1] * q[1].y + w[2] * q[2].y + w[3] * q[3].y}});
    }
    at_ = p;
    if (n > 1 || distance(q[0], q[3]) > 0) add({q[3]});
}

void Pen::ellipse_to(Spot centre, double rx, double ry, double turn, double begin, double sweep, Spot p) {
    const Spot end = to_mm_(p);
    at_ = p;
    if (rx == ry && to_mm_.keeps_circles()) {
        add({end, to_mm_(centre), to_mm_.determinant() < 0 ? -sweep : sweep});
        return;
    }
    const SinCos axis = sin_cos(turn);
    const int n = chords(sweep, std::max(rx, ry) * to_mm_.max_scale(), tolerance_);
    for (int i = 1; i < n && complete(); ++i) {
        const SinCos angle = sin_cos(begin + sweep * i / n);
        const double u = rx * angle.cos, v = ry * angle.sin;
        add({to_mm_({centre.x + axis.cos * u - axis.sin * v, centre.y + axis.sin * u + axis.cos * v})});
    }
    add({end});
}

void Pen::close() {
    if (down_) line_to(begin_);
    move_to(begin_);
}

Drawing transformed(const Drawing& drawing, const Affine& transform, double tolerance_mm) {
    Drawing out;
    Pen pen(out, tolerance_mm);
    pen.use(transform);
    for (const Stroke& stroke : drawing.strokes) {
        pen.move_to(stroke.from);
        Spot at = stroke.from;
        for (const Element& e : stroke.elements) {
            if (e.sweep == 0) {
                pen.line_to(e.to);
            } else {
                const double r = distance(at, e.centre);
                pen.ellipse_to(e.centre, r, r, 0, atan2(at.y - e.centre.y, at.x - e.centre.x), e.sweep, e.to);
            }
            at = e.to;
        }
    }
    return out;
}

std::size_t segment_count(const Drawing& drawing, double tolerance_mm) {
    std::size_t out = 0;
    for (const Stroke& stroke : drawing.strokes) {
        Spot at = stroke.from;
        for (const Element& e : stroke.elements) {
            out += e.sweep == 0 ? 1 : static_cast<std::size_t>(chords(e.sweep, distance(at, e.centre), tolerance_mm));
            at = e.to;
        }
    }
    return out;
}

std::vector<parts::DrawnSegment> segments_of(const Drawing& drawing, double tolerance_mm) {
    std::vector<parts::DrawnSegment> out;
    for (const Stroke& stroke : drawing.strokes) {
        Spot at = stroke.from;
        for (const Element& e : stroke.elements) {
            if (e.sweep != 0) {
                const Spot begin = at;
                const int n = chords(e.sweep, distance(at, e.centre), tolerance_mm);
                for (int i = 1; i < n; ++i) {
                    const SinCos turn = sin_cos(e.sweep * i / n);
                    const double dx = begin.x - e.centre.x, dy = begin.y - e.centre.y;
                    const Spot next{e.centre.x + turn.cos * dx - turn.sin * dy,
                                    e.centre.y + turn.sin * dx + turn.cos * dy};
                    out.push_back({at, next});
                    at = next;
                }
            }
            out.push_back({at, e.to});
            at = e.to;
        }
    }
    return out;
}

Box box_of(const Drawing& drawing) {
    const std::vector<parts::DrawnSegment> segments = segments_of(drawing, default_tolerance_mm);
    if (segments.empty()) return {};
    Box out{segments[0].from, segments[0].from};
    for (const parts::DrawnSegment& s : segments)
        for (const Spot& p : {s.from, s.to}) {
            out.low = {std::min(out.low.x, p.x), std::min(out.low.y, p.y)};
            out.high = {std::max(out.high.x, p.x), std::max(out.high.y, p.y)};
        }
    return out;
}

double length_of(const Drawing& drawing) {
    double out = 0;
    for (const Stroke& stroke : drawing.strokes) {
        Spot at = stroke.from;
        for (const Element& e : stroke.elements) {
            out += e.sweep == 0 ? distance(at, e.to) : std::fabs(e.sweep) * distance(at, e.centre);
            at = e.to;
        }
    }
    return out;
}

std::size_t element_count(const Drawing& drawing) {
    std::size_t out = 0;
    for (const Stroke& stroke : drawing.strokes) out += stroke.elements.size();
    return out;
}

}  // namespace motionrack::mark
