// Slope tables from the limits of a machine, and the reverse: the motion of a table, with its legs and times, before
// anything moves.
//
//   top speed, acceleration, deceleration, load ──► SlopeTable ──► SlopeMotion: legs, times, distances
//
//   speed ^      ___________ top           24 equal steps of speed; each lasts as long as the
//         |    _|           |__            acceleration needs for it, so that the staircase
//         |  _|                |__         rises with the requested acceleration
//         +-------------------------> time
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/databoard4002/slope_table.hpp>
#include <vector>

namespace motionrack::databoard4002 {

/// Scale from the card's rate to the speed of the machine: counts per pulse of FOUT, or counts/s per volt.
struct SpeedScale {
    bool analog = false;
    double counts_per_pulse = 1;  ///< > 0 if the motor follows FOUT
    double counts_per_volt = 0;   ///< counts/s per volt, > 0, if the motor follows the voltage
    Trim trim = default_trim;

    /// Returns the speed at a rate of 0 .. 16383, counts/s.
    double speed(int rate) const;
    /// Returns the highest rate whose speed does not exceed `counts_s`; 0 if rate 1 is already faster.
    int rate_for(double counts_s) const;
};

/// Limits of the machine, in counts and seconds.
struct SlopeDemand {
    double top_speed = 10'000;     ///< counts/s
    double acceleration = 20'000;  ///< counts/s2 of the empty machine
    double deceleration = 20'000;  ///< counts/s2 of the empty machine
    double load = 0;               ///< >= 0: inertia of the load relative to the empty machine; makes both ramps longer
    double creep_speed = 0;        ///< counts/s of the first and last step; 0: 1/24 of the top speed
    double lag_s = 0;  ///< s, >= 0: time constant of the empty machine's speed; deceleration begins that much earlier,
                       ///< and the last step lasts four time constants longer
};

/// Designs a slope table. Errors: refused, with the number and its limit, if a value is not positive or not finite, or
/// is faster than the card's rates. Also refused: a creep speed not below the top speed, and a ramp longer than
/// 8,388,607 counts.
Result<SlopeTable> design_slope(const SlopeDemand& demand, const SpeedScale& scale);

/// A part of a move at one rate.
struct SlopeLeg {
    int rate = 0;
    double speed = 0;       ///< counts/s
    std::int64_t from = 0;  ///< counts travelled before it
    std::int64_t to = 0;
    double start_s = 0;
    double duration_s = 0;
};

struct SlopeMotion {
    std::vector<SlopeLeg> legs;
    double duration_s = 0;
    double top_speed = 0;           ///< counts/s
    std::int64_t distance = 0;      ///< counts
    std::int64_t accelerating = 0;  ///< counts up to the first leg at the top speed
    std::int64_t decelerating = 0;  ///< counts after the last leg at the top speed
};

/// Computes the motion of the card with this table for a move of `distance` counts (0 .. 8,388,607) with Rate at
/// `rate_limit`, if the motor follows without delay. Errors: refused if an interval on the way has the speed 0, so the
/// move would never end.
Result<SlopeMotion> motion_of(const SlopeTable& table, std::int64_t distance, int rate_limit, const SpeedScale& scale);

/// A motion as polylines with two points for each leg: s, counts/s, counts travelled.
struct SlopeSeries {
    std::vector<double> seconds;
    std::vector<float> speed;
    std::vector<float> position;
};
SlopeSeries series_of(const SlopeMotion& motion);

}  // namespace motionrack::databoard4002
