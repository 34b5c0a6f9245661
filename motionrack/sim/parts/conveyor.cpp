// Travel of belts and rotary tables, and the counts of their encoder.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/base/hash_bits.hpp>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/parts/conveyor.hpp>

namespace motionrack::parts {

namespace {

constexpr double track_tick_s = 1e-5;

/// Pseudo-random value -1 .. 1, a function of the tick.
double tremble(std::int64_t tick) {
    return static_cast<double>(mixed_bits(static_cast<std::uint64_t>(tick) + golden_step) >> 11) * 0x1p-52 - 1;
}

sim::Spot turned(sim::Spot p, sim::Spot centre, double degrees) {
    const SinCos t = sin_cos(degrees * (pi / 180));
    const double dx = p.x - centre.x, dy = p.y - centre.y;
    return {centre.x + (t.cos * dx - t.sin * dy), centre.y + (t.sin * dx + t.cos * dy)};
}

bool within(double v, double min, double max) {
    return v >= min && v <= max;
}

/// The first time at which an object has moved `distance` (>= 0) upwards; infinity if never.
double time_for(double distance, double velocity, double accel) {
    constexpr double never_s = std::numeric_limits<double>::infinity();
    if (!(distance < never_s)) return never_s;
    const double under = velocity * velocity + 2 * accel * distance;
    if (under < 0) return never_s;
    const double root = std::sqrt(under);
    if (velocity + root > 0) return 2 * distance / (velocity + root);
    return accel > 0 ? (root - velocity) / accel : never_s;
}

}  // namespace

Result<Conveyor> Conveyor::make(const ConveyorSettings& s) {
    const auto refuse = [](std::string why) { return fail(ErrorKind::refused, std::move(why)); };
    if (s.profile.empty()) return refuse("the velocity profile is empty; it must have at least one point");
    for (std::size_t i = 0; i < s.profile.size(); ++i) {
        const VelocityPoint& p = s.profile[i];
        if (!within(p.at_s, 0, 1e6) || (i > 0 && p.at_s <= s.profile[i - 1].at_s))
            return refuse(fmt::format(
                "point {} of the velocity profile is at {} s; times must rise, from 0 to 1000000 s", i + 1, p.at_s));
        if (!within(p.velocity, -max_track_velocity, max_track_velocity))
            return refuse(
                fmt::format("point {} of the velocity profile has the velocity {}; it must be -100000 to 100000", i + 1,
                            p.velocity));
    }
    if (!within(std::abs(s.counts_per_unit), 1e-6, 1e9))
        return refuse(fmt::format("the encoder has {} counts a unit; it must be 0.000001 to 1e9, or negative",
                                  s.counts_per_unit));
    if (!within(s.deceleration, 1, 1e7))
        return refuse(fmt::format("the deceleration is {}; it must be 1 to 1e7", s.deceleration));
    if (!within(s.slip, -0.5, 0.5)) return refuse(fmt::format("the slip is {}; it must be -0.5 to 0.5", s.slip));
    if (!within(s.jitter_counts, 0, 1000))
        return refuse(fmt::format("the jitter is {} counts; it must be 0 to 1000", s.jitter_counts));
    if (!within(s.direction_deg, -3600, 3600))
        return refuse(fmt::format("the direction is {} degrees; it must be -3600 to 3600", s.direction_deg));
    if (!within(s.centre_mm.x, -1e5, 1e5) || !within(s.centre_mm.y, -1e5, 1e5))
        return refuse(
            fmt::format("the centre is ({}, {}) mm; both must be -100000 to 100000", s.centre_mm.x, s.centre_mm.y));
    Conveyor out;
    out.settings_ = s;
    const SinCos t = sin_cos(s.direction_deg * (pi / 180));
    out.cosine_ = t.cos, out.sine_ = t.sin;
    double sum = s.profile[0].velocity * s.profile[0].at_s;
    out.travelled_.push_back(sum);
    for (std::size_t i = 1; i < s.profile.size(); ++i) {
        const VelocityPoint &a = s.profile[i - 1], &b = s.profile[i];
        sum += (a.velocity + b.velocity) / 2 * (b.at_s - a.at_s);
        out.travelled_.push_back(sum);
    }
    return out;
}

double Conveyor::law_velocity(double t_s) const {
    const auto& p = settings_.profile;
    const auto above =
        std::upper_bound(p.begin(), p.end(), t_s, [](double t, const VelocityPoint& q) { return t < q.at_s; });
    if (above == p.begin()) return p.front().velocity;
    if (above == p.end()) return p.back().velocity;
    const VelocityPoint &a = *(above - 1), &b = *above;
    return a.velocity + (b.velocity - a.velocity) * ((t_s - a.at_s) / (b.at_s - a.at_s));
}

std::ptrdiff_t Conveyor::point_before(double t_s) const {
    const auto& p = settings_.profile;
    if (t_s <= p.front().at_s) return -1;
    return std::upper_bound(p.begin(), p.end(), t_s, [](double t, const VelocityPoint& q) { return t < q.at_s; }) -
           p.begin() - 1;
}

double Conveyor::law_travel_from(std::ptrdiff_t point, double t_s) const {
    const auto& p = settings_.profile;
    if (point < 0) return p.front().velocity * t_s;
    const auto i = static_cast<std::size_t>(point);
    const double dt = t_s - p[i].at_s;
    if (i + 1 == p.size()) return travelled_[i] + p[i].velocity * dt;
    const VelocityPoint& next = p[i + 1];
    return travelled_[i] + (p[i].velocity + (next.velocity - p[i].velocity) / (next.at_s - p[i].at_s) * (dt / 2)) * dt;
}

double Conveyor::law_travel(double t_s) const {
    return law_travel_from(point_before(t_s), t_s);
}

double Conveyor::velocity(double t_s) const {
    const Driving& d = driving_;
    return d.by_hand ? d.velocity - d.accel * std::max(0.0, d.since_s + d.ramp_s - t_s) : law_velocity(t_s);
}

double Conveyor::driven(double law, double t_s) const {
    const Driving& d = driving_;
    return d.travelled + (d.by_hand ? travel_by_hand(t_s - d.since_s) : law - d.law);
}

double Conveyor::travel_by_hand(double after_s) const {
    const Driving& d = driving_;
    const double missing_s = std::max(0.0, d.ramp_s - after_s);  // remaining part of the ramp
    return d.velocity * after_s - d.accel / 2 * (d.ramp_s * d.ramp_s - missing_s * missing_s);
}

double Conveyor::travel(double t_s) const {
    return driven(driving_.by_hand ? 0 : law_travel(t_s), t_s);
}

void Conveyor::drive(double t_s, double velocity) {
    driving_ = {travel(t_s), 0, t_s, velocity, 0, 0, 1};
}

void Conveyor::stop(double t_s) {
    const double now = velocity(t_s), accel = now > 0 ? -settings_.deceleration : settings_.deceleration;
    driving_ = {travel(t_s), 0, t_s, 0, accel, std::fabs(now) / settings_.deceleration, 1};
}

void Conveyor::follow_profile(double t_s) {
    driving_ = {travel(t_s), law_travel(t_s), t_s, 0, 0, 0, 0};
}

double Conveyor::leaves(double from_s, double low, double high) const {
    constexpr double never_s = std::numeric_limits<double>::infinity();
    for (;;) {
        // Steps through the sections of constant acceleration.
        const auto& p = settings_.profile;
        double accel = 0, end_s = never_s;
        if (const Driving& d = driving_; d.by_hand && from_s < d.since_s + d.ramp_s) {
            accel = d.accel, end_s = d.since_s + d.ramp_s;
        } else if (!d.by_hand) {
            const auto above = std::upper_bound(p.begin(), p.end(), from_s,
                                                [](double t, const VelocityPoint& q) { return t < q.at_s; });
            if (above != p.end()) end_s = above->at_s;
            if (above != p.end() && above != p.begin())
                accel = (above->velocity - (above - 1)->velocity) / (above->at_s - (above - 1)->at_s);
        }
        const double here = travel(from_s), v = velocity(from_s);
        const double after = std::min(time_for(high - here, v, accel), time_for(here - low, -v, -accel));
        if (from_s + after <= end_s || end_s == never_s) return from_s + after;
        from_s = end_s;
    }
}

void Conveyor::counts(std::int64_t first_tick, std::span<std::int32_t> out) const {
    const double per_unit = settings_.counts_per_unit * (1 - settings_.slip);
    const auto time = [&](std::size_t i) {
        return static_cast<double>(first_tick + static_cast<std::int64_t>(i)) * track_tick_s;
    };
    for (std::size_t begin = 0; begin < out.size();) {
        // The profile is searched once per section, not once per tick.
        const std::ptrdiff_t point = point_before(time(begin));
        std::size_t end = out.size();
        if (point_before(time(end - 1)) != point)
            for (end = begin + 1; point_before(time(end)) == point;) ++end;
        for (std::size_t i = begin; i < end; ++i) {
            double count = driven(law_travel_from(point, time(i)), time(i)) * per_unit;
            if (settings_.jitter_counts > 0)
                count += settings_.jitter_counts * tremble(first_tick + static_cast<std::int64_t>(i));
            auto whole = static_cast<std::int64_t>(count);
            whole -= count < static_cast<double>(whole);
            out[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(whole));
        }
        begin = end;
    }
}

sim::Spot Conveyor::carried(sim::Spot position, double distance) const {
    if (settings_.rotary) return turned(position, settings_.centre_mm, distance);
    return {position.x + distance * cosine_, position.y + distance * sine_};
}

sim::Spot Conveyor::on_part(sim::Spot field, double t_s) const {
    return carried(field, -travel(t_s));
}

sim::Spot Conveyor::in_field(sim::Spot part, double t_s) const {
    return carried(part, travel(t_s));
}

}  // namespace motionrack::parts
