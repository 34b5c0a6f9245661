// Computes the pulses to reserve for the end (AO) of a fixed drive whose speed is changed on the fly; T-curves only.
//
//   The chip counts the pulses of its accelerating ramps, less those of the decelerating ones, and begins the final
//   deceleration when only this number is left. A ramp holds each speed for one step before leaving it: an
//   acceleration holds its lowest speed but not its highest, a deceleration the reverse. So every deceleration takes
//   slightly more pulses than the acceleration before it; without the reserve a drive would end above its start speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace motionrack::mcx314 {

/// Reserve of one drive. Speeds are in V units, >= 0.
class RampReserve {
  public:
    RampReserve() = default;
    /// Begins the reserve of a drive that starts now. `pulses_per_v`: pulses of a ramp step per unit of its speed.
    RampReserve(std::int64_t sv, double pulses_per_v, std::int64_t v)
        : sv_(sv), pulses_per_v_(pulses_per_v), from_(std::min(sv, v)), wanted_(v) {}

    /// Records a change at the speed `cv` to the new speed `v`.
    void change(std::int64_t cv, std::int64_t v) {
        lost_ += taken(from_ - cv) + 1;
        if (wanted_ < cv) lost_ += taken(cv);  // a deceleration is left in the middle of a step
        from_ = cv;
        wanted_ = v;
    }
    /// Returns an upper bound of the pulses that the final deceleration takes beyond those that the chip has counted.
    std::int64_t pulses() const {
        const double last = taken(from_ - wanted_) + taken(std::max(from_, wanted_) - sv_);
        return static_cast<std::int64_t>(std::ceil(lost_ + last)) + rounding;
    }

  private:
    static constexpr std::int64_t rounding = 2;  ///< whole pulses at both ends
    double taken(std::int64_t v) const { return pulses_per_v_ * static_cast<double>(std::max<std::int64_t>(v, 0)); }

    std::int64_t sv_ = 1;
    double pulses_per_v_ = 0;
    std::int64_t from_ = 1, wanted_ = 1;  ///< speeds at the last change and after it
    double lost_ = 0;
};

}  // namespace motionrack::mcx314
