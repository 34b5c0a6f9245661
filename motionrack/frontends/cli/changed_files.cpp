// Compares files with the texts read from them.
#include <fmt/format.h>

#include <filesystem>
#include <motionrack/base/fnv.hpp>
#include <motionrack/frontends/cli/changed_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/subprogram_files.hpp>

namespace motionrack::cli {

namespace {

void warn_of_change(const std::string& path, const std::string& text) {
    std::error_code unknown;
    const std::filesystem::file_status status = std::filesystem::status(path, unknown);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return;
    const char* const advice = "The run used the text that was read before its start; run it again for the new one";
    const Result<std::string> now = read_text(path);
    if (!now)
        print_warning(
            fmt::format("{} cannot be read any more after the run; the executed text has the checksum {:016x}. {}",
                        path, fnv_of(text), advice));
    else if (*now != text)
        print_warning(
            fmt::format("{} was changed while it ran: the executed text has the checksum {:016x}, the file now has "
                        "{:016x}. {}",
                        path, fnv_of(text), fnv_of(*now), advice));
}

}  // namespace

void warn_of_changes(const std::string& program, const std::string& text,
                     const std::map<std::string, std::string>& subprograms) {
    if (program.empty() || program == "-") return;
    warn_of_change(program, text);
    const std::filesystem::path folder = std::filesystem::path(program).parent_path();
    for (const auto& [name, content] : subprograms)
        warn_of_change(rack::subprogram_file(folder, name).string(), content);
}

}  // namespace motionrack::cli
