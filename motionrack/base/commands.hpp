// Declaration of a card's commands.
#pragma once

#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>

namespace motionrack {

struct CommandInfo {
    std::string_view name;
    std::uint32_t code = 0;
    int data_bytes = 0;    ///< bytes of data: 0 none, 1 .. 4 a number, up to 1024 a table (without a range)
    std::int64_t min = 0;  ///< range of the data, as documented
    std::int64_t max = 0;
    std::string_view unit;
    std::string_view variant;  ///< "": all variants of the card have it
    std::string_view meaning;
    bool reproduced = true;  ///< false: the virtual card ignores it and reports a condition
    int answer_bytes = 0;    ///< bytes that the host reads afterwards (if it has a choice: instead of writing data)
};

/// Checks that codes and names are unique, and that ranges are ordered and fit into the data.
constexpr DeclarationError commands_flaw(std::span<const CommandInfo> commands) {
    if (const DeclarationError flaw = names_flaw("the commands", "command", commands); !flaw.empty()) return flaw;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const CommandInfo& command = commands[i];
        for (std::size_t j = 0; j < i; ++j)
            if (commands[j].code == command.code)
                return {"the commands ", commands[j].name, " and ", command.name, " have one code"};
        const bool table = command.data_bytes > 4;
        if (command.data_bytes < 0 || command.data_bytes > 1024 || command.answer_bytes < 0 ||
            command.answer_bytes > 1024)
            return {"the command ", command.name, " does not have 0 to 1024 bytes of data or answer"};
        if (table && (command.min != 0 || command.max != 0))
            return {"the command ", command.name, " has a table of data, which has no range"};
        if (command.min > command.max) return {"the range of the command ", command.name, " is upside down"};
        const std::int64_t values = std::int64_t{1} << (table ? 0 : 8 * command.data_bytes);
        const std::int64_t min_value = command.data_bytes == 0 ? 0 : -values / 2;
        if (command.min < min_value || command.max >= values)
            return {"the range of the command ", command.name, " does not fit its bytes of data"};
    }
    return {};
}

/// Returns the command of that name; an undeclared name does not compile.
consteval const CommandInfo& command_named(std::span<const CommandInfo> commands, std::string_view name) {
    for (const CommandInfo& command : commands)
        if (command.name == name) return command;
    throw "unknown command name";
}

}  // namespace motionrack
