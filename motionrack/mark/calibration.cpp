// Computes calibrations from marks and readings, with first-order propagation of independent errors.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/calibration.hpp>

namespace motionrack::mark {

namespace {

double root_of_squares(double a, double b) {
    return std::sqrt(a * a + b * b);
}
tl::unexpected<Error> refused(const std::string& sentence) {
    return fail(ErrorKind::refused, sentence);
}
bool good(std::initializer_list<double> numbers) {
    for (const double n : numbers)
        if (!(std::fabs(n) <= 1e12)) return false;
    return true;
}
constexpr const char* no_numbers = "A number is infinite, above 1e12 or missing. Give finite numbers.";

/// Centre x and y and radius, mm; encoder counts per turn of the table.
using Circle = std::array<double, 4>;

/// Returns the angle at `centre` from `from` to `to`, -pi to pi, counter-clockwise positive.
double angle_between(sim::Spot centre, sim::Spot from, sim::Spot to) {
    const double ax = from.x - centre.x, ay = from.y - centre.y, bx = to.x - centre.x, by = to.y - centre.y;
    return atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/// Computes the circle through three marks, and in `unlike` the relative difference of the counts per turn between both
/// steps. Returns false if the marks are collinear or coincide.
bool circle_of(const std::array<RotaryMark, 3>& m, Circle& out, double& unlike) {
    const double bx = m[1].at.x - m[0].at.x, by = m[1].at.y - m[0].at.y, cx = m[2].at.x - m[0].at.x,
                 cy = m[2].at.y - m[0].at.y;
    const double twice = 2 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    if (!(std::fabs(twice) > 1e-12 * (b2 + c2))) return false;
    const double ux = (cy * b2 - by * c2) / twice, uy = (bx * c2 - cx * b2) / twice;
    const sim::Spot centre{m[0].at.x + ux, m[0].at.y + uy};
    const double first = angle_between(centre, m[0].at, m[1].at), second = angle_between(centre, m[1].at, m[2].at);
    if (first == 0 || second == 0 || first + second == 0) return false;
    // The table turns the part away under the fixed laser spot, so the marks run in the opposite direction on the part.
    const double turns1 = -first / (2 * pi), turns2 = -second / (2 * pi);
    const double by_both = (m[2].count - m[0].count) / (turns1 + turns2);
    unlike = std::fabs((m[1].count - m[0].count) / turns1 - (m[2].count - m[1].count) / turns2) / std::fabs(by_both);
    out = {centre.x, centre.y, std::sqrt(ux * ux + uy * uy), by_both};
    return true;
}

}  // namespace

Result<ScaleResult> calibrate_scale(const ScaleData& d) {
    if (!good({d.reading1, d.reading2, d.distance_mm, d.bits_per_mm, d.reading_uncertainty, d.distance_uncertainty_mm}))
        return refused(no_numbers);
    const double counts = d.reading2 - d.reading1;
    if (counts == 0)
        return refused(
            fmt::format("Both readings are {:g}: the source did not move. Move the part between them.", d.reading1));
    if (d.distance_mm == 0 || !(d.bits_per_mm > 0) || d.reading_uncertainty < 0 || d.distance_uncertainty_mm < 0)
        return refused(
            fmt::format("The distance is {:g} mm and the field {:g} bits/mm; neither may be 0, and uncertainties must "
                        "not be negative.",
                        d.distance_mm, d.bits_per_mm));
    const double part =
        root_of_squares(std::sqrt(2.0) * d.reading_uncertainty / counts, d.distance_uncertainty_mm / d.distance_mm);
    ScaleResult out;
    out.per_mm.value = counts / d.distance_mm;
    out.per_mm.uncertainty = std::fabs(out.per_mm.value) * part;
    out.scale.value = d.bits_per_mm / out.per_mm.value;
    out.scale.uncertainty = std::fabs(out.scale.value) * part;
    return out;
}

Result<RotaryResult> calibrate_rotary(const std::array<RotaryMark, 3>& marks, double place_uncertainty_mm,
                                      double count_uncertainty) {
    for (const RotaryMark& m : marks)
        if (!good({m.at.x, m.at.y, m.count})) return refused(no_numbers);
    if (!good({place_uncertainty_mm, count_uncertainty}) || place_uncertainty_mm < 0 || count_uncertainty < 0)
        return refused("An uncertainty must be 0 or above.");
    if (marks[0].count == marks[1].count || marks[1].count == marks[2].count ||
        (marks[1].count > marks[0].count) != (marks[2].count > marks[1].count))
        return refused("The counts of the three marks must rise, or fall, from mark to mark.");
    Circle middle{};
    RotaryResult out;
    if (!circle_of(marks, middle, out.unlike))
        return refused(
            "The three marks are collinear or identical, so they have no centre. Turn the table further "
            "between them.");
    const double first = angle_between({middle[0], middle[1]}, marks[0].at, marks[1].at),
                 second = angle_between({middle[0], middle[1]}, marks[1].at, marks[2].at);
    if ((first > 0) != (second > 0))
        return refused(
            "The marks do not turn in one direction. Turn the table by less than half a revolution between them.");
    // Adds the contribution of each input: the numerical derivative of the result with respect to it, times its
    // uncertainty.
    std::array<double, 4> squares{};
    const auto tried = [&](const std::array<RotaryMark, 3>& changed, double times) {
        Circle c{};
        double ignored = 0;
        if (!circle_of(changed, c, ignored)) return;
        for (std::size_t i = 0; i < 4; ++i) squares[i] += (c[i] - middle[i]) * (c[i] - middle[i]) * times * times;
    };
    const double step = 1e-6 * middle[2];
    for (std::size_t i = 0; i < 3; ++i) {
        auto x = marks, y = marks, n = marks;
        x[i].at.x += step, y[i].at.y += step, n[i].count += 1;
        tried(x, place_uncertainty_mm / step);
        tried(y, place_uncertainty_mm / step);
        tried(n, count_uncertainty);
    }
    Measured* const results[] = {&out.centre_x, &out.centre_y, &out.radius_mm, &out.counts_per_turn};
    for (std::size_t i = 0; i < 4; ++i) *results[i] = {middle[i], std::sqrt(squares[i])};
    return out;
}

Result<LagResult> calibrate_lag(const LagData& d) {
    if (!good({d.velocity_mm_s[0], d.velocity_mm_s[1], d.shift_mm[0], d.shift_mm[1], d.shift_uncertainty_mm}) ||
        d.shift_uncertainty_mm < 0)
        return refused(no_numbers);
    const double velocities = d.velocity_mm_s[1] - d.velocity_mm_s[0];
    if (velocities == 0)
        return refused(
            fmt::format("Both crosses were marked at {:g} mm/s. Mark one at another velocity.", d.velocity_mm_s[0]));
    LagResult out;
    out.lag_us = {(d.shift_mm[1] - d.shift_mm[0]) / velocities * 1e6,
                  std::sqrt(2.0) * d.shift_uncertainty_mm / std::fabs(velocities) * 1e6};
    if (out.lag_us.value < -std::fmax(5.0, 3 * out.lag_us.uncertainty) || out.lag_us.value > 655'350)
        return refused(
            fmt::format("The lag would be {:.1f} us; the card compensates 0 to 655350. Is the sign of the shifts "
                        "right? Positive is against the movement.",
                        out.lag_us.value));
    out.tracking_error = static_cast<int>(std::floor(std::fmax(out.lag_us.value, 0) / 10 + 0.5));
    out.fixed_shift_mm = d.shift_mm[0] - out.lag_us.value * 1e-6 * d.velocity_mm_s[0];
    return out;
}

}  // namespace motionrack::mark
