// Reads and writes files; prints errors and progress.
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/terminal.hpp>

namespace motionrack::cli {

bool is_terminal(int descriptor) {
    const char* term = std::getenv("TERM");
    return ::isatty(descriptor) && std::getenv("NO_COLOR") == nullptr && term != nullptr &&
           std::string_view(term) != "dumb";
}

namespace {

void print(const char* label, const char* colour, std::string_view sentence) {
    if (is_terminal(2))
        fmt::print(stderr, "{}{}\033[0m {}\n", colour, label, sentence);
    else
        fmt::print(stderr, "{} {}\n", label, sentence);
}

}  // namespace

void print_error(std::string_view sentence) {
    print("error:", "\033[1;31m", sentence);
}
void print_warning(std::string_view sentence) {
    print("warning:", "\033[1;33m", sentence);
}

Result<std::string> read_text(const std::string& path, const ReadLimit& limit) {
    return path == "-" ? read_descriptor(STDIN_FILENO, "standard input", limit) : read_whole_file(path, limit);
}

namespace {

tl::unexpected<Error> not_writable(const std::string& path, std::string_view why) {
    return fail(ErrorKind::io, fmt::format("{} cannot be written: {}. Choose another name or make room.", path, why));
}
tl::unexpected<Error> not_writable(const std::string& path, int code) {
    return not_writable(path, std::string_view(std::strerror(code)));
}

}  // namespace

Result<void> check_writable(const std::string& path) {
    struct stat found {};
    if (path == "-") return {};
    if (::stat(path.c_str(), &found) == 0) {
        if (S_ISDIR(found.st_mode)) return not_writable(path, EISDIR);
        return ::access(path.c_str(), W_OK) == 0 ? Result<void>{} : not_writable(path, errno);
    }
    if (errno != ENOENT) return not_writable(path, errno);
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    return ::access(folder.c_str(), W_OK | X_OK) == 0 ? Result<void>{} : not_writable(path, errno);
}

Result<void> write_text(const std::string& path, std::string_view text) {
    if (path != "-") {
        const Result<void> done = disk::write_whole(path, text);
        return done ? done : not_writable(path, std::string_view(done.error().message));
    }
    // Short output stays in the buffer, so a full disk is detected on flush.
    const bool good = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    return good ? Result<void>{} : not_writable(path, errno);
}

int report(const Error& error) {
    print_error(error.text());
    return exit_code(error.kind);
}

ProgressLine::ProgressLine(bool quiet) : on_(!quiet && ::isatty(2) != 0) {}

void ProgressLine::show(double part, std::string_view text) {
    part = std::clamp(part, 0.0, 1.0);
    if (!on_ || std::fabs(part - last_part_) < 0.002) return;
    last_part_ = part;
    static constexpr int width = 30;
    const auto full = static_cast<std::size_t>(part * width);
    fmt::print(stderr, "\r\033[K[{}{}] {:3.0f} %  {}", std::string(full, '='), std::string(width - full, ' '),
               part * 100, text);
    std::fflush(stderr);
    shown_ = true;
}

void ProgressLine::clear() {
    if (shown_) fmt::print(stderr, "\r\033[K");
    shown_ = false;
}

}  // namespace motionrack::cli
