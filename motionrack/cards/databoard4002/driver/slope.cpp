// Steps of the ramps, and the traversal of a table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/databoard4002/driver/slope.hpp>

namespace motionrack::databoard4002 {

// ---- speed of a rate

double SpeedScale::speed(int rate) const {
    return analog ? counts_per_volt * 1e-6 * microvolts_of(rate, trim) : counts_per_pulse * hz_of(rate);
}

int SpeedScale::rate_for(double counts_s) const {
    int low = 0, high = max_rate + 1;  // speed(low) <= counts_s < speed(high)
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (speed(middle) <= counts_s ? low : high) = middle;
    }
    return low;
}

// ---- from requirements to table

namespace {

Result<void> sound(const SlopeDemand& d, const SpeedScale& scale) {
    const struct {
        const char* name;
        double value;
    } positive[] = {
        {"The top speed", d.top_speed}, {"The acceleration", d.acceleration}, {"The deceleration", d.deceleration}};
    for (const auto& each : positive)
        if (!(each.value > 0 && each.value < 1e12))
            return fail(
                ErrorKind::refused,
                fmt::format("{} is {}, but it must be greater than 0. No table was created.", each.name, each.value));
    if (!(d.load >= 0 && d.load < 1e6))
        return fail(ErrorKind::refused,
                    fmt::format("The load is {}; it must be 0 or more. No table was created.", d.load));
    if (!(d.lag_s >= 0 && d.lag_s < 1e6))
        return fail(ErrorKind::refused,
                    fmt::format("The lag is {} s; it must be 0 or more. No table was created.", d.lag_s));
    if (!(d.creep_speed >= 0 && d.creep_speed < d.top_speed))
        return fail(ErrorKind::refused,
                    fmt::format("The creep speed is {} counts/s, but it must be below the top speed, {} counts/s. No "
                                "table was created.",
                                d.creep_speed, d.top_speed));
    if (d.top_speed > scale.speed(max_rate))
        return fail(ErrorKind::refused,
                    fmt::format("The top speed is {} counts/s, but this machine reaches {} at the card's greatest "
                                "rate. No table was created.",
                                d.top_speed, scale.speed(max_rate)));
    return {};
}

/// Computes one half of the table, slowest interval first. Each interval lasts as long as its velocity step takes. A
/// motor with the time constant `lag` gets every step that much earlier.
Result<void> fill_half(SlopeTable& table, int first, const SlopeDemand& d, double ramp, double lag,
                       const SpeedScale& scale) {
    const double creep = d.creep_speed > 0 ? d.creep_speed : d.top_speed / SlopeTable::half;
    const double step = (d.top_speed - creep) / (SlopeTable::half - 1);
    double position = 0;
    for (int i = 0; i < SlopeTable::half; ++i) {
        const double speed = creep + i * step;
        const int rate = scale.rate_for(speed * (1 + 1e-12));
        if (rate == 0)
            return fail(ErrorKind::refused,
                        fmt::format("The lowest step is {:.3f} counts/s, but the card's slowest rate gives {:.3f}. Use "
                                    "a higher creep speed. No table was created.",
                                    speed, scale.speed(1)));
        const double longer = i == 0 ? 4 * lag * scale.speed(rate) : lag * step;
        position = std::max(position + scale.speed(rate) * step / ramp + longer, position + 1);
        if (position > static_cast<double>(max_move_counts))
            return fail(ErrorKind::refused,
                        fmt::format("A ramp to {} counts/s with {:.3f} counts/s2 is longer than {} counts. Use a lower "
                                    "top speed or a steeper ramp. No table was created.",
                                    d.top_speed, ramp, max_move_counts));
        table.set(first + i, {rate, static_cast<std::int64_t>(position + 0.5)});
    }
    return {};
}

}  // namespace

Result<SlopeTable> design_slope(const SlopeDemand& demand, const SpeedScale& scale) {
    MOTIONRACK_CHECK(sound(demand, scale));
    SlopeTable table;
    const double heavier = 1 + demand.load;
    MOTIONRACK_CHECK(fill_half(table, 0, demand, demand.deceleration / heavier, demand.lag_s * heavier, scale));
    MOTIONRACK_CHECK(fill_half(table, SlopeTable::half, demand, demand.acceleration / heavier, 0, scale));
    return table;
}

// ---- from table to motion

Result<SlopeMotion> motion_of(const SlopeTable& table, std::int64_t distance, int rate_limit, const SpeedScale& scale) {
    if (distance < 0 || distance > max_move_counts)
        return fail(ErrorKind::refused,
                    fmt::format("The move is {} counts long; it must be 0 to {}.", distance, max_move_counts));
    SlopeMotion motion;
    motion.distance = distance;
    std::int64_t at = 0;
    while (at < distance) {
        const SlopeTable::Step faster = table.accelerating(at), slower = table.decelerating(distance - at);
        const int rate = std::min({rate_limit, faster.rate, slower.rate});
        const double speed = scale.speed(rate);
        if (!(speed > 0))
            return fail(ErrorKind::refused,
                        fmt::format("At {} counts from the start the speed is 0, so the move would never end.", at));
        const std::int64_t next = std::min({distance, faster.max + 1, distance - slower.min + 1});
        const double time = static_cast<double>(next - at) / speed;
        if (!motion.legs.empty() && motion.legs.back().rate == rate) {
            motion.legs.back().to = next;
            motion.legs.back().duration_s += time;
        } else {
            motion.legs.push_back({rate, speed, at, next, motion.duration_s, time});
        }
        motion.duration_s += time;
        motion.top_speed = std::max(motion.top_speed, speed);
        at = next;
    }
    bool reached = false;
    for (const SlopeLeg& leg : motion.legs) {
        if (leg.speed == motion.top_speed) {
            reached = true;
            motion.decelerating = distance - leg.to;
        } else if (!reached) {
            motion.accelerating = leg.to;
        }
    }
    return motion;
}

SlopeSeries series_of(const SlopeMotion& motion) {
    SlopeSeries out;
    auto add = [&out](double seconds, double speed, std::int64_t position) {
        out.seconds.push_back(seconds);
        out.speed.push_back(static_cast<float>(speed));
        out.position.push_back(static_cast<float>(position));
    };
    add(0, 0, 0);
    for (const SlopeLeg& leg : motion.legs) {
        add(leg.start_s, leg.speed, leg.from);
        add(leg.start_s + leg.duration_s, leg.speed, leg.to);
    }
    add(motion.duration_s, 0, motion.distance);
    return out;
}

}  // namespace motionrack::databoard4002
