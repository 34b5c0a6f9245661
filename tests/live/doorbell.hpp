// How the driver's process and the one that serves the card speak: a page of shared memory, one question at a time.
//
//   driver's process      what, offset ──► asked + 1, wake ──► wait until answered == asked ──► value
//   server's process      wait until asked != answered ──► works the card ──► value ──► answered = asked, wake
//
// The register words lie in another file, which both map too: "read" means that the server puts the register's value
// into its word, "write" that it takes the word and writes it to the card.
#pragma once

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace motionrack::live_test {

enum class Question : std::uint32_t {
    read,      ///< offset, width
    write,     ///< offset, width
    pass,      ///< value: how long
    interrupt  ///< value: how long at most; answer: 1 if the line is active
};

/// `atomic` in shared memory of two processes is sound where it is lock-free.
struct Doorbell {
    std::atomic<std::uint32_t> asked;
    std::atomic<std::uint32_t> answered;
    Question what;
    std::uint32_t offset;
    std::uint32_t width;
    std::int64_t value;
    std::atomic<std::int64_t> now;  ///< virtual time; the server keeps it current
};
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

/// Sleeps while the word has that value, two seconds at most; callable in a signal handler.
inline void sleep_while(std::atomic<std::uint32_t>& word, std::uint32_t value) {
    const timespec most{2, 0};
    ::syscall(SYS_futex, &word, FUTEX_WAIT, value, &most, nullptr, 0);
}

inline void wake(std::atomic<std::uint32_t>& word) {
    ::syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

/// The driver's side; callable in a signal handler. Ends the process if nobody answers for a minute.
inline std::int64_t ask(Doorbell& bell, Question what, std::int64_t value, std::uint32_t offset = 0,
                        std::uint32_t width = 16) {
    bell.what = what;
    bell.offset = offset;
    bell.width = width;
    bell.value = value;
    const std::uint32_t number = bell.asked.load() + 1;
    bell.asked.store(number);
    wake(bell.asked);
    for (int waits = 0; bell.answered.load() != number; ++waits) {
        if (waits == 30) {
            static constexpr char sentence[] = "The process that serves the card does not answer any more.\n";
            (void)!::write(2, sentence, sizeof sentence - 1);
            ::_exit(3);
        }
        sleep_while(bell.answered, number - 1);
    }
    return bell.value;
}

}  // namespace motionrack::live_test
