// Computes the ellipse about the path.
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/wobbel_motion.hpp>

namespace motionrack::rtc5 {

void WobbelMotion::set(const Command& c) {
    Wobbel& w = wobbel_;
    w.transversal = c.p[0], w.longitudinal = c.p[1], w.turns = c.p[2] / 100'000;
    w.step = 0;
    w.direction = {1, 0};
}

void WobbelMotion::add(double* x, double* y, std::size_t n, std::int64_t first) {
    Wobbel& w = wobbel_;
    w.offset = {};
    if (!active()) return;
    const Activity& a = activity_;
    const auto along = [&](Point d) {
        const double length = std::sqrt(d.x * d.x + d.y * d.y);
        w.direction = length > 0 ? Point{d.x / length, d.y / length} : Point{1, 0};
    };
    if (a.kind == ActivityKind::line) along(a.direction);
    for (std::size_t i = 0; i < n; ++i) {
        if (a.kind == ActivityKind::arc) {
            const Point radius = a.position(first + static_cast<std::int64_t>(i), {}) - a.to;
            along(a.step.x < 0 ? Point{radius.y, -radius.x} : Point{-radius.y, radius.x});
        }
        const double turns = static_cast<double>(++w.step) * w.turns;
        const SinCos t = sin_cos(2 * pi * (turns - std::floor(turns)));
        const double ahead = w.longitudinal * t.cos, aside = w.transversal * t.sin;
        w.offset = {ahead * w.direction.x - aside * w.direction.y, ahead * w.direction.y + aside * w.direction.x};
        x[i] += w.offset.x;
        y[i] += w.offset.y;
    }
}

}  // namespace motionrack::rtc5
