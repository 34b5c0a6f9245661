// The wires of a card that are not bus lines: state, end of a frame, interrupt, analog outputs.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::grating_bus {

class CardWires {
  public:
    enum Pin { state_pin, done_pin };

    /// Adds the wires "<name>.<pin>" to the kernel. `fresh` (STATUS.FRAME) is part of the card's state and must outlive
    /// this.
    CardWires(sim::Kernel& kernel, sim::DeviceId card, const std::string& name, std::uint32_t& fresh);

    sim::WireId interrupt() const { return interrupt_; }
    bool fresh() const { return fresh_ != 0; }
    /// Sets STATUS.FRAME and the interrupt; a new frame ends the kernel's run.
    void set_fresh(bool fresh);
    /// Shows the state on the wires that have subscribers.
    void show(State state);
    /// Sets the analog output (0 .. 3) to `microvolts`, +-10 V at most.
    void put_out(int output, int microvolts);

  private:
    sim::Kernel& kernel_;
    std::uint32_t& fresh_;
    sim::WireId state_, done_, interrupt_;
    std::array<sim::WireId, output_count> outputs_{};
};

}  // namespace motionrack::grating_bus
