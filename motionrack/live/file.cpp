// Opening of card files.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <motionrack/live/file.hpp>

namespace motionrack::live {

namespace {

std::string sentence(const std::string& path, int error) {
    switch (error) {
        case ENOENT:
        case ENODEV:
        case ENXIO:
            return fmt::format(
                "{} does not exist, or has no card behind it. Check with 'ls /dev/uio*' or 'lspci -v', and load the "
                "card's driver (for UIO: modprobe uio_pci_generic and bind the card to it).",
                path);
        case EACCES:
            return fmt::format(
                "User {} may not read and write {}. Grant access with a udev rule or chgrp and chmod g+rw; "
                "files of PCI regions and /dev/port belong to root.",
                ::geteuid(), path);
        case EPERM:
            return fmt::format(
                "The kernel does not allow {} to be opened. With Secure Boot it is locked down and blocks access to "
                "cards in this way; UIO still works.",
                path);
        case EISDIR:
            return fmt::format("{} is a folder, not a file.", path);
        case EBUSY:
            return fmt::format("{} is in use by a driver of the kernel. Unbind the card from it first.", path);
        default:
            return fmt::format("{} cannot be opened: {}.", path, std::strerror(error));
    }
}

}  // namespace

Result<File> File::open(const std::string& path, int flags) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY | flags);
    if (descriptor < 0) return fail(ErrorKind::io, sentence(path, errno) + " Nothing was opened.");
    return File(descriptor);
}

/// A lock of the open file, not of the process: it persists when another descriptor of the same file is closed.
Result<void> File::keep(std::uint64_t from, std::uint64_t length, const std::string& named) const {
    struct flock range {};
    range.l_type = F_WRLCK;
    range.l_whence = SEEK_SET;
    range.l_start = static_cast<off_t>(from);
    range.l_len = static_cast<off_t>(length);
    if (::fcntl(descriptor_, F_OFD_SETLK, &range) == 0) return {};
    if (errno == EAGAIN || errno == EACCES)
        return fail(ErrorKind::refused,
                    fmt::format("The card at {} is already open in this or another program: two writers would disturb "
                                "each other. Nothing was opened. Close it there first.",
                                named));
    return fail(ErrorKind::io, fmt::format("{} cannot be locked against other programs: {}. Nothing was opened.", named,
                                           std::strerror(errno)));
}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace motionrack::live
