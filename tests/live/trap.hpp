// Notices every access of this process to a mapped page, one by one, as a card on a bus does: plain memory cannot say
// that it was read, or written with the value that it had. The code that makes the access is as it always is.
//
//   access ──► page is closed: SIGSEGV ──► before() ──► page opened, single step
//          ──► the access is made: SIGTRAP ──► page closed ──► after() ──► the program goes on
//
// x86-64 only, for its single step. One trap at a time in a process, one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace motionrack::live_test {

struct Touch {
    std::size_t offset = 0;  ///< bytes from the page's start, of the first byte
    bool writes = false;
};

class Trap {
  public:
    /// False where this machine cannot single-step.
    static bool possible();
    /// Where this process has mapped the file; nullptr if it has not.
    static void* mapping_of(const std::string& path);

    /// `before` and `after` are called in a signal handler: no allocation, no locks. `length`: whole pages.
    Trap(void* page, std::size_t length, void (*before)(const Touch&), void (*after)(const Touch&));
    ~Trap();
    Trap(const Trap&) = delete;
    Trap& operator=(const Trap&) = delete;
};

}  // namespace motionrack::live_test
