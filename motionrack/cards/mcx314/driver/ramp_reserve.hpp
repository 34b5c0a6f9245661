// Pulses that a fixed drive keeps for its end (AO) where its speed is changed on the way; T-curves.
//
//   The chip counts the pulses of its rising ramps, less those of the falling ones, and begins the last fall when only
//   so many are left. In a ramp it stays at each speed for one step before it leaves it: a rise does so at its lowest
//   speed and not at its highest, a fall the other way round. So every fall takes a little more than the rise before it
//   gave; without these pulses the drive would end above its start speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace motionrack::mcx314 {

/// Speeds are V units, not negative.
class RampReserve {
  public:
    RampReserve() = default;
    /// Of a drive that begins now. `pulses_per_v`: pulses that a step of a ramp takes for each unit of its speed.
    RampReserve(std::int64_t sv, double pulses_per_v, std::int64_t v)
        : sv_(sv), pulses_per_v_(pulses_per_v), from_(std::min(sv, v)), wanted_(v) {}

    /// The drive has the speed `cv` and is to go on at `v`.
    void change(std::int64_t cv, std::int64_t v) {
        lost_ += taken(from_ - cv) + 1;
        if (wanted_ < cv) lost_ += taken(cv);  // a fall is left in the middle of a step
        from_ = cv;
        wanted_ = v;
    }
    /// What the last fall may take besides the pulses that the chip has counted, never too few.
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
