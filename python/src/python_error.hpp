// Error conversion to Python: returns the value of a Result or throws; module.cpp maps the thrown object to a named
// exception.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::python {

/// Thrown exception. `timeout`: a wait timed out. `all`: all problems, if there are several.
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

/// Returns the value or throws its error.
template <class T>
T value_of(Result<T> result) {
    if (!result) raise(std::move(result).error());
    if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace motionrack::python
