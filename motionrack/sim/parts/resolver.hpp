// A resolver with its tracking converter, as a source of A, B and Z.
//
//   rotor ──► windings: sin * (1 + gain) + offset, cos + offset ──► converter: angle of (sin, cos) ──► A B Z
//                 └── broken? ──► los (loss of signal): the converter's lines stay
//
// The angle of windings that are not alike or not without offset errs, twice or once a turn. A tracking converter
// counts one step after the other and never leaves one out: what is quicker than it tracks comes later. It knows the
// angle, not the turns: after a loss of signal it goes the shorter way. Not reproduced: the lag of its loop while the
// speed changes.
//
// The faults: those of LineOutput, and "gain" (-0.3 .. 0.3), "offset_sin", "offset_cos" (-0.3 .. 0.3 of the amplitude),
// "broken_sin", "broken_cos" (not 0: no signal).
#pragma once

#include <motionrack/sim/parts/encoder_part.hpp>

namespace motionrack::parts {

struct ResolverSettings {
    std::int64_t counts_per_turn = 4096;  ///< of an electrical turn: 2^10 to 2^16, mostly
    std::int64_t place_per_turn =
        4096;  ///< how far `place` goes meanwhile; with p pole pairs the p-th of a rotor's turn
    Duration fastest = nanoseconds(1'000);  ///< 10 ns .. 1 s: one count of the converter
    std::uint64_t seed = 1;
};

class Resolver final : public EncoderPart {
  public:
    /// Adds the device `name` and the wires NAME.a, NAME.b, NAME.z, NAME.los to the kernel, before it starts. The index
    /// is at angle 0.
    Resolver(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& place,
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
