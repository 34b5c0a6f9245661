// libFuzzer: any bytes as samples of a grating bus at any time; test/judge_fuzz.hpp of the module contains the
// invariants.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/dds/test/frame_validator_fuzz.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    motionrack::fuzz::Bytes bytes({data, size});
    const std::string problem = motionrack::dds::fuzz::Run(bytes).go(2'000);
    if (problem.empty()) return 0;
    std::fprintf(stderr, "%s\n", problem.c_str());
    std::abort();
}
