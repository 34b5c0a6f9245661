// Millimetres (degrees) and seconds to registers and back, with what the rounding does to every value.
//
// The chip counts speeds in units of M = 8,000,000 / R pulses/s, accelerations in 125 M pulses/s2, and the jerk as
// 62.5e6 M / K pulses/s3. A small M resolves finely but ends low: real_setting() takes the smallest M that reaches what
// is asked, then moves R a little so that the drive speed comes out as asked.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <string>

namespace motionrack::mcx314 {

/// What a pulse is worth: pulses a mm, or a degree; more than 0.
struct Scale {
    double pulses_per_unit = 1;
};

/// A drive in mm (degrees) and s.
struct RealDrive {
    double speed = 0;         ///< drive speed, more than 0
    double start_speed = 0;   ///< speed at the start and at the end of ramps, more than 0
    double acceleration = 0;  ///< more than 0; of an S-curve the greatest
    double deceleration = 0;  ///< 0: as the acceleration
    double jerk = 0;          ///< 0: T-curve
};

/// A value as asked and as the card has it.
struct Rounded {
    double asked = 0;
    double real = 0;
    std::int64_t value = 0;  ///< in the register
    /// (real - asked) / asked; 0 where 0 was asked for.
    double error() const { return asked == 0 ? 0 : (real - asked) / asked; }
};

/// Registers of a drive, with the rounding of each.
struct RealSetting {
    std::int64_t R = 8'000'000;
    Rounded speed, start_speed, acceleration, deceleration, jerk;
    bool s_curve = false;
    bool asymmetric = false;  ///< D is not A
    /// Greatest of the relative errors, without sign.
    double worst_error() const;
    /// A line a value: "speed 33.3 -> V 6660: 33.3004 (+0.001 %)".
    std::string text() const;
    /// The curve in register units; no pulses yet.
    CurveData curve() const;
};

/// Chooses R. Errors: ErrorKind::refused with the greatest possible value in the same unit; also for what is not a
/// number, or not above 0.
Result<RealSetting> real_setting(const Scale& scale, const RealDrive& drive);
/// The same with a given R, 16,000 .. 8,000,000.
Result<RealSetting> real_setting_at(const Scale& scale, const RealDrive& drive, std::int64_t range);
/// Back from registers.
RealDrive real_values(const Scale& scale, const CurveData& curve);
/// The nearest whole pulse. Errors: not a number, or further than 2,147,483,647 pulses.
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
