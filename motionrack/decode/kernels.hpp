// Inner loops of the decoder, one set per kind of CPU; all give the same results.
//
// Samples of one line are a bit plane: bit i of word w is sample 64 w + i. With the lines one sample earlier (pa, pb):
//
//     one = a ^ pa ^ b ^ pb         exactly one line has changed: a count
//     up  = one & (a ^ pb)          A leads B;  the rest of `one` is down
//     illegal = (a ^ pa) & ~one     both have changed
//
// so a word of 64 samples takes a dozen instructions, and a count is a popcount.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace motionrack::decode {

/// Counts of a sequence of samples.
struct QuadratureCounts {
    std::uint64_t up = 0;
    std::uint64_t down = 0;
    std::uint64_t illegal = 0;
    void operator+=(const QuadratureCounts& other) { up += other.up, down += other.down, illegal += other.illegal; }
};

/// Levels (0 or 1) of a channel's lines in the sample before a sequence.
struct Levels {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
};

/// Bit numbers 0 .. 7 of a channel's two lines in a byte.
struct Bits {
    int a = 0;
    int b = 1;
};

struct Kernels {
    const char* name;
    /// Counts `words` whole words of the planes a and b.
    QuadratureCounts (*tally)(const std::uint64_t* a, const std::uint64_t* b, std::size_t words, Levels before);
    /// Extracts `words` words of a plane from bit `bit` of 64 * `words` bytes.
    void (*split)(const std::uint8_t* bytes, std::size_t words, int bit, std::uint64_t* plane);
    /// Extracts the planes of two bits at once.
    void (*split_pair)(const std::uint8_t* bytes, std::size_t words, Bits bits, std::uint64_t* a, std::uint64_t* b);
    /// Returns true if the bits of `mask` equal those of `level` in all of 64 * `words` bytes.
    bool (*steady)(const std::uint8_t* bytes, std::size_t words, std::uint8_t mask, std::uint8_t level);
    /// Adds the counts of four channels in 64 * `words` bytes; `before` is the byte before the first.
    void (*four)(const std::uint8_t* bytes, std::size_t words, const std::array<Bits, 4>& bits, std::uint8_t before,
                 std::array<QuadratureCounts, 4>& sums);
};

/// 64 samples; `before`: the previous sample. One bit for each sample that counted up, down, or was illegal.
struct WordMasks {
    std::uint64_t up, down, illegal;
};

inline WordMasks masks_of(std::uint64_t a, std::uint64_t b, Levels before) {
    const std::uint64_t pa = a << 1 | before.a, pb = b << 1 | before.b;
    const std::uint64_t one = a ^ pa ^ b ^ pb, up = one & (a ^ pb);
    return {up, one ^ up, (a ^ pa) & ~one};
}

/// Returns the kernels in standard C++, for every CPU.
const Kernels& portable_kernels();

/// All variants that this CPU supports, the fastest last; the portable ones come first.
const std::vector<Kernels>& available_kernels();

/// Returns the fastest kernels that this CPU supports.
const Kernels& best_kernels();

}  // namespace motionrack::decode
