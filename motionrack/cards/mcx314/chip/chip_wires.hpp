// The wires of a chip, and the numbers of its pins in the kernel.
#pragma once

#include <array>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::mcx314 {

struct ChipWires {
    /// Numbers below 16 * axes_of_chip are input pins of an axis: 16 * axis + Pin.
    static constexpr int emergency_pin = 100, step_pin = 101;
    static constexpr int encoder_pin = 120;  ///< first encoder pin: add 2 * axis + (0 xeca, 1 xecb)
    static constexpr int output_pin =
        200;  ///< first output pin: add 16 * axis + (0 xpp, 1 xpm, 2 xdrive, 8 + n: nOUTn)

    /// Adds the wires "<name>.<pin>" of the device `id` to the kernel.
    ChipWires(sim::Kernel& kernel, sim::DeviceId id, const std::string& name);

    std::array<std::array<sim::WireId, 10>, axes_of_chip> inputs{};
    std::array<std::array<sim::WireId, 8>, axes_of_chip> general_outputs{};
    std::array<std::array<sim::WireId, 2>, axes_of_chip> pulses{};
    std::array<sim::WireId, axes_of_chip> drives{};
    std::array<std::array<sim::WireId, 2>, axes_of_chip> encoders{};
    sim::WireId emergency{};
    sim::WireId step{};
    sim::WireId interrupt{};
};

}  // namespace motionrack::mcx314
