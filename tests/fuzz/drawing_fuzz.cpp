// libFuzzer: any bytes as a drawing (SVG, G-code or text); test/mark_fuzz.hpp of the module contains the invariants.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/mark/test/mark_fuzz.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string problem = motionrack::mark::fuzz::check_drawing({reinterpret_cast<const char*>(data), size});
    if (problem.empty()) return 0;
    std::fprintf(stderr, "%s\n", problem.c_str());
    std::abort();
}
