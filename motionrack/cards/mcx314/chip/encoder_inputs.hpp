// The counter EP of each axis: it counts the connected encoder, or the wires xeca and xecb.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::mcx314 {

class EncoderInputs {
  public:
    EncoderInputs(State& state, sim::Kernel& kernel, const ChipWires& wires)
        : state_(state), kernel_(kernel), wires_(wires) {}

    /// Connects an encoder; `listener` is notified when it passes a comparison value.
    void connect(int a, sim::PositionFunction& counts, sim::PositionListener& listener);
    /// Returns true if axis `a` has an encoder, connected or taken.
    bool has_encoder(int a) const { return sources_[a].motion != nullptr; }
    bool connected(int a) const { return has_encoder(a) && !kernel_.forced(wires_.encoders[a][0]); }
    /// Disconnects the encoder and forces the wires to its present levels.
    void take(int a, Instant now);
    /// Releases the wires and reconnects the encoder.
    void give_back(int a);

    /// EP.
    std::int32_t position(const Axis& axis, int a) const;
    /// Writes EP; also applies the edge ratio of WR2 and the direction of EM.
    void set_position(int a, std::int32_t value);
    /// Subscribes axis `a` to its encoder, at the next count that may change a comparison with EP.
    void watch(int a);
    /// Counts a change of xeca or xecb while no encoder is connected; returns true if EP has changed.
    bool count_lines(int a);

  private:
    struct ConnectedEncoder {
        sim::PositionFunction* motion = nullptr;
        int slot = -1;
    };

    State& state_;
    sim::Kernel& kernel_;
    const ChipWires& wires_;
    std::array<ConnectedEncoder, axes_of_chip> sources_{};
};

}  // namespace motionrack::mcx314
