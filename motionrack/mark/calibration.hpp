// What a marking machine's corrections are to be set to, from marks and readings, with standard uncertainties.
#pragma once

#include <array>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>

namespace motionrack::mark {

/// A value and its standard uncertainty (one sigma).
struct Measured {
    double value = 0, uncertainty = 0;
};

struct ScaleData {
    double reading1 = 0, reading2 = 0;  ///< counts or bits of the source (get_encoder, read_mcbsp)
    double distance_mm = 0;             ///< that the part went from the one to the other, with its sign
    double bits_per_mm = 0;             ///< K of the field
    double reading_uncertainty = 0.5;   ///< of each reading
    double distance_uncertainty_mm = 0;
};
struct ScaleResult {
    Measured per_mm;  ///< counts or bits of the source a mm
    Measured scale;   ///< for set_fly_x and the like: bits of the field a count
};
/// Errors: refused: equal readings, no distance, numbers that are none.
Result<ScaleResult> calibrate_scale(const ScaleData& data);

/// One and the same place of the field, marked while the table stood at this count; then measured on the part, in any
/// coordinates that are at rest on it.
struct RotaryMark {
    sim::Spot at;      ///< mm
    double count = 0;  ///< of the encoder
};
struct RotaryResult {
    Measured centre_x, centre_y, radius_mm;
    Measured counts_per_turn;  ///< Resolution, for a part that turns: positive if it turns counter-clockwise with
                               ///< rising counts
    double unlike = 0;         ///< how far both steps disagree about the counts a turn, as a part of it
};
/// Three marks, each less than half a turn from the one before. Errors: refused: marks on a line or on one another,
/// equal counts.
Result<RotaryResult> calibrate_rotary(const std::array<RotaryMark, 3>& marks, double place_uncertainty_mm,
                                      double count_uncertainty = 0.5);

struct LagData {
    std::array<double, 2> speed_mm_s{};  ///< of the part
    std::array<double, 2> shift_mm{};    ///< of the cross against where it should be, positive against the movement
    double shift_uncertainty_mm = 0;
};
struct LagResult {
    Measured lag_us;
    int tracking_error = 0;     ///< for set_fly_tracking_error: 10 us
    double fixed_shift_mm = 0;  ///< what does not grow with speed: of the fixture, not of time
};
/// Errors: refused: equal speeds, a lag below 0 by more than its uncertainty, or above 655,350 us.
Result<LagResult> calibrate_lag(const LagData& data);

}  // namespace motionrack::mark
