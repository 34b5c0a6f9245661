// Inner loops of the decoder for CPUs with AVX-512 as of Ice Lake and Zen 4 (VPOPCNTDQ, VBMI, VBMI2, GFNI): 512 samples
// at once.
#include <motionrack/decode/kernels_x86.hpp>

#if defined(__x86_64__)
#include <immintrin.h>

#endif

namespace motionrack::decode {

#if defined(__x86_64__)

namespace {

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] inline __m512i load(
    const void* at) {
    return _mm512_loadu_si512(at);
}

struct Counters {
    __m512i up, one, illegal;
};

/// Adds the counts of eight words; xb, yb are the words before x, y.
[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] inline void add(
    __m512i x, __m512i xb, __m512i y, __m512i yb, Counters& sums) {
    const __m512i px = _mm512_shldi_epi64(x, xb, 1), py = _mm512_shldi_epi64(y, yb, 1);
    const __m512i changed = _mm512_xor_si512(x, px);
    const __m512i one = _mm512_ternarylogic_epi64(changed, y, py, 0x96);  // changed ^ y ^ py
    const __m512i up = _mm512_ternarylogic_epi64(one, x, py, 0x60);       // one & (x ^ py)
    sums.one = _mm512_add_epi64(sums.one, _mm512_popcnt_epi64(one));
    sums.up = _mm512_add_epi64(sums.up, _mm512_popcnt_epi64(up));
    sums.illegal = _mm512_add_epi64(sums.illegal, _mm512_popcnt_epi64(_mm512_andnot_si512(one, changed)));
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] inline std::uint64_t
sum_of(__m512i words) {
    return static_cast<std::uint64_t>(_mm512_reduce_add_epi64(words));
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] QuadratureCounts tally(
    const std::uint64_t* a, const std::uint64_t* b, std::size_t words, Levels before) {
    if (words == 0) return {};
    Counters sums{_mm512_setzero_si512(), _mm512_setzero_si512(), _mm512_setzero_si512()};
    // The first words, without a previous word in memory: one to eight of them.
    const std::size_t head = (words - 1) % 8 + 1;
    const auto here = static_cast<__mmask8>(0xFFU >> (8 - head));
    const __m512i x = _mm512_maskz_loadu_epi64(here, a), y = _mm512_maskz_loadu_epi64(here, b);
    const std::uint64_t top_a = before.a << 63, top_b = before.b << 63;
    const __m512i up_a_lane = _mm512_setr_epi64(0, 0, 1, 2, 3, 4, 5, 6);
    const __m512i xb = _mm512_mask_mov_epi64(_mm512_permutexvar_epi64(up_a_lane, x), 1,
                                             _mm512_set1_epi64(static_cast<long long>(top_a)));
    const __m512i yb = _mm512_mask_mov_epi64(_mm512_permutexvar_epi64(up_a_lane, y), 1,
                                             _mm512_set1_epi64(static_cast<long long>(top_b)));
    // Missing lanes repeat the last sample of the previous word, so they contain no change.
    const __m512i last_a = _mm512_srai_epi64(_mm512_set1_epi64(static_cast<long long>(a[head - 1])), 63);
    const __m512i last_b = _mm512_srai_epi64(_mm512_set1_epi64(static_cast<long long>(b[head - 1])), 63);
    const auto gone = static_cast<__mmask8>(~here);
    const auto after = static_cast<__mmask8>(gone & ~(1U << head));
    add(_mm512_mask_mov_epi64(x, gone, last_a), _mm512_mask_mov_epi64(xb, after, last_a),
        _mm512_mask_mov_epi64(y, gone, last_b), _mm512_mask_mov_epi64(yb, after, last_b), sums);
    for (std::size_t w = head; w < words; w += 8) add(load(a + w), load(a + w - 1), load(b + w), load(b + w - 1), sums);
    const std::uint64_t up = sum_of(sums.up);
    return {up, sum_of(sums.one) - up, sum_of(sums.illegal)};
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] void split(
    const std::uint8_t* bytes, std::size_t words, int bit, std::uint64_t* plane) {
    const __m512i mask = _mm512_set1_epi8(static_cast<char>(1U << bit));
    for (std::size_t w = 0; w < words; ++w) plane[w] = _mm512_test_epi8_mask(load(bytes + 64 * w), mask);
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] void split_pair(
    const std::uint8_t* bytes, std::size_t words, Bits bits, std::uint64_t* a, std::uint64_t* b) {
    const __m512i mask_a = _mm512_set1_epi8(static_cast<char>(1U << bits.a)),
                  mask_b = _mm512_set1_epi8(static_cast<char>(1U << bits.b));
    for (std::size_t w = 0; w < words; ++w) {
        const __m512i lines = load(bytes + 64 * w);
        a[w] = _mm512_test_epi8_mask(lines, mask_a);
        b[w] = _mm512_test_epi8_mask(lines, mask_b);
    }
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] bool steady(
    const std::uint8_t* bytes, std::size_t words, std::uint8_t mask, std::uint8_t level) {
    const __m512i expected = _mm512_set1_epi8(static_cast<char>(level));
    __m512i other = _mm512_setzero_si512();
    for (std::size_t w = 0; w < words; ++w)
        other = _mm512_ternarylogic_epi64(other, load(bytes + 64 * w), expected, 0xF6);  // other | (lines ^ expected)
    return _mm512_test_epi8_mask(other, _mm512_set1_epi8(static_cast<char>(mask))) == 0;
}

/// Transposes 64 bytes to eight words: lane i is bit order[i] of all bytes. The middle step transposes each 8 x 8 bits
/// with reversed row numbers, hence the first step.
struct Turn {
    __m512i reverse, unit, collect;
};

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] inline Turn turn_of(
    const std::array<Bits, 4>& bits) {
    alignas(64) std::array<std::uint8_t, 64> reverse, collect;
    for (std::size_t i = 0; i < 64; ++i) {
        reverse[i] = static_cast<std::uint8_t>(i ^ 7U);
        const Bits& at = bits[i / 16];
        collect[i] = static_cast<std::uint8_t>(i % 8 * 8 + static_cast<std::size_t>(i / 8 % 2 == 0 ? at.a : at.b));
    }
    return {load(reverse.data()), _mm512_set1_epi64(static_cast<long long>(0x8040201008040201U)), load(collect.data())};
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] inline __m512i turned(
    const Turn& turn, __m512i bytes) {
    const __m512i planes = _mm512_gf2p8affine_epi64_epi8(turn.unit, _mm512_permutexvar_epi8(turn.reverse, bytes), 0);
    return _mm512_permutexvar_epi8(turn.collect, planes);
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] inline __m512i swapped(
    __m512i pairs) {
    return _mm512_shuffle_epi32(pairs, _MM_PERM_BADC);
}

/// Lanes A and B of a channel are adjacent. With them swapped, one & (line ^ other line before) is up in lane A and
/// down in lane B.
[[gnu::target("avx512f,avx512bw,avx512vl,avx512vpopcntdq,avx512vbmi,avx512vbmi2,gfni,popcnt")]] void four(
    const std::uint8_t* bytes, std::size_t words, const std::array<Bits, 4>& bits, std::uint8_t before,
    std::array<QuadratureCounts, 4>& sums) {
    const Turn turn = turn_of(bits);
    __m512i last = turned(turn, _mm512_set1_epi8(static_cast<char>(before)));
    __m512i counts = _mm512_setzero_si512(), illegal = counts;
    for (std::size_t w = 0; w < words; ++w) {
        const __m512i lines = turned(turn, load(bytes + 64 * w));
        const __m512i earlier = _mm512_shldi_epi64(lines, last, 1);
        const __m512i changed = _mm512_xor_si512(lines, earlier), other = swapped(changed);
        const __m512i one = _mm512_xor_si512(changed, other);
        counts = _mm512_add_epi64(counts,
                                  _mm512_popcnt_epi64(_mm512_ternarylogic_epi64(one, lines, swapped(earlier), 0x60)));
        illegal = _mm512_add_epi64(illegal, _mm512_popcnt_epi64(_mm512_and_si512(changed, other)));
        last = lines;
    }
    alignas(64) std::array<std::uint64_t, 8> count, wrong;
    _mm512_store_si512(count.data(), counts);
    _mm512_store_si512(wrong.data(), illegal);
    for (std::size_t i = 0; i < 4; ++i) sums[i] += {count[2 * i], count[2 * i + 1], wrong[2 * i]};
}

constexpr Kernels kernels{"avx512", tally, split, split_pair, steady, four};

}  // namespace

const Kernels* avx512_kernels() {
    const bool able = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vpopcntdq") &&
                      __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2") &&
                      __builtin_cpu_supports("gfni") && __builtin_cpu_supports("popcnt");
    return able ? &kernels : nullptr;
}

#else

const Kernels* avx512_kernels() {
    return nullptr;
}

#endif

}  // namespace motionrack::decode
