// The control commands as a table: what each takes and in which range, what it answers, what it does and where it is
// described. For frontends that bind commands by their names; list commands are in map/commands.hpp.
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
    std::string_view name;  ///< "": there is none
    double min = 0, max = 4294967295.0;
    std::string_view unit = "";
    bool whole = true;
};

/// The board's reason not to do a command.
enum class Refusal : std::uint8_t {
    parameter,  ///< a parameter is wrong
    busy,       ///< a list is running or the card moves, where that is so; else a parameter is wrong
    rejected,   ///< there is no room, or nothing to read
};
/// Bits of get_last_error where the card did not do a command.
std::uint32_t error_bits_of(const Error& error, Refusal refusal, const Engine& engine);

/// Numbers that a command answers, in the order of its arguments.
using ControlAnswer = std::vector<double>;

struct ControlCommand {
    std::string_view name;
    std::array<ControlParam, max_params> all_params{};
    std::size_t answers = 0;    ///< how many numbers
    bool whole_answers = true;  ///< false: they are doubles
    bool asks = false;          ///< it takes the time of a question first
    Refusal refusal = Refusal::parameter;
    /// Does it with parameters that check() has found good. Errors: those of the card; nothing is changed then.
    Result<ControlAnswer> (*run)(Engine& engine, std::span<const double> parameters) = nullptr;
    std::string_view meaning;
    std::string_view source;  ///< where it is described

    constexpr std::span<const ControlParam> params() const {
        std::size_t n = 0;
        while (n < all_params.size() && !all_params[n].name.empty()) ++n;
        return {all_params.data(), n};
    }

    /// Refused: another count of parameters, one out of its range, a fraction of a whole number.
    Result<void> check(std::span<const double> parameters) const;
    /// "No 0 to 3. Scale -1000000000 to 1000000000 bits/bit.", with a blank before each; "" without parameters.
    std::string ranges() const;
};

std::span<const ControlCommand> control_commands();
/// nullptr: there is none of that name.
const ControlCommand* find_control_command(std::string_view name);

}  // namespace motionrack::rtc5
