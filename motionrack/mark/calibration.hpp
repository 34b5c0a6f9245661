// Calibration of a marking machine's corrections from marks and readings, with standard uncertainties.
#pragma once

#include <array>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>

namespace motionrack::mark {

/// Value with its standard uncertainty (one sigma).
struct Measured {
    double value = 0, uncertainty = 0;
};

struct ScaleData {
    double reading1 = 0, reading2 = 0;  ///< counts or bits of the source (get_encoder, read_mcbsp)
    double distance_mm = 0;             ///< signed distance of the part between both readings
    double bits_per_mm = 0;             ///< K of the field
    double reading_uncertainty = 0.5;   ///< standard uncertainty of each reading, counts or bits
    double distance_uncertainty_mm = 0;
};
struct ScaleResult {
    Measured per_mm;  ///< counts or bits of the source per mm of travel
    Measured scale;   ///< parameter of set_fly_x, set_fly_x_pos and similar: field bits per count or bit of the source
};
/// Computes a scale from two readings. Errors: refused if the readings are equal, the distance or the bits per mm are
/// 0, an uncertainty is negative, or a number is not finite or above 1e12.
Result<ScaleResult> calibrate_scale(const ScaleData& data);

/// A mark that the laser made at a fixed point of the field at this table count, measured in coordinates fixed to the
/// part.
struct RotaryMark {
    sim::Spot at;      ///< mm
    double count = 0;  ///< encoder count
};
struct RotaryResult {
    Measured centre_x, centre_y, radius_mm;
    Measured
        counts_per_turn;  ///< Resolution of a rotating part: positive if it turns counter-clockwise with rising counts
    double unlike = 0;    ///< relative difference of the counts per turn between the first and the second step
};
/// Computes centre, radius and resolution of a table. Requires three marks, each less than half a turn after the
/// previous one. Errors: refused if marks are collinear or coincide, counts do not rise or fall from mark to mark, an
/// uncertainty is negative, or a number is not finite.
Result<RotaryResult> calibrate_rotary(const std::array<RotaryMark, 3>& marks, double place_uncertainty_mm,
                                      double count_uncertainty = 0.5);

struct LagData {
    std::array<double, 2> velocity_mm_s{};  ///< velocities of the part while each cross was marked
    std::array<double, 2> shift_mm{};  ///< offset of the cross from its nominal position, positive against the movement
    double shift_uncertainty_mm = 0;
};
struct LagResult {
    Measured lag_us;
    int tracking_error = 0;     ///< parameter of set_fly_tracking_error, units of 10 us
    double fixed_shift_mm = 0;  ///< velocity-independent part of the shift: its cause is the fixture, not a delay
};
/// Computes the delay of the mirrors. Errors: refused if both velocities are equal, the delay is negative beyond its
/// uncertainty or above 655,350 us, or a number is not finite.
Result<LagResult> calibrate_lag(const LagData& data);

}  // namespace motionrack::mark
