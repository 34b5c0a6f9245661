// How many bytes a journal may have, and what happens near that.
//
//   80 %    a sentence, once a run
//   100 %   the oldest tenth of the entries goes, and a sentence says up to which one
//
// What is removed makes place in the file, which does not get shorter.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::journal {

class Database;

class Quota {
  public:
    /// So many of the newest entries stay in any case.
    static constexpr std::int64_t min_entries = 100;

    explicit Quota(std::int64_t max_bytes) : max_bytes_(max_bytes) {}

    /// On the writing thread, between transactions. The sentence, where there is one. Errors: io.
    Result<std::string> look(const Database& file);

  private:
    std::int64_t max_bytes_;
    bool warned_ = false;
};

/// Bytes that entries and what is kept take up.
std::int64_t bytes_used(const Database& file);

}  // namespace motionrack::journal
