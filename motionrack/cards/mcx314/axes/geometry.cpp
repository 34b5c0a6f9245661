// Rounding to pulses, and the search for the whole centre with which the chip's arc ends where it should.
#include <motionrack/cards/mcx314/axes/geometry.hpp>

#include <cmath>
#include <motionrack/cards/mcx314/arithmetic.hpp>

namespace motionrack::mcx314 {

Pulses4 AxisMap::pulses(const control::Point& position) const {
    Pulses4 out = {};
    for (std::size_t i = 0; i < channel.size(); ++i)
        if (channel[i] >= 0)
            out[static_cast<std::size_t>(channel[i])] =
                static_cast<std::int64_t>(std::floor(position[i] * limits[i].pulses_per_unit + 0.5));
    return out;
}

namespace {

double length(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

std::optional<ChipArc> fit_arc(const ArcRequest& wanted) {
    const std::array<std::int64_t, 2> finish = {wanted.end[0] - wanted.start[0], wanted.end[1] - wanted.start[1]};
    const std::array<double, 2> ideal = {wanted.centre[0] - static_cast<double>(wanted.start[0]),
                                         wanted.centre[1] - static_cast<double>(wanted.start[1])};
    std::optional<ChipArc> best;
    bool best_exact = false;
    for (int dx = -2; dx <= 3; ++dx) {
        for (int dy = -2; dy <= 3; ++dy) {
            const std::int64_t cx = static_cast<std::int64_t>(std::floor(ideal[0])) + dx;
            const std::int64_t cy = static_cast<std::int64_t>(std::floor(ideal[1])) + dy;
            const rules::ArcEnd end = rules::end_of_arc(cx, cy, finish[0], finish[1], wanted.clockwise);
            const double own_radius = length(static_cast<double>(cx), static_cast<double>(cy));
            const double off = length(static_cast<double>(cx) - ideal[0], static_cast<double>(cy) - ideal[1]) +
                               std::fabs(own_radius - wanted.radius);
            // One basic pulse is 1 .. 1.414 pulses of path: an arc that is longer than that went round once too often.
            if (static_cast<double>(end.basic_pulses) > wanted.length * 1.02 + 8) continue;
            const bool exact = end.first == finish[0] && end.second == finish[1];
            if (best && (best_exact > exact || (best_exact == exact && best->deviation_pulses <= off))) continue;
            best = ChipArc{{static_cast<std::int32_t>(cx), static_cast<std::int32_t>(cy)},
                           {static_cast<std::int32_t>(finish[0]), static_cast<std::int32_t>(finish[1])},
                           {static_cast<std::int32_t>(end.first), static_cast<std::int32_t>(end.second)},
                           end.basic_pulses,
                           off};
            best_exact = exact;
        }
    }
    return best;
}

}  // namespace motionrack::mcx314
