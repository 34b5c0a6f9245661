// The inner loops of the decoder, once for each kind of CPU; all give the same numbers.
//
// Samples of one line stand in a bit plane: bit i of word w is sample 64 w + i. With the lines one sample earlier (pa,
// pb):
//
//     one = a ^ pa ^ b ^ pb         exactly one line has changed: a count
//     up  = one & (a ^ pb)          A leads B;  the rest of `one` is down
//     illegal = (a ^ pa) & ~one     both have changed
//
// so that a word of 64 samples takes a dozen instructions, and a count is a popcount.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace motionrack::decode {

/// What a stretch of samples counted.
struct Sums {
    std::uint64_t up = 0;
    std::uint64_t down = 0;
    std::uint64_t illegal = 0;
    void operator+=(const Sums& other) { up += other.up, down += other.down, illegal += other.illegal; }
};

/// The levels (0 or 1) of a channel's lines in the sample before a stretch.
struct Levels {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
};

/// Where the two lines of a channel are in a byte: bit numbers 0 .. 7.
struct Bits {
    int a = 0;
    int b = 1;
};

struct Kernels {
    const char* name;
    /// Counts `words` whole words of the planes a and b.
    Sums (*tally)(const std::uint64_t* a, const std::uint64_t* b, std::size_t words, Levels before);
    /// Makes `words` words of a plane from bit `bit` of 64 * `words` bytes.
    void (*split)(const std::uint8_t* bytes, std::size_t words, int bit, std::uint64_t* plane);
    /// The same for two bits at once.
    void (*split_pair)(const std::uint8_t* bytes, std::size_t words, Bits bits, std::uint64_t* a, std::uint64_t* b);
    /// Whether the bits of `mask` are those of `level` in all of 64 * `words` bytes.
    bool (*steady)(const std::uint8_t* bytes, std::size_t words, std::uint8_t mask, std::uint8_t level);
    /// Adds what four channels in 64 * `words` bytes counted; `before` is the byte before the first.
    void (*four)(const std::uint8_t* bytes, std::size_t words, const std::array<Bits, 4>& bits, std::uint8_t before,
                 std::array<Sums, 4>& sums);
};

/// 64 samples; `before`: the sample before them. One bit for each sample that counted up, down, was illegal.
struct WordMasks {
    std::uint64_t up, down, illegal;
};

inline WordMasks masks_of(std::uint64_t a, std::uint64_t b, Levels before) {
    const std::uint64_t pa = a << 1 | before.a, pb = b << 1 | before.b;
    const std::uint64_t one = a ^ pa ^ b ^ pb, up = one & (a ^ pb);
    return {up, one ^ up, (a ^ pa) & ~one};
}

/// In standard C++, for every CPU.
const Kernels& portable_kernels();

/// All that this CPU can run, the fastest last; the portable ones come first.
const std::vector<Kernels>& available_kernels();

/// The fastest of them.
const Kernels& best_kernels();

}  // namespace motionrack::decode
