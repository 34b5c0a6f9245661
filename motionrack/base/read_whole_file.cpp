#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <motionrack/base/open_to_read.hpp>
#include <motionrack/base/read_whole_file.hpp>

namespace motionrack {

namespace {

tl::unexpected<Error> not_readable(const std::string& name, const std::string& why) {
    return fail(ErrorKind::io,
                fmt::format("{} cannot be read: {}. Nothing was done; check the name and the permissions.", name, why));
}

std::string size_text(std::size_t bytes) {
    return bytes % (1 << 20) == 0 ? fmt::format("{} MiB", bytes >> 20) : fmt::format("{} bytes", bytes);
}

}  // namespace

Result<std::string> read_descriptor(int file, const std::string& name, const ReadLimit& limit) {
    static constexpr std::size_t piece = 1 << 20;
    std::string text;
    for (;;) {
        const std::size_t old = text.size();
        text.resize(old + piece);
        const ssize_t got = ::read(file, text.data() + old, piece);
        const int why = errno;
        text.resize(old + (got > 0 ? static_cast<std::size_t>(got) : 0));
        if (text.size() > limit.max_bytes)
            return fail(ErrorKind::invalid_input,
                        fmt::format("{} has more than {}, the limit of {}. Nothing was done; name another file.", name,
                                    size_text(limit.max_bytes), limit.kind));
        if (got == 0) return text;
        if (got > 0 || why == EINTR) continue;
        if (why != EAGAIN) return not_readable(name, std::strerror(why));
        wait_to_read(file);  // a pipe whose writer has not written yet
    }
}

Result<std::string> read_whole_file(const std::string& path, const ReadLimit& limit) {
    const int file = open_to_read(path.c_str());
    if (file < 0) return not_readable(path, std::strerror(errno));
    struct stat about {};
    const bool is_known = ::fstat(file, &about) == 0;
    Result<std::string> out;
    if (is_known && S_ISDIR(about.st_mode))
        out = not_readable(path, "it is a folder, not a file");
    else
        out = read_descriptor(file, path, limit);
    ::close(file);
    if (out && out->empty() && is_known && S_ISFIFO(about.st_mode))
        return not_readable(path, "it is a FIFO to which nothing was written");
    return out;
}

}  // namespace motionrack
