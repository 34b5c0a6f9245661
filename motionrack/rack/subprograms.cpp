// Reading them when they are called.
#include <fmt/format.h>

#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/rack/subprograms.hpp>

namespace motionrack::rack {

namespace {

constexpr std::uintmax_t largest = 64 << 20;

Result<std::string> read(const std::filesystem::path& file) {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    if (missing)
        return fail(Trouble::bad_input, fmt::format("{} beside it is not there or cannot be read", file.string()));
    if (size > largest)
        return fail(Trouble::bad_input, fmt::format("{} beside it is larger than 64 MiB", file.string()));
    return read_whole_file(file.string(), {largest, "a subprogram"});
}

}  // namespace

std::filesystem::path subprogram_file(const std::filesystem::path& folder, const std::string& name) {
    return folder / (name + ".ngc");
}

control::gcode::SubprogramSource subprograms_in(std::filesystem::path folder) {
    return [folder = std::move(folder)](const std::string& name) { return read(subprogram_file(folder, name)); };
}

}  // namespace motionrack::rack
