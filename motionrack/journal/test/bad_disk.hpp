// Disk between SQLite and the system, whose nth writing call fails, is torn or is lost, or whose nth reading call
// fails. Records all writing calls, from which the state after a power loss at any point can be reconstructed.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace motionrack::journal {

/// Writing calls: write, truncate, sync and removal of a file. One instance at a time; the default disk of SQLite
/// during its lifetime.
class BadDisk {
  public:
    enum class Fault : std::uint8_t {
        none,
        fail,  ///< does nothing and returns an error: disk full, or a device fault
        stay,  ///< as `fail`, and for every later call
        tear,  ///< writes half and returns an error
        drop,  ///< does nothing and returns success
    };
    struct Plan {
        Fault fault = Fault::none;
        std::int64_t nth = 0;       ///< from 1
        std::int64_t nth_read = 0;  ///< reading call that fails, from 1; 0: none
    };
    BadDisk() : BadDisk(Plan{}) {}
    explicit BadDisk(const Plan& plan);
    ~BadDisk();
    BadDisk(const BadDisk&) = delete;
    BadDisk& operator=(const BadDisk&) = delete;

    std::int64_t calls() const;
    std::int64_t reads() const;
    /// Blocks writing calls while set.
    void hold(bool on);
    /// Writes the files as found after a power loss following the call `calls`. Synced data is present; each later
    /// write is present, torn or lost, chosen by `random`.
    void write_state(std::int64_t calls, std::mt19937& random, const std::string& from, const std::string& to) const;
};

}  // namespace motionrack::journal
