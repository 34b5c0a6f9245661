// Shared parts of the C interface functions: they check pointers, convert errors to codes and sentences, and catch all
// exceptions.
#pragma once

#include <motionrack/c.h>

#include <initializer_list>
#include <memory>
#include <motionrack/frontends/calls/calls.hpp>
#include <motionrack/rack/session.hpp>
#include <string>
#include <string_view>
#include <utility>

struct mr_rack {
    std::unique_ptr<motionrack::rack::Session> session;
    std::string sentence = {}, report = {};  ///< results of the last program or homing
};

namespace motionrack::c {

/// Returns the last error sentence of this thread.
std::string& last_error();

/// Stores the sentence for mr_last_error (an empty one if out of memory) and returns the code.
inline int failed(int code, std::string_view sentence) noexcept {
    try {
        last_error() = sentence;
    } catch (...) {
        last_error().clear();
    }
    return code;
}

/// Returns the code of an error that occurred before any motion.
inline int code_of(ErrorKind trouble) {
    switch (trouble) {
        case ErrorKind::invalid_input:
            return MR_BAD_CALL;
        case ErrorKind::refused:
            return MR_REFUSED;
        case ErrorKind::io:
            return MR_IO;
        case ErrorKind::machine:
        case ErrorKind::stopped:
            break;
    }
    return MR_INTERNAL;
}

/// Pointer argument and the error sentence to report if it is null.
struct Pointer {
    const void* pointer;
    const char* sentence;
};
/// Returns the sentence of the first null pointer, or nullptr if none is null.
inline const char* first_null(std::initializer_list<Pointer> pointers) noexcept {
    for (const Pointer& each : pointers)
        if (each.pointer == nullptr) return each.sentence;
    return nullptr;
}

/// Runs `call`, which returns a Result; converts any exception to an error.
template <class Call>
int guarded(Call call) noexcept {
    return calls::guarded(
        [&]() -> Result<int> {
            MOTIONRACK_CHECK(call());
            return static_cast<int>(MR_OK);
        },
        [](ErrorKind trouble, std::string_view sentence) { return failed(code_of(trouble), sentence); });
}

/// As above, after checking that none of these pointers is null.
template <class Call>
int guarded(std::initializer_list<Pointer> pointers, Call call) noexcept {
    if (const char* sentence = first_null(pointers)) return failed(MR_BAD_CALL, sentence);
    return guarded(call);
}

/// As above; on success stores the value of `call` in *value.
template <class Value, class Call>
int fetched(std::initializer_list<Pointer> pointers, Value* value, Call call) noexcept {
    return guarded(pointers, [&]() -> Result<void> {
        MOTIONRACK_TRY(const auto got, call());
        *value = static_cast<Value>(got);
        return {};
    });
}

inline constexpr const char* no_card = "The card's name is a null pointer. Nothing was done.";
inline constexpr const char* no_tell = "The call-back is a null pointer. Nothing was reported.";
inline constexpr const char* no_rack = "The rack is a null pointer; open one with mr_rack_open. Nothing was done.";

}  // namespace motionrack::c
