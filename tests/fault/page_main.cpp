// Writes docs/reference/faults.md to standard output.
#include <fmt/format.h>

#include <tests/fault/catalogue.hpp>
#include <tests/source_root.hpp>

int main() {
    const auto groups = motionrack::faults::read_catalogue(motionrack::source_dir() + "/tests/fault/catalogue.toml");
    if (!groups) {
        fmt::print(stderr, "{}\n", groups.error().text());
        return 2;
    }
    fmt::print("{}", motionrack::faults::catalogue_page(*groups));
}
