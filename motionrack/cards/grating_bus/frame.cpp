// Computes the CRC of frames and compares frames.
#include <zlib.h>

#include <algorithm>
#include <motionrack/cards/grating_bus/frame.hpp>

namespace motionrack::grating_bus {

namespace {

/// Appends the low `bytes` bytes of `value`, low byte first.
std::uint8_t* put(std::uint8_t* at, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) *at++ = static_cast<std::uint8_t>(value >> (8 * i));
    return at;
}

}  // namespace

std::uint32_t crc_of(const Frame& frame) {
    MOTIONRACK_ASSERT(frame.words <= max_scales);
    std::array<std::uint8_t, 14 + 5 * max_scales> bytes;
    std::uint8_t* at = put(bytes.data(), frame.sequence, 4);
    at = put(at, static_cast<std::uint64_t>(frame.time), 8);
    at = put(at, frame.words, 2);
    for (std::uint32_t k = 0; k < frame.words; ++k) {
        at = put(at, frame.addresses[k], 1);
        at = put(at, frame.counts[k], 4);
    }
    return static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(at - bytes.data())));
}

bool sound(const Frame& frame) {
    if (frame.words < 1 || frame.words > max_scales) return false;
    const auto end = frame.addresses.begin() + frame.words;
    return std::all_of(frame.addresses.begin(), end, [](std::uint8_t address) { return address < max_scales; }) &&
           frame.crc == crc_of(frame);
}

bool same(const Frame& a, const Frame& b) {
    return a.time == b.time && a.sequence == b.sequence && a.words == b.words &&
           std::equal(a.positions().begin(), a.positions().end(), b.positions().begin()) &&
           std::equal(a.addresses.begin(), a.addresses.begin() + a.words, b.addresses.begin());
}

std::optional<std::uint32_t> word_of(const Frame& frame, std::uint64_t address) {
    const auto end = frame.addresses.begin() + frame.words;
    const auto found = std::find(frame.addresses.begin(), end, address);
    if (found == end) return std::nullopt;
    return static_cast<std::uint32_t>(found - frame.addresses.begin());
}

}  // namespace motionrack::grating_bus
