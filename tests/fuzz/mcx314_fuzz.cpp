// libFuzzer: any bytes as accesses, wires and elapsed time on a virtual MCX314, or an MCX314As if their number is odd;
// test/chip_fuzz.hpp of the card contains the invariants.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/cards/mcx314/test/chip_fuzz.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    motionrack::fuzz::Bytes bytes({data, size});
    motionrack::mcx314::fuzz::Verdict verdict;
    motionrack::mcx314::fuzz::run(
        bytes, 2'000, verdict,
        size % 2 == 0 ? motionrack::mcx314::Variant::mcx314 : motionrack::mcx314::Variant::mcx314as);
    if (verdict.problem.empty()) return 0;
    std::fprintf(stderr, "%s\n", verdict.problem.c_str());
    std::abort();
}
