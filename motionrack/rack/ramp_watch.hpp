// Detects axes whose pulses end without a ramp after a stop, which may cause step loss.
//
//   armed                     a stop comes into force        the driver has seen all axes at standstill
//     │     every millisecond        │                              │
//     ▼                              ▼                              ▼
//   windows of 1 to 8 ms, and the rate before a standstill: see JumpLaw ──► instant of the last velocity step of each
//   axis ──► an axis that jumped
//
// A card that stops on a command or at a limit switch decelerates with a ramp. A chip that follows a path by segments
// ends its pulses at the end of the current one, at any velocity. A card may stop before its driver knows, and without
// a stop in force, where a switch was active before the motion began: see look_back().
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
    /// Call when the rack has all its axes, before it starts.
    explicit RampWatch(Rack& rack);

    /// Records the recent motion of the axes from this instant.
    void arm(Instant now);
    /// Call when a stop comes into force.
    void begin(Instant now) { state_.since = now; }
    /// Call between runs when all axes are at standstill. Ends the watch until arm(); a second call has no effect.
    void settle();
    /// Call in place of begin() and settle() when a card has stopped the axes by itself. Also detects velocity steps of
    /// the last `looks_back`.
    void look_back(Instant now);
    /// Call when no stop is in force or expected.
    void end();
    /// Returns true if axis `axis` (0 .. 5) had a velocity step after begin().
    bool has_jumped(int axis) const { return state_.jumped[static_cast<std::size_t>(axis)] > state_.since; }

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    static constexpr Duration period = milliseconds(1), looks_back = whole_seconds(2);
    static constexpr std::size_t counts_kept = 2 * (JumpLaw::max_window / period) + 1;
    /// An axis moved by pulses, with a velocity step limit.
    struct SteppedAxis {
        std::size_t axis = 0;  ///< index in Rack::axes()
        JumpLaw law;
    };
    struct State {
        std::int64_t watches = 0;
        Instant since = never;  ///< earlier velocity steps are ignored
        std::array<std::array<std::int64_t, counts_kept>, control::axis_count> counts{};  ///< newest last
        std::array<double, control::axis_count> rates{};             ///< pulses/s at the last sample
        std::array<std::int64_t, control::axis_count> rest_looks{};  ///< samples with a rate of 0, up to the last one
        std::array<Instant, control::axis_count> rests_from{};       ///< the first of them
        std::array<double, control::axis_count> ended_hz{};          ///< highest rate possible before the first of them
        /// One tick after the last velocity step of each axis; 0: none.
        std::array<Instant, control::axis_count> jumped{};
    };
    std::int64_t count_of(std::size_t i, Instant now) const;
    double rate_of(std::size_t i, Instant now) const;
    void keep(std::size_t i, std::int64_t count);
    bool ends_abruptly(std::size_t i, Instant now);
    void judge(std::size_t i, Instant now);

    Rack& rack_;
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<SteppedAxis> watched_;  ///< same order as state_.counts
    State state_;
};

}  // namespace motionrack::rack
