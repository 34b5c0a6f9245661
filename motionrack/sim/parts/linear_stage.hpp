// A stage on a linear motor with a current amplifier: the voltage sets a force, which accelerates the mass.
//
//   volts x accel_per_volt --top_accel--> / (1 + load) --(- friction)--> acceleration
//       --(saturation_velocity, ends of travel)--> position
//
//   pos.  ^            .--'      Between two changes of the voltage the position is one parabola; with viscous friction
//         |         .-'          it is a sequence of parabolas of a tenth of a millisecond each, with the friction of
//         |  _ . -'              the mean velocity (implicit midpoint).
//         +------------> time
//
//   A parabola is in whole numbers: position, velocity and acceleration in 2^-68 of a count, time in ticks of 0.1 ns.
//   So a position is exact at every tick, independent of the queries, and never moves back within a parabola.
//
// The position's count is 1/1024 nm: fine enough for any scale on it.
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

/// Counts of a stage's position per nanometre.
inline constexpr std::int64_t places_per_nm = 1024;

struct LinearStageSettings {
    double accel_per_volt = 5;        ///< m/s2 per volt, > 0, at most 1000; without load
    double current_limit_accel = 50;  ///< m/s2, > 0, at most 1000: at the current limit; without load
    double saturation_velocity = 2;   ///< m/s, > 0, at most 10: limit by the amplifier's voltage
    double viscous_friction = 0;      ///< 1/s, 0 .. 100: deceleration proportional to the velocity, m/s2 per m/s
    double coulomb_friction =
        0;  ///< m/s2, 0 .. 1000: deceleration by dry friction; a smaller force does not move the stage
    double load_mass_ratio = 0;        ///< 0 .. 1000: mass on the stage relative to its own
    double start_nm = 0;               ///< initial position, within the ends
    double hard_stop_minus_nm = -1e9;  ///< ends of travel, -1e10 .. 1e10
    double hard_stop_plus_nm = 1e9;
};

class LinearStage final : public sim::DeferringDevice, public sim::PositionFunction {
  public:
    /// Adds the device `name` and its wire NAME.drive (level in uV), or `wire`, to the kernel before it starts.
    LinearStage(sim::Kernel& kernel, const std::string& name, const LinearStageSettings& settings,
                const std::string& wire = {});

    // ---- the position, 1/1024 nm
    std::int64_t count(Instant t) const override;
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(sim::PositionListener& listener) override;
    void watch_rate(double rate) override;
    void set_edge_listener(sim::EdgeListener* listener) override;
    void deliver_edges() override { hand_over(kernel_.now()); }

    /// Position in nm with its fraction; m/s; m/s2.
    double position_nm(Instant t) const;
    double velocity(Instant t) const;
    double accel() const;
    double volts() const { return static_cast<double>(state_.microvolts) * 1e-6; }
    /// End of travel at which the stage is stationary, +1 or -1; 0: none.
    int blocked() const { return state_.blocked; }
    sim::WireId drive_wire() const { return drive_; }
    sim::DeviceId id() const { return id_; }
    const LinearStageSettings& settings() const { return settings_; }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    void sync(Instant now) override { hand_over(now); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    /// motor.stall: blocked while not 0; motor.push n: moved by n nm by hand; motor.friction x: x m/s2 more dry
    /// friction; motor.load x: mass on the stage relative to its own.
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    static constexpr int slots = sim::PositionFunction::max_listeners;
    struct State {
        Wide position = 0;            ///< at `since`
        Wide velocity = 0;            ///< per tick, at `since`
        std::int64_t half_accel = 0;  ///< half of the acceleration, per tick squared
        Instant since{};
        std::int64_t length = 0;  ///< ticks for which the parabola is valid; `endless`
        Instant handed{};
        double reported = 0;  ///< the rate last sent to listeners
        double load = 0;
        double rubbing = 0;  ///< m/s2, by the fault
        sim::Listeners::Watches watches{};
        std::int32_t microvolts = 0;
        std::int32_t blocked = 0;
        std::int32_t held = 0;
        std::int32_t reserved[3] = {};
    };

    Wide position_at(Instant t) const { return place_after((t - state_.since).count()); }
    Wide place_after(std::int64_t ticks) const {
        return state_.position + ticks * (state_.velocity + Wide{state_.half_accel} * ticks);
    }
    Wide velocity_at(Instant t) const {
        return state_.velocity + 2 * Wide{state_.half_accel} * (t - state_.since).count();
    }
    int direction() const;
    void move_to(Instant now);
    void begin_law();
    std::int64_t accel_law(double push, int direction) const;
    std::int64_t law_length() const;
    void change(Instant now);
    void notify(double before, Instant now);
    bool meet_ends(Instant now);
    Instant law_end() const;
    Instant reaches(std::int64_t count) const;
    std::int64_t guess(Wide distance, std::int64_t last) const;
    Instant next(Instant now) const;
    void reschedule() { kernel_.schedule(id_, next(kernel_.now())); }
    void hand_over(Instant now);

    sim::Kernel& kernel_;
    LinearStageSettings settings_;
    Wide saturation_velocity_ = 0;
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
