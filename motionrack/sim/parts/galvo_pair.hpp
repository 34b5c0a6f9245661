// Two scan mirrors behind a card: actual positions for the commanded ones of every 10 us.
//
//   commanded ──► dead time ──► second-order lag ──► velocity limit ──► position at the end of the 10 us
//
// Ideal mirrors reach at the end of a tick the position commanded at its start: the micro-step takes its 10 us.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <span>

namespace motionrack::parts {

inline constexpr int max_dead_time_us = 10'000;

struct GalvoSettings {
    bool ideal_mirrors = true;
    double dead_time_us = 0;               ///< 0 .. 10000, rounded down to 10 us
    double natural_frequency_hz = 2000;    ///< 10 .. 20000
    double damping_ratio = 0.8;            ///< 0.1 .. 10; 1: no overshoot
    double max_velocity_bits_ms = 800000;  ///< bits/ms, 1 .. 1e9
};

/// Checks the settings. Errors: refused for numbers not finite or out of range.
Result<void> check(const GalvoSettings& settings);

class GalvoPair {
  public:
    /// `settings` must pass check().
    explicit GalvoPair(const GalvoSettings& settings = {});

    /// Computes the mirror positions at the ends of consecutive ticks of 10 us from the commanded ones, bits. The spans
    /// have equal length.
    void run(std::span<const std::int32_t> x, std::span<const std::int32_t> y, std::span<double> to_x,
             std::span<double> to_y);
    /// Sets the mirrors to standstill at (x, y).
    void reset(double x, double y);
    /// Lag of the mirrors in steady motion, us; for the tracking error setting.
    double lag_us() const;

    std::span<std::byte> state() { return std::as_writable_bytes(std::span(mirrors_)); }

  private:
    struct Mirror {
        double position = 0, velocity = 0;  ///< bits, bits/tick
        std::int64_t head = 0;
        std::array<double, max_dead_time_us / 10> late{};  ///< commanded values during the dead time
    };
    double step(Mirror& mirror, double reported) const;

    GalvoSettings settings_;
    std::array<double, 4> over_tick_{};  ///< (position, velocity) relative to the target, one tick later
    double limit_ = 0;                   ///< bits/tick
    std::int64_t dead_ = 0;              ///< ticks
    std::array<Mirror, 2> mirrors_;
};

}  // namespace motionrack::parts
