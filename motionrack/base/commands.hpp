// How a card's commands are declared.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace motionrack {

struct CommandInfo {
    std::string_view name;
    std::uint32_t code = 0;
    int data_bytes = 0;             ///< that go with it, 0: none
    std::int64_t least = 0;         ///< range of the data, as documented
    std::int64_t greatest = 0;
    std::string_view unit;
    std::string_view variant;       ///< "": every variant of the card has it
    std::string_view meaning;
};

/// No code and no name twice; ranges the right way round.
constexpr bool commands_are_sound(std::span<const CommandInfo> commands) {
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (commands[i].name.empty() || commands[i].least > commands[i].greatest) return false;
        for (std::size_t j = 0; j < i; ++j)
            if (commands[j].code == commands[i].code || commands[j].name == commands[i].name) return false;
    }
    return true;
}

/// The command of that name; asking for one that is not declared does not compile.
consteval const CommandInfo& command_named(std::span<const CommandInfo> commands, std::string_view name) {
    for (const CommandInfo& command : commands)
        if (command.name == name) return command;
    throw "there is no command of that name";
}

}  // namespace motionrack
