// Collects the levels of lines, sample by sample, into bit planes: shared by the text readers.
#pragma once

#include <cstdint>
#include <motionrack/decode/capture.hpp>
#include <vector>

namespace motionrack::decode {

class Sampler {
  public:
    static constexpr std::size_t capacity = 16'384;

    void begin(std::size_t lines) {
        levels_.assign(lines, 0);
        unknown_.assign(lines, 0);
        planes_.assign(lines, std::vector<std::uint64_t>(capacity / 64));
        times_.resize(capacity);
    }
    bool full() const { return size_ == capacity; }
    std::uint64_t samples() const { return before_ + size_; }

    /// Sets the level of a line. Returns true if it changes or is the first one.
    bool set(std::size_t line, bool high, LineFacts& facts) {
        const auto level = static_cast<std::uint8_t>(high);
        const bool first = facts.known_from == LineFacts::never, changed = levels_[line] != level;
        if (first) facts.known_from = samples();
        unknown_[line] = 0;
        levels_[line] = level;
        return first || changed;
    }
    /// Marks a line as X or Z. Returns true if it had a level before.
    bool lose(std::size_t line, LineFacts& facts) {
        const bool fresh = unknown_[line] == 0 && facts.known_from != LineFacts::never;
        unknown_[line] = 1;
        facts.unknown += fresh;
        return fresh;
    }
    /// Adds the present levels of all lines as a sample.
    void take(std::int64_t time) {
        const std::size_t word = size_ / 64, bit = size_ % 64;
        for (std::size_t line = 0; line < levels_.size(); ++line) {
            std::uint64_t& at = planes_[line][word];
            at = (bit == 0 ? 0 : at) | std::uint64_t{levels_[line]} << bit;
        }
        times_[size_++] = time;
    }
    /// Returns the collected samples and starts again; `timed`: with the times.
    void hand_over(SampleBlock& block, bool timed) {
        block = {};
        block.samples = size_;
        for (const auto& plane : planes_) block.planes.push_back(plane.data());
        if (timed) block.times = times_.data();
        before_ += size_;
        size_ = 0;
    }
    std::size_t waiting() const { return size_; }

  private:
    std::vector<std::uint8_t> levels_, unknown_;
    std::vector<std::vector<std::uint64_t>> planes_;
    std::vector<std::int64_t> times_;
    std::size_t size_ = 0;
    std::uint64_t before_ = 0;
};

}  // namespace motionrack::decode
