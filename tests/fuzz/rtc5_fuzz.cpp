// libFuzzer: any bytes as list commands, control commands, words, starts and files on a virtual RTC5;
// test/card_fuzz.hpp of the card contains the invariants.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/cards/rtc5/test/card_fuzz.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    motionrack::fuzz::Bytes bytes({data, size});
    motionrack::rtc5::fuzz::Verdict verdict;
    motionrack::rtc5::fuzz::run(bytes, 2'000, verdict);
    if (verdict.problem.empty()) return 0;
    std::fprintf(stderr, "%s\n", verdict.problem.c_str());
    std::abort();
}
