// Window of the last 64 sequence numbers, with a bit for each received one: distinguishes a late frame from a
// duplicate.
#pragma once

#include <cstdint>

namespace motionrack::dds {

class SequenceWindow {
  public:
    void begin(std::uint32_t sequence) {
        newest_ = sequence;
        seen_ = 1;
        span_ = 1;
    }
    /// Adds `sequence`, which is `ahead` (1 .. 2^31 - 1) numbers after the newest one.
    void advance(std::uint32_t ahead) {
        newest_ += ahead;
        seen_ = ahead < 64 ? seen_ << ahead | 1 : 1;
        span_ = ahead < 64 && span_ + ahead < 64 ? span_ + ahead : 64;
    }
    /// Marks the number `behind` (0 .. 2^31) numbers before the newest as received; returns true if the window has it
    /// as missing.
    bool fill(std::uint32_t behind) {
        if (behind >= span_) return false;
        const std::uint64_t bit = std::uint64_t{1} << behind;
        const bool missing = (seen_ & bit) == 0;
        seen_ |= bit;
        return missing;
    }
    /// Returns true if the number `behind` numbers before the newest is in the window.
    bool knows(std::uint32_t behind) const { return behind < span_; }
    std::uint32_t newest() const { return newest_; }

  private:
    std::uint32_t newest_ = 0;
    std::uint64_t seen_ = 0;
    std::uint32_t span_ = 0;  ///< sequence numbers in the window: those since begin(), at most 64
};

}  // namespace motionrack::dds
