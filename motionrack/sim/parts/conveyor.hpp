// What moves the part under a scan head: a belt or a rotary table with a speed profile and an encoder on it.
//
//   speed     ___
//         ___/   \___      travel(t) is the integral, in closed form; the encoder sees travel * (1 - slip) and trembles
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>
#include <span>
#include <vector>

namespace motionrack::parts {

/// mm/s or degrees/s, either way.
inline constexpr double max_track_speed = 1e5;

struct SpeedPoint {
    double at_s = 0;
    double speed = 0;  ///< mm/s or degrees/s; straight between points, constant before the first and after the last
};

struct ConveyorSettings {
    bool rotary = false;
    double direction_deg = 0;  ///< belt: where it goes, from +X counter-clockwise
    sim::Spot centre_mm{};     ///< rotary: about this, counter-clockwise when the speed is positive
    std::vector<SpeedPoint> profile{{0, 100}};
    double deceleration = 2000;     ///< of stop(), a second squared, 1 .. 1e7
    double counts_per_unit = 1000;  ///< counts (x4) a mm or degree, +-1e-6 .. 1e9; negative counts the other way
    double slip = 0;                ///< of the encoder's wheel, -0.5 .. 0.5: it sees 1 - slip of the travel
    double jitter_counts = 0;       ///< 0 .. 1000: each reading is off by up to so much, evenly, the same in every run
};

class Conveyor {
  public:
    /// Refused: no profile, times that do not rise, numbers that are none or out of range.
    static Result<Conveyor> make(const ConveyorSettings& settings);

    /// mm or degrees since 0 s; speed then. Before a change of the drive the present way is continued backwards.
    double travel(double t_s) const;
    double speed(double t_s) const;
    /// The first time from `from_s` on at which travel() is at or beyond `low` (downwards) or `high` (upwards);
    /// infinity if never. Travel is between them at `from_s`.
    double leaves(double from_s, double low, double high) const;
    /// From t_s on at this speed, at most max_track_speed; braking to a standstill; by the profile again.
    void drive(double t_s, double speed);
    void stop(double t_s);
    void follow_profile(double t_s);
    /// The encoder's counts (wrapping) at ticks of 10 us: first, first + 1, ..
    void counts(std::int64_t first_tick, std::span<std::int32_t> out) const;
    /// A place that the part carries on by so many mm or degrees.
    sim::Spot carried(sim::Spot place, double way) const;
    /// The place on the part that is at `field` mm, and back. Part and field are one at travel 0.
    sim::Spot on_part(sim::Spot field, double t_s) const;
    sim::Spot in_field(sim::Spot part, double t_s) const;
    const ConveyorSettings& settings() const { return settings_; }

    /// What changes of the drive have done.
    struct Driving {
        double travelled = 0;  ///< when it was changed last
        double law = 0;        ///< what the profile's travel was then
        double since_s = 0;
        double speed = 0;              ///< by hand, after the ramp
        double accel = 0, ramp_s = 0;  ///< the ramp begins at since_s
        std::int64_t by_hand = 0;
    };
    Driving& driving() { return driving_; }
    /// Not by its profile.
    bool by_hand() const { return driving_.by_hand != 0; }

  private:
    double law_speed(double t_s) const;
    double law_travel(double t_s) const;
    /// The point of the profile at or before that time; -1: before the first.
    std::ptrdiff_t point_before(double t_s) const;
    double law_travel_from(std::ptrdiff_t point, double t_s) const;
    double driven(double law, double t_s) const;
    double travel_by_hand(double after_s) const;

    Driving driving_;
    ConveyorSettings settings_;
    std::vector<double> travelled_;  ///< at the profile's points, from 0 s
    double cosine_ = 1, sine_ = 0;
};

}  // namespace motionrack::parts
