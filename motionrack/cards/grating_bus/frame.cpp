// The frame's CRC and comparisons.
#include <zlib.h>

#include <algorithm>
#include <motionrack/cards/grating_bus/frame.hpp>

namespace motionrack::grating_bus {

namespace {

/// Appends the low `bytes` bytes of `value`, the low one first.
std::uint8_t* put(std::uint8_t* at, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) *at++ = static_cast<std::uint8_t>(value >> (8 * i));
    return at;
}

}  // namespace

std::uint32_t crc_of(const Frame& frame) {
    MOTIONRACK_ASSERT(frame.words <= most_scales);
    std::array<std::uint8_t, 14 + 4 * most_scales> bytes;
    std::uint8_t* at = put(bytes.data(), frame.sequence, 4);
    at = put(at, static_cast<std::uint64_t>(frame.time), 8);
    at = put(at, frame.words, 2);
    for (const std::uint32_t count : frame.positions()) at = put(at, count, 4);
    return static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(at - bytes.data())));
}

bool sound(const Frame& frame) {
    return frame.words >= 1 && frame.words <= most_scales && frame.crc == crc_of(frame);
}

bool same(const Frame& a, const Frame& b) {
    return a.time == b.time && a.sequence == b.sequence && a.words == b.words &&
           std::equal(a.positions().begin(), a.positions().end(), b.positions().begin());
}

}  // namespace motionrack::grating_bus
