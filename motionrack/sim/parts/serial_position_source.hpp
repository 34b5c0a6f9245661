// A source of position words for a card's serial input: samples a conveyor periodically and sends the words with a
// delay.
//
//   sample at n * period ──► delay ──► word complete      one axis: 32 bits; two axes: X low, Y high 16 bits
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/conveyor.hpp>
#include <span>

namespace motionrack::parts {

struct SerialPositionSettings {
    double bits_per_mm = 1000;  ///< resolution, +-1e-6 .. 1e9; for a rotary table: bits per degree
    double period_us = 10;      ///< between samples, 1 .. 1e6
    double delay_us = 0;        ///< from a sample to its word, 0 .. 1e6
    bool two_axes = false;      ///< X and Y of a belt's motion in one word
};

class SerialPositionSource {
  public:
    /// `track` must outlive the source. Errors: refused for numbers not finite or out of range.
    static Result<SerialPositionSource> make(const Conveyor& track, const SerialPositionSettings& settings);
    /// Writes the latest complete word at each tick of 10 us to `out`, from `first_tick` on. Sampling began long before
    /// 0 s.
    void words(std::int64_t first_tick, std::span<std::uint32_t> out) const;
    /// Returns the word of a sample taken at `t_s`.
    std::uint32_t word_at(double t_s) const;
    const SerialPositionSettings& settings() const { return settings_; }

  private:
    const Conveyor* track_ = nullptr;
    SerialPositionSettings settings_;
    double cosine_ = 1, sine_ = 0;
};

}  // namespace motionrack::parts
