// Calls of C functions with arguments drawn by type.
#pragma once

#include <cstdint>
#include <tuple>
#include <type_traits>

namespace motionrack::fuzz {

/// Calls `function`. `arguments.draw(std::type_identity<T>{})` returns an argument of type T; arguments are drawn in
/// order with any compiler. Returns the result as an integer; 0 for void and pointers.
template <class Arguments, class Answer, class... Parameters>
std::int64_t call_with_drawn(Answer (*function)(Parameters...), Arguments& arguments) {
    const std::tuple<Parameters...> drawn{arguments.draw(std::type_identity<Parameters>{})...};
    static_cast<void>(arguments);  // for a function without parameters
    if constexpr (std::is_arithmetic_v<Answer>) {
        return static_cast<std::int64_t>(std::apply(function, drawn));
    } else {
        std::apply(function, drawn);
        return 0;
    }
}

/// A function with its name.
template <class Arguments>
struct DrawnCall {
    const char* name;
    std::int64_t (*call)(Arguments&);
};

template <auto function, class Arguments>
constexpr DrawnCall<Arguments> drawn(const char* name) {
    return {name, [](Arguments& arguments) { return call_with_drawn(function, arguments); }};
}

}  // namespace motionrack::fuzz
