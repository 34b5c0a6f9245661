// A DC motor with tachometer on a servo amplifier: the velocity follows the voltage with a lag, within the limits of
// current and load.
//
//   volts --dead band--> x gain --saturation--> commanded velocity -(current limit)-> torque -(inertia, friction)--> v
//                                                   ^------------- tachometer ------------------------------------'
//
//   v     ^        ______ commanded       ramp: the current is at its limit, the velocity v rises linearly
//         |     .-'                       lag: the remaining change, 1/e of it each `lag`
//         |    /                          stop: the same downwards; friction ends it, so the rotor reaches standstill
//         +---/--------------> time       after a finite time
//
// Between two changes of the voltage there are at most a ramp, a lag and a standstill; each is a closed form of time.
// The rotor is evaluated at every whole microsecond of a law.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <motionrack/sim/position_function.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::parts {

/// Settings of the amplifier and the unloaded motor; counts are those of the rotor's encoder.
struct DcMotorSettings {
    double gain = 10'000;                  ///< > 0: counts/s per volt
    double saturation_velocity = 100'000;  ///< > 0, at most 1e6: counts/s; saturation of the amplifier
    double current_limit_accel = 2e6;      ///< counts/s2 at the current limit; greater than the friction
    double time_constant_s = 0.01;         ///< 0.0001 .. 10: time constant of the velocity
    double coulomb_friction = 20'000;      ///< counts/s2, >= 0: deceleration without current
    double dead_band_v = 0.005;     ///< V, 0 .. 5: smaller voltages have no effect; larger ones are reduced by it
    double load_inertia_ratio = 0;  ///< 0 .. 1000: inertia of the load relative to the motor
    std::optional<std::int64_t> end_minus{};  ///< counts of the end of travel; 0 lies between the ends
    std::optional<std::int64_t> end_plus{};
};

/// One section of motion, times in seconds from its start.
struct DcMotorModel {
    double velocity0 = 0;  ///< counts/s at the start
    double aim = 0;        ///< lag: the velocity that it approaches; ramp: counts/s2
    double lag = 0;        ///< s; 0: a ramp
    double end = 0;        ///< s; the law is valid up to here, `endless`: without limit
    double after = 0;      ///< velocity at the end
    static constexpr double endless = 1e9;

    double travel(double seconds) const;
    double velocity(double seconds) const;
    /// Direction of motion: +1, -1, or 0 at standstill.
    int direction() const;
};

class DcMotor final : public sim::DeferringDevice, public sim::PositionFunction {
  public:
    /// Adds the device `name` and its wire NAME.drive (level in uV), or `wire`, to the kernel before it starts.
    DcMotor(sim::Kernel& kernel, const std::string& name, const DcMotorSettings& settings,
            const std::string& wire = {});

    // ---- the rotor
    std::int64_t count(Instant t) const override;
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(sim::PositionListener& listener) override;
    void set_edge_listener(sim::EdgeListener* listener) override;
    void deliver_edges() override { hand_over(kernel_.now()); }

    /// The rotor in counts, with its fraction.
    double position(Instant t) const;
    /// Output of the tachometer, as a part of the saturation velocity.
    double tacho(Instant t) const { return rate(t) / settings_.saturation_velocity; }
    /// End of travel at which the rotor is stationary, +1 or -1; 0: none.
    int blocked() const { return state_.blocked; }
    double volts() const { return state_.volts; }
    sim::WireId drive_wire() const { return drive_; }
    sim::DeviceId id() const { return id_; }
    const DcMotorSettings& settings() const { return settings_; }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    void sync(Instant now) override { hand_over(now); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    /// motor.load x: inertia of the load; motor.stall: blocked while not 0; motor.push n: moved by n counts by hand.
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    struct State {
        std::int64_t base = 0;  ///< counts at `since`
        double part = 0.5;      ///< fraction of a count, at `since`
        Instant since{};
        DcMotorModel law;
        double volts = 0;
        double load = 0;
        double reported = 0;  ///< the rate last sent to listeners
        Instant handed{};
        sim::Listeners::Watches watches{};
        std::int32_t blocked = 0;
        std::int32_t held = 0;
    };

    double seconds(Instant t) const;
    double wanted_velocity() const;
    DcMotorModel law_from(double velocity) const;
    void begin_law(double velocity, Instant now);
    void change(Instant now);
    void notify(double before, Instant now);
    bool meet_ends(Instant now);
    Instant law_end() const;
    Instant reaches(std::int64_t count) const;
    Instant next(Instant now) const;
    void reschedule() { kernel_.schedule(id_, next(kernel_.now())); }
    void hand_over(Instant now);

    sim::Kernel& kernel_;
    DcMotorSettings settings_;
    sim::DeviceId id_{};
    sim::WireId drive_{};
    State state_{};
    sim::Listeners listeners_;
    sim::EdgeListener* edges_ = nullptr;
    sim::EdgeBatch batch_{};
};

}  // namespace motionrack::parts
