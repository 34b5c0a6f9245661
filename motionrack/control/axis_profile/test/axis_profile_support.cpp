#include <algorithm>
#include <bit>
#include <cstdio>
#include <limits>
#include <motionrack/base/fnv.hpp>
#include <motionrack/control/axis_profile/test/axis_profile_support.hpp>

namespace motionrack::control::travel_test {

std::string text_of(const Task& t) {
    char text[400];
    std::snprintf(text, sizeof text, "{{%.17g, %.17g, %.17g}, {%.17g, %.17g, %.17g}, {%.17g, %.17g, %.17g}}",
                  t.from.position, t.from.velocity, t.from.accel, t.to.position, t.to.velocity, t.to.accel,
                  t.limits.velocity, t.limits.accel, t.limits.jerk);
    return text;
}

/// Returns a number of either sign: a power of two times 1 .. 2, so that no logarithm is needed.
double Tasks::of_magnitude(double min, double max) {
    const int low = std::ilogb(min), high = std::ilogb(max);
    const int power = low + static_cast<int>(random_() % static_cast<unsigned>(std::max(1, high - low)));
    const double side = one_in(2) ? 1 : -1;
    return std::ldexp(side * between(1, 2), power);
}

void Tasks::allow(Task& task) {
    const double a = task.to.accel;
    const double room = task.limits.velocity - 0.5 * a * a / task.limits.jerk;
    if (!(room >= 0)) {
        task.to.accel = 0;
    } else {
        task.to.velocity = std::clamp(task.to.velocity, -room, room);
    }
}

Task Tasks::usual() {
    Task t;
    t.limits = {between(0.2, 3), between(0.2, 3), between(0.2, 3)};
    const auto some = [&](double max) {
        return one_in(8) ? 0 : one_in(12) ? (one_in(2) ? max : -max) : between(-max, max);
    };
    const double quick = t.limits.velocity, a_start = std::min(t.limits.accel, std::sqrt(2 * quick * t.limits.jerk));
    t.from = {0, some(quick), some(a_start)};
    // a start that can stay within the limits
    const double room = quick - 0.5 * t.from.accel * t.from.accel / t.limits.jerk;
    if (t.from.velocity * t.from.accel > 0 && room >= 0) t.from.velocity = std::clamp(t.from.velocity, -room, room);
    if (room < 0) t.from.accel = 0;
    t.to = {one_in(3) ? between(-1, 1) * 0.3 : of_magnitude(1e-3, 32), some(quick), some(t.limits.accel)};
    if (one_in(30)) t.to = t.from;
    if (one_in(50)) t.to.position = 0;
    allow(t);
    return t;
}

Task Tasks::any() {
    Task t = usual();
    t.limits = {std::fabs(of_magnitude(1e-3, 1e3)), std::fabs(of_magnitude(1e-3, 1e3)),
                std::fabs(of_magnitude(1e-3, 1e3))};
    const auto within = [&](KinematicState& s) {
        const double part_of_accel = one_in(3) ? of_magnitude(1e-6, 1) : between(-1, 1);
        const double part_of_velocity = one_in(3) ? of_magnitude(1e-6, 1) : between(-1, 1);
        s.accel = one_in(4) ? 0 : t.limits.accel * part_of_accel;
        s.velocity = one_in(4) ? 0 : t.limits.velocity * part_of_velocity;
        const double room = t.limits.velocity - 0.5 * s.accel * s.accel / t.limits.jerk;
        if (room < 0)
            s.accel = 0;
        else
            s.velocity = std::clamp(s.velocity, -room, room);
    };
    within(t.from);
    within(t.to);
    t.to.position = one_in(40) ? 0 : of_magnitude(1e-9, 1e6);
    allow(t);
    return t;
}

Task Tasks::outside() {
    Task t = one_in(3) ? any() : usual();
    if (one_in(2)) t.from.velocity = t.limits.velocity * between(-4, 4);
    if (!one_in(3)) t.from.accel = t.limits.accel * between(-3, 3);
    return t;
}

std::optional<double> Tasks::motion(Task& t) {
    t = usual();
    // slightly within the limits: rounding may make a state exactly at its limits unreachable
    t.from.accel *= 0.999;
    t.from.velocity *= 0.999;
    const KinematicLimits m = {0.999 * t.limits.velocity, 0.999 * t.limits.accel, t.limits.jerk};
    KinematicState s = t.from;
    double seconds = 0;
    const int phases = 1 + static_cast<int>(random_() % 5);
    double side = one_in(2) ? 1 : -1;
    for (int k = 0; k < phases; ++k, side = -side) {
        double jerk = side * m.jerk * (one_in(4) ? part() : 0.999);
        double dt = between(0, 2) * std::min(m.accel / m.jerk, std::sqrt(m.velocity / m.jerk));
        // up to the acceleration limit; then, in one case of three, constant acceleration for a while
        const double until = (side * m.accel - s.accel) / jerk;
        if (dt > until) dt = until;
        for (int part_of = 0; part_of < 2; ++part_of) {
            if (part_of == 1) {
                if (!one_in(3)) break;
                jerk = 0;
                dt = between(0, 1) * m.velocity / m.accel;
            }
            for (int i = 1; i <= 8; ++i) {
                const double u = dt * i / 8, v = s.velocity + u * (s.accel + 0.5 * u * jerk), a = s.accel + u * jerk;
                if (std::fabs(v) + 0.5 * a * a / m.jerk > m.velocity) return std::nullopt;
            }
            s = {s.position + dt * (s.velocity + dt * (0.5 * s.accel + dt * jerk / 6)),
                 s.velocity + dt * (s.accel + 0.5 * dt * jerk), s.accel + dt * jerk};
            seconds += dt;
        }
    }
    t.to = s;
    return seconds;
}

std::string fault_of(const AxisProfile& travel, const Task& task, double within) {
    const KinematicLimits& m = task.limits;
    const double T = travel.duration();
    if (!(T >= 0 && std::isfinite(T))) return "duration";
    const ProfileSample first = travel.sample(0), last = travel.sample(T);
    if (first.position != task.from.position || first.velocity != task.from.velocity || first.accel != task.from.accel)
        return "start";
    if (last.position != task.to.position || last.velocity != task.to.velocity || last.accel != task.to.accel)
        return "end";
    double begin = 0;
    KinematicState at = task.from;
    const double a_size = std::max({m.accel, std::fabs(task.from.accel)});
    const double v_size =
        std::max({m.velocity, std::fabs(task.from.velocity), a_size * a_size / m.jerk * (a_size > m.accel)});
    // the distance due to the accelerations at both ends has rounding errors, even in a short profile
    const double a_ends = std::fabs(task.from.accel) + std::fabs(task.to.accel);
    const double ends =
        (std::fabs(task.from.velocity) + std::fabs(task.to.velocity) + a_ends * a_ends / m.jerk) * a_ends / m.jerk;
    const double p_size =
        std::max({std::fabs(task.from.position), std::fabs(task.to.position), v_size * T, 0.01 * ends});
    const auto jump = [&](double position, double velocity, double accel) {
        const double instant = 1e-15 * T;  // resolution of times
        if (!(std::fabs(position - at.position) <= 1e-12 * p_size + instant * v_size)) return "jump of the position";
        if (!(std::fabs(velocity - at.velocity) <= 1e-12 * v_size + instant * a_size)) return "jump of the velocity";
        if (!(std::fabs(accel - at.accel) <= 1e-12 * a_size + instant * m.jerk)) return "jump of the acceleration";
        return "";
    };
    for (const AxisProfile::CubicPhase& p : travel.phases()) {
        if (!(p.end > begin)) return "order of phases";
        if (p.jerk != 0 && std::fabs(p.jerk) != m.jerk) return "jerk";
        for (int i = 0; i <= 8; ++i) {
            const double t = begin + (p.end - begin) * i / 8;
            const auto [position, velocity, accel, jerk] = p.at(t);
            if (i == 0)
                if (const std::string fault = jump(position, velocity, accel); !fault.empty()) return fault;
            if (t >= within) {
                if (!(std::fabs(accel) <= m.accel * (1 + 1e-9))) return "acceleration";
                if (!(std::fabs(velocity) <= m.velocity * (1 + 1e-9))) return "velocity";
                // the velocity has its peak where the acceleration passes through 0
                if (i > 0 && p.jerk != 0) {
                    const double zero = -p.accel / p.jerk + p.zero;
                    const double peak = p.velocity - 0.5 * p.accel * p.accel / p.jerk;
                    if (zero > begin && zero < p.end && zero > within && !(std::fabs(peak) <= m.velocity * (1 + 1e-9)))
                        return "peak velocity";
                }
            }
            at = {position, velocity, accel};
        }
        begin = p.end;
    }
    if (begin != T) return "duration is not the last end";
    return jump(task.to.position, task.to.velocity, task.to.accel);
}

double entry_of(const AxisProfile& travel, const KinematicLimits& limits) {
    const auto outside = [&](const ProfileSample& s) {
        return std::fabs(s.accel) > limits.accel * (1 + 1e-9) || std::fabs(s.velocity) > limits.velocity * (1 + 1e-9);
    };
    double entry = 0, begin = 0;
    for (const AxisProfile::CubicPhase& p : travel.phases()) {
        const double length = p.end - begin;
        for (int i = 0; i < 64; ++i) {
            double out = begin + length * i / 64, in = begin + length * (i + 1) / 64;
            if (!outside(p.at(out))) continue;
            for (int step = 0; step < 60 && !outside(p.at(in)); ++step) {
                const double middle = 0.5 * (out + in);
                (outside(p.at(middle)) ? out : in) = middle;
            }
            entry = in;
        }
        // a peak between two samples
        const double peak = p.jerk != 0 ? p.zero - p.accel / p.jerk : begin;
        if (peak > std::max(begin, entry) && peak < p.end && outside(p.at(peak))) {
            double out = peak, in = p.end;
            for (int step = 0; step < 60 && !outside(p.at(p.end)); ++step) {
                const double middle = 0.5 * (out + in);
                (outside(p.at(middle)) ? out : in) = middle;
            }
            entry = in;
        }
        begin = p.end;
    }
    return entry;
}

std::uint64_t bits_of_travels(std::uint64_t seed, int count) {
    Tasks tasks(seed);
    std::uint64_t sum = fnv_start;
    const auto fold = [&sum](double x) { sum = fnv_step(sum, std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x)); };
    for (int i = 0; i < count; ++i) {
        const Task t = i % 3 == 0 ? tasks.outside() : i % 3 == 1 ? tasks.any() : tasks.usual();
        const auto one = time_optimal_profile(t.from, t.to, t.limits);
        const auto two = velocity_change_profile(t.from, t.to.velocity, t.to.accel, t.limits);
        for (const auto* out : {&one, &two}) {
            if (!*out) continue;
            for (const AxisProfile::CubicPhase& p : (*out)->phases())
                for (const double x : {p.end, p.zero, p.seconds, p.position, p.velocity, p.accel, p.jerk}) fold(x);
            fold((*out)->sample(0.3 * (*out)->duration()).position);
        }
    }
    return sum;
}

}  // namespace motionrack::control::travel_test
