// determinism_histories FOLDER: prints the histories of the project in FOLDER, as every build must give them.
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
