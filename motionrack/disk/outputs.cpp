#include <fmt/format.h>

#include <filesystem>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/disk/outputs.hpp>

namespace motionrack::disk {

namespace fs = std::filesystem;

namespace {

bool is_left_out(const std::string& path) {
    return path.empty() || path == "-";
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code none;
    return fs::equivalent(a, b, none) ||
           fs::weakly_canonical(fs::absolute(a, none), none) == fs::weakly_canonical(fs::absolute(b, none), none);
}

tl::unexpected<Error> refused(std::string sentence) {
    return fail(ErrorKind::refused, std::move(sentence));
}

Result<void> may_write_one(const std::string& output, const std::vector<std::string>& inputs) {
    std::error_code none;
    if (fs::is_symlink(output, none))
        return refused(
            fmt::format("{} is a symbolic link, which is not overwritten; give the name of a file. Nothing "
                        "was done.",
                        output));
    for (const std::string& input : inputs) {
        if (is_left_out(input)) continue;
        if (same_file(input, output))
            return refused(fmt::format(
                "{} is an input, so it cannot be an output; choose another name. Nothing was done.", output));
        if (same_file(input, output + beside))
            return refused(
                fmt::format("{} is first written to {}{}, which is an input; choose another name. Nothing was done.",
                            output, output, beside));
    }
    return {};
}

}  // namespace

bool is_device(const std::string& path) {
    std::error_code none;
    const fs::file_status found = fs::status(path, none);
    if (fs::exists(found) && !fs::is_regular_file(found) && !fs::is_directory(found)) return true;
    return path.starts_with("/dev/") || path.starts_with("/proc/");
}

Result<void> may_write(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (is_left_out(outputs[i]) || is_device(outputs[i])) continue;
        MOTIONRACK_CHECK(may_write_one(outputs[i], inputs));
        for (std::size_t k = 0; k < outputs.size(); ++k) {
            if (k == i || is_left_out(outputs[k])) continue;
            if (same_file(outputs[k], outputs[i]) || same_file(outputs[k], outputs[i] + beside))
                return refused(fmt::format(
                    "Two outputs have the name {}; choose another name for one. Nothing was done.", outputs[i]));
        }
    }
    return {};
}

}  // namespace motionrack::disk
