// Protocol between the driver's process and the server of the card: a page of shared memory, one request at a time.
//
//  driver's process      request, offset ──► asked + 1, wake ──► wait until answered == asked ──► value
//  server's process      wait until asked != answered ──► accesses the card ──► value ──► answered = asked, wake
//
// The register words are in another file, which both map too. For "read" the server copies the register value into its
// word; for "write" it copies the word to the card.
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
    pass,      ///< value: duration
    interrupt  ///< value: maximum duration; answer: 1 if the line is active
};

/// `atomic` in memory shared between processes requires it to be lock-free.
struct Doorbell {
    std::atomic<std::uint32_t> asked;
    std::atomic<std::uint32_t> answered;
    Question what;
    std::uint32_t offset;
    std::uint32_t width;
    std::int64_t value;
    std::atomic<std::int64_t> now;  ///< simulated time; updated by the server
};
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

/// Sleeps while the word has that value, at most two seconds; async-signal-safe.
inline void sleep_while(std::atomic<std::uint32_t>& word, std::uint32_t value) {
    const timespec max_wait{2, 0};
    ::syscall(SYS_futex, &word, FUTEX_WAIT, value, &max_wait, nullptr, 0);
}

inline void wake(std::atomic<std::uint32_t>& word) {
    ::syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

/// Driver side; async-signal-safe. Ends the process after a minute without an answer.
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
