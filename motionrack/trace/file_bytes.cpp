// Buffered reading.
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <motionrack/trace/file_bytes.hpp>
#include <system_error>

namespace motionrack::trace {

namespace {

tl::unexpected<Error> not_readable(const std::string& path, int why) {
    return fail(ErrorKind::io,
                fmt::format("The file cannot be read: {}. Check the name and the permissions.",
                            std::generic_category().message(why)),
                {}, path);
}

}  // namespace

Result<FileBytes> FileBytes::open(const std::string& path) {
    FileBytes out;
    out.path_ = path;
    out.file_.reset(std::fopen(path.c_str(), "rb"));
    if (!out.file_) return not_readable(path, errno);
    struct stat found {};
    if (::fstat(::fileno(out.file_.get()), &found) == 0) out.total_ = static_cast<std::uint64_t>(found.st_size);
    out.buffer_.resize(std::size_t{1} << 18);
    out.peek();
    MOTIONRACK_CHECK(out.check());
    return out;
}

bool FileBytes::fill() {
    if (trouble_ != 0) return false;
    errno = 0;
    at_ = 0;
    end_ = std::fread(buffer_.data(), 1, buffer_.size(), file_.get());
    read_ += end_;
    if (end_ == 0 && std::ferror(file_.get()) != 0) trouble_ = errno != 0 ? errno : EIO;
    return end_ > 0;
}

Result<void> FileBytes::check() const {
    return trouble_ == 0 ? Result<void>() : Result<void>(not_readable(path_, trouble_));
}

}  // namespace motionrack::trace
