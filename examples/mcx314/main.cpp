// The programs of the how-to pages about the function library: runs one on a virtual card and writes its picture.
//   example_mcx314 PAGE [PICTURE.svg]
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <motionrack/trace/svg.hpp>

#include "bench.hpp"

namespace {

using namespace howto;

constexpr std::array<Page, 7> pages = {{
    {"trapezoid", trapezoid, [](Bench& bench) { return bench.speeds("X speed", axis_x); }},
    {"s_curve", s_curve, [](Bench& bench) { return bench.speeds("X and Y speed", axis_x | axis_y); }},
    {"asymmetric", asymmetric, [](Bench& bench) { return bench.speeds("X speed", axis_x); }},
    {"line", line, [](Bench& bench) { return bench.speeds("Speeds along the line", axis_x | axis_y | axis_z); }},
    {"arc", arc, [](Bench& bench) { return bench.path("Arc"); }},
    {"contour", contour, [](Bench& bench) { return bench.path("Contour"); }},
    {"bit_pattern", bit_pattern, [](Bench& bench) { return bench.path("Bit pattern"); }},
}};

int run(const Page& page, const char* picture) {
    Bench bench;
    if (const auto done = page.run(bench.card()); !done) return fmt::print(stderr, "{}\n", done.error().text()), 1;
    if (!picture) return 0;
    if (const auto written = trace::write_text(page.picture(bench), picture); !written)
        return fmt::print(stderr, "{}\n", written.error().text()), 5;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    for (const Page& page : pages)
        if (argc >= 2 && std::strcmp(argv[1], page.name) == 0) return run(page, argc >= 3 ? argv[2] : nullptr);
    fmt::print(stderr, "Usage: example_mcx314 PAGE [PICTURE.svg]. Pages:");
    for (const Page& page : pages) fmt::print(stderr, " {}", page.name);
    fmt::print(stderr, "\n");
    return 1;
}
