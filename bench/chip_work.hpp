// Workload of the chip benchmarks: a chip with four axis machines, and drives written to it or to its tick-by-tick
// twin.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <motionrack/cards/mcx314/test/twin_host.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <optional>
#include <string>

namespace motionrack::bench {

inline constexpr unsigned all_axes = 15;

/// Parameters of a drive in register units.
struct Speeds {
    std::int64_t range = 16'000, start = 8'000, speed = 8'000, accel = 400, jerk = 100;
};

/// Writes the parameters to the axes of `mask`; A, D and K differ slightly per axis, so that the velocities step at
/// different ticks.
template <class Host>
void set_speeds(Host& host, const Speeds& speeds, unsigned mask = all_axes) {
    for (unsigned i = 0; i < 4; ++i) {
        const unsigned axis = 1u << i;
        if (!(mask & axis)) continue;
        host.data(axis, 0x00, speeds.range);
        host.data(axis, 0x01, speeds.jerk + 3 * i);
        host.data(axis, 0x02, speeds.accel + 7 * i);
        host.data(axis, 0x03, speeds.accel + 7 * i);
        host.data(axis, 0x04, speeds.start);
        host.data(axis, 0x05, speeds.speed);
        host.data(axis, 0x0D, 0);
    }
}

/// Starts fixed drives of `pulses` by the axes of `mask`; `plus`: direction.
template <class Host>
void drive_fixed(Host& host, std::int64_t pulses, bool plus, unsigned mask = all_axes) {
    host.data(mask, 0x06, pulses);
    host.command(mask, plus ? 0x20 : 0x21);
}

/// A fixed drive from standstill to standstill.
struct Move {
    Speeds speeds;
    std::int64_t pulses = 0;
    bool s_curve = false;
};
// A servo: up to 4 Mpps in 0.16 s (0.32 s), 1 s at that rate. A stepper: up to 40 kpps in 0.30 s, 1 s at that rate.
inline constexpr Move servo{{16'000, 200, 8'000, 400, 100}, 4'500'000, false};
inline constexpr Move servo_s{{16'000, 200, 8'000, 400, 400}, 5'200'000, true};
inline constexpr Move stepper{{800'000, 200, 4'000, 100, 100}, 52'000, false};
inline constexpr Move stepper_s{{800'000, 200, 4'000, 100, 1'600}, 64'000, true};

template <class Host>
void prepare(Host& host, const Move& move, unsigned mask = all_axes) {
    set_speeds(host, move.speeds, mask);
    host.mode(mask, 3, move.s_curve ? 0x0004u : 0u);
}

/// Returns settings of a motor that follows any pulses, with one encoder count per pulse.
inline parts::AxisMechanicsSettings machine_settings() {
    parts::AxisMechanicsSettings settings;
    settings.motor.start_stop_hz = settings.motor.pull_out_hz = 1e8;
    settings.encoder.counts_per_rev = settings.motor.pulses_per_rev();
    return settings;
}

/// An axis machine on each axis of a chip; create before the kernel starts.
class Machines {
  public:
    Machines(sim::Kernel& kernel, const std::string& prefix, mcx314::Chip& chip) {
        for (int a = 0; a < 4; ++a) {
            all_[a] = std::make_unique<parts::AxisMechanics>(kernel, prefix + "xyzu"[a], machine_settings());
            all_[a]->connect(chip.pulses(a));
        }
    }
    sim::PositionFunction& encoder(int axis) { return all_[axis]->encoder(); }

  private:
    std::array<std::unique_ptr<parts::AxisMechanics>, 4> all_;
};

/// A chip, with an axis machine on each axis if `machines`.
class Stage {
  public:
    explicit Stage(bool machines) {
        if (machines) machines_.emplace(host.kernel, "", host.chip);
        host.start();
    }
    void listen(int axis, sim::EdgeListener& listener) { machines_->encoder(axis).set_edge_listener(&listener); }

    /// Runs until no axis drives; polls every 10 ms.
    void finish() {
        while ((host.read(0) & all_axes) != 0) host.advance(milliseconds(10));
    }
    double seconds() const { return to_seconds(host.kernel.now() - Instant{0}); }
    std::int64_t pulses() {
        std::int64_t sum = 0;
        for (int a = 0; a < 4; ++a) sum += host.chip.pulses_made(a);
        return sum;
    }

    mcx314::outside::Bench host;

  private:
    std::optional<Machines> machines_;
};

/// Baseline decoder: each edge separately, through the table of 16 transitions.
class OneByOne final : public sim::EdgeListener {
  public:
    void edges(const sim::EdgeBatch& batch) override {
        constexpr std::int8_t bad = 2;
        static constexpr std::int8_t table[16] = {0, 1, -1, bad, -1, 0, bad, 1, 1, bad, 0, -1, bad, -1, 1, 0};
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            const unsigned lines = sim::lines_of(batch.first_count + batch.step * static_cast<std::int64_t>(i));
            const std::int8_t change = table[lines_ * 4 + lines];
            lines_ = lines;
            if (change == bad)
                ++illegal_;
            else
                count_ += change;
        }
    }
    std::int64_t count() const { return count_; }
    std::uint64_t illegal() const { return illegal_; }

  private:
    std::int64_t count_ = 0;
    std::uint64_t illegal_ = 0;
    unsigned lines_ = 0;
};

}  // namespace motionrack::bench
