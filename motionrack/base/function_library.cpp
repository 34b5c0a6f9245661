// Validation of calls against their declaration.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/base/function_library.hpp>

namespace motionrack {

bool is_possible(const ArgumentInfo& argument, std::int64_t value) {
    if (value < argument.min || value > argument.max) return false;
    if (argument.values.empty()) return true;
    std::int64_t bits = 0;
    for (const ValueInfo& one : argument.values) {
        if (!argument.sum && one.value == value) return true;
        bits |= one.value;
    }
    return argument.sum && value != 0 && (value & ~bits) == 0;
}

std::string range_text(const ArgumentInfo& argument) {
    if (argument.values.empty())
        return fmt::format("{} to {}{}{}", argument.min, argument.max, argument.unit.empty() ? "" : " ", argument.unit);
    std::string out;
    for (const ValueInfo& one : argument.values)
        out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", one.value, one.meaning);
    return argument.sum ? out + " or a sum of these" : out;
}

namespace {

Result<std::int64_t> value_of(const FunctionInfo& function, const ArgumentInfo& argument,
                              const std::map<std::string, std::int64_t, std::less<>>& arguments) {
    const auto given = arguments.find(argument.name);
    if (given == arguments.end())
        return fail(ErrorKind::invalid_input,
                    fmt::format("{}: the argument {} is missing; it must be {}. Nothing was done.", function.name,
                                argument.name, range_text(argument)));
    if (!is_possible(argument, given->second))
        return fail(ErrorKind::invalid_input,
                    fmt::format("{}: {} is {}, but must be {}. Nothing was done.", function.name, argument.name,
                                given->second, range_text(argument)));
    return given->second;
}

}  // namespace

Result<CheckedCall> check_call(std::span<const FunctionInfo> functions, std::string_view name,
                               const std::map<std::string, std::int64_t, std::less<>>& arguments) {
    const auto found = std::find_if(functions.begin(), functions.end(),
                                    [name](const FunctionInfo& function) { return function.name == name; });
    if (found == functions.end()) {
        std::string known;
        for (const FunctionInfo& function : functions)
            known += fmt::format("{}{}", known.empty() ? "" : ", ", function.name);
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The library has no function {}; it has {}. Nothing was done.", name.substr(0, 40), known));
    }
    CheckedCall out{static_cast<std::size_t>(found - functions.begin()), {}};
    for (const ArgumentInfo& argument : found->arguments) {
        MOTIONRACK_TRY(const std::int64_t value, value_of(*found, argument, arguments));
        out.values.push_back(value);
    }
    if (arguments.size() == out.values.size()) return out;
    std::string known;
    for (const ArgumentInfo& argument : found->arguments)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", argument.name);
    return fail(ErrorKind::invalid_input,
                fmt::format("{} was given {} arguments; its arguments are: {}. Nothing was done.", found->name,
                            arguments.size(), known.empty() ? "none" : known));
}

}  // namespace motionrack
