// A resolver with its tracking converter, as a source of A, B and Z.
//
//   rotor ──► windings: sin * (1 + gain) + offset, cos + offset ──► converter: angle of (sin, cos) ──► A B Z
//                 └── broken? ──► los (loss of signal): the converter's lines stay constant
//
// Windings with mismatch or offset cause an angle error, twice or once per revolution. A tracking converter counts
// single steps and never skips one: faster motion is delayed. It knows the angle, not the revolutions: after a loss of
// signal it takes the shorter way. Not reproduced: the lag of its loop while the velocity changes.
//
// Faults: those of LineOutput, and "gain" (-0.3 .. 0.3), "offset_sin", "offset_cos" (-0.3 .. 0.3 of the amplitude),
// "broken_sin", "broken_cos" (not 0: no signal).
#pragma once

#include <motionrack/sim/parts/encoder_part.hpp>

namespace motionrack::parts {

struct ResolverSettings {
    std::int64_t counts_per_turn = 4096;  ///< counts of an electrical revolution: typically 2^10 to 2^16
    std::int64_t position_per_turn =
        4096;  ///< change of `position` per electrical revolution; with p pole pairs 1/p of a rotor revolution
    Duration min_edge_interval = nanoseconds(1'000);  ///< 10 ns .. 1 s: one count of the converter
    std::uint64_t seed = 1;
};

class Resolver final : public EncoderPart {
  public:
    /// Adds the device `name` and the wires NAME.a, NAME.b, NAME.z, NAME.los to the kernel before it starts. The index
    /// is at angle 0.
    Resolver(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
             const ResolverSettings& settings = {});

    sim::WireId los() const { return los_; }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    enum Own { gain, offset_sin, offset_cos, broken };
    double displacement(std::int64_t n) const override;
    bool blind() const override { return state_.own[broken] != 0; }

    sim::WireId los_{};
};

}  // namespace motionrack::parts
