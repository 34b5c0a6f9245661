// The decoder's inner loops for x86 CPUs with AVX2 (256 bits) and with AVX-512 (512 bits). Only for kernels.cpp.
#pragma once

#include <motionrack/decode/kernels.hpp>

namespace motionrack::decode {

/// Null where the CPU (or the architecture) has not what they need.
const Kernels* avx2_kernels();
const Kernels* avx512_kernels();

}  // namespace motionrack::decode
