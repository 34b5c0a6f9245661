// Detects every access of this process to a mapped page individually, as a card on a bus does. Plain memory cannot
// detect a read, or a write of an unchanged value. The accessing code is unmodified.
//
//   access ──► page is closed: SIGSEGV ──► before() ──► page opened, single step
//         ──► the access is made: SIGTRAP ──► page closed ──► after() ──► the program continues
//
// Requires x86-64 for its single step. One trap at a time per process, one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace motionrack::live_test {

struct Touch {
    std::size_t offset = 0;  ///< bytes from the start of the page to the first byte
    bool writes = false;
};

class Trap {
  public:
    /// Returns false if this machine cannot single-step.
    static bool possible();
    /// Returns the address at which this process has mapped the file; nullptr if not mapped.
    static void* mapping_of(const std::string& path);

    /// Calls `before` and `after` in a signal handler: no allocation, no locks. `length`: whole pages.
    Trap(void* page, std::size_t length, void (*before)(const Touch&), void (*after)(const Touch&));
    ~Trap();
    Trap(const Trap&) = delete;
    Trap& operator=(const Trap&) = delete;
};

}  // namespace motionrack::live_test
