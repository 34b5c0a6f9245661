// How functions of the C libraries run what is C++: one at a time, an error becomes a sentence, nothing is thrown out.
#pragma once

#include <exception>
#include <motionrack/base/result.hpp>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::calls {

/// Runs `call`, which gives a Result<Value>; where it or what it throws is an error, the answer is that of
/// failed(trouble, sentence), a Value.
template <class Call, class Failed>
auto guarded(Call call, Failed failed) noexcept {
    using Value = decltype(failed(ErrorKind::machine, std::string_view()));
    try {
        Result<Value> result = call();
        if (result) return static_cast<Value>(*result);
        return failed(result.error().kind, result.error().text());
    } catch (const std::bad_alloc&) {
        return failed(ErrorKind::machine, "There is not enough memory; the call was not finished.");
    } catch (const std::exception& e) {
        return failed(ErrorKind::machine, e.what());
    } catch (...) {
        return failed(ErrorKind::machine, "Something went wrong in the library that it has no words for.");
    }
}

/// `what`: of the argument, "The name".
inline Result<void> check_pointer(const void* pointer, std::string_view what) {
    if (pointer != nullptr) return {};
    return fail(ErrorKind::invalid_input, std::string(what) + " is a null pointer. Nothing was done.");
}

/// What the functions of a library share in a process.
template <class Bench>
class Process {
  public:
    using Handler = void (*)(const char* sentence, void* user);

    void on_error(Handler handler, void* user) {
        const std::lock_guard<std::mutex> alone(lock_);
        handler_ = handler;
        user_ = user;
    }

    /// Runs `call` with the bench; it gives a Result<Value>.
    template <class Call>
    auto alone(Call call) {
        const std::lock_guard<std::mutex> alone(lock_);
        return call(bench_);
    }

    /// Makes "WHO: SENTENCE" the thread's last error and, if it is to be told, calls the handler. The lock must be
    /// free.
    void failed(std::string& last, std::string_view who, std::string_view sentence, bool told = true) noexcept {
        try {
            const std::string start = std::string(who) + ": ";
            last = sentence;
            if (last.rfind(start, 0) != 0) last.insert(0, start);
            if (!told) return;
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
