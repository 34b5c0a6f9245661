// Rows of the function library: a function's declaration, and the call that passes its arguments in order to the
// Driver.
#pragma once

#include <motionrack/cards/databoard4002/library/library.hpp>
#include <vector>

namespace motionrack::databoard4002::functions {

using Values = std::span<const std::int64_t>;
using Call = Result<CallAnswer> (*)(Driver& driver, Values values);

struct LibraryRow {
    FunctionInfo info;
    Call call = nullptr;
};
std::span<const LibraryRow> function_rows();

/// Sends a command without an argument.
template <Result<void> (Driver::*function)()>
Result<CallAnswer> give(Driver& driver, Values) {
    MOTIONRACK_CHECK((driver.*function)());
    return CallAnswer{{}, "Given."};
}
/// Sends a command with one number, `v[0]`.
template <class Number, Result<void> (Driver::*function)(Number)>
Result<CallAnswer> set(Driver& driver, Values v) {
    MOTIONRACK_CHECK((driver.*function)(static_cast<Number>(v[0])));
    return CallAnswer{{}, "Written."};
}
/// Sends a command and returns the card's answer.
template <class Number, Result<Number> (Driver::*function)()>
Result<CallAnswer> ask(Driver& driver, Values) {
    MOTIONRACK_TRY(const Number value, (driver.*function)());
    return CallAnswer{value, {}};
}

}  // namespace motionrack::databoard4002::functions
