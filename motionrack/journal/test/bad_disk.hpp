// A disk between SQLite and the system's, whose nth writing call fails, is torn or is lost; and the record of all
// writing calls, from which the state of a computer that lost power in between can be made.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace motionrack::journal {

/// Writing calls: write, truncate, sync and removal of a file. One at a time; the default disk of SQLite while it
/// lives.
class BadDisk {
  public:
    enum class Fault : std::uint8_t {
        none,
        fail,  ///< nothing is done, and an error comes back: full, or a fault of the device
        stay,  ///< as `fail`, and so is every later one
        tear,  ///< half of it is written, and an error comes back
        drop,  ///< nothing is done, and success comes back
    };
    struct Plan {
        Fault fault = Fault::none;
        std::int64_t nth = 0;  ///< from 1
    };
    BadDisk() : BadDisk(Plan{}) {}
    explicit BadDisk(const Plan& plan);
    ~BadDisk();
    BadDisk(const BadDisk&) = delete;
    BadDisk& operator=(const BadDisk&) = delete;

    std::int64_t calls() const;
    /// Writing calls wait while it is held.
    void hold(bool on);
    /// The files as a computer finds them that lost power after the call `calls`: what was synced is there; of the rest
    /// each write may be there, be torn or be lost, as `random` says.
    void write_state(std::int64_t calls, std::mt19937& random, const std::string& from, const std::string& to) const;
};

}  // namespace motionrack::journal
