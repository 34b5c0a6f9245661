// Whether the pulses of the axes end in a ramp once a stop is in force, or without one: then steps may be lost.
//
//   armed                     a stop comes into force        whoever drives has seen all axes stand
//     │     every millisecond        │                              │
//     ▼                              ▼                              ▼
//   counts of pulses ─────────────── windows of 1 to 8 ms: see JumpLaw ──► an axis whose speed jumped
//
// A card that is told to stop, or does so at a limit switch, brakes with a ramp; but the chip of an MCX314 that follows
// a path ends its pulses where the piece ends that it has begun, however fast it is there.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/move.hpp>
#include <motionrack/rack/breaches.hpp>
#include <motionrack/sim/kernel.hpp>
#include <span>
#include <vector>

namespace motionrack::rack {

class Rack;

class RampWatch final : public sim::Device {
  public:
    /// Of a rack that has all its axes, before it starts.
    explicit RampWatch(Rack& rack);

    /// From now on what the axes did last is known.
    void arm(Instant now);
    /// A stop comes into force.
    void begin() { state_.judges = 1; }
    /// All axes stand. Between runs.
    void settle();
    /// No stop is in force, and none comes.
    void end();
    /// `axis`: 0 .. 5.
    bool has_jumped(int axis) const { return (state_.jumped & 1u << axis) != 0; }

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    static constexpr Duration period = milliseconds(1);
    static constexpr std::size_t counts_kept = 2 * (JumpLaw::max_window / period) + 1;
    /// An axis that pulses move, with a start speed.
    struct Watched {
        std::size_t axis = 0;  ///< of Rack::axes()
        JumpLaw law;
    };
    struct State {
        std::int64_t judges = 0;
        std::array<std::array<std::int64_t, counts_kept>, control::axis_count> counts{};  ///< the newest is the last
        std::uint64_t jumped = 0;                                                         ///< bits: axes
    };
    std::int64_t count_of(std::size_t i, Instant now) const;
    void keep(std::size_t i, std::int64_t count);
    void judge(std::size_t i);

    Rack& rack_;
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<Watched> watched_;  ///< goes with state_.counts
    State state_;
};

}  // namespace motionrack::rack
