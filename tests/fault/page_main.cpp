// Writes docs/reference/faults.md to standard output; with the argument `coverage`, docs/reference/fault-coverage.md.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <tests/fault/catalogue.hpp>
#include <tests/fault/coverage.hpp>
#include <tests/source_root.hpp>

int main(int argc, char** argv) {
    using namespace motionrack::faults;
    const std::string folder = motionrack::source_dir() + "/tests/fault/";
    const auto catalogue = read_catalogue(folder + "catalogue.toml");
    const auto coverage = read_coverage(folder + "coverage.toml");
    for (const std::string& error :
         {catalogue ? "" : catalogue.error().text(), coverage ? std::string() : coverage.error().text()})
        if (!error.empty()) {
            fmt::print(stderr, "{}\n", error);
            return 2;
        }
    const bool of_coverage = argc > 1 && std::string_view(argv[1]) == "coverage";
    fmt::print("{}", of_coverage ? coverage_page(*coverage, *catalogue) : catalogue_page(*catalogue));
    return 0;
}
