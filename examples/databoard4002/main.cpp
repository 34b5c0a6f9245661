// The programs of the how-to pages about the DataBoard 4002: runs one on a virtual card and writes its picture.
//   example_databoard4002 slope [PICTURE.svg] | lock [PICTURE.svg] | old_host RUN.csv PICTURE.svg
#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench.hpp"

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const std::string page = words.empty() ? "" : words[0];
    const std::size_t most = page == "old_host" ? 3 : 2;
    if ((page != "slope" && page != "lock" && page != "old_host") || words.size() > most ||
        (page == "old_host" && words.size() < most)) {
        fmt::print(stderr,
                   "Usage: example_databoard4002 slope|lock [PICTURE.svg], or example_databoard4002 old_host RUN.csv "
                   "PICTURE.svg\n");
        return 1;
    }
    const auto picture = page == "slope" ? howto::slope() : page == "lock" ? howto::lock() : howto::old_host(words[1]);
    if (!picture) return fmt::print(stderr, "{}\n", picture.error().text()), 1;
    if (words.size() < most) return 0;
    if (const auto written = motionrack::trace::write_text(*picture, words.back()); !written)
        return fmt::print(stderr, "{}\n", written.error().text()), 5;
    return 0;
}
