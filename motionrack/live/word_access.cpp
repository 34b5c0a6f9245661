// Mapped words are volatile accesses of their own width, so each is one bus cycle. Words of a file are one system call
// each, which is one IN or OUT if the kernel serves I/O ports.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <motionrack/live/file.hpp>
#include <motionrack/live/word_access.hpp>

namespace motionrack::live {

namespace {

constexpr std::uint64_t map_apart = 1ull << 41;  ///< between the locks of two maps: larger than any offset

class MappedWords final : public WordAccess {
  public:
    MappedWords(File file, void* mapping, std::size_t length, std::size_t first, int width)
        : file_(std::move(file)),
          mapping_(mapping),
          length_(length),
          first_(static_cast<volatile std::uint8_t*>(mapping) + first),
          width_(width) {}
    ~MappedWords() override { ::munmap(mapping_, length_); }
    MappedWords(const MappedWords&) = delete;
    MappedWords& operator=(const MappedWords&) = delete;

    int write(std::uint64_t at, std::uint16_t value) override {
        volatile std::uint8_t* const place = first_ + at;
        if (width_ == 16) {
            *reinterpret_cast<volatile std::uint16_t*>(place) = value;
        } else {
            place[1] = static_cast<std::uint8_t>(value >> 8);
            place[0] = static_cast<std::uint8_t>(value & 0xFF);
        }
        return 0;
    }
    int read(std::uint64_t at, std::uint16_t& value) override {
        volatile std::uint8_t* const place = first_ + at;
        if (width_ == 16) {
            value = *reinterpret_cast<volatile std::uint16_t*>(place);
        } else {
            const unsigned high = place[1];
            const unsigned low = place[0];
            value = static_cast<std::uint16_t>(high << 8 | low);
        }
        return 0;
    }
    int write_byte(std::uint64_t at, std::uint8_t value) override { return first_[at] = value, 0; }
    int read_byte(std::uint64_t at, std::uint8_t& value) override { return value = first_[at], 0; }

  private:
    File file_;  ///< holds the lock
    void* mapping_;
    std::size_t length_;
    volatile std::uint8_t* first_;
    int width_;
};

class FileWords final : public WordAccess {
  public:
    FileWords(File file, std::uint64_t first, int width) : file_(std::move(file)), first_(first), width_(width) {}

    int write(std::uint64_t at, std::uint16_t value) override {
        if (width_ == 16) return put(at, &value, 2);
        const std::uint8_t bytes[2] = {static_cast<std::uint8_t>(value & 0xFF), static_cast<std::uint8_t>(value >> 8)};
        if (const int error = put(at + 1, &bytes[1], 1); error != 0) return error;
        return put(at, &bytes[0], 1);
    }
    int read(std::uint64_t at, std::uint16_t& value) override {
        if (width_ == 16) return get(at, &value, 2);
        std::uint8_t low = 0, high = 0;
        if (const int error = get(at + 1, &high, 1); error != 0) return error;
        if (const int error = get(at, &low, 1); error != 0) return error;
        value = static_cast<std::uint16_t>(high << 8 | low);
        return 0;
    }
    int write_byte(std::uint64_t at, std::uint8_t value) override { return put(at, &value, 1); }
    int read_byte(std::uint64_t at, std::uint8_t& value) override { return get(at, &value, 1); }

  private:
    int put(std::uint64_t at, const void* from, std::size_t bytes) {
        return error_of(::pwrite(file_.descriptor(), from, bytes, static_cast<off_t>(first_ + at)), bytes);
    }
    int get(std::uint64_t at, void* to, std::size_t bytes) {
        return error_of(::pread(file_.descriptor(), to, bytes, static_cast<off_t>(first_ + at)), bytes);
    }
    static int error_of(ssize_t done, std::size_t bytes) {
        return done == static_cast<ssize_t>(bytes) ? 0 : done < 0 ? errno : EIO;
    }

    File file_;
    std::uint64_t first_;
    int width_;
};

tl::unexpected<Error> too_short(const PortSpec& spec, std::uint64_t size, std::uint64_t needed) {
    return fail(
        ErrorKind::io,
        fmt::format("{} has {} bytes, but the card's registers end at byte {} (offset {}, stride {}). Check offset and "
                    "stride, or whether it is another region of the card. Nothing was opened.",
                    spec.path, size, needed, spec.offset, spec.stride));
}

Result<std::uint64_t> number_in(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::uint64_t value = 0;
    if (!(file >> std::setbase(0) >> value))
        return fail(ErrorKind::io,
                    fmt::format("{} has no number, so the address of the card's region is unknown. Nothing was opened; "
                                "reload the card's driver.",
                                path.string()));
    return value;
}

Result<std::unique_ptr<WordAccess>> map_words(const PortSpec& spec, File file, std::uint64_t at, std::uint64_t start,
                                              std::uint64_t length) {
    // `start`: possible start of the mapping in the file; `at`: the first register, relative to it.
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t skipped = spec.reach == AddressSpace::uio ? 0 : at / page * page;
    const std::uint64_t mapped = at - skipped + length;
    void* const mapping = ::mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_SHARED, file.descriptor(),
                                 static_cast<off_t>(start + skipped));
    if (mapping == MAP_FAILED) {
        const int error = errno;
        return fail(ErrorKind::io,
                    fmt::format("{} cannot be mapped: {}. {} Nothing was opened.", spec.path, std::strerror(error),
                                error == EPERM ? "The kernel is locked down (Secure Boot); UIO still works."
                                               : "If it is a region of I/O ports, use port: instead."));
    }
    return std::make_unique<MappedWords>(std::move(file), mapping, mapped, at - skipped, spec.width);
}

}  // namespace

Result<UioMap> read_uio_map(const std::filesystem::path& folder, int map) {
    const std::filesystem::path place = folder / "maps" / fmt::format("map{}", map);
    std::error_code ignored;
    if (!std::filesystem::exists(place, ignored))
        return fail(
            ErrorKind::io,
            fmt::format(
                "{} has no map {}: its driver gives interrupts only, or fewer regions. Map the card's PCI region "
                "with memory:.../resourceN and use this node as interrupt=. Nothing was opened.",
                folder.filename().string(), map));
    UioMap out;
    MOTIONRACK_TRY(out.size, number_in(place / "size"));
    MOTIONRACK_TRY(out.offset, number_in(place / "offset"));
    return out;
}

Result<std::unique_ptr<WordAccess>> open_words(const PortSpec& spec, std::uint64_t length) {
    MOTIONRACK_TRY(File file, File::open(spec.path, spec.reach == AddressSpace::port ? 0 : O_SYNC));
    struct stat facts {};
    if (::fstat(file.descriptor(), &facts) != 0)
        return fail(ErrorKind::io,
                    fmt::format("{} gives no information: {}. Nothing was opened.", spec.path, std::strerror(errno)));
    const std::uint64_t needed = spec.offset + length;
    const bool has_size = S_ISREG(facts.st_mode);
    if (has_size && static_cast<std::uint64_t>(facts.st_size) < needed)
        return too_short(spec, static_cast<std::uint64_t>(facts.st_size), needed);
    // Cards at other offsets of the same file (/dev/port, maps of a node) have other locks.
    MOTIONRACK_CHECK(file.keep(static_cast<std::uint64_t>(spec.map) * map_apart + spec.offset, length, spec.path));

    if (spec.reach == AddressSpace::port) {
        // Linux divides every access to its /dev/port into bytes, the low one first.
        if (spec.width == 16 && S_ISCHR(facts.st_mode) && facts.st_rdev == ::makedev(1, 4))
            return fail(
                ErrorKind::refused,
                fmt::format("{} moves single bytes, the low one first, which would execute a command before its axes "
                            "are written. Set width=8 if the card is on its 8-bit bus; a PCI card's 16-bit ports are "
                            "reached by port:/sys/bus/pci/devices/.../resourceN. Nothing was opened.",
                            spec.path));
        return std::make_unique<FileWords>(std::move(file), spec.offset, spec.width);
    }
    if (spec.reach == AddressSpace::memory) return map_words(spec, std::move(file), spec.offset, 0, length);

    const auto folder = std::filesystem::path("/sys/class/uio") / std::filesystem::path(spec.path).filename();
    MOTIONRACK_TRY(const UioMap map, read_uio_map(folder, spec.map));
    if (map.size < needed) return too_short(spec, map.size, needed);
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return map_words(spec, std::move(file), map.offset + spec.offset, static_cast<std::uint64_t>(spec.map) * page,
                     length);
}

}  // namespace motionrack::live
