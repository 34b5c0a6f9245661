// Runtime of mutated sources. MOTIONRACK_MUTANT selects the number of the one active mistake; each number that the
// program reaches is appended to the file MOTIONRACK_REACHED.
#pragma once
// Suppresses warnings: operands have the types of the mutated source.
#pragma GCC system_header
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#pragma GCC diagnostic ignored "-Wunused-value"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace mutant {

inline int chosen() {
    const char* text = std::getenv("MOTIONRACK_MUTANT");
    return text ? std::atoi(text) : -1;
}

/// Records each number once per process, without a lock: mutated code may run where nothing may wait.
inline void reach(int number) {
    constexpr int max_numbers = 1 << 16;
    static std::atomic<bool> reached[max_numbers];
    static const char* const path = std::getenv("MOTIONRACK_REACHED");
    if (!path || number >= max_numbers || reached[number].exchange(true)) return;
    char line[16];
    char* const end = std::to_chars(line, line + sizeof line - 1, number).ptr;
    *end = '\n';
    const int file = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (file < 0) return;
    if (write(file, line, static_cast<std::size_t>(end + 1 - line)) < 0) std::abort();
    close(file);
}

inline bool on(int number) {
    static const int one = chosen();
    reach(number);
    return number == one;
}

template <class A, class B>
constexpr auto less(int number, const A& a, const B& b) {
    return on(number) ? a <= b : a < b;
}

template <class A, class B>
constexpr auto less_equal(int number, const A& a, const B& b) {
    return on(number) ? a < b : a <= b;
}

template <class A, class B>
constexpr auto greater(int number, const A& a, const B& b) {
    return on(number) ? a >= b : a > b;
}

template <class A, class B>
constexpr auto greater_equal(int number, const A& a, const B& b) {
    return on(number) ? a > b : a >= b;
}

template <class A, class B>
auto plus(int number, const A& a, const B& b) {
    return on(number) ? a - b : a + b;
}

template <class A, class B>
auto minus(int number, const A& a, const B& b) {
    return on(number) ? a + b : a - b;
}

}  // namespace mutant
