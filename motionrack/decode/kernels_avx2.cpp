// Inner loops of the decoder for CPUs with AVX2: 256 samples at once.
#include <motionrack/decode/kernels_x86.hpp>

#if defined(__x86_64__)
#include <immintrin.h>

#endif

namespace motionrack::decode {

#if defined(__x86_64__)

namespace {

[[gnu::target("avx2,popcnt")]] inline __m256i load(const void* at) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(at));
}

/// Ones in each byte.
[[gnu::target("avx2,popcnt")]] inline __m256i ones_of(__m256i bits) {
    const __m256i low = _mm256_set1_epi8(15);
    const __m256i table = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4, 0, 1, 1, 2, 1, 2, 2, 3, 1, 2,
                                           2, 3, 2, 3, 3, 4);
    return _mm256_add_epi8(_mm256_shuffle_epi8(table, _mm256_and_si256(bits, low)),
                           _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi16(bits, 4), low)));
}

[[gnu::target("avx2,popcnt")]] inline std::uint64_t sum_of(__m256i bytes) {
    const __m256i four = _mm256_sad_epu8(bytes, _mm256_setzero_si256());
    const __m128i two = _mm_add_epi64(_mm256_castsi256_si128(four), _mm256_extracti128_si256(four, 1));
    return static_cast<std::uint64_t>(_mm_cvtsi128_si64(two)) + static_cast<std::uint64_t>(_mm_extract_epi64(two, 1));
}

[[gnu::target("avx2,popcnt")]] inline void add_words(const std::uint64_t* a, const std::uint64_t* b, std::size_t words,
                                                     Levels before, QuadratureCounts& sums) {
    for (std::size_t w = 0; w < words; ++w) {
        const WordMasks masks = masks_of(a[w], b[w], before);
        sums.up += static_cast<std::uint64_t>(_mm_popcnt_u64(masks.up));
        sums.down += static_cast<std::uint64_t>(_mm_popcnt_u64(masks.down));
        sums.illegal += static_cast<std::uint64_t>(_mm_popcnt_u64(masks.illegal));
        before = {a[w] >> 63, b[w] >> 63};
    }
}

[[gnu::target("avx2,popcnt")]] QuadratureCounts tally(const std::uint64_t* a, const std::uint64_t* b, std::size_t words,
                                                      Levels before) {
    QuadratureCounts sums;
    if (words == 0) return sums;
    add_words(a, b, 1, before, sums);
    std::size_t w = 1;
    while (w + 4 <= words) {
        // The byte sums can hold 31 vectors of up to 8 ones each.
        const std::size_t end = words - w < 31 * 4 ? w + (words - w) / 4 * 4 : w + 31 * 4;
        __m256i up = _mm256_setzero_si256(), one = up, illegal = up;
        for (; w < end; w += 4) {
            const __m256i x = load(a + w), y = load(b + w);
            const __m256i px = _mm256_or_si256(_mm256_add_epi64(x, x), _mm256_srli_epi64(load(a + w - 1), 63));
            const __m256i py = _mm256_or_si256(_mm256_add_epi64(y, y), _mm256_srli_epi64(load(b + w - 1), 63));
            const __m256i changed = _mm256_xor_si256(x, px);
            const __m256i counts = _mm256_xor_si256(changed, _mm256_xor_si256(y, py));
            one = _mm256_add_epi8(one, ones_of(counts));
            up = _mm256_add_epi8(up, ones_of(_mm256_and_si256(counts, _mm256_xor_si256(x, py))));
            illegal = _mm256_add_epi8(illegal, ones_of(_mm256_andnot_si256(counts, changed)));
        }
        const std::uint64_t ups = sum_of(up);
        sums += {ups, sum_of(one) - ups, sum_of(illegal)};
    }
    add_words(a + w, b + w, words - w, {a[w - 1] >> 63, b[w - 1] >> 63}, sums);
    return sums;
}

/// Shifts 64 bytes left by `shift` (0 .. 7) and returns bit 7 of each: byte i gives bit i of the result.
[[gnu::target("avx2,popcnt")]] inline std::uint64_t plane_of(__m256i first, __m256i second, __m128i shift) {
    const auto low = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_sll_epi16(first, shift)));
    const auto high = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_sll_epi16(second, shift)));
    return std::uint64_t{high} << 32 | low;
}

[[gnu::target("avx2,popcnt")]] void split(const std::uint8_t* bytes, std::size_t words, int bit, std::uint64_t* plane) {
    const __m128i shift = _mm_cvtsi32_si128(7 - bit);
    for (std::size_t w = 0; w < words; ++w) plane[w] = plane_of(load(bytes + 64 * w), load(bytes + 64 * w + 32), shift);
}

[[gnu::target("avx2,popcnt")]] void split_pair(const std::uint8_t* bytes, std::size_t words, Bits bits,
                                               std::uint64_t* a, std::uint64_t* b) {
    const __m128i shift_a = _mm_cvtsi32_si128(7 - bits.a), shift_b = _mm_cvtsi32_si128(7 - bits.b);
    for (std::size_t w = 0; w < words; ++w) {
        const __m256i first = load(bytes + 64 * w), second = load(bytes + 64 * w + 32);
        a[w] = plane_of(first, second, shift_a);
        b[w] = plane_of(first, second, shift_b);
    }
}

[[gnu::target("avx2,popcnt")]] bool steady(const std::uint8_t* bytes, std::size_t words, std::uint8_t mask,
                                           std::uint8_t level) {
    const __m256i expected = _mm256_set1_epi8(static_cast<char>(level));
    __m256i other = _mm256_setzero_si256();
    for (std::size_t i = 0; i < 64 * words; i += 32)
        other = _mm256_or_si256(other, _mm256_xor_si256(load(bytes + i), expected));
    return _mm256_testz_si256(other, _mm256_set1_epi8(static_cast<char>(mask))) != 0;
}

[[gnu::target("avx2,popcnt")]] void four(const std::uint8_t* bytes, std::size_t words, const std::array<Bits, 4>& bits,
                                         std::uint8_t before, std::array<QuadratureCounts, 4>& sums) {
    static constexpr std::size_t piece = 64;
    alignas(32) std::array<std::array<std::uint64_t, piece>, 8> planes;
    for (std::size_t done = 0; done < words; done += piece) {
        const std::size_t size = words - done < piece ? words - done : piece;
        for (std::size_t w = 0; w < size; ++w) {
            __m256i first = load(bytes + 64 * (done + w)), second = load(bytes + 64 * (done + w) + 32);
            for (std::size_t bit = 8; bit-- > 0;) {
                planes[bit][w] = plane_of(first, second, _mm_setzero_si128());
                first = _mm256_add_epi8(first, first), second = _mm256_add_epi8(second, second);
            }
        }
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const Bits& at = bits[channel];
            sums[channel] +=
                tally(planes[static_cast<std::size_t>(at.a)].data(), planes[static_cast<std::size_t>(at.b)].data(),
                      size, {before >> at.a & 1U, before >> at.b & 1U});
        }
        before = bytes[64 * (done + size) - 1];
    }
}

constexpr Kernels kernels{"avx2", tally, split, split_pair, steady, four};

}  // namespace

const Kernels* avx2_kernels() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt") ? &kernels : nullptr;
}

#else

const Kernels* avx2_kernels() {
    return nullptr;
}

#endif

}  // namespace motionrack::decode
