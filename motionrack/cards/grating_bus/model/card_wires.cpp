// Adds the wires of a card, and sets their levels.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/card_wires.hpp>

namespace motionrack::grating_bus {

CardWires::CardWires(sim::Kernel& kernel, sim::DeviceId card, const std::string& name, std::uint32_t& fresh)
    : kernel_(kernel),
      fresh_(fresh),
      state_(kernel.add_wire(name + ".state", 0, 4)),
      done_(kernel.add_wire(name + ".frame_done", 0)),
      interrupt_(kernel.add_wire(name + ".int_n", 1)) {
    for (int n = 0; n < output_count; ++n)
        outputs_[static_cast<std::size_t>(n)] = kernel.add_wire(name + ".vout" + std::to_string(n), 0);
    kernel.drive_lazily(state_, card, state_pin);
    kernel.drive_lazily(done_, card, done_pin);
}

void CardWires::set_fresh(bool fresh) {
    if (fresh == (fresh_ != 0)) return;
    fresh_ = fresh;
    kernel_.set_wire(interrupt_, fresh ? 0 : 1);
    if (fresh) kernel_.break_run();
}

void CardWires::show(State state) {
    if (kernel_.wanted(state_)) kernel_.set_wire(state_, static_cast<int>(state));
    if (kernel_.wanted(done_)) kernel_.set_wire(done_, state == State::S12);
}

void CardWires::put_out(int output, int microvolts) {
    kernel_.set_wire(outputs_[static_cast<std::size_t>(output)], std::clamp(microvolts, -10'000'000, 10'000'000));
}

}  // namespace motionrack::grating_bus
