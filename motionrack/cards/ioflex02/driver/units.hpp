// Counts of an axis in the user's unit: mm of a scale, degrees of a spindle.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <motionrack/base/result.hpp>

namespace motionrack::ioflex02 {

class Units {
  public:
    /// Uses counts as the unit.
    Units() = default;
    /// A linear scale; negative: the axis counts in the opposite direction. Errors: refused (0 or not finite).
    static Result<Units> mm(double counts_per_mm) { return of(counts_per_mm, "counts for a mm"); }
    /// A rotary encoder, in degrees. Errors: refused (0 or not finite).
    static Result<Units> degrees(double counts_per_turn) { return of(counts_per_turn / 360, "counts for a degree"); }

    /// Converts whole counts of any width, or their mean.
    template <class Counts>
    double of_counts(Counts counts) const {
        return static_cast<double>(counts) / counts_per_unit_;
    }
    double to_counts(double value) const { return value * counts_per_unit_; }
    double counts_per_unit() const { return counts_per_unit_; }

  private:
    static Result<Units> of(double counts_per_unit, const char* what) {
        if (!std::isfinite(counts_per_unit) || counts_per_unit == 0)
            return fail(ErrorKind::refused,
                        fmt::format("The {1} are {0}; they must be a number other than 0. The units were not changed.",
                                    counts_per_unit, what));
        Units out;
        out.counts_per_unit_ = counts_per_unit;
        return out;
    }
    double counts_per_unit_ = 1;
};

}  // namespace motionrack::ioflex02
