// Operations that can fail return Result<T>; an Error is a readable sentence with the place of the error.
#pragma once

#include <cstdlib>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace motionrack {

/// Kind of an error; the command line converts it to an exit code.
enum class ErrorKind {
    invalid_input,  ///< a file or argument is wrong; nothing was done
    refused,        ///< the request is well formed but outside a limit; nothing was done
    machine,        ///< the machine stopped: limit switch, alarm, step loss
    io,             ///< a file or device could not be read or written
    stopped         ///< the user requested a stop; recorded data are kept
};

/// A position in a text file; line and column count from 1, 0: unknown.
struct TextPosition {
    int line = 0;
    int column = 0;
    friend constexpr bool operator==(const TextPosition&, const TextPosition&) = default;
};

/// A failure as a sentence: the value found, the limit, the consequence and the remedy.
struct Error {
    ErrorKind kind = ErrorKind::invalid_input;
    std::string message;
    std::string file = {};
    TextPosition location = {};

    /// "file:line:column: message" without unknown parts.
    std::string text() const {
        std::string out = file;
        if (location.line > 0) {
            if (!out.empty()) out += ':';
            out += std::to_string(location.line);
            if (location.column > 0) out += ':' + std::to_string(location.column);
        }
        return out.empty() ? message : out + ": " + message;
    }
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for returning an error.
inline tl::unexpected<Error> fail(ErrorKind kind, std::string message, TextPosition location = {},
                                  std::string file = {}) {
    return tl::unexpected<Error>(Error{kind, std::move(message), std::move(file), location});
}

/// Prints an internal error of the program and aborts; used by MOTIONRACK_ASSERT.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line) noexcept;

}  // namespace motionrack

/// Checks for an error in the program; also active in Release builds.
#define MOTIONRACK_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::motionrack::assertion_failed(#condition, __FILE__, __LINE__))

#define MOTIONRACK_JOIN2(a, b) a##b
#define MOTIONRACK_JOIN(a, b) MOTIONRACK_JOIN2(a, b)

/// `MOTIONRACK_TRY(auto x, f());` declares x from a Result or returns its error.
#define MOTIONRACK_TRY(declaration, expression)                                                              \
    auto MOTIONRACK_JOIN(result_, __LINE__) = (expression);                                                  \
    if (!MOTIONRACK_JOIN(result_, __LINE__))                                                                 \
        return ::tl::unexpected<::motionrack::Error>(std::move(MOTIONRACK_JOIN(result_, __LINE__)).error()); \
    declaration = std::move(*MOTIONRACK_JOIN(result_, __LINE__))  // NOLINT(bugprone-macro-parentheses): it declares

/// `MOTIONRACK_CHECK(f());` returns if the Result<void> is an error.
#define MOTIONRACK_CHECK(expression)                                                         \
    do {                                                                                     \
        if (auto checked_result = (expression); !checked_result)                             \
            return ::tl::unexpected<::motionrack::Error>(std::move(checked_result).error()); \
    } while (false)
