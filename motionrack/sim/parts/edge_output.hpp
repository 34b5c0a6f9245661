// The edges of one axis to its edge listeners: rotor, encoder, and the pulses themselves.
//
//   pulses ──edges──► EdgeOutput ──► listener of the pulses
//                        │
//                        └── rotor in step ──► EdgeGenerator ──► listeners of rotor and encoder
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/sim/parts/edge_generator.hpp>
#include <motionrack/sim/parts/encoder.hpp>
#include <motionrack/sim/parts/mechanics_faces.hpp>
#include <motionrack/sim/parts/pulse_input.hpp>
#include <motionrack/sim/parts/stepper.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::parts {

class EdgeOutput final : private sim::EdgeListener {
  public:
    /// `until`: the rotor after the last delivered edge; `last`: the instant of that edge. They and `motor` are parts
    /// of the axis' state.
    EdgeOutput(PulseInput& input, const StepperState& motor, const Encoder& encoder, std::int64_t& until, Instant& last)
        : input_(input),
          motor_(motor),
          encoder_(encoder),
          until_(until),
          generator_(std::make_unique<EdgeGenerator>(last)) {}

    void set_listener(MechanicsFaces::MechanicsAdapter face, sim::EdgeListener* listener, Instant now);
    /// Sets the listener for the edges of the pulses.
    void set_pulse_listener(sim::EdgeListener* listener);

    /// The rotor jumps from `from` to `to`.
    void jump(std::int64_t from, std::int64_t to, Instant now);
    /// The encoder's count jumps from `from` to `to`.
    void count_jump(std::int64_t from, std::int64_t to, Instant now);

  private:
    void edges(const sim::EdgeBatch& batch) override;
    /// True if rotor or encoder have a listener.
    bool wanted() const { return listeners_[MechanicsFaces::rotor_face] || listeners_[MechanicsFaces::encoder_face]; }
    void listen() { input_.set_edge_listener(wanted() || pulse_listener_ ? this : nullptr); }

    PulseInput& input_;
    const StepperState& motor_;
    const Encoder& encoder_;
    std::int64_t& until_;
    EdgeGenerator::Listeners listeners_{};
    sim::EdgeListener* pulse_listener_ = nullptr;
    std::unique_ptr<EdgeGenerator> generator_;
};

}  // namespace motionrack::parts
