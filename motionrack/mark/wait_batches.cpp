// Cuts strokes into cells along the movement and sorts them by the time they enter the field.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/wait_batches.hpp>

namespace motionrack::mark {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double pieces_in_field = 4, batches_in_field = 20;

double dot(Spot a, Spot b) {
    return a.x * b.x + a.y * b.y;
}
Spot between(Spot a, Spot b, double part) {
    return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

/// Interval along a direction.
struct Reach {
    double low = infinite, high = -infinite;
    void take(double v) { low = std::min(low, v), high = std::max(high, v); }
};

/// Calls `take` with the start of a stroke and the end of each of its lines and of the chords of its arcs.
template <class Take>
void each_point(const Stroke& stroke, const Take& take) {
    take(stroke.from);
    for (const parts::DrawnSegment& s : segments_of({{stroke}}, default_tolerance_mm)) take(s.to);
}

Reach reach_of(const Stroke& stroke, Spot direction) {
    Reach out;
    each_point(stroke, [&](Spot p) { out.take(dot(p, direction)); });
    return out;
}

/// Returns the parameters (0 .. 1 along the element) at which it crosses the planes direction * p = origin + n * cell,
/// in order.
std::vector<double> crossings(Spot at, const Element& e, Spot direction, double origin, double cell) {
    std::vector<double> out;
    const auto planes = [&](double low, double high, const auto& found) {
        for (double n = std::floor((low - origin) / cell) + 1; origin + n * cell < high; ++n) found(origin + n * cell);
    };
    if (e.sweep == 0) {
        const double a = dot(at, direction), b = dot(e.to, direction);
        planes(std::min(a, b), std::max(a, b), [&](double plane) { out.push_back((plane - a) / (b - a)); });
    } else {
        const Spot r{at.x - e.centre.x, at.y - e.centre.y};
        const double radius = std::sqrt(dot(r, r)), middle = dot(e.centre, direction);
        const double begin = atan2(r.y, r.x) - atan2(direction.y, direction.x);
        planes(middle - radius, middle + radius, [&](double plane) {
            const double c = (plane - middle) / radius, half = atan2(std::sqrt(std::max(0.0, 1 - c * c)), c);
            for (const double angle : {half, -half}) {
                const double turns = (angle - begin) / e.sweep, whole = std::fabs(2 * pi / e.sweep);
                for (double part = turns - whole * std::floor(turns / whole); part < 1; part += whole)
                    out.push_back(part);
            }
        });
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// Cuts the stroke at the planes of crossings(), and appends the pieces to `out`.
void cut(const Stroke& stroke, Spot direction, double origin, double cell, std::vector<Stroke>& out) {
    constexpr double min_part = 1e-6;  // fraction of an element
    out.push_back({stroke.from, {}});
    Spot at = stroke.from;
    for (const Element& e : stroke.elements) {
        double done = 0;
        const Spot begin = at;
        for (const double part : crossings(begin, e, direction, origin, cell)) {
            if (part - done < min_part || 1 - part < min_part) continue;
            Spot to = between(begin, e.to, part);
            if (e.sweep != 0) {
                const SinCos t = sin_cos(e.sweep * part);
                const double dx = begin.x - e.centre.x, dy = begin.y - e.centre.y;
                to = {e.centre.x + t.cos * dx - t.sin * dy, e.centre.y + t.sin * dx + t.cos * dy};
            }
            out.back().elements.push_back({to, e.centre, e.sweep * (part - done)});
            out.push_back({to, {}});
            done = part;
        }
        out.back().elements.push_back({e.to, e.centre, e.sweep * (1 - done)});
        at = e.to;
    }
}

/// Returns the belt distances between which the whole stroke is in the field; low > high: there are none.
Reach ways_of(const Stroke& stroke, const Box& field, Spot movement) {
    Reach out{-infinite, infinite};
    const auto axis = [&](double p, double v, double low, double high) {
        if (v == 0) {
            if (p < low || p > high) out = {infinite, -infinite};
            return;
        }
        const double a = (low - p) / v, b = (high - p) / v;
        out.low = std::max(out.low, std::min(a, b)), out.high = std::min(out.high, std::max(a, b));
    };
    each_point(stroke, [&](Spot p) {
        axis(p.x, movement.x, field.low.x, field.high.x);
        axis(p.y, movement.y, field.low.y, field.high.y);
    });
    return out;
}

struct Piece {
    Stroke stroke;
    Reach ways;
};

Result<void> check(const Piece& piece, const Box& field) {
    const Spot p = piece.stroke.from;
    if (!(piece.ways.low <= piece.ways.high))
        return fail(ErrorKind::refused,
                    fmt::format("The stroke at {:.3f}, {:.3f} mm is never inside the field, which goes from {:.3f}, "
                                "{:.3f} to {:.3f}, {:.3f} mm without its margin. Nothing was marked; make the drawing "
                                "smaller across the movement or move it.",
                                p.x, p.y, field.low.x, field.low.y, field.high.x, field.high.y));
    if (piece.ways.high < 0)
        return fail(ErrorKind::refused,
                    fmt::format("The stroke at {:.3f}, {:.3f} mm has left the field by {:.3f} mm before the job "
                                "begins. Nothing was marked; move the drawing by that distance against the movement "
                                "(x_mm, y_mm), or take a longer track delay.",
                                p.x, p.y, -piece.ways.high));
    return {};
}

}  // namespace

Result<std::vector<WaitBatch>> batches_of(const Drawing& drawing, const Box& field, Spot movement) {
    const Spot size{field.high.x - field.low.x, field.high.y - field.low.y};
    const double along = std::min(movement.x != 0 ? size.x / std::fabs(movement.x) : infinite,
                                  movement.y != 0 ? size.y / std::fabs(movement.y) : infinite);
    const double cell = along / pieces_in_field;
    Reach all;
    for (const Stroke& stroke : drawing.strokes) each_point(stroke, [&](Spot p) { all.take(dot(p, movement)); });
    std::vector<Stroke> strokes;
    for (const Stroke& stroke : drawing.strokes) {
        const Reach reach = reach_of(stroke, movement);
        if (reach.high - reach.low > cell)
            cut(stroke, movement, all.high, cell, strokes);
        else
            strokes.push_back(stroke);
        if (strokes.size() > max_elements)
            return fail(ErrorKind::refused,
                        fmt::format("The drawing needs more than {} pieces to come into the field. Nothing was marked.",
                                    max_elements));
    }
    std::vector<Piece> pieces;
    for (Stroke& stroke : strokes) {
        Piece piece{std::move(stroke), {}};
        piece.ways = ways_of(piece.stroke, field, movement);
        MOTIONRACK_CHECK(check(piece, field));
        pieces.push_back(std::move(piece));
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Piece& a, const Piece& b) { return a.ways.low < b.ways.low; });
    std::vector<WaitBatch> out;
    double begin = -infinite;
    for (Piece& piece : pieces) {
        const double at = std::max(piece.ways.low, 0.0);
        if (out.empty() || at > begin + along / batches_in_field) out.push_back({at, piece.ways.high, {}}), begin = at;
        WaitBatch& batch = out.back();
        batch.at_mm = std::max(batch.at_mm, at);
        batch.until_mm = std::min(batch.until_mm, piece.ways.high);
        batch.strokes.push_back(std::move(piece.stroke));
    }
    return out;
}

}  // namespace motionrack::mark
