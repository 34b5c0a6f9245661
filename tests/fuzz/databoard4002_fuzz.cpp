// libFuzzer: any bytes as accesses, wires, faults and elapsed time on a virtual DataBoard 4002; test/card_fuzz.hpp of
// the card contains the invariants.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/cards/databoard4002/test/card_fuzz.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    motionrack::fuzz::Bytes bytes({data, size});
    motionrack::databoard4002::fuzz::Verdict verdict;
    motionrack::databoard4002::fuzz::run(bytes, 2'000, verdict);
    if (verdict.problem.empty()) return 0;
    std::fprintf(stderr, "%s\n", verdict.problem.c_str());
    std::abort();
}
