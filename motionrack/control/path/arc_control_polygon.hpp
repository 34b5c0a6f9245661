// An arc as a polygon with a width for each of its turns, so that the spread turns lie on the arc.
//
//   knot  -1    0     1        2              3
//               ╱╲    ╱╲       ╱╲
//            ╱  ╲╱  ╲ ╱    ╲  ╱      ╲   ╱
//   ───────╱────╱╲───╱╲──────╱╲────────╱╲─
//           ^ the arc begins here
//
// Corner i is spread over the knots i - 1 to i + 1, steepest at knot i. These hats add up to one everywhere inside, so
// that the curvature is that of the arc: the corners are the control points of a cubic B-spline. At a joint the first
// steps are short, each twice the one before; at a rest the first hat begins with its full height.
#pragma once

#include <cstdint>
#include <motionrack/control/path/arc_curve.hpp>

namespace motionrack::control {

/// Part of its step by which an arc's first hat lies after the joint: the corner is then on the tangent and, as all
/// others are, a sixth of a step squared times the curvature outside of the arc.
inline constexpr double step_after_joint = 0.57735026918962576451;
inline constexpr double step_before_joint = 1 - step_after_joint;

/// How far from its arc (or from the line before) a polygon that begins with this step comes near the joint, by
/// curvature times step squared; measured.
inline constexpr double joint_error = 0.0232;

/// The longest step inside an arc whose curve is within `tolerance` (mm) of it.
double inner_step(const ArcCurve& arc, double tolerance);

/// A corner of an arc's polygon; u counts from the arc's start.
struct ArcControlPoint {
    double u;
    double begin, peak, end;  ///< knots; u is their mean
    Point at;
    bool last;
};

class ArcControlPolygon {
  public:
    ArcControlPolygon() = default;
    /// Steps at the two ends; 0: there the path rests. All other steps are `inner` at most.
    ArcControlPolygon(const ArcCurve& arc, double step_in, double step_out, double inner);

    /// The next corner; not after the last one.
    ArcControlPoint next();

    /// Of u: the arc's, and a little more for the way over the corners at its joints.
    double length() const { return bow_.length() + more_in_ + more_out_; }

  private:
    double knot(std::int64_t i) const;
    Point control(double u, const double (&knots)[3]) const;

    ArcCurve bow_;
    double step_in_ = 0, step_out_ = 0, step_ = 0;
    int rising_ = 0, falling_ = 0;  ///< steps that double, and halve
    std::int64_t corners_ = 0, next_ = 0;
    double first_ = 0, last_ = 0;        ///< knots 0 and corners_ - 1
    double more_in_ = 0, more_out_ = 0;  ///< of u, on the way to the first corner and from the last one
};

}  // namespace motionrack::control
