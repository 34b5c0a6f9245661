// The chip's integer arithmetic (RULES.md), shared by the virtual chip, the function library and the planner: limits of
// the parameters, points of lines and arcs after any number of basic pulses, and the actual end of an arc.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace motionrack::mcx314::rules {

inline constexpr std::int64_t sclk_hz = 8'000'000;
inline constexpr std::int64_t tick_100ps = 1'250;     ///< 125 ns
inline constexpr std::int64_t speed_carry = 64'000;   ///< va at which the speed changes by one step
inline constexpr std::int64_t jerk_ticks_per_k = 16;  ///< SCLK per step of the acceleration, times K
/// Register units in pulses and seconds: V = 1 is M = clock_hz / R pulses/s, A = 1 is rate_unit * M pulses/s2, the jerk
/// is jerk_unit * M / K pulses/s3. V, SV, A and D go up to max_units.
inline constexpr double clock_hz = static_cast<double>(sclk_hz), rate_unit = 125, jerk_unit = 62.5e6;
inline constexpr std::int64_t max_units = 8'000;
inline constexpr int start_ticks = 2;  ///< ticks between a drive command and the generator's first tick

/// Returns a parameter limited to its documented range, as the generator uses it.
constexpr std::int64_t used_range(std::int64_t r) {
    return std::clamp<std::int64_t>(r, 16'000, 16'777'215);
}
constexpr std::int64_t used_speed(std::int64_t v) {
    return std::clamp<std::int64_t>(v, 1, max_units);
}
constexpr std::int64_t used_jerk(std::int64_t k) {
    return std::clamp<std::int64_t>(k, 1, 65'535);
}

/// Converts a register to the signed value of its low 24 bits; for finish points and centres.
constexpr std::int64_t signed24(std::uint32_t v) {
    return static_cast<std::int64_t>((v & 0xFF'FFFFu) ^ 0x80'0000u) - 0x80'0000;
}

/// Converts a register to its signed 32-bit value, limited to +-2,147,483,646, as on the MCX314As.
constexpr std::int64_t limited32(std::uint32_t v) {
    return std::clamp<std::int64_t>(static_cast<std::int32_t>(v), -2'147'483'646, 2'147'483'646);
}

constexpr std::int64_t magnitude(std::int64_t x) {
    return x < 0 ? -x : x;
}
constexpr std::int64_t ceil_div(std::int64_t a, std::int64_t b) {
    return (a + b - 1) / b;
}  // a >= 0, b > 0

/// Returns the largest s with s * s <= v; 0 <= v < 2^63 - 2^33.
inline std::int64_t isqrt(std::int64_t v) {
    auto s = static_cast<std::int64_t>(std::sqrt(static_cast<double>(v)));
    while (s * s > v) --s;
    while ((s + 1) * (s + 1) <= v) ++s;
    return s;
}

/// Returns the integer nearest to sqrt(q); 0 for q <= 0.
inline std::int64_t near(std::int64_t q) {
    if (q <= 0) return 0;
    const std::int64_t m = isqrt(q);
    return q - m * m > m ? m + 1 : m;  // beyond (m + 1/2)^2
}

// ---- lines

/// Returns the pulses of an axis with finish point `p` (>= 0) after `n` basic pulses of a line whose longest axis has
/// `max_p` (> 0); n * p is below 2^63 for all values that the chip accepts.
constexpr std::int64_t line_steps(std::int64_t n, std::int64_t p, std::int64_t max_p) {
    const std::int64_t done = n * p / max_p, rest = n * p - done * max_p;
    return 2 * rest >= max_p ? done + 1 : done;
}

/// Returns the basic pulse at which an axis of a line makes its pulse number `steps` (1 .. p); `p`, `max_p`: as in
/// line_steps().
constexpr std::int64_t line_pulse_of_step(std::int64_t steps, std::int64_t p, std::int64_t max_p) {
    const auto way = static_cast<std::uint64_t>(2 * steps - 1) * static_cast<std::uint64_t>(max_p);
    const auto twice = static_cast<std::uint64_t>(2 * p);
    return static_cast<std::int64_t>((way + twice - 1) / twice);
}

// ---- arcs

/// Octant of a circle: the coordinate (0: x, 1: y) that steps at every basic pulse, its direction, and the sign of the
/// other coordinate.
struct Octant {
    int short_axis, short_step, long_side;
};
inline constexpr std::array<Octant, 8> octants{
    {{1, +1, +1}, {0, -1, +1}, {0, -1, +1}, {1, -1, -1}, {1, -1, -1}, {0, +1, -1}, {0, +1, -1}, {1, +1, +1}}};

constexpr int octant_of(std::int64_t x, std::int64_t y) {
    if (x == 0 && y == 0) return 0;
    if (y >= 0 && x > y) return 0;
    if (x > 0 && y >= x) return 1;
    if (y > 0 && x <= 0 && -x < y) return 2;
    if (y > 0 && -x >= y) return 3;
    if (x < 0 && y <= 0 && -y < -x) return 4;
    if (x < 0 && -y >= -x) return 5;
    if (y < 0 && x >= 0 && x < -y) return 6;
    return 7;
}

constexpr bool leaves_octant(int octant, std::int64_t x, std::int64_t y) {
    switch (octant) {
        case 0:
            return y >= x;
        case 1:
            return x <= 0;
        case 2:
            return -x >= y;
        case 3:
            return y <= 0;
        case 4:
            return -y >= -x;
        case 5:
            return x >= 0;
        case 6:
            return x >= -y;
        default:
            return y >= 0;
    }
}

/// Returns the direction, -1 or +1, of a coordinate (0: x, 1: y) on a counter-clockwise arc: x decreases in the upper
/// half, y in the left half.
constexpr int direction_in_octant(int octant, int coordinate) {
    if (coordinate == 0) return octant < 4 ? -1 : +1;
    return octant >= 2 && octant < 6 ? -1 : +1;
}

/// State of an arc; trivially copyable. Coordinates are relative to the centre. Clockwise arcs are stored mirrored
/// (second axis negated), so all arithmetic here is counter-clockwise.
struct Arc {
    std::array<std::int64_t, 2> at{};
    std::array<std::int64_t, 2> finish{};
    std::int64_t r2 = 0;
    std::int32_t octant = 0;
    std::int32_t finish_octant = 0;
    std::int32_t clockwise = 0;
    std::int32_t lap =
        0;  ///< 1: the start lies behind the finish point in the same octant, so the arc passes that octant first
    std::int32_t finished = 1;
    std::int32_t reserved = 0;  ///< avoids padding in a state that is compared by its bytes

    /// Begins an arc. Centre and finish point are relative to the start, each coordinate within +-2,147,483,646.
    void begin(std::int64_t cx, std::int64_t cy, std::int64_t fx, std::int64_t fy, bool cw) {
        clockwise = cw;
        const std::int64_t mirror = cw ? -1 : 1;
        at = {-cx, -cy * mirror};
        finish = {fx - cx, (fy - cy) * mirror};
        r2 = at[0] * at[0] + at[1] * at[1];
        octant = octant_of(at[0], at[1]);
        finish_octant = octant_of(finish[0], finish[1]);
        lap = octant == finish_octant && past_finish();
        finished = r2 == 0;
    }

    bool past_finish() const {
        const Octant& o = octants[static_cast<std::size_t>(octant)];
        const auto s = static_cast<std::size_t>(o.short_axis);
        return (at[s] - finish[s]) * o.short_step >= 0;
    }

    /// Returns the point after `pulses` more basic pulses, of which only the last may leave the octant.
    std::array<std::int64_t, 2> after(std::int64_t pulses) const {
        if (pulses == 0) return at;
        const Octant& o = octants[static_cast<std::size_t>(octant)];
        const auto s = static_cast<std::size_t>(o.short_axis), l = 1 - s;
        std::array<std::int64_t, 2> out = at;
        out[s] += pulses * o.short_step;
        out[l] = o.long_side * near(r2 - out[s] * out[s]);
        return out;
    }

    /// Executes one basic pulse; returns the step of each axis, -1, 0 or +1, in the chip's own (not mirrored)
    /// directions.
    std::array<int, 2> step() {
        const Octant& o = octants[static_cast<std::size_t>(octant)];
        const auto s = static_cast<std::size_t>(o.short_axis), l = 1 - s;
        std::array<int, 2> steps{};
        at[s] += o.short_step;
        steps[s] = o.short_step;
        const std::int64_t wanted = o.long_side * near(r2 - at[s] * at[s]);
        steps[l] = wanted > at[l] ? 1 : wanted < at[l] ? -1 : 0;
        at[l] += steps[l];
        finished = octant == finish_octant && !lap && past_finish();
        for (int i = 0; i < 4 && !finished && leaves_octant(octant, at[0], at[1]); ++i) {
            finished =
                octant == finish_octant && !lap;  // its octant has passed: the finish point lies beyond the circle
            if (finished) break;
            octant = (octant + 1) % 8;
            lap = 0;
            finished = octant == finish_octant && past_finish();
        }
        if (clockwise) steps[1] = -steps[1];
        return steps;
    }

    /// Returns the number of basic pulses (>= 1) until the octant is left.
    std::int64_t pulses_to_leave() const {
        const Octant& o = octants[static_cast<std::size_t>(octant)];
        const std::int64_t s = magnitude(at[static_cast<std::size_t>(o.short_axis)]);
        if (octant & 1) return std::max<std::int64_t>(1, s);
        std::int64_t next = std::max(s + 1, isqrt(r2 / 2) - 2);
        while (next < near(r2 - next * next)) ++next;
        return next - s;
    }

    /// Returns the number of basic pulses (>= 1) until the octant is left or the arc ends.
    std::int64_t pulses_to_event() const {
        std::int64_t pulses = pulses_to_leave();
        if (octant == finish_octant && !lap) {
            const Octant& o = octants[static_cast<std::size_t>(octant)];
            const auto s = static_cast<std::size_t>(o.short_axis);
            pulses = std::min(pulses, std::max<std::int64_t>(1, (finish[s] - at[s]) * o.short_step));
        }
        return pulses;
    }
};

/// Result of an arc command: basic pulses, and the end relative to the start.
struct ArcEnd {
    std::int64_t basic_pulses = 0;
    std::int64_t first = 0;
    std::int64_t second = 0;
};

inline ArcEnd end_of_arc(std::int64_t cx, std::int64_t cy, std::int64_t fx, std::int64_t fy, bool clockwise) {
    Arc arc;
    arc.begin(cx, cy, fx, fy, clockwise);
    ArcEnd end;
    while (!arc.finished) {
        const std::int64_t pulses = arc.pulses_to_event();
        arc.at = arc.after(pulses - 1);
        arc.step();
        end.basic_pulses += pulses;
    }
    end.first = arc.at[0] + cx;
    end.second = (clockwise ? -arc.at[1] : arc.at[1]) + cy;
    return end;
}

}  // namespace motionrack::mcx314::rules
