// Reads subprograms when they are called.
#include <fmt/format.h>

#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/rack/subprogram_files.hpp>

namespace motionrack::rack {

namespace {

constexpr ReadLimit limit{std::size_t{64} << 20, "a subprogram"};

Result<std::string> read(const std::filesystem::path& file) {
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown) && !unknown)
        return fail(ErrorKind::invalid_input, fmt::format("{} was not found beside it", file.string()));
    return read_whole_file(file.string(), limit);
}

}  // namespace

std::filesystem::path subprogram_file(const std::filesystem::path& folder, const std::string& name) {
    return folder / (name + ".ngc");
}

control::gcode::SubprogramSource subprograms_in(std::filesystem::path folder) {
    return [folder = std::move(folder)](const std::string& name) { return read(subprogram_file(folder, name)); };
}

}  // namespace motionrack::rack
