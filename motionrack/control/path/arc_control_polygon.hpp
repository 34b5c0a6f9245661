// An arc as a control polygon: corners with a blend length each, whose blends lie on the arc.
//
//   knot  -1    0     1        2              3
//               ╱╲    ╱╲       ╱╲
//            ╱  ╲╱  ╲ ╱    ╲  ╱      ╲   ╱
//   ───────╱────╱╲───╱╲──────╱╲────────╱╲─
//           ^ start of the arc
//
// The blend of corner i spans the knots i - 1 to i + 1, with its peak at knot i. These hat functions add up to one
// inside the arc, so the curvature is that of the arc: the corners are control points of a cubic B-spline. At a
// junction the first knot intervals are short, each twice the previous one; at a standstill the first hat starts at
// full height.
#pragma once

#include <cstdint>
#include <motionrack/control/path/arc_curve.hpp>

namespace motionrack::control {

/// Position of the first hat of an arc after the junction, as a share of its knot interval. The corner is then on the
/// tangent. As all others it lies a sixth of an interval squared times the curvature outside the arc.
inline constexpr double step_after_junction = 0.57735026918962576451;
inline constexpr double step_before_junction = 1 - step_after_junction;

/// Deviation from the arc (or from the line before) near a junction, relative to curvature times first interval
/// squared; measured.
inline constexpr double junction_error = 0.0232;

/// Returns the longest knot interval inside an arc whose curve stays within `tolerance` (mm) of the arc.
double inner_step(const ArcCurve& arc, double tolerance);

/// A corner of an arc's control polygon; u counts from the start of the arc.
struct ArcControlPoint {
    double u;
    double begin, peak, end;  ///< knots; u is their mean
    Point at;
    bool last;
};

class ArcControlPolygon {
  public:
    ArcControlPolygon() = default;
    /// `step_in`, `step_out`: knot intervals at the ends; 0 for a standstill. All others are at most `inner`.
    ArcControlPolygon(const ArcCurve& arc, double step_in, double step_out, double inner);

    /// Returns the next corner; do not call after the last one.
    ArcControlPoint next();

    /// Returns the length in u: that of the arc plus the detour over the corners at its junctions.
    double length() const { return arc_.length() + more_in_ + more_out_; }

  private:
    double knot(std::int64_t i) const;
    Point control(double u, const double (&knots)[3]) const;

    ArcCurve arc_;
    double step_in_ = 0, step_out_ = 0, step_ = 0;
    int rising_ = 0, falling_ = 0;  ///< number of intervals that double, and that halve
    std::int64_t corners_ = 0, next_ = 0;
    double first_ = 0, last_ = 0;        ///< u of knots 0 and corners_ - 1
    double more_in_ = 0, more_out_ = 0;  ///< detour in u to the first corner and from the last one
};

}  // namespace motionrack::control
