// All declarations of a card, for documents, inspectors, traces and tests.
#pragma once

#include <motionrack/base/commands.hpp>
#include <motionrack/base/registers.hpp>
#include <motionrack/base/states.hpp>
#include <span>
#include <string_view>

namespace motionrack {

enum class PinDirection : std::uint8_t { input, output };

struct PinInfo {
    std::string_view name;  ///< per axis: with '*' for the axis letter ("*lmtp")
    PinDirection direction = PinDirection::input;
    bool active_low = false;
    std::string_view meaning;
    std::string_view same_as = {};  ///< another pin of the card, whose wire has this second name
};

constexpr DeclarationError pins_flaw(std::span<const PinInfo> pins) {
    return names_flaw("the pins", "pin", pins);
}

struct CardMap {
    std::string_view name;
    std::string_view title;
    std::span<const RegisterInfo> registers;
    std::span<const CommandInfo> commands;
    std::span<const MachineInfo> machines;
    std::span<const PinInfo> pins;
};

}  // namespace motionrack
