// The conveyor under a scan head: a belt or a rotary table with a velocity profile and an encoder.
//
//   velocity  ___
//         ___/   \___      travel(t) is the integral, in closed form; encoder: travel * (1 - slip) with jitter
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>
#include <span>
#include <vector>

namespace motionrack::parts {

/// mm/s or degrees/s, in either direction.
inline constexpr double max_track_velocity = 1e5;

struct VelocityPoint {
    double at_s = 0;
    double velocity = 0;  ///< mm/s or degrees/s; linear between points, constant before the first and after the last
};

struct ConveyorSettings {
    bool rotary = false;
    double direction_deg = 0;  ///< belt: direction of motion, from +X counter-clockwise
    sim::Spot centre_mm{};     ///< rotary: centre; counter-clockwise for a positive velocity
    std::vector<VelocityPoint> profile{{0, 100}};
    double deceleration = 2000;     ///< deceleration of stop(), units/s2, 1 .. 1e7
    double counts_per_unit = 1000;  ///< counts (x4) per mm or degree, +-1e-6 .. 1e9; negative: opposite direction
    double slip = 0;                ///< slip of the encoder's wheel, -0.5 .. 0.5: it measures 1 - slip of the travel
    double jitter_counts = 0;  ///< 0 .. 1000: maximum error of a reading, uniformly distributed, the same in every run
};

class Conveyor {
  public:
    /// Errors: refused for a missing profile, times that do not increase, numbers not finite or out of range.
    static Result<Conveyor> make(const ConveyorSettings& settings);

    /// mm or degrees since 0 s, and the velocity. Before a change of the drive the present motion is extrapolated
    /// backwards.
    double travel(double t_s) const;
    double velocity(double t_s) const;
    /// The first time from `from_s` on at which travel() is at or beyond `low` (downwards) or `high` (upwards);
    /// infinity if never. At `from_s` the travel must be between them.
    double leaves(double from_s, double low, double high) const;
    /// From t_s on: constant velocity, at most max_track_velocity; deceleration to a standstill; the profile again.
    void drive(double t_s, double velocity);
    void stop(double t_s);
    void follow_profile(double t_s);
    /// Encoder counts (wrapping) at ticks of 10 us: first, first + 1, ..
    void counts(std::int64_t first_tick, std::span<std::int32_t> out) const;
    /// A position after the part has carried it on by `distance` mm or degrees.
    sim::Spot carried(sim::Spot position, double distance) const;
    /// Position on the part at `field` mm, and the inverse. Part and field coincide at travel 0.
    sim::Spot on_part(sim::Spot field, double t_s) const;
    sim::Spot in_field(sim::Spot part, double t_s) const;
    const ConveyorSettings& settings() const { return settings_; }

    /// Accumulated effect of drive(), stop() and follow_profile().
    struct Driving {
        double travelled = 0;  ///< travel at the last change
        double law = 0;        ///< travel by the profile at the last change
        double since_s = 0;
        double velocity = 0;           ///< manual velocity, after the ramp
        double accel = 0, ramp_s = 0;  ///< the ramp begins at since_s
        std::int64_t by_hand = 0;
    };
    Driving& driving() { return driving_; }
    /// True while the profile is overridden.
    bool by_hand() const { return driving_.by_hand != 0; }

  private:
    double law_velocity(double t_s) const;
    double law_travel(double t_s) const;
    /// Index of the profile point at or before that time; -1: before the first.
    std::ptrdiff_t point_before(double t_s) const;
    double law_travel_from(std::ptrdiff_t point, double t_s) const;
    double driven(double law, double t_s) const;
    double travel_by_hand(double after_s) const;

    Driving driving_;
    ConveyorSettings settings_;
    std::vector<double> travelled_;  ///< travel at the profile's points, from 0 s
    double cosine_ = 1, sine_ = 0;
};

}  // namespace motionrack::parts
