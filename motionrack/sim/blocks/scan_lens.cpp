// Optics of two mirrors and an f-theta lens, forward and inverse.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>

namespace motionrack::sim {

namespace {

constexpr double full_bits = 524288;

double height(const ScanLens& lens, double theta) {
    return theta * (lens.f_mm[0] + theta * (lens.f_mm[1] + theta * (lens.f_mm[2] + theta * lens.f_mm[3])));
}
double slope(const ScanLens& lens, double theta) {
    return lens.f_mm[0] + theta * (2 * lens.f_mm[1] + theta * (3 * lens.f_mm[2] + theta * 4 * lens.f_mm[3]));
}
/// Optical radians per bit.
double radians_per_bit(const ScanLens& lens) {
    return 2 * (lens.calibration_deg / 0.96) * (pi / 180) / full_bits;
}

}  // namespace

Result<void> check(const ScanLens& lens) {
    const auto ranged = [](double v, double min, double max) { return v >= min && v <= max; };
    if (!ranged(lens.f_mm[0], 1, 10'000))
        return fail(ErrorKind::refused, fmt::format("f1 of the lens is {} mm; it must be 1 to 10000 mm", lens.f_mm[0]));
    if (!ranged(lens.calibration_deg, 1, 22))
        return fail(ErrorKind::refused, fmt::format("the angle calibration is {} degrees; it must be 1 to 22 degrees",
                                                    lens.calibration_deg));
    if (!ranged(lens.bits_per_mm, 1, 1e6))
        return fail(ErrorKind::refused,
                    fmt::format("the lens has {} bits/mm; it must be 1 to 1000000", lens.bits_per_mm));
    const double corner = 1.5 * radians_per_bit(lens) * full_bits;
    for (int i = 0; i <= 64; ++i) {
        const double theta = corner * i / 64;
        if (!(slope(lens, theta) > 0))
            return fail(ErrorKind::refused,
                        fmt::format("a lens whose image height does not grow at {:.3f} rad: its "
                                    "coefficients f1 .. f4 ({}, {}, {}, {} mm) are not those of an f-theta lens",
                                    theta, lens.f_mm[0], lens.f_mm[1], lens.f_mm[2], lens.f_mm[3]));
    }
    return {};
}

Spot spot_of(const ScanLens& lens, Spot bits) {
    const double radians = radians_per_bit(lens);
    const SinCos x = sin_cos(radians * bits.x), y = sin_cos(radians * bits.y);
    const double tx = x.sin / x.cos, ty = y.sin / y.cos / x.cos;
    const double r = std::sqrt(tx * tx + ty * ty);
    if (!(r > 0)) return {};
    const double h = height(lens, atan2(r, 1));
    return {h * (tx / r), h * (ty / r)};
}

Spot bits_for(const ScanLens& lens, Spot mm) {
    const double h = std::sqrt(mm.x * mm.x + mm.y * mm.y);
    if (!(h > 0)) return {};
    double theta = h / lens.f_mm[0];
    for (int i = 0; i < 40; ++i) {
        const double s = slope(lens, theta);
        const double step = (height(lens, theta) - h) / (s > 1e-3 ? s : 1e-3);
        theta -= step;
        if (theta > 1.5) theta = 1.5;
        if (!(std::abs(step) > 1e-16)) break;
    }
    const SinCos t = sin_cos(theta);
    const double r = t.sin / t.cos, tx = r * (mm.x / h), ty = r * (mm.y / h);
    const double ax = atan2(tx, 1), ay = atan2(ty * sin_cos(ax).cos, 1), radians = radians_per_bit(lens);
    return {ax / radians, ay / radians};
}

}  // namespace motionrack::sim
