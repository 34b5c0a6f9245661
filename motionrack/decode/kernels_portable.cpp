// Inner loops of the decoder over 64-bit words, for every CPU.
#include <bit>
#include <cstring>
#include <motionrack/decode/kernels.hpp>

namespace motionrack::decode {

namespace {

QuadratureCounts tally(const std::uint64_t* a, const std::uint64_t* b, std::size_t words, Levels before) {
    QuadratureCounts sums;
    for (std::size_t w = 0; w < words; ++w) {
        const WordMasks masks = masks_of(a[w], b[w], before);
        sums.up += static_cast<std::uint64_t>(std::popcount(masks.up));
        sums.down += static_cast<std::uint64_t>(std::popcount(masks.down));
        sums.illegal += static_cast<std::uint64_t>(std::popcount(masks.illegal));
        before = {a[w] >> 63, b[w] >> 63};
    }
    return sums;
}

/// Eight bytes as a number, the first byte lowest.
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

/// Four sums in the pairs of bits of each byte, added up in wider fields before they can overflow.
class PairSums {
  public:
    /// `ones`: bits 0, 2, 4, 6 of each byte.
    void add(std::uint64_t ones) {
        pairs_ += ones;
        if (++added_ == 3) widen();
    }
    std::array<std::uint64_t, 4> take() {
        widen();
        flush();
        return sums_;
    }

  private:
    static constexpr std::uint64_t low_pairs = 0x3333333333333333U, low_halves = 0x0F0F0F0F0F0F0F0FU,
                                   low_bytes = 0x00FF00FF00FF00FFU;

    void widen() {
        even_ += pairs_ & low_pairs, odd_ += pairs_ >> 2 & low_pairs;
        pairs_ = 0, added_ = 0;
        if (++widened_ == 5) to_bytes();
    }
    void to_bytes() {
        bytes_[0] += even_ & low_halves, bytes_[2] += even_ >> 4 & low_halves;
        bytes_[1] += odd_ & low_halves, bytes_[3] += odd_ >> 4 & low_halves;
        even_ = odd_ = 0, widened_ = 0;
        if (++filled_ == 17) flush();
    }
    void flush() {
        if (widened_ > 0) to_bytes();
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint64_t words = (bytes_[i] & low_bytes) + (bytes_[i] >> 8 & low_bytes);
            sums_[i] += words * 0x0001000100010001U >> 48;
            bytes_[i] = 0;
        }
        filled_ = 0;
    }

    std::uint64_t pairs_ = 0, even_ = 0, odd_ = 0;
    std::array<std::uint64_t, 4> bytes_{}, sums_{};
    unsigned added_ = 0, widened_ = 0, filled_ = 0;
};

constexpr std::uint64_t lines_a = 0x5555555555555555U;

/// Channels in bits 0 1, 2 3, 4 5, 6 7 need no planes: the neighbouring byte is the previous sample.
void four_in_order(const std::uint8_t* bytes, std::size_t words, std::uint8_t before,
                   std::array<QuadratureCounts, 4>& sums) {
    PairSums ups, ones, illegals;
    std::uint64_t last = before;
    for (std::size_t i = 0; i < 8 * words; ++i) {
        const std::uint64_t lines = load_eight(bytes + 8 * i), earlier = lines << 8 | last;
        const std::uint64_t changed = lines ^ earlier, other = changed >> 1;
        const std::uint64_t one = (changed ^ other) & lines_a, illegal = changed & other & lines_a;
        ones.add(one);
        ups.add(one & (lines ^ earlier >> 1));
        if (illegal != 0) illegals.add(illegal);
        last = lines >> 56;
    }
    const auto up = ups.take(), one = ones.take(), illegal = illegals.take();
    for (std::size_t channel = 0; channel < 4; ++channel)
        sums[channel] += {up[channel], one[channel] - up[channel], illegal[channel]};
}

void four(const std::uint8_t* bytes, std::size_t words, const std::array<Bits, 4>& bits, std::uint8_t before,
          std::array<QuadratureCounts, 4>& sums) {
    bool in_order = true;
    for (int channel = 0; channel < 4; ++channel) {
        const Bits& at = bits[static_cast<std::size_t>(channel)];
        in_order = in_order && at.a == 2 * channel && at.b == 2 * channel + 1;
    }
    if (in_order) return four_in_order(bytes, words, before, sums);
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
