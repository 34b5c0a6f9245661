// Reading them when they are called.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <motionrack/rack/subprograms.hpp>

namespace motionrack::rack {

namespace {

constexpr std::uintmax_t largest = 64 << 20;

Result<std::string> read(const std::filesystem::path& file) {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    std::ifstream in(file, std::ios::binary);
    if (missing || !in)
        return fail(Trouble::bad_input, fmt::format("{} beside it is not there or cannot be read", file.string()));
    if (size > largest)
        return fail(Trouble::bad_input, fmt::format("{} beside it is larger than 64 MiB", file.string()));
    return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace

control::gcode::SubprogramSource subprograms_in(std::filesystem::path folder) {
    return [folder = std::move(folder)](const std::string& name) { return read(folder / (name + ".ngc")); };
}

}  // namespace motionrack::rack
