// Approximates cubic Bezier splines (G5, G5.1) by biarcs: pairs of tangent arcs, made one by one in constant memory.
//
//      start ──► control ─ ─ ─ ─ ─ control ◄── end        the curve; each part of it, from t to t':
//
//      at(t), tangent(t) ──arc──► joint ──arc──► at(t'), tangent(t')        halved until it is within tolerance
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control::gcode {

/// Maximum distance between the arcs and the curve, in both directions; mm.
inline constexpr double spline_tolerance_mm = 0.001;

/// Start, two control points, end; mm.
struct CubicBezier {
    std::array<PlanePoint, 4> points;

    PlanePoint at(double t) const;  ///< point at parameter t, 0 .. 1
    /// Returns the unit tangent before or after t, which differ at a cusp. Requires at least two different points.
    PlanePoint tangent(double t, bool before) const;
    /// Computes the range of one coordinate over the whole curve.
    void range(double PlanePoint::*coordinate, double& min, double& max) const;
    bool is_point() const;  ///< all four points are equal
};

/// Returns the quadratic curve with this control point as a cubic one.
CubicBezier quadratic(PlanePoint start, PlanePoint control, PlanePoint end);

class BiarcApproximator {
  public:
    /// Starts the approximation of `curve`. `pattern` provides all fields of the moves except kind, plane, turns,
    /// centre and the end in the XY plane.
    void begin(const CubicBezier& curve, const Move& pattern);
    /// Returns the next arc or line; false after the last one, which ends at the end of the pattern.
    bool next(Move& move);

  private:
    struct Biarc {
        PlanePoint from, to, joint, tangent_in, tangent_out, tangent_joint;
        std::array<double, 2> radius;  ///< radius of each arc, mm; > 0 counter-clockwise; 0: a line
        std::array<PlanePoint, 2> centre;
    };

    bool piece();
    bool fit(double from, double to, Biarc& biarc) const;
    bool near(double from, double to, const Biarc& biarc) const;
    Move half(std::size_t which) const;

    CubicBezier curve_;
    Move pattern_;
    std::uint32_t at_ = 0;     ///< completed part of the curve, in steps of the finest division
    std::uint32_t width_ = 0;  ///< size of the part tried last, in the same steps
    std::size_t given_ = 2;    ///< number of halves of biarc_ that were returned, 0 .. 2
    Biarc biarc_;
};

}  // namespace motionrack::control::gcode
