// Access to words and bytes of a card: in mapped memory, or in a file that takes them one by one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/live/port_spec.hpp>

namespace motionrack::live {

/// One word is one access of 16 bits, or two of 8: the high byte first, because the low byte of a command register
/// executes it.
class WordAccess {
  public:
    virtual ~WordAccess() = default;
    /// `at`: bytes from the first register. Returns 0, or the errno of a refused access.
    virtual int write(std::uint64_t at, std::uint16_t value) = 0;
    virtual int read(std::uint64_t at, std::uint16_t& value) = 0;
    /// One access of 8 bits, whatever the width of words.
    virtual int write_byte(std::uint64_t at, std::uint8_t value) = 0;
    virtual int read_byte(std::uint64_t at, std::uint8_t& value) = 0;
};

/// `length`: bytes from the start of the first register to the end of the last. Errors: io, refused.
Result<std::unique_ptr<WordAccess>> open_words(const PortSpec& spec, std::uint64_t length);

/// A map of a UIO node, as given by its folder in /sys (maps/map0/size and offset).
struct UioMap {
    std::uint64_t size = 0;    ///< bytes of the card's region
    std::uint64_t offset = 0;  ///< bytes from the start of the mapping's first page to the region
};
Result<UioMap> read_uio_map(const std::filesystem::path& folder, int map);

}  // namespace motionrack::live
