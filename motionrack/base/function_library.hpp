// The function library of a card as a declaration: whoever calls it function by function (a form of a page, an order)
// needs no code of his own for a function or a card.
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

/// A value of an argument that has a meaning of its own, or a bit of it.
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
    std::int64_t start = 0;                  ///< what a form begins with
    std::span<const ValueInfo> values = {};  ///< the only ones that there are; empty: all of the range
    bool sum = false;                        ///< any sum of `values`, of one at least
};

struct FunctionInfo {
    std::string_view name;
    std::string_view group;    ///< chapter of its source; functions of a group follow each other
    std::string_view meaning;  ///< a sentence
    std::span<const ArgumentInfo> arguments = {};
    std::string_view returns = {};  ///< the returned number, with its unit; empty: none is returned
    bool waits = false;             ///< it returns when what it has begun has ended
    bool own = false;               ///< the source has no function of this name
};

struct CallAnswer {
    std::optional<std::int64_t> value = {};  ///< returned
    std::string text;                        ///< the result in words
};

/// A card's function library over its bus. Not to be used beside another driver of the same card.
class FunctionLibrary {
  public:
    virtual ~FunctionLibrary() = default;
    virtual std::span<const FunctionInfo> functions() const = 0;
    /// The card as the library finds it after power on; nothing moves.
    virtual Result<void> begin() = 0;
    /// `function`: its place in functions(); `values`: all that check_call gives. Functions that wait let the port's
    /// time pass, and end when the port's stop_requested() says so. Errors: those of the library.
    virtual Result<CallAnswer> call(std::size_t function, std::span<const std::int64_t> values) = 0;
    /// Whether an axis drives.
    virtual bool moving() = 0;
    /// All axes, at once.
    virtual void stop_now() = 0;
};

/// A function by its name, and the values of its arguments in their order.
struct CheckedCall {
    std::size_t function = 0;
    std::vector<std::int64_t> values;
};
/// Errors: invalid_input, with the functions or arguments that there are, or the range; nothing was called.
Result<CheckedCall> check_call(std::span<const FunctionInfo> functions, std::string_view name,
                               const std::map<std::string, std::int64_t, std::less<>>& arguments);

/// "1 to 8000 pulses", "X 1, Y 2, Z 4, U 8 or a sum of these".
std::string range_text(const ArgumentInfo& argument);
/// Whether the argument may have this value.
bool is_possible(const ArgumentInfo& argument, std::int64_t value);

}  // namespace motionrack
