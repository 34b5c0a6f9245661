#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <motionrack/auth/private_files.hpp>

namespace motionrack::auth {

namespace {

tl::unexpected<Error> not_seen(const std::string& path, const std::string& subject) {
    return fail(ErrorKind::io,
                fmt::format("{} cannot be checked: {}. Nothing was started; name another file, or correct its "
                            "path.",
                            subject, std::strerror(errno)),
                {}, path);
}

/// An owner can change the rights at any time.
bool is_of_another_user(const struct stat& about) {
    return about.st_uid != ::geteuid() && about.st_uid != 0;
}

/// A private group of the user, which many systems create, does not count as others.
bool is_open_to_others(const struct stat& about) {
    if ((about.st_mode & S_ISVTX) != 0) return false;  // sticky, as /tmp: users may replace only their own files
    return (about.st_mode & S_IWOTH) != 0 || ((about.st_mode & S_IWGRP) != 0 && about.st_gid != ::getegid());
}

Result<void> check_folder(const std::string& path, const std::string& subject) {
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    struct stat about {};
    if (::stat(folder.c_str(), &about) != 0) return {};  // it is missing: any other error is also one of the file
    if (is_of_another_user(about))
        return fail(
            ErrorKind::invalid_input,
            fmt::format("Another user (uid {}) may replace {}: the folder {} belongs to them. Nothing was started; "
                        "chown the folder, or name a file elsewhere.",
                        about.st_uid, subject, folder),
            {}, path);
    if (!is_open_to_others(about)) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("Others may replace {}: its folder {} is open to them (mode {:o}). Nothing was started; "
                            "chmod go-w the folder, or name a file elsewhere.",
                            subject, folder, about.st_mode & 0777),
                {}, path);
}

/// Returns "the users file".
std::string lower_first(std::string text) {
    text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
    return text;
}

}  // namespace

Result<void> check_writers(const std::string& path, const std::string& subject) {
    struct stat about {};
    const bool there = ::stat(path.c_str(), &about) == 0;
    if (!there && errno != ENOENT) return not_seen(path, subject);
    if (there && is_of_another_user(about))
        return fail(ErrorKind::invalid_input,
                    fmt::format("Another user (uid {}) owns {}; they could grant themselves access, or make wrong "
                                "positions valid. Nothing was started; check its content, then chown it.",
                                about.st_uid, lower_first(subject)),
                    {}, path);
    if (there && (about.st_mode & (S_IWGRP | S_IWOTH)) != 0)
        return fail(ErrorKind::invalid_input,
                    fmt::format("Others may write {} (mode {:o}); they could grant themselves access, or make wrong "
                                "positions valid. Nothing was started; check its content, then chmod 600 it.",
                                lower_first(subject), about.st_mode & 0777),
                    {}, path);
    return check_folder(path, lower_first(subject));
}

Result<void> check_readers(const std::string& path, const std::string& subject) {
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0) return not_seen(path, subject);
    const mode_t open = about.st_uid == 0 ? S_IWGRP | S_IXGRP | S_IRWXO : S_IRWXG | S_IRWXO;
    if ((about.st_mode & open) == 0) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("Others may read {} (mode {:o}). Nothing was started; chmod 600 it, and make a new key if "
                            "another user may have read this one.",
                            lower_first(subject), about.st_mode & 0777),
                {}, path);
}

}  // namespace motionrack::auth
