// The programs of the how-to pages about the IOFLEX02: runs one on a virtual card.
//   example_ioflex02 calibrate|speed|broken_line|lathe
#include <fmt/format.h>

#include <array>
#include <string_view>

#include "bench.hpp"

int main(int argc, char** argv) {
    struct Page {
        std::string_view name;
        motionrack::Result<void> (*run)();
    };
    static constexpr std::array<Page, 4> pages = {{{"calibrate", &howto::calibrate},
                                                   {"speed", &howto::speed},
                                                   {"broken_line", &howto::broken_line},
                                                   {"lathe", &howto::lathe}}};
    for (const Page& page : pages) {
        if (argc != 2 || page.name != argv[1]) continue;
        if (const auto done = page.run(); !done) return fmt::print(stderr, "{}\n", done.error().text()), 4;
        return 0;
    }
    fmt::print(stderr, "Usage: example_ioflex02 calibrate|speed|broken_line|lathe\n");
    return 1;
}
