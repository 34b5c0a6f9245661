// Construction of the pins, levels of the inputs, broken wires.
#include <motionrack/cards/databoard4002/model/pins.hpp>

namespace motionrack::databoard4002 {

Pins::Pins(sim::Kernel& kernel, sim::DeviceId card, const std::string& name, std::uint8_t& broken)
    : kernel_(kernel), card_(card), broken_(broken) {
    for (std::size_t i = 0; i < pin_count; ++i) {
        const PinInfo& pin = card_map().pins[i];
        wires_[i] = kernel.add_wire(name + "." + std::string(pin.name), static_cast<int>(i) == sign_pin);
        if (pin.direction == PinDirection::input) kernel.listen(wires_[i], card, static_cast<int>(i));
    }
    kernel.drive_lazily(wires_[fout_pin], card, fout_pin);
}

std::uint8_t Pins::inputs() const {
    unsigned out = 0;
    if (level(zero_pin) != 0) out |= stat::ZERO;
    if (input(ref_pin, stat::REF)) out |= stat::REF;
    if (input(ems_pin, stat::EMS)) out |= stat::EMS;
    if (input(esr_pin, stat::ESR)) out |= stat::ESR;
    if (input(esl_pin, stat::ESL)) out |= stat::ESL;
    return static_cast<std::uint8_t>(out);
}

void Pins::set_interrupt(bool asked) {
    if (asked && level(interrupt_pin) == 0) kernel_.break_run();
    set(interrupt_pin, asked);
}

bool Pins::break_wire(std::string_view fault, bool broken) {
    constexpr struct {
        std::string_view name;
        std::uint8_t bit;
        Pin pin;
    } wires[] = {{"esl.broken", stat::ESL, esl_pin},
                 {"esr.broken", stat::ESR, esr_pin},
                 {"ems.broken", stat::EMS, ems_pin},
                 {"ref.broken", stat::REF, ref_pin}};
    for (const auto& wire : wires) {
        if (wire.name != fault) continue;
        broken_ = static_cast<std::uint8_t>(broken ? broken_ | wire.bit : broken_ & ~wire.bit);
        if (broken)
            force(wire.pin, 1);  // the pin shows the forced level to all other listeners
        else
            release(wire.pin);
        return true;
    }
    return false;
}

}  // namespace motionrack::databoard4002
