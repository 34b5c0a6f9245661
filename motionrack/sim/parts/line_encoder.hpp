// An incremental encoder, a disc or a linear scale, with lines A, B, Z as wires and all line faults.
//
//        ___
//       / . \  eccentric centre: edges come early on one side, late on the other
//      |  .  | dirt: some lines are invisible
//       \_|_/  index
//
// Faults: those of LineOutput (broken, swapped and inverted lines, noise, missing and double index, jitter, dirt,
// over-speed), and "eccentricity" (counts, the maximum displacement; 0: none).
#pragma once

#include <motionrack/sim/parts/encoder_part.hpp>

namespace motionrack::parts {

struct LineEncoderSettings {
    std::int64_t counts_per_turn = 4000;  ///< > 0, a multiple of 4; for a scale: counts from index to index
    std::int64_t position_per_turn =
        4000;  ///< > 0: change of `position` per revolution; finer than the counts, so edges keep their distance
    bool index = true;                              ///< a Z pulse per revolution, at count 0
    double eccentricity = 0;                        ///< counts, 0 .. counts_per_turn / 7
    std::int64_t dirt_at = 100;                     ///< count at which the dirt begins
    Duration min_edge_interval = nanoseconds(200);  ///< 10 ns .. 1 s: minimum time between two edges
    TooQuick too_quick = TooQuick::loses_lines;
    std::uint64_t seed = 1;  ///< seed of jitter and noise
};

class LineEncoder final : public EncoderPart {
  public:
    /// Adds the device `name` and the wires NAME.a, NAME.b, NAME.z to the kernel before it starts.
    LineEncoder(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                const LineEncoderSettings& settings = {});

    bool fault(std::string_view name, double value, Instant now) override;

  private:
    double displacement(std::int64_t n) const override;
};

}  // namespace motionrack::parts
