// Exponential and natural logarithm whose bits do not depend on the CPU, the compiler or the C library.
//
// Both use only + - * / and exact scaling by powers of two. The stated errors are measured by
// base/test/exponential_test.cpp against long double.
#pragma once

namespace motionrack {

/// e to the power x, within 1 ulp for -700 <= x <= 700; 0 below, infinity above; NaN gives NaN.
double exponential(double x);

/// The natural logarithm of x > 0 (normal numbers), within 1.5 ulp outside 0.7 .. 1.4 and 2e-16 absolute inside;
/// -infinity for 0, NaN below and for NaN.
double natural_log(double x);

}  // namespace motionrack
