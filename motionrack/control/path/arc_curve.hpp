// An arc, helix or spiral arc as a smooth function of u, with its derivatives.
#pragma once

#include <motionrack/control/geometry.hpp>

namespace motionrack::control {

/// A place on an arc and the first three derivatives there, by u.
struct ArcCurvePoint {
    Point at, tangent, curvature, curvature_rate;
};

/// u grows at least as fast as the length of XYZ does, and exactly so where the radius does not grow and at both ends.
class ArcCurve {
  public:
    ArcCurve() = default;
    explicit ArcCurve(const Geometry& arc);

    double length() const { return 0.5 * (rate_in_ + rate_out_); }  ///< of u
    ArcCurvePoint at(double u) const;
    double max_curvature() const { return max_curvature_; }  ///< greatest |curvature|
    double turn_rate() const { return turn_rate_; }          ///< greatest angle in the arc's plane per u
    double rotary_rate() const { return rotary_rate_; }      ///< degrees per u of the rotary axis that turns most

  private:
    std::uint8_t first_ = 0, second_ = 1;
    double centre_first_ = 0, centre_second_ = 0;
    double from_first_ = 0, from_second_ = 0;  ///< start from the centre
    double sweep_ = 0, growth_ = 0;
    double rate_in_ = 0, rate_out_ = 0;  ///< of u by the part of the arc, at its ends; linear between
    Point start_ = {}, change_ = {};
    double max_curvature_ = 0, turn_rate_ = 0, rotary_rate_ = 0;
};

}  // namespace motionrack::control
