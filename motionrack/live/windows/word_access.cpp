// The PC's I/O ports on Windows, which a program cannot access directly: through a library with the functions of
// InpOut32 (inpoutx64.dll), which includes a kernel driver. port:PATH names that library.
//
//   CardPort ──► WordAccess ──► DlPortWritePortUshort, DlPortReadPortUshort   one IN or OUT of 16 bits
//                 └──► DlPortWritePortUchar, DlPortReadPortUchar     two of 8 bits, the high byte first
#include <fmt/format.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/live/word_access.hpp>

// Calling convention of the library's functions in 32-bit programs; 64-bit programs have only one.
#if defined(__i386__)
#define MOTIONRACK_STDCALL __attribute__((stdcall))
#else
#define MOTIONRACK_STDCALL
#endif

namespace motionrack::live {

namespace {

constexpr std::uint64_t first_of_cards = 0x100;  ///< ports below belong to the mainboard
constexpr std::uint64_t end_of_ports = 0x10000;

/// The library's functions.
struct PortLibrary {
    int(MOTIONRACK_STDCALL* is_open)() = nullptr;
    std::uint16_t(MOTIONRACK_STDCALL* read16)(std::uint16_t port) = nullptr;
    void(MOTIONRACK_STDCALL* write16)(std::uint16_t port, std::uint16_t value) = nullptr;
    std::uint8_t(MOTIONRACK_STDCALL* read8)(std::uint16_t port) = nullptr;
    void(MOTIONRACK_STDCALL* write8)(std::uint16_t port, std::uint8_t value) = nullptr;

    void find_in(LateLibrary& file) {
        file.find("IsInpOutDriverOpen", is_open);
        file.find("DlPortReadPortUshort", read16);
        file.find("DlPortWritePortUshort", write16);
        file.find("DlPortReadPortUchar", read8);
        file.find("DlPortWritePortUchar", write8);
    }
};

class PortWords final : public WordAccess {
  public:
    PortWords(const PortLibrary& library, std::uint64_t first, int width)
        : library_(library), first_(first), width_(width) {}

    int write(std::uint64_t at, std::uint16_t value) override {
        if (width_ == 16) {
            library_.write16(port_of(at), value);
        } else {
            library_.write8(port_of(at + 1), static_cast<std::uint8_t>(value >> 8));
            library_.write8(port_of(at), static_cast<std::uint8_t>(value & 0xFF));
        }
        return 0;
    }
    int read(std::uint64_t at, std::uint16_t& value) override {
        if (width_ == 16) {
            value = library_.read16(port_of(at));
        } else {
            const unsigned high = library_.read8(port_of(at + 1));
            const unsigned low = library_.read8(port_of(at));
            value = static_cast<std::uint16_t>(high << 8 | low);
        }
        return 0;
    }
    int write_byte(std::uint64_t at, std::uint8_t value) override { return library_.write8(port_of(at), value), 0; }
    int read_byte(std::uint64_t at, std::uint8_t& value) override { return value = library_.read8(port_of(at)), 0; }

  private:
    std::uint16_t port_of(std::uint64_t at) const { return static_cast<std::uint16_t>(first_ + at); }

    PortLibrary library_;
    std::uint64_t first_;
    int width_;
};

Result<void> check_ports(const PortSpec& spec, std::uint64_t length) {
    if (spec.offset >= first_of_cards && spec.offset <= end_of_ports && length <= end_of_ports - spec.offset) return {};
    return fail(
        ErrorKind::invalid_input,
        fmt::format("The card's registers are {} bytes from the I/O port {:#x} on (offset, stride), but cards are "
                    "at 0x100 to 0xffff. Nothing was opened. Give the card's first port as offset=, such as "
                    "offset=0x300.",
                    length, spec.offset));
}

}  // namespace

Result<std::unique_ptr<WordAccess>> open_words(const PortSpec& spec, std::uint64_t length) {
    if (spec.reach != AddressSpace::port)
        return fail(
            ErrorKind::refused,
            "uio: and memory: are files of Linux; Windows does not map cards into programs. Nothing was opened. Use "
            "port:inpoutx64.dll,offset=N for a card at I/O ports, or a computer with Linux.");
    MOTIONRACK_CHECK(check_ports(spec, length));
    LateLibrary file(spec.path.c_str());
    PortLibrary library;
    library.find_in(file);
    if (!file.trouble().empty())
        return fail(ErrorKind::io,
                    fmt::format("{} cannot be used: {}. Windows requires a driver for I/O ports, which the library "
                                "InpOut32 provides (inpoutx64.dll, for 32 bits inpout32.dll). Nothing was "
                                "opened. Put that file into the folder of the program, or its full path after port:.",
                                spec.path, file.trouble()));
    if (library.is_open() == 0)
        return fail(
            ErrorKind::io,
            fmt::format("The driver of {} is not running. Nothing was opened. Run InstallDriver.exe, which comes "
                        "with it, once as administrator.",
                        spec.path));
    return std::make_unique<PortWords>(library, spec.offset, spec.width);
}

}  // namespace motionrack::live
