// Blend lengths: as long as the tolerance allows, and not longer than useful for the machine.

#include <algorithm>
#include <cmath>
#include <motionrack/control/path/corner_blends.hpp>
#include <motionrack/control/path/junction.hpp>

namespace motionrack::control {
namespace {

/// A corner that takes less than this share of acceleration and jerk at the maximum velocity needs no longer blend.
constexpr double unnoticed = 1.0 / 16;

/// Smaller changes count as zero.
constexpr double no_change = 1e-13;

/// Minimum of the blend length that the velocity, acceleration and jerk of the machine need, mm or degrees.
constexpr double narrowest_need = 0.05;

/// Lower bound on the factor by which a blend is shortened to reach from corner to corner. Then the allowed difference
/// of its two sides, relative to its length.
constexpr double min_snapped = 0.7;
constexpr double min_snapped_even = 0.45;
constexpr double snap_ratio = 0.01;

/// Largest share of the distance from a corner to the start or end of the curve that a blend covers.
constexpr double part_to_rest = 0.6;

/// Lengths with a smaller relative difference are equal.
constexpr double equal = 1e-10;

/// The deviation at distance d from a corner of size 1 and blend length L is (L - 2d)^3 / 12 L^2. Sum of these over
/// blends of the same length.
struct Sum {
    double a = 0, b = 0, c = 0, e = 0;
    double per_accel = 0, per_jerk = 0;

    void add(const CornerBlend& turn, double weight, double d) {
        a += weight;
        b += weight * 6 * d;
        c += weight * 12 * d * d;
        e += weight * 8 * d * d * d;
        per_accel += turn.per_accel;
        per_jerk += turn.per_jerk;
    }
    double at(double width) const { return (((a * width - b) * width + c) * width - e) / (12 * width * width); }
    double slope(double width) const {
        return (a * width * width * width - c * width + 2 * e) / (12 * width * width * width);
    }
    /// Returns the blend length at which the sum is `tolerance`, or slightly more: it is convex, and `width` exceeds
    /// it.
    double solve(double width, double tolerance) const {
        for (int i = 0; i < 3; ++i) width -= (at(width) - tolerance) / slope(width);
        return width;
    }
    double need(double velocity) const {
        const double by_accel = 2 * per_accel * velocity * velocity / unnoticed;
        const double by_jerk = std::sqrt(4 * per_jerk * velocity * velocity * velocity / unnoticed);
        return std::max({by_accel, by_jerk, narrowest_need});
    }
};

double weight_of(const CornerBlend& turn, const CornerBlend& corner) {
    return std::max(turn.linear, turn.rotary * corner.tolerance_per_rotary);
}

}  // namespace

CornerBlends::CornerBlends(const MachineLimits& limits) {
    for (int i = 0; i < axis_count; ++i) {
        per_accel_[i] = limits[i].max_accel > 0 ? 1 / limits[i].max_accel : 0;
        per_jerk_[i] = effective_jerk(limits[i]) > 0 ? 1 / effective_jerk(limits[i]) : 0;
    }
}

void CornerBlends::clear() {
    made_ = proposed_ = checked_ = settled_ = dropped_ = 0;
    complete_ = false;
}

CornerBlend& CornerBlends::add() {
    CornerBlend& out = turn(made_++);
    out = CornerBlend{};
    return out;
}

void CornerBlends::added() {
    CornerBlend& last = turn(made_ - 1);
    double square = 0;
    for (int i = 0; i < axis_count; ++i) {
        const double size = std::fabs(last.change[i]);
        if (i < 3)
            square += size * size;
        else
            last.rotary = std::max(last.rotary, size);
        last.per_accel = std::max(last.per_accel, size * per_accel_[i]);
        last.per_jerk = std::max(last.per_jerk, size * per_jerk_[i]);
    }
    last.linear = std::sqrt(square);
    advance();
}

void CornerBlends::complete(double u) {
    complete_ = true;
    end_ = u;
    advance();
}

void CornerBlends::advance() {
    const auto known = [this](std::int64_t done, std::int64_t upto) {
        return complete_ ? done < upto : done + reach < upto;
    };
    for (; known(proposed_, made_); ++proposed_)
        if (!turn(proposed_).fixed) turn(proposed_).blend_length = proposed_width(proposed_);
    for (; known(checked_, proposed_); ++checked_) turn(checked_).blend_scale = shrink_at(checked_);
    for (; known(settled_, checked_); ++settled_) settle(settled_);
}

double CornerBlends::proposed_width(std::int64_t k) const {
    const CornerBlend& own = (*this)[k];
    if (own.linear < no_change && own.rotary < no_change) return 0;
    const std::int64_t first = std::max<std::int64_t>(0, k - reach);
    const std::int64_t past = std::min(made_, k + reach + 1);
    // A blend near a standstill stays short: it uses jerk that the start or end of the path needs.
    const double left = (own.u - (*this)[first].u) * (first == 0 ? part_to_rest : 1);
    const double right = past == k + reach + 1 ? (*this)[past - 1].u - own.u : part_to_rest * (end_ - own.u);
    const double max_width = 2 * std::min(left, right);
    Sum sum;
    sum.add(own, weight_of(own, own), 0);
    double from = 0;
    std::int64_t before = k - 1, after = k + 1;
    for (;;) {
        const double d_before = before >= first ? own.u - (*this)[before].u : max_width;
        const double d_after = after < past ? (*this)[after].u - own.u : max_width;
        const double width = std::min(max_width, 2 * std::min(d_before, d_after));
        const double need = std::max(sum.need(own.velocity), from);
        const double widest = std::min(need, width);
        if (widest > 0 && sum.at(widest) >= own.tolerance) return sum.solve(widest, own.tolerance);
        if (need <= width) return need;
        if (width >= max_width) return max_width;
        const std::int64_t next = d_before < d_after ? before-- : after++;
        const CornerBlend& other = (*this)[next];
        if (!other.fixed) sum.add(other, weight_of(other, own), 0.5 * width);
        from = width;
    }
}

double CornerBlends::shrink_at(std::int64_t k) const {
    const CornerBlend& own = (*this)[k];
    struct Reaching {
        double weight, width, distance;
    };
    std::array<Reaching, 2 * reach + 1> all;
    std::size_t count = 0;
    const std::int64_t past = std::min(made_, k + reach + 1);
    for (std::int64_t j = std::max<std::int64_t>(0, k - reach); j < past; ++j) {
        const CornerBlend& other = (*this)[j];
        const double twice = 2 * std::fabs(other.u - own.u);
        if (!other.fixed && other.blend_length > twice)
            all[count++] = {weight_of(other, own), other.blend_length, twice};
    }
    const auto deviation = [&](double scale, double& slope) {
        double sum = 0;
        slope = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double width = all[i].width * scale;
            const double inside = width - all[i].distance;
            if (inside <= 0) continue;
            const double part = all[i].weight * inside * inside / (12 * width * width);
            sum += part * inside;
            slope += part * (width + 2 * all[i].distance) * all[i].width / width;
        }
        return sum;
    };
    double slope = 0, scale = 1;
    double sum = deviation(scale, slope);
    if (sum <= own.tolerance) return 1;
    for (int i = 0; i < 2; ++i) {
        scale -= (sum - own.tolerance) / slope;
        sum = deviation(scale, slope);
    }
    return scale * std::min(1.0, own.tolerance / sum);
}

/// Sets a blend length, or slightly less so that the blend reaches from corner to corner. With equally spaced corners
/// the blends then add up to a curvature without ripples, and knots coincide.
void CornerBlends::set_blend_length(std::int64_t k, double width) {
    CornerBlend& own = turn(k);
    own.blend_length = width;
    std::int64_t m = 0;
    const auto both = [this, k](std::int64_t n) { return (*this)[k + n].u - (*this)[k - n].u; };
    while (m < reach && k > m && k + m + 1 < made_ && both(m + 1) <= width * (1 + equal)) ++m;
    bool snapped = false;
    if (m > 0) {
        const double uneven = std::fabs((*this)[k + m].u + (*this)[k - m].u - 2 * own.u);
        snapped = both(m) > (uneven < snap_ratio * both(m) ? min_snapped_even : min_snapped) * width;
    }
    if (snapped) own.blend_length = both(m);
    own.begin = own.u - 0.5 * own.blend_length;
    own.peak = own.u;
    own.end = own.u + 0.5 * own.blend_length;
    if (snapped && std::fabs((*this)[k - m].u - own.begin) <= equal * width) {
        own.begin = (*this)[k - m].u;
        own.end = (*this)[k + m].u;
    }
}

void CornerBlends::settle(std::int64_t k) {
    CornerBlend& own = turn(k);
    if (!own.fixed) {
        double shrink = 1;
        const std::int64_t past = std::min(made_, k + reach + 1);
        for (std::int64_t j = std::max<std::int64_t>(0, k - reach); j < past; ++j) {
            const CornerBlend& other = (*this)[j];
            if (2 * std::fabs(other.u - own.u) < own.blend_length) shrink = std::min(shrink, other.blend_scale);
        }
        set_blend_length(k, own.blend_length * shrink);
    }
    if (own.peak > own.begin) own.rise = 1 / ((own.peak - own.begin) * (own.end - own.begin));
    if (own.end > own.peak) own.fall = 1 / ((own.end - own.peak) * (own.end - own.begin));
}

}  // namespace motionrack::control
