// Selection of the inner loops for this CPU.
#include <motionrack/decode/kernels.hpp>
#include <motionrack/decode/kernels_x86.hpp>

namespace motionrack::decode {

const std::vector<Kernels>& available_kernels() {
    static const std::vector<Kernels> all = [] {
        std::vector<Kernels> out{portable_kernels()};
        for (const Kernels* kernels : {avx2_kernels(), avx512_kernels()})
            if (kernels) out.push_back(*kernels);
        return out;
    }();
    return all;
}

const Kernels& best_kernels() {
    return available_kernels().back();
}

}  // namespace motionrack::decode
