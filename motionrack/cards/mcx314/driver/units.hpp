// Conversion of millimetres (degrees) and seconds to registers and back, with the rounding of every value.
//
// The chip counts speeds in units of M = 8,000,000 / R pulses/s, accelerations in 125 M pulses/s2, and the jerk
// as 62.5e6 M / K pulses/s3. A small M resolves finely but has a low maximum: real_setting() selects the smallest M
// that reaches the requested values, then adjusts R slightly for the requested drive speed.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <string>

namespace motionrack::mcx314 {

/// Pulse scale: pulses per mm, or per degree; > 0.
struct Scale {
    double pulses_per_unit = 1;
};

/// A drive in mm (degrees) and s.
struct RealDrive {
    double speed = 0;         ///< drive speed, > 0
    double start_speed = 0;   ///< speed at the start and at the end of ramps, > 0
    double acceleration = 0;  ///< > 0; for an S-curve the maximum
    double deceleration = 0;  ///< 0: as the acceleration
    double jerk = 0;          ///< 0: T-curve
};

/// A value as requested and as realised by the card.
struct Rounded {
    double asked = 0;
    double real = 0;
    std::int64_t value = 0;  ///< in the register
    /// (real - asked) / asked; 0 if 0 was requested.
    double error() const { return asked == 0 ? 0 : (real - asked) / asked; }
};

/// Registers of a drive, with the rounding of each.
struct RealSetting {
    std::int64_t R = 8'000'000;
    Rounded speed, start_speed, acceleration, deceleration, jerk;
    bool s_curve = false;
    bool asymmetric = false;  ///< D is not A
    /// Returns the largest magnitude of the relative errors.
    double max_error() const;
    /// Returns one line per value: "speed 33.3 -> V 6660: 33.3004 (+0.001 %)".
    std::string text() const;
    /// Returns the curve in register units, without pulses.
    CurveData curve() const;
};

/// Selects R and computes the setting. Errors: ErrorKind::refused with the maximum possible value in the same unit;
/// also for values that are not numbers or not above 0.
Result<RealSetting> real_setting(const Scale& scale, const RealDrive& drive);
/// Computes the setting for a given R, 16,000 .. 8,000,000. Errors: as real_setting().
Result<RealSetting> real_setting_at(const Scale& scale, const RealDrive& drive, std::int64_t range);
/// Converts a curve in register units to mm (degrees) and s.
RealDrive real_values(const Scale& scale, const CurveData& curve);
/// Rounds a distance to the nearest whole pulse. Errors: refused if it is not a number, or beyond 2,147,483,647 pulses.
Result<Rounded> to_pulses(const Scale& scale, double distance);

/// A plan in real units.
struct RealPart {
    double seconds = 0;
    double distance = 0;
    double from_speed = 0, to_speed = 0;
    double peak_acceleration = 0;
};
struct RealPlan {
    RealPart rise, cruise, fall, creep;
    double seconds = 0;
    double distance = 0;
    double top_speed = 0;
    double end_speed = 0;
    double jerk = 0;
    bool reaches_speed = false;  ///< false: a triangle
    CurvePlan plan;              ///< the same in register units
};
RealPlan in_units(const Scale& scale, const CurvePlan& plan);

}  // namespace motionrack::mcx314
