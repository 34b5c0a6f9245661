// Opening files of cards.
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
                "There is no {}, or no card behind it. Look with 'ls /dev/uio*' or 'lspci -v', and load the card's "
                "driver (for UIO: modprobe uio_pci_generic and bind the card to it).",
                path);
        case EACCES:
            return fmt::format(
                "User {} may not read and write {}. Give the right to it with a udev rule or chgrp and chmod g+rw; "
                "files of PCI regions and /dev/port belong to root.",
                ::geteuid(), path);
        case EPERM:
            return fmt::format(
                "The kernel does not allow {} to be opened. With Secure Boot it is locked down and lets no program "
                "reach cards like this; UIO still works.",
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
    if (descriptor < 0) return fail(Trouble::io, sentence(path, errno) + " Nothing was opened.");
    return File(descriptor);
}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace motionrack::live
