// An arc, helix or spiral arc as a smooth function of u, with its derivatives.
#pragma once

#include <motionrack/control/geometry.hpp>

namespace motionrack::control {

/// A point of an arc and its first three derivatives with respect to u.
struct ArcCurvePoint {
    Point at, tangent, curvature, curvature_rate;
};

/// u grows at least as fast as the XYZ length, and equally fast at both ends and where the radius is constant.
class ArcCurve {
  public:
    ArcCurve() = default;
    explicit ArcCurve(const Geometry& arc);

    double length() const { return 0.5 * (rate_in_ + rate_out_); }  ///< length in u
    ArcCurvePoint at(double u) const;
    double max_curvature() const { return max_curvature_; }  ///< largest |second derivative|, 1/mm
    double turn_rate() const { return turn_rate_; }          ///< largest rotation in the plane of the arc per u, rad
    double rotary_rate() const { return rotary_rate_; }  ///< degrees per u of the rotary axis with the largest rotation

  private:
    std::uint8_t first_ = 0, second_ = 1;
    double centre_first_ = 0, centre_second_ = 0;
    double from_first_ = 0, from_second_ = 0;  ///< start relative to the centre, mm
    double sweep_ = 0, growth_ = 0;
    double rate_in_ = 0, rate_out_ = 0;  ///< du/ds at both ends, linear between; s: share of the arc, 0 .. 1
    Point start_ = {}, change_ = {};
    double max_curvature_ = 0, turn_rate_ = 0, rotary_rate_ = 0;
};

}  // namespace motionrack::control
