// Source of numbers for the cards' fuzzers: a generator with a seed, or the bytes from libFuzzer.
#pragma once

#include <cstdint>
#include <random>
#include <span>

namespace motionrack::fuzz {

class Feed {
  public:
    virtual ~Feed() = default;
    /// Returns the next number of 16 bits.
    virtual std::uint32_t word() = 0;
    virtual bool empty() const = 0;
    /// Returns the next number in 0 .. n - 1.
    std::uint32_t below(std::uint32_t n) { return word() % n; }
};

/// Pseudo-random numbers from a seed; never empty.
class Random final : public Feed {
  public:
    explicit Random(std::uint64_t seed) : random_(seed) {}
    std::uint32_t word() override { return static_cast<std::uint32_t>(random_() & 0xFFFF); }
    bool empty() const override { return false; }

  private:
    std::mt19937_64 random_;
};

/// Two bytes per word, the low one first; 0 beyond the end.
class Bytes final : public Feed {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint32_t word() override {
        const std::uint32_t low = byte();  // in this order on every compiler
        return low | byte() << 8;
    }
    bool empty() const override { return bytes_.empty(); }

  private:
    std::uint32_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint32_t value = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return value;
    }
    std::span<const std::uint8_t> bytes_;
};

}  // namespace motionrack::fuzz
