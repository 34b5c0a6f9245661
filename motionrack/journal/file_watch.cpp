#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <motionrack/journal/file_watch.hpp>

namespace motionrack::journal {

namespace {

constexpr int max_links = 40;  ///< as many as the system follows

}  // namespace

std::string file_behind(const std::string& path) {
    std::error_code none;
    std::filesystem::path file = path;
    for (int i = 0; i < max_links && std::filesystem::is_symlink(file, none); ++i)
        file = file.parent_path() / std::filesystem::read_symlink(file, none);
    return file.string();
}

Result<void> FileWatch::add(const std::string& path) {
    struct stat seen {};
    if (::stat(path.c_str(), &seen) != 0)
        return fail(ErrorKind::io,
                    fmt::format("cannot be watched: the file '{}' cannot be checked: {}", path, std::strerror(errno)));
    files_.push_back({path, seen.st_dev, seen.st_ino, seen.st_size});
    return {};
}

Result<void> FileWatch::check() {
    for (WatchedFile& one : files_) {
        struct stat seen {};
        const auto gone = [&](const std::string& what) {
            return fail(ErrorKind::io, fmt::format("is lost: the file '{}' {}", one.path, what));
        };
        if (::stat(one.path.c_str(), &seen) != 0)
            return gone(errno == ENOENT ? "was deleted while it was in use"
                                        : fmt::format("cannot be checked: {}", std::strerror(errno)));
        if (seen.st_dev != one.device || seen.st_ino != one.inode) return gone("was replaced while it was in use");
        if (seen.st_size < one.size)
            return gone(fmt::format("was cut from {} to {} bytes while it was in use", one.size, seen.st_size));
        one.size = seen.st_size;
    }
    return {};
}

}  // namespace motionrack::journal
