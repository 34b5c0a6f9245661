// x to the power y whose bits do not depend on the CPU, the compiler or the C library.
//
// It uses only + - * / on pairs of doubles, and exponential(). The errors named are those that base/test/power_test.cpp
// measures against long double.
#pragma once

namespace motionrack {

/// x to the power y. A whole y up to 1e6 in size gives the nearest double but for rare ties (measured: 0.5 ulp); other
/// y within 1.6 ulp (measured: 1.25) while the result lies in 1e-300 .. 1e300. NaN for x < 0 with a y that is not
/// whole, and for NaN; power(x, 0) is 1, power(0, y) is 0, or infinity for y < 0. Beyond the range of a double infinity
/// or 0.
double power(double x, double y);

}  // namespace motionrack
