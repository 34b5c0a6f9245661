// One encoder in sampled lines: counts, illegal transitions and index events, block by block.
//
//     ChannelDecoder x;
//     x.bytes(samples.data(), samples.size(), {0, 1, 2});   // A, B, Z in bits 0, 1, 2 of each byte
//     x.count();                                            // x4; consecutive blocks of any length
//
// A leads B counts up. A simultaneous change of both lines is illegal: it is not counted, and the new levels are kept.
// The first sample only sets the levels. An index event is a rising edge of Z; its count is the one after its own
// sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/decode/kernels.hpp>
#include <vector>

namespace motionrack::decode {

/// Bits of a byte, 0 .. 7; z: -1 without an index line.
struct LineBits {
    int a = 0;
    int b = 1;
    int z = -1;
};

struct ChannelSettings {
    std::size_t illegal_kept = 1000;     ///< number of illegal transitions with stored samples; all are counted
    std::size_t indexes_kept = 100'000;  ///< number of index events with stored samples; all are counted
    bool index_low = false;              ///< Z is active low: its falling edges are the index events
};

struct IndexEvent {
    std::uint64_t sample = 0;
    std::int64_t count = 0;
    friend bool operator==(const IndexEvent&, const IndexEvent&) = default;
};

class ChannelDecoder {
  public:
    explicit ChannelDecoder(const ChannelSettings& settings = {}, const Kernels& kernels = best_kernels())
        : settings_(settings), kernels_(&kernels) {}

    /// Decodes `size` samples, one per byte.
    void bytes(const std::uint8_t* samples, std::size_t size, const LineBits& lines);
    /// Decodes `size` samples as bit planes: bit i of word w is sample 64 w + i; bits after the last one are ignored. z
    /// may be null.
    void planes(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* z, std::size_t size);
    /// Skips `size` samples without a channel: they only advance the sample numbers.
    void skip(std::uint64_t size) { samples_ += size; }

    /// Upward minus downward counts.
    std::int64_t count() const { return static_cast<std::int64_t>(sums_.up - sums_.down); }
    std::uint64_t up() const { return sums_.up; }
    std::uint64_t down() const { return sums_.down; }
    std::uint64_t illegal() const { return sums_.illegal; }
    std::uint64_t indexes() const { return indexes_; }
    std::uint64_t samples() const { return samples_; }
    /// Sample numbers of the first illegal transitions, and the first index events.
    const std::vector<std::uint64_t>& illegal_samples() const { return illegal_samples_; }
    const std::vector<IndexEvent>& index_events() const { return index_events_; }

  private:
    void begin(std::uint64_t a, std::uint64_t b, std::uint64_t z);
    void words(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* z, std::size_t words,
               std::size_t size);
    bool index_in(const std::uint64_t* z, std::size_t words) const;
    void find_illegal(const std::uint64_t* a, const std::uint64_t* b, std::size_t words);
    void find_indexes(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* z, std::size_t words);
    void keep_illegal(std::uint64_t mask, std::uint64_t sample);
    void keep_indexes(std::uint64_t edges, const WordMasks& masks, std::int64_t count, std::uint64_t sample);

    ChannelSettings settings_;
    const Kernels* kernels_;
    bool begun_ = false;
    Levels last_;
    std::uint64_t last_z_ = 0;
    QuadratureCounts sums_;
    std::uint64_t indexes_ = 0;
    std::uint64_t samples_ = 0;
    std::vector<std::uint64_t> illegal_samples_;
    std::vector<IndexEvent> index_events_;
};

/// Four encoders in a byte, two bits each: counts and illegal transitions, without sample numbers.
class FourChannelDecoder {
  public:
    explicit FourChannelDecoder(const std::array<Bits, 4>& bits = {{{0, 1}, {2, 3}, {4, 5}, {6, 7}}},
                                const Kernels& kernels = best_kernels())
        : bits_(bits), kernels_(&kernels) {}

    void bytes(const std::uint8_t* samples, std::size_t size);

    /// `channel`: 0 .. 3.
    std::int64_t count(std::size_t channel) const {
        return static_cast<std::int64_t>(sums_[channel].up - sums_[channel].down);
    }
    const QuadratureCounts& sums(std::size_t channel) const { return sums_[channel]; }

  private:
    std::array<Bits, 4> bits_;
    const Kernels* kernels_;
    bool begun_ = false;
    std::uint8_t last_ = 0;
    std::array<QuadratureCounts, 4> sums_{};
};

}  // namespace motionrack::decode
