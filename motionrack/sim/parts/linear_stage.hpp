// A stage on a linear motor behind a current amplifier: the voltage is a force, the force accelerates the mass.
//
//   volts x accel_per_volt --top_accel--> / (1 + load) --(- friction)--> acceleration
//       --(top_speed, ends of travel)--> place
//
//   place ^            .--'      Between two changes of the voltage the place is one parabola; with viscous friction
//         |         .-'          it is a row of them, each a tenth of a millisecond long, with the friction of the
//         |  _ . -'              mean speed (implicit midpoint).
//         +------------> time
//
//   A parabola is whole numbers: place, speed and acceleration in 2^-68 of a count, time in ticks of 0.1 ns. So a
//   place is exact at every tick, however often it is asked for, and never goes back within a parabola.
//
// The place's count is 1/1024 nm: fine enough for any scale on it.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/edge_batcher.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <motionrack/sim/position_function.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::parts {

/// Counts of a stage's place in a nanometre.
inline constexpr std::int64_t places_per_nm = 1024;

struct LinearStageSettings {
    double accel_per_volt = 5;   ///< m/s2 for a volt, more than 0, at most 1000; of the stage without load
    double top_accel = 50;       ///< m/s2, more than 0, at most 1000: the current limit; of the stage without load
    double top_speed = 2;        ///< m/s, more than 0, at most 10: there the amplifier's voltage is used up
    double viscous = 0;          ///< 1/s, 0 .. 100: the brake grows with the speed, m/s2 for a m/s
    double coulomb = 0;          ///< m/s2, 0 .. 1000: the brake of rubbing parts; what pushes less does not move it
    double load = 0;             ///< 0 .. 1000: mass on the stage in units of its own
    double start_nm = 0;         ///< where it stands at first, within the ends
    double end_minus_nm = -1e9;  ///< ends of travel, -1e10 .. 1e10
    double end_plus_nm = 1e9;
};

class LinearStage final : public sim::DeferringDevice, public sim::PositionFunction {
  public:
    /// Adds the device `name` and its wire NAME.drive (level in uV), or `wire`, to the kernel, before it starts.
    LinearStage(sim::Kernel& kernel, const std::string& name, const LinearStageSettings& settings,
                const std::string& wire = {});

    // ---- the place, 1/1024 nm
    std::int64_t count(Instant t) const override;
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(sim::PositionListener& listener) override;
    void watch_rate(double rate) override;
    void set_edge_listener(sim::EdgeListener* listener) override;
    void deliver_edges() override { hand_over(kernel_.now()); }

    /// The place in nm with its fraction; m/s; m/s2.
    double position_nm(Instant t) const;
    double speed(Instant t) const;
    double accel() const;
    double volts() const { return static_cast<double>(state_.microvolts) * 1e-6; }
    /// +1, -1: stands at that end of travel.
    int blocked() const { return state_.blocked; }
    sim::WireId drive_wire() const { return drive_; }
    sim::DeviceId id() const { return id_; }
    const LinearStageSettings& settings() const { return settings_; }

    /// motor.stall: held fast while not 0; motor.push n: moved by n nm by hand; motor.friction x: x m/s2 more of
    /// rubbing; motor.load x: mass on the stage in units of its own.
    static std::span<const std::string_view> fault_names();

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    void sync(Instant now) override { hand_over(now); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    static constexpr int slots = sim::PositionFunction::max_listeners;
    struct State {
        Wide place = 0;               ///< at `since`
        Wide speed = 0;               ///< a tick, at `since`
        std::int64_t half_accel = 0;  ///< half of it, a tick a tick
        Instant since{};
        std::int64_t length = 0;  ///< ticks for which the parabola holds; `endless`
        Instant handed{};
        double told = 0;  ///< the rate that listeners know
        double load = 0;
        double rubbing = 0;  ///< m/s2, of the fault
        sim::Listeners::Watches watches{};
        std::int32_t microvolts = 0;
        std::int32_t blocked = 0;
        std::int32_t held = 0;
        std::int32_t reserved[3] = {};
    };

    Wide place_at(Instant t) const { return place_after((t - state_.since).count()); }
    Wide place_after(std::int64_t ticks) const {
        return state_.place + ticks * (state_.speed + Wide{state_.half_accel} * ticks);
    }
    Wide speed_at(Instant t) const { return state_.speed + 2 * Wide{state_.half_accel} * (t - state_.since).count(); }
    int direction() const;
    void move_to(Instant now);
    void begin_law();
    std::int64_t accel_law(double push, int direction) const;
    std::int64_t law_length() const;
    void change(Instant now);
    void tell(double before, Instant now);
    bool meet_ends(Instant now);
    Instant law_end() const;
    Instant reaches(std::int64_t count) const;
    std::int64_t guess(Wide way, std::int64_t last) const;
    Instant next(Instant now) const;
    void reschedule() { kernel_.schedule(id_, next(kernel_.now())); }
    void hand_over(Instant now);

    sim::Kernel& kernel_;
    LinearStageSettings settings_;
    Wide top_speed_ = 0;
    std::int64_t end_minus_ = 0;
    std::int64_t end_plus_ = 0;
    sim::DeviceId id_{};
    sim::WireId drive_{};
    State state_{};
    sim::Listeners listeners_;
    std::array<Wide, slots> marks_{};
    int mark_count_ = 0;
    sim::EdgeListener* edges_ = nullptr;
    sim::EdgeBatcher row_;
};

}  // namespace motionrack::parts
