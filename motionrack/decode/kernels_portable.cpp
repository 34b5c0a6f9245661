// The decoder's inner loops over 64-bit words, for every CPU.
#include <bit>
#include <cstring>
#include <motionrack/decode/kernels.hpp>

namespace motionrack::decode {

namespace {

Sums tally(const std::uint64_t* a, const std::uint64_t* b, std::size_t words, Levels before) {
    Sums sums;
    for (std::size_t w = 0; w < words; ++w) {
        const WordMasks masks = masks_of(a[w], b[w], before);
        sums.up += static_cast<std::uint64_t>(std::popcount(masks.up));
        sums.down += static_cast<std::uint64_t>(std::popcount(masks.down));
        sums.illegal += static_cast<std::uint64_t>(std::popcount(masks.illegal));
        before = {a[w] >> 63, b[w] >> 63};
    }
    return sums;
}

/// Eight bytes as a number whose lowest byte is the first of them.
std::uint64_t load_eight(const std::uint8_t* bytes) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes, 8);
    if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
    return eight;
}

void split(const std::uint8_t* bytes, std::size_t words, int bit, std::uint64_t* plane) {
    for (std::size_t w = 0; w < words; ++w) {
        std::uint64_t word = 0;
        for (int i = 0; i < 8; ++i) {
            // The product brings bit 0 of byte k to bit 56 + k.
            const std::uint64_t ones = load_eight(bytes + 64 * w + 8 * i) >> bit & 0x0101010101010101U;
            word |= (ones * 0x0102040810204080U >> 56) << (8 * i);
        }
        plane[w] = word;
    }
}

void split_pair(const std::uint8_t* bytes, std::size_t words, Bits bits, std::uint64_t* a, std::uint64_t* b) {
    split(bytes, words, bits.a, a);
    split(bytes, words, bits.b, b);
}

bool steady(const std::uint8_t* bytes, std::size_t words, std::uint8_t mask, std::uint8_t level) {
    std::uint64_t other = 0;
    for (std::size_t i = 0; i < 64 * words; i += 8) other |= load_eight(bytes + i) ^ level * 0x0101010101010101U;
    return (other & mask * 0x0101010101010101U) == 0;
}

void four(const std::uint8_t* bytes, std::size_t words, const std::array<Bits, 4>& bits, std::uint8_t before,
          std::array<Sums, 4>& sums) {
    static constexpr std::size_t piece = 64;
    std::array<std::uint64_t, piece> a, b;
    for (std::size_t done = 0; done < words; done += piece) {
        const std::size_t size = words - done < piece ? words - done : piece;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const Bits& at = bits[channel];
            split_pair(bytes + 64 * done, size, at, a.data(), b.data());
            sums[channel] += tally(a.data(), b.data(), size, {before >> at.a & 1U, before >> at.b & 1U});
        }
        before = bytes[64 * (done + size) - 1];
    }
}

}  // namespace

const Kernels& portable_kernels() {
    static constexpr Kernels kernels{"portable", tally, split, split_pair, steady, four};
    return kernels;
}

}  // namespace motionrack::decode
