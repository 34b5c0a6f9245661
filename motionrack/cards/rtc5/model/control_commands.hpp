// Table of the control commands: parameters with ranges, answers, action and source. Frontends use it to bind the
// commands by name; map/commands.hpp has the list commands.
#pragma once

#include <array>
#include <motionrack/cards/rtc5/map/errors.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rtc5 {

struct ControlParam {
    std::string_view name;  ///< "": this and all later parameters are unused
    double min = 0, max = 4294967295.0;
    std::string_view unit = "";
    bool whole = true;
};

/// Reason why the card rejects a command; it selects the bits of get_last_error.
enum class Refusal : std::uint8_t {
    parameter,  ///< a parameter is wrong
    busy,       ///< a list is running or the card is moving; if neither, a parameter is wrong
    rejected,   ///< no free memory, or no data to read
};
/// Returns the bits of get_last_error for a rejected command.
std::uint32_t error_bits_of(const Error& error, Refusal refusal, const Engine& engine);

/// Numeric answers of a command, in the order of its arguments.
using ControlAnswer = std::vector<double>;

struct ControlCommand {
    std::string_view name;
    std::array<ControlParam, max_params> all_params{};
    std::size_t answers = 0;    ///< number of values that the command answers
    bool whole_answers = true;  ///< true: the answers are integers
    bool asks = false;          ///< reads the card, so it waits one query duration before executing
    Refusal refusal = Refusal::parameter;
    /// Executes the command with parameters that check() has accepted. Errors: those of the card; nothing is changed
    /// then.
    Result<ControlAnswer> (*run)(Engine& engine, std::span<const double> parameters) = nullptr;
    std::string_view meaning;
    std::string_view source;  ///< section of the source document that describes the command

    constexpr std::span<const ControlParam> params() const {
        std::size_t n = 0;
        while (n < all_params.size() && !all_params[n].name.empty()) ++n;
        return {all_params.data(), n};
    }

    /// Checks parameters. Errors: refused for a wrong number of parameters, a parameter out of range, or a fraction of
    /// a whole number.
    Result<void> check(std::span<const double> parameters) const;
    /// Returns the parameters' ranges as text, as in " No 0 to 3. Scale -1000000000 to 1000000000 bits/bit.", with the
    /// leading blank; "" without parameters.
    std::string ranges() const;
};

std::span<const ControlCommand> control_commands();
/// Finds a control command by its name; returns nullptr if the name is unknown.
const ControlCommand* find_control_command(std::string_view name);

}  // namespace motionrack::rtc5
