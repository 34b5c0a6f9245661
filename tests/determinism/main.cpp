// determinism_histories FOLDER: prints the hashes of the event traces of the examples in FOLDER, which every build must
// reproduce.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <tests/determinism/histories.hpp>

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("determinism_histories FOLDER\n", stderr), 1;
    try {
        fmt::print("{}{}", motionrack::example_histories(argv[1]), motionrack::rack_histories(argv[1]));
    } catch (const std::exception& problem) {
        fmt::print(stderr, "{}\n", problem.what());
        return 1;
    }
}
