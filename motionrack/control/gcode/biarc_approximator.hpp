// CubicBezier splines (G5, G5.1) as arcs: pairs of arcs that pass tangentially into each other, made one after the
// other in constant memory.
//
//      start ──► control ─ ─ ─ ─ ─ control ◄── end        the curve; each piece of it, from t to t':
//
//      at(t), tangent(t) ──arc──► joint ──arc──► at(t'), tangent(t')        halved until it is near enough
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control::gcode {

/// The arcs are nowhere farther from the curve than this, nor the curve from the arcs; mm.
inline constexpr double spline_tolerance_mm = 0.001;

/// Start, two control points, end; mm.
struct CubicBezier {
    std::array<PlanePoint, 4> points;

    PlanePoint at(double t) const;  ///< 0 .. 1
    /// Unit vector along the curve as it comes to t (`before`) or leaves it; they differ in a cusp. Not for four points
    /// in one place.
    PlanePoint tangent(double t, bool before) const;
    /// Least and greatest of one coordinate anywhere on the curve.
    void range(double PlanePoint::*coordinate, double& least, double& greatest) const;
    bool is_point() const;  ///< all four in one place
};

/// With a control point in common: the same curve as a cubic.
CubicBezier quadratic(PlanePoint start, PlanePoint control, PlanePoint end);

class BiarcApproximator {
  public:
    /// `pattern` gives all but kind, plane, turns, centre and the end in the plane of X and Y.
    void begin(const CubicBezier& curve, const Move& pattern);
    /// The next arc or line; false: no more. The last one ends at the pattern's end.
    bool next(Move& move);

  private:
    struct Biarc {
        PlanePoint from, to, joint, tangent_in, tangent_out, tangent_joint;
        std::array<double, 2> radius;  ///< > 0 counter-clockwise; 0: straight
        std::array<PlanePoint, 2> centre;
    };

    bool piece();
    bool fit(double from, double to, Biarc& biarc) const;
    bool near(double from, double to, const Biarc& biarc) const;
    Move half(std::size_t which) const;

    CubicBezier curve_;
    Move pattern_;
    std::uint32_t at_ = 0;     ///< how much of the curve is done, in steps of the finest division
    std::uint32_t width_ = 0;  ///< of the piece tried last
    std::size_t given_ = 2;    ///< halves of biarc_
    Biarc biarc_;
};

}  // namespace motionrack::control::gcode
