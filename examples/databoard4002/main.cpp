// The programs of the how-to pages about the DataBoard 4002: runs one on a virtual card and writes its picture.
//   example_databoard4002 slope [PICTURE.svg] | lock [PICTURE.svg]
//   example_databoard4002 old_host RUN.csv PICTURE.svg | closed_loop RUN.csv PICTURE.svg
#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench.hpp"

namespace {

motionrack::Result<std::string> picture_of(const std::string& page, const std::string& csv) {
    if (page == "slope") return howto::slope();
    if (page == "lock") return howto::lock();
    return page == "old_host" ? howto::old_host(csv) : howto::closed_loop(csv);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const std::string page = words.empty() ? "" : words[0];
    const bool drawn = page == "old_host" || page == "closed_loop";  // of a run that another program has written
    const std::size_t max_words = drawn ? 3 : 2;
    if ((page != "slope" && page != "lock" && !drawn) || words.size() > max_words ||
        (drawn && words.size() < max_words)) {
        fmt::print(stderr,
                   "Usage: example_databoard4002 slope|lock [PICTURE.svg], or example_databoard4002 "
                   "old_host|closed_loop RUN.csv PICTURE.svg\n");
        return 1;
    }
    const auto picture = picture_of(page, drawn ? words[1] : "");
    if (!picture) return fmt::print(stderr, "{}\n", picture.error().text()), 1;
    if (words.size() < max_words) return 0;
    if (const auto written = motionrack::trace::write_text(*picture, words.back()); !written)
        return fmt::print(stderr, "{}\n", written.error().text()), 5;
    return 0;
}
