// The function library of a card as a declaration. A client that calls single functions (a form of a page, a script)
// needs no code per function or card.
//
//   FunctionInfo ──► JSON ──► forms          name, values ──check_call──► FunctionLibrary::call ──► CallAnswer
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <motionrack/base/result.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack {

/// A value of an argument, or one bit of it, that has its own meaning.
struct ValueInfo {
    std::int64_t value = 0;
    std::string_view meaning;
};

/// An argument: a whole number.
struct ArgumentInfo {
    std::string_view name;
    std::int64_t min = 0, max = 0;
    std::string_view unit;
    std::string_view meaning;
    std::int64_t start = 0;                  ///< initial value of a form
    std::span<const ValueInfo> values = {};  ///< the only valid values; empty: the whole range
    bool sum = false;                        ///< sums of one or more `values` are valid
};

struct FunctionInfo {
    std::string_view name;
    std::string_view group;    ///< chapter of its source; functions of a group are consecutive
    std::string_view meaning;  ///< a sentence
    std::span<const ArgumentInfo> arguments = {};
    std::string_view returns = {};  ///< the returned number, with its unit; empty: none
    bool waits = false;             ///< the function returns when its action has ended
    bool own = false;               ///< the source has no function of this name
};

struct CallAnswer {
    std::optional<std::int64_t> value = {};  ///< returned number
    std::string text;                        ///< the result in words
};

/// A card's function library over its bus. No other driver may use the card at the same time.
class FunctionLibrary {
  public:
    virtual ~FunctionLibrary() = default;
    virtual std::span<const FunctionInfo> functions() const = 0;
    /// Brings the card into its state after power-on for the library; nothing moves.
    virtual Result<void> begin() = 0;
    /// `function`: index in functions(); `values`: values of check_call. Functions that wait advance the port's time,
    /// and end when the port's stop_requested() is true. Errors: those of the library.
    virtual Result<CallAnswer> call(std::size_t function, std::span<const std::int64_t> values) = 0;
    /// True while an axis drives.
    virtual bool moving() = 0;
    /// Stops all axes at once.
    virtual void stop_now() = 0;
};

/// Index of a function, and the values of its arguments in order.
struct CheckedCall {
    std::size_t function = 0;
    std::vector<std::int64_t> values;
};
/// Checks a call by names. Errors: invalid_input, with the known functions or arguments, or the range; nothing was
/// called.
Result<CheckedCall> check_call(std::span<const FunctionInfo> functions, std::string_view name,
                               const std::map<std::string, std::int64_t, std::less<>>& arguments);

/// Describes the valid values of an argument: "1 to 8000 pulses", "X 1, Y 2, Z 4, U 8 or a sum of these".
std::string range_text(const ArgumentInfo& argument);
/// True if the argument accepts this value.
bool is_possible(const ArgumentInfo& argument, std::int64_t value);

}  // namespace motionrack
