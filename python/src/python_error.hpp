// Errors on their way to Python: a Result becomes its value or is thrown, and module.cpp makes the named exception of
// it.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::python {

/// What is thrown. `timeout`: a wait ended before what it waited for came. `all`: every problem, where there are
/// several.
struct PythonError {
    Error error;
    bool timeout = false;
    std::vector<Error> all = {};
};

[[noreturn]] inline void raise(Error error, bool timeout = false) {
    throw PythonError{std::move(error), timeout};
}
[[noreturn]] inline void refuse(std::string sentence) {
    raise({ErrorKind::refused, std::move(sentence)});
}

/// The value, or its error thrown.
template <class T>
T value_of(Result<T> result) {
    if (!result) raise(std::move(result).error());
    if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace motionrack::python
