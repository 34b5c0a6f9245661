// Two scan mirrors and an f-theta lens: position of the spot in the image plane for the commanded mirror angles.
//
//   beam ──► X mirror ──► Y mirror ──► lens ──► (x, y) mm      tan of the two optical angles,
//                                                              then height = f1 t + f2 t^2 + ..
//
// Card (correction tables) and part (the lens in the beam) share the same optics. It reproduces a maker's own tables
// to 1.5 bits.
#pragma once

#include <motionrack/base/result.hpp>

namespace motionrack::sim {

struct Spot {
    double x = 0, y = 0;
};

struct ScanLens {
    /// Height in mm = f[0] theta + f[1] theta^2 + ..; f[0]: 1 .. 10000.
    double f_mm[4] = {163.064, -1.259, -21.465, -26.664};
    double calibration_deg = 11.7;  ///< mechanical deflection at 96 % of the range, 1 .. 22
    double bits_per_mm = 8656;      ///< K, 1 .. 1e6
};

/// Checks the lens. Errors: refused for numbers not finite or out of range, or a height that does not increase up to
/// the field's corner.
Result<void> check(const ScanLens& lens);

/// Returns the spot in mm for mirrors at (x, y) bits, -524288 .. 524288 with a small margin.
Spot spot_of(const ScanLens& lens, Spot bits);

/// Returns the mirror positions in bits for a spot at (x, y) mm, by Newton's method, to about 1e-9 bits within the
/// reach of the lens. For a spot out of reach, returns the last iterate, which is beyond the range.
Spot bits_for(const ScanLens& lens, Spot mm);

}  // namespace motionrack::sim
