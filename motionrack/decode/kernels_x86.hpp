// Inner loops of the decoder for x86 CPUs with AVX2 (256 bits) and with AVX-512 (512 bits). Only for kernels.cpp.
#pragma once

#include <motionrack/decode/kernels.hpp>

namespace motionrack::decode {

/// Returns the kernels; nullptr if the CPU (or the architecture) lacks the required instructions.
const Kernels* avx2_kernels();
const Kernels* avx512_kernels();

}  // namespace motionrack::decode
