// Mechanics of one axis: motor, transmission, encoder and switches driven by the pulses of a card.
//
//   card's pulses ───────────► Stepper ──rotor()──► Transmission ──► position(t) in mm or degrees
//                               │                   └─► limit_plus, limit_minus, home   (wires)
//                               └─► Encoder ──encoder()────────► card,  enc_z          (lazy wire)
//
// Single pulses cost no time. The machine uses one listener slot of the pulses and watches the nearest position of an
// event: a switch, the index if it has subscribers, an end of travel, a watch on rotor() or encoder(). A step of the
// pulse rate costs one comparison. Edges are generated only for listeners.
#pragma once

#include <array>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/axis_switches.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/edge_output.hpp>
#include <motionrack/sim/parts/encoder.hpp>
#include <motionrack/sim/parts/index_line.hpp>
#include <motionrack/sim/parts/mechanics_faces.hpp>
#include <motionrack/sim/parts/pulse_input.hpp>
#include <motionrack/sim/parts/rotor_strain.hpp>
#include <motionrack/sim/parts/stepper.hpp>
#include <motionrack/sim/parts/transmission.hpp>
#include <motionrack/sim/position_function.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::parts {

/// Positions are in mm (linear) or degrees (rotary), by axle.travel_per_rev.
struct AxisMechanicsSettings {
    StepperSettings motor;
    TransmissionSettings axle;
    EncoderSettings encoder;
    LimitSwitchSettings limit_minus{.position = {}, .side = SwitchSide::at_and_below};
    LimitSwitchSettings limit_plus{.position = {}, .side = SwitchSide::at_and_above};
    LimitSwitchSettings home{.position = {}, .side = SwitchSide::at_and_below};
};

class AxisMechanics final : public sim::Device, private sim::PositionListener {
  public:
    /// Adds the device `name` and its wires to the kernel (before start): NAME.limit_minus, NAME.limit_plus, NAME.home
    /// for existing switches, NAME.enc_z (lazily driven) for an encoder.
    AxisMechanics(sim::Kernel& kernel, const std::string& name, const AxisMechanicsSettings& settings);
    AxisMechanics(const AxisMechanics&) = delete;
    AxisMechanics& operator=(const AxisMechanics&) = delete;

    /// Sets the source of the motor's pulses; once, before Kernel::start. Count 0 is the start position. The count is
    /// that of the pulses on the wire: a write to a card's position register must not change it.
    void connect(sim::PositionFunction& pulses);

    /// The rotor in microsteps (pulses), 0 at the start. Up to PositionFunction::max_listeners listeners, one edge
    /// listener.
    sim::PositionFunction& rotor();
    /// The encoder's counts as a decoder at the end of its lines counts them, 0 at the start. Otherwise as rotor();
    /// without an encoder it stays 0.
    sim::PositionFunction& encoder();
    bool has_encoder() const { return encoder_.present(); }
    /// The lines A and B at `t`.
    QuadratureLevels encoder_lines(Instant t) const { return encoder_.lines(input_.rotor_at(t)); }
    /// Sets the listener for the edges of the pulses. The pulses have only one edge listener, which is this machine if
    /// it generates edges.
    void listen_pulse_edges(sim::EdgeListener* listener) { edges_.set_pulse_listener(listener); }

    /// True position of the table at `t` (not before the last event, not after the present), mm or degrees.
    double position(Instant t) const { return axle_.position(input_.rotor_at(t)); }
    /// True velocity of the table by the present law, mm/s or degrees/s, signed.
    double velocity() const { return input_.rotor_rate() * axle_.units_per_pulse(); }
    /// Pulses - rotor at `t`: 0 without step loss; a multiple of 4 full steps while in step.
    std::int64_t lost_steps(Instant t) const { return input_.pulses_at(t) - input_.rotor_at(t); }
    std::int64_t lost_steps() const { return lost_steps(kernel_.now()); }
    bool in_step() const { return motor_.in_step(); }
    /// Highest velocity so far with the motor in step, mm/s or degrees/s.
    double peak_velocity() const { return state_.top_hz * axle_.units_per_pulse(); }
    double units_per_pulse() const { return axle_.units_per_pulse(); }

    /// Wires of the machine; WireId::none if the part is absent.
    sim::WireId limit_minus_wire() const { return switches_.wire(0); }
    sim::WireId limit_plus_wire() const { return switches_.wire(1); }
    sim::WireId home_wire() const { return switches_.wire(2); }
    sim::WireId index_wire() const { return index_.wire(); }
    sim::DeviceId id() const { return id_; }
    const AxisMechanicsSettings& settings() const { return settings_; }
    const AxisSwitches& switches() const { return switches_; }

    void on_scheduled(Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    /// Faults that it accepts:
    ///   motor.stall            the axle is blocked while not 0
    ///   motor.lose_steps n     the rotor falls back against its motion by about n pulses (see Stepper::push)
    ///   motor.push n           the rotor is moved by about n microsteps
    ///   encoder.broken_a, encoder.broken_b, encoder.swapped       while not 0, one at a time
    ///   S.stuck_open, S.stuck_closed   while not 0; S: limit_minus, limit_plus, home
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    using MechanicsAdapter = MechanicsFaces::MechanicsAdapter;

    class MechanicsPosition final : public sim::PositionFunction {
      public:
        MechanicsPosition(AxisMechanics& machine, MechanicsAdapter face) : machine_(machine), face_(face) {}
        std::int64_t count(Instant t) const override { return machine_.faces_.count_at(face_, t); }
        double rate(Instant t) const override { return machine_.faces_.rate_at(face_, t); }
        void watch(int slot, std::int64_t below, std::int64_t above) override {
            const Instant now = machine_.kernel_.now();
            machine_.faces_.watch(face_, slot, {below, above}, now);
            machine_.aim(now);
        }
        int add_listener(sim::PositionListener& listener) override {
            return machine_.faces_.add_listener(face_, listener);
        }
        void set_edge_listener(sim::EdgeListener* listener) override {
            machine_.edges_.set_listener(face_, listener, machine_.kernel_.now());
        }
        void deliver_edges() override { machine_.input_.deliver_edges(); }

      private:
        AxisMechanics& machine_;
        MechanicsAdapter face_;
    };
    struct State {
        StepperState motor;
        RotorStrainState strain;
        TransmissionState axle;
        EncoderState encoder;
        AxisSwitches::States switches;
        MechanicsFaces::Watches watches;
        Range index;  // rotor range of a constant index line, while subscribed
        Range aimed;  // watched range of the pulses
        double top_hz = 0;
        Instant pending = never;       // instant of the notification for a watch that is already left
        std::int64_t edges_until = 0;  // the rotor after the last delivered edge
        Instant last_edge{};           // the instant of that edge
        std::int32_t index_wanted = 0;
        std::int32_t index_level = 0;
    };

    void crossed(Instant now) override;
    void rate_changed(double before, double rate, Instant now) override;

    /// Runs `change` of the motor, which may move the rotor or cause a step loss, and updates all dependent state.
    template <class Change>
    void change_motor(Instant now, Change change);
    void check(Instant now);
    bool check_ends(Instant now);
    void aim(Instant now);
    void put_off();
    bool motor_fault(std::string_view name, double value, Instant now);
    bool encoder_fault(std::string_view name, double value, Instant now);

    sim::Kernel& kernel_;
    AxisMechanicsSettings settings_;
    State state_{};
    sim::DeviceId id_;
    Stepper motor_;
    PulseInput input_;
    RotorStrain strain_;
    Transmission axle_;
    Encoder encoder_;
    AxisSwitches switches_;
    IndexLine index_;
    MechanicsFaces faces_;
    std::array<MechanicsPosition, MechanicsFaces::face_count> positions_;
    EdgeOutput edges_;
    bool checking_ = false;  // within check(): defers aim() to its end
};

}  // namespace motionrack::parts
