// System calls with their errors as text.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/disk/outputs.hpp>
#include <vector>

namespace motionrack::disk {

namespace {

tl::unexpected<Error> reason(int code) {
    return fail(ErrorKind::io, std::strerror(code));
}

/// Locks against a second writer of the same file. Does not use flock, which the HDF5 library takes itself.
bool lock(int file) {
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    return ::fcntl(file, F_OFD_SETLK, &whole) == 0 || (errno != EAGAIN && errno != EACCES);
}

bool is_still_there(int file, const std::string& path) {
    struct stat here {
    }, there{};
    return ::fstat(file, &here) == 0 && ::stat(path.c_str(), &there) == 0 && here.st_dev == there.st_dev &&
           here.st_ino == there.st_ino;
}

/// Makes the rename durable. File systems without support return error codes other than EIO.
bool sync_folder_of(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const int place = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (place < 0) return true;
    const bool bad = ::fsync(place) != 0 && errno == EIO;
    ::close(place);
    return !bad;
}

/// Removes a file that others could have opened, before secrets are written.
void remove_unless_private(const std::string& path) {
    struct stat found {};
    if (::lstat(path.c_str(), &found) != 0) return;
    if (!S_ISREG(found.st_mode) || found.st_uid != ::geteuid() || (found.st_mode & 0077) != 0 || found.st_nlink != 1)
        (void)::unlink(path.c_str());
}

}  // namespace

Result<NewFile> NewFile::create(const std::string& path, Incomplete part, Rights rights) {
    if (is_device(path)) return create_in_place(path);
    struct stat old {};
    const bool there = ::lstat(path.c_str(), &old) == 0;
    if (there && S_ISLNK(old.st_mode)) return fail(ErrorKind::io, "it is a symbolic link, which is not overwritten");
    if (there && S_ISDIR(old.st_mode)) return reason(EISDIR);
    if (there && ::access(path.c_str(), W_OK) != 0) return reason(errno);
    NewFile out;
    out.path_ = path;
    out.made_ = path + beside;
    out.part_ = part;
    if (rights == Rights::owner) remove_unless_private(out.made_);
    out.file_ =
        ::open(out.made_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, rights == Rights::owner ? 0600 : 0666);
    if (out.file_ < 0) return reason(errno);
    if (!lock(out.file_) || !is_still_there(out.file_, out.made_)) {
        out.part_ = Incomplete::keep;  // it belongs to another program
        return fail(ErrorKind::io, "another program is writing it");
    }
    if (::ftruncate(out.file_, 0) != 0) return reason(errno);
    if (rights == Rights::owner || there)
        (void)::fchmod(out.file_, rights == Rights::owner ? S_IRUSR | S_IWUSR : old.st_mode & 07777);
    return out;
}

Result<NewFile> NewFile::create_in_place(const std::string& path) {
    NewFile out;
    out.path_ = out.made_ = path;
    out.part_ = Incomplete::keep;
    out.file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (out.file_ < 0) return reason(errno);
    return out;
}

NewFile::~NewFile() {
    if (file_ < 0) return;
    if (part_ == Incomplete::remove) (void)::unlink(made_.c_str());
    (void)close();
}

void NewFile::swap(NewFile& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(path_, other.path_);
    std::swap(made_, other.made_);
    std::swap(trouble_, other.trouble_);
    std::swap(part_, other.part_);
    std::swap(written_, other.written_);
    std::swap(checksum_, other.checksum_);
}

bool NewFile::fail_with(int code) {
    if (trouble_.empty()) trouble_ = std::strerror(code);
    return false;
}

bool NewFile::close() {
    return ::close(std::exchange(file_, -1)) == 0;
}

bool NewFile::write(std::string_view bytes) {
    if (!trouble_.empty() || file_ < 0) return false;
    while (!bytes.empty()) {
        const ssize_t some = ::write(file_, bytes.data(), bytes.size());
        if (some < 0 && errno == EINTR) continue;
        if (some <= 0) return fail_with(some < 0 ? errno : EIO);
        const auto done = static_cast<std::size_t>(some);
        checksum_ = ::crc32_z(checksum_, reinterpret_cast<const unsigned char*>(bytes.data()), done);
        written_ += done;
        bytes.remove_prefix(done);
    }
    return true;
}

bool NewFile::is_as_written() {
    std::vector<unsigned char> piece(std::min<std::size_t>(written_ + 1, 1 << 20));
    unsigned long checksum = 0;
    std::uint64_t at = 0;
    while (true) {
        const ssize_t some = ::pread(file_, piece.data(), piece.size(), static_cast<off_t>(at));
        if (some < 0 && errno == EINTR) continue;
        if (some < 0) return fail_with(errno);
        if (some == 0) break;
        checksum = ::crc32_z(checksum, piece.data(), static_cast<std::size_t>(some));
        at += static_cast<std::uint64_t>(some);
    }
    if (at == written_ && checksum == checksum_) return true;
    trouble_ = "the content of the disk differs from the written data";
    return false;
}

Result<void> NewFile::commit() {
    if (file_ < 0) return {};
    const auto reported = [this] { return fail(ErrorKind::io, trouble_); };
    const bool in_place = made_ == path_;
    // A device cannot be synchronised.
    bool good = trouble_.empty() && (in_place || ::fsync(file_) == 0 || fail_with(errno));
    good = good && (in_place || written_ == 0 || is_as_written());
    good = good && (in_place || ::rename(made_.c_str(), path_.c_str()) == 0 || fail_with(errno));
    if (good && !in_place && !is_still_there(file_, path_)) {
        trouble_ = "another file has taken its name";
        good = false;
    }
    if (!good) return reported();
    if (!close()) {
        (void)fail_with(errno);
        return reported();
    }
    if (in_place || sync_folder_of(path_)) return {};
    trouble_ = "it is there, but may be gone after a power failure: " + std::string(std::strerror(EIO));
    return reported();
}

Result<void> NewFile::reported(std::string_view kind) const {
    if (trouble_.empty()) return {};
    return fail(ErrorKind::io,
                fmt::format("Only about {} bytes of the {} file could be written: {}. They are kept in {}, which ends "
                            "too early; make room or choose another place, and run again.",
                            written_, kind, trouble_, made_),
                {}, path_);
}

Result<void> write_whole(const std::string& path, std::string_view bytes, Rights rights) {
    MOTIONRACK_TRY(NewFile file, NewFile::create(path, NewFile::Incomplete::remove, rights));
    (void)file.write(bytes);
    return file.commit();
}

}  // namespace motionrack::disk
