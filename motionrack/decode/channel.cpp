// Sampled lines are divided into chunks that stay in the first-level cache; only a chunk with a rare event is examined
// again.
#include <algorithm>
#include <bit>
#include <cstring>
#include <motionrack/base/result.hpp>
#include <motionrack/decode/channel.hpp>

namespace motionrack::decode {

namespace {

constexpr std::size_t chunk_words = 64;

using Plane = std::array<std::uint64_t, chunk_words>;

/// Returns the word with `size` (1 .. 63) samples, padded with the last one.
std::uint64_t filled(std::uint64_t word, std::size_t size) {
    const std::uint64_t there = (std::uint64_t{1} << size) - 1;
    return (word >> (size - 1) & 1U) != 0 ? word | ~there : word & there;
}

std::uint64_t level(std::uint8_t byte, int bit) {
    return byte >> bit & 1U;
}

}  // namespace

void ChannelDecoder::begin(std::uint64_t a, std::uint64_t b, std::uint64_t z) {
    if (begun_) return;
    begun_ = true;
    last_ = {a, b};
    last_z_ = z;
}

void ChannelDecoder::bytes(const std::uint8_t* samples, std::size_t size, const LineBits& lines) {
    if (size == 0) return;
    for (const int bit : {lines.a, lines.b, lines.z}) MOTIONRACK_ASSERT(bit >= -1 && bit < 8);
    begin(level(*samples, lines.a), level(*samples, lines.b), lines.z < 0 ? 0 : level(*samples, lines.z));
    Plane a, b, z;
    const auto decode = [&](const std::uint8_t* from, std::size_t words, std::size_t count) {
        kernels_->split_pair(from, words, {lines.a, lines.b}, a.data(), b.data());
        const auto mask = static_cast<std::uint8_t>(lines.z < 0 ? 0U : 1U << lines.z);
        const bool quiet =
            lines.z < 0 || kernels_->steady(from, words, mask, static_cast<std::uint8_t>(last_z_ != 0 ? mask : 0));
        if (!quiet) kernels_->split(from, words, lines.z, z.data());
        this->words(a.data(), b.data(), quiet ? nullptr : z.data(), words, count);
    };
    while (size >= 64) {
        const std::size_t words = std::min(size / 64, chunk_words);
        decode(samples, words, words * 64);
        samples += words * 64, size -= words * 64;
    }
    if (size == 0) return;
    std::array<std::uint8_t, 64> rest;
    std::memcpy(rest.data(), samples, size);
    std::memset(rest.data() + size, rest[size - 1], 64 - size);
    decode(rest.data(), 1, size);
}

void ChannelDecoder::planes(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* z, std::size_t size) {
    if (size == 0) return;
    begin(*a & 1U, *b & 1U, z ? *z & 1U : 0);
    std::size_t at = 0;
    while (at < size / 64) {
        const std::size_t words = std::min(size / 64 - at, chunk_words * 8);
        this->words(a + at, b + at, z ? z + at : nullptr, words, words * 64);
        at += words;
    }
    const std::size_t rest = size % 64;
    if (rest == 0) return;
    const std::uint64_t last_a = filled(a[at], rest), last_b = filled(b[at], rest),
                        last_z = z ? filled(z[at], rest) : 0;
    words(&last_a, &last_b, z ? &last_z : nullptr, 1, rest);
}

/// Decodes whole words, of which `size` samples are new.
void ChannelDecoder::words(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* z, std::size_t words,
                           std::size_t size) {
    const QuadratureCounts sums = kernels_->tally(a, b, words, last_);
    if (sums.illegal != 0) find_illegal(a, b, words);
    if (z && index_in(z, words)) find_indexes(a, b, z, words);
    sums_ += sums;
    samples_ += size;
    last_ = {a[words - 1] >> 63, b[words - 1] >> 63};
    if (z) last_z_ = z[words - 1] >> 63;
}

/// Returns true if the index line changes.
bool ChannelDecoder::index_in(const std::uint64_t* z, std::size_t words) const {
    const std::uint64_t steady = 0 - last_z_;
    std::uint64_t changed = 0;
    for (std::size_t w = 0; w < words; ++w) changed |= z[w] ^ steady;
    return changed != 0;
}

void ChannelDecoder::find_illegal(const std::uint64_t* a, const std::uint64_t* b, std::size_t words) {
    Levels before = last_;
    for (std::size_t w = 0; w < words && illegal_samples_.size() < settings_.illegal_kept; ++w) {
        const WordMasks masks = masks_of(a[w], b[w], before);
        if (masks.illegal != 0) keep_illegal(masks.illegal, samples_ + 64 * w);
        before = {a[w] >> 63, b[w] >> 63};
    }
}

/// Words between two index events are counted as usual.
void ChannelDecoder::find_indexes(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* z,
                                  std::size_t words) {
    const auto before = [&](std::size_t w) { return w == 0 ? last_ : Levels{a[w - 1] >> 63, b[w - 1] >> 63}; };
    std::int64_t count = this->count();
    for (std::size_t w = 0, counted = 0; w < words; ++w) {
        const std::uint64_t earlier = z[w] << 1 | (w == 0 ? last_z_ : z[w - 1] >> 63);
        const std::uint64_t edges = settings_.index_low ? ~z[w] & earlier : z[w] & ~earlier;
        if (edges == 0) continue;
        const QuadratureCounts sums = kernels_->tally(a + counted, b + counted, w - counted, before(counted));
        count += static_cast<std::int64_t>(sums.up - sums.down);
        counted = w;
        keep_indexes(edges, masks_of(a[w], b[w], before(w)), count, samples_ + 64 * w);
    }
}

void ChannelDecoder::keep_illegal(std::uint64_t mask, std::uint64_t sample) {
    for (; mask != 0 && illegal_samples_.size() < settings_.illegal_kept; mask &= mask - 1)
        illegal_samples_.push_back(sample + static_cast<std::uint64_t>(std::countr_zero(mask)));
}

/// `count`: before the word, whose first sample is `sample`.
void ChannelDecoder::keep_indexes(std::uint64_t edges, const WordMasks& masks, std::int64_t count,
                                  std::uint64_t sample) {
    indexes_ += static_cast<std::uint64_t>(std::popcount(edges));
    for (; edges != 0 && index_events_.size() < settings_.indexes_kept; edges &= edges - 1) {
        const std::uint64_t first_edge = edges & (0 - edges), until = first_edge | (first_edge - 1);
        index_events_.push_back({sample + static_cast<std::uint64_t>(std::countr_zero(edges)),
                                 count + std::popcount(masks.up & until) - std::popcount(masks.down & until)});
    }
}

void FourChannelDecoder::bytes(const std::uint8_t* samples, std::size_t size) {
    if (size == 0) return;
    if (!begun_) last_ = *samples;
    begun_ = true;
    const std::size_t words = size / 64, rest = size % 64;
    kernels_->four(samples, words, bits_, last_, sums_);
    if (words > 0) last_ = samples[words * 64 - 1];
    if (rest == 0) return;
    std::array<std::uint8_t, 64> filled;
    std::memcpy(filled.data(), samples + words * 64, rest);
    std::memset(filled.data() + rest, filled[rest - 1], 64 - rest);
    kernels_->four(filled.data(), 1, bits_, last_, sums_);
    last_ = filled[rest - 1];
}

}  // namespace motionrack::decode
