// Runs the C++ implementation of C library functions: one call at a time, errors as sentences, no exception out.
#pragma once

#include <exception>
#include <motionrack/base/result.hpp>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::calls {

/// Runs `call`, which returns a Result<Value>. On an error or exception, returns failed(kind, sentence), a Value.
template <class Call, class Failed>
auto guarded(Call call, Failed failed) noexcept {
    using Value = decltype(failed(ErrorKind::machine, std::string_view()));
    try {
        Result<Value> result = call();
        if (result) return static_cast<Value>(*result);
        return failed(result.error().kind, result.error().text());
    } catch (const std::bad_alloc&) {
        return failed(ErrorKind::machine, "Not enough memory; the call was not finished.");
    } catch (const std::exception& e) {
        return failed(ErrorKind::machine, e.what());
    } catch (...) {
        return failed(ErrorKind::machine, "Unknown internal error of the library.");
    }
}

/// `what`: name of the argument in the sentence, e.g. "The name".
inline Result<void> check_pointer(const void* pointer, std::string_view what) {
    if (pointer != nullptr) return {};
    return fail(ErrorKind::invalid_input, std::string(what) + " is a null pointer. Nothing was done.");
}

/// State that the functions of a library share within a process.
template <class Bench>
class Process {
  public:
    using Handler = void (*)(const char* sentence, void* user);

    void on_error(Handler handler, void* user) {
        const std::lock_guard<std::mutex> alone(lock_);
        handler_ = handler;
        user_ = user;
    }

    /// Runs `call` with the bench; `call` returns a Result<Value>.
    template <class Call>
    auto alone(Call call) {
        const std::lock_guard<std::mutex> alone(lock_);
        return call(bench_);
    }

    /// Stores "WHO: SENTENCE" as the last error of the thread. Calls the handler if `reported` is set. Requires the
    /// lock to be free.
    void failed(std::string& last, std::string_view who, std::string_view sentence, bool reported = true) noexcept {
        try {
            const std::string start = std::string(who) + ": ";
            last = sentence;
            if (last.rfind(start, 0) != 0) last.insert(0, start);
            if (!reported) return;
            const auto [handler, user] = [&] {
                const std::lock_guard<std::mutex> alone(lock_);
                return std::pair(handler_, user_);
            }();
            // A copy: the handler may call functions that fail.
            if (handler != nullptr) handler(std::string(last).c_str(), user);
        } catch (...) {
            last.clear();
        }
    }

  private:
    std::mutex lock_;
    Bench bench_;
    Handler handler_ = nullptr;
    void* user_ = nullptr;
};

}  // namespace motionrack::calls
