// x to the power y with the same bits on every CPU, compiler and C library.
//
// The function uses only + - * / on pairs of doubles, and exponential(). The stated errors are measured by
// base/test/power_test.cpp against long double.
#pragma once

namespace motionrack {

/// x to the power y. A whole y up to a magnitude of 1e6 gives the nearest double except in rare ties (measured: 0.5
/// ulp). Any other y is within 1.6 ulp (measured: 1.25) for results in 1e-300 .. 1e300. NaN for x < 0 with a y that is
/// not whole, and for NaN; power(x, 0) is 1, power(0, y) is 0, or infinity for y < 0. Beyond the range of a double the
/// result is infinity or 0.
double power(double x, double y);

}  // namespace motionrack
