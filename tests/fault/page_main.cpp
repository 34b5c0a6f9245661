// Writes docs/reference/faults.md to standard output, with the word `coverage` docs/reference/fault-coverage.md.
#include <fmt/format.h>

#include <string_view>
#include <tests/fault/catalogue.hpp>
#include <tests/fault/coverage.hpp>
#include <tests/source_root.hpp>

namespace {

template <class Read>
int print_page(const Read& read, std::string (*page)(const typename Read::value_type&)) {
    if (!read) {
        fmt::print(stderr, "{}\n", read.error().text());
        return 2;
    }
    fmt::print("{}", page(*read));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace motionrack::faults;
    if (argc > 1 && std::string_view(argv[1]) == "coverage")
        return print_page(read_coverage(motionrack::source_dir() + "/tests/fault/coverage.toml"), coverage_page);
    return print_page(read_catalogue(motionrack::source_dir() + "/tests/fault/catalogue.toml"), catalogue_page);
}
