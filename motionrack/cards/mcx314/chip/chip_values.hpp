// Reads any value of the chip by name, without side effects.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/machine_states.hpp>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/cards/mcx314/chip/status_registers.hpp>
#include <motionrack/sim/kernel.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace motionrack::mcx314 {

struct ChipValues {
    const State& state;
    const sim::Kernel& kernel;
    const MotionLaw& law;
    const EncoderInputs& encoders;
    const Drives& drives;
    const StatusRegisters& status;
    const MachineStates& machines;

    /// Implements Chip::inspect().
    std::optional<std::int64_t> inspect(std::string_view name, int a) const;
    /// Implements Chip::inspected_names().
    static std::vector<std::string_view> names(bool per_axis);
    /// Return the counters LP and EP of axis `a` at the present instant.
    std::int32_t lp(int a) const;
    std::int32_t ep(int a) const;
};

}  // namespace motionrack::mcx314
