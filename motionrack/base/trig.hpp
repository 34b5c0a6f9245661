// Sine, cosine, tangent and their inverses with the same bits on every CPU, compiler and C library.
//
// They use only + - * / sqrt on doubles and no fused operations, so the same input gives the same bits everywhere. The
// stated errors are measured by base/test/trig_test.cpp against long double (64-bit mantissa).
#pragma once

namespace motionrack {

inline constexpr double pi = 3.14159265358979323846;

/// Sine and cosine of one angle, computed together because they share its reduction.
struct SinCos {
    double sin;
    double cos;
};

/// Sine and cosine of `radians`, each within 1 ulp (measured: 0.8) for |radians| <= 1e6. Up to 1e9 the angle error is
/// at most 1e-6 rad; beyond 1e9 and for infinities and NaN both are NaN.
SinCos sin_cos(double radians);

/// The angle of (x, y) from the positive x axis, in [-pi, pi] rad, within 1.2 ulp (measured: 1.05). Zeros, their signs
/// and infinities as in C: atan2(0, -1) is pi, atan2(-0.0, -1) is -pi, atan2(0, 0) is 0; NaN gives NaN.
double atan2(double y, double x);

/// The angle in [0, pi] rad whose cosine is `x`, within 2.6 ulp (measured: 2.4); NaN outside [-1, 1].
double acos(double x);

/// The angle in [-pi/2, pi/2] rad whose sine is `x`, within 2.6 ulp; NaN outside [-1, 1].
double asin(double x);

/// Tangent of `radians`, within 2.5 ulp for |radians| <= 1e6; NaN where sin_cos is.
double tan(double radians);

}  // namespace motionrack
