// Size quota of a journal and the actions near it.
//
//  80 %    writes a warning, once per run
//  100 %   removes the oldest tenth of the entries, again until the rest is within the quota, and writes the first
//          number kept
//
// The newest `min_entries` remain even if they alone exceed the quota. Then each new entry replaces the oldest one, and
// only the first removal of the run is written: further notes would themselves replace entries.
//
// Removed entries free space inside the file; the file does not shrink.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::journal {

class Database;

class Quota {
  public:
    /// Number of newest entries that always remain.
    static constexpr std::int64_t min_entries = 100;

    explicit Quota(std::int64_t max_bytes) : max_bytes_(max_bytes) {}

    /// Applies the quota; returns a warning, or empty. Call on the writing thread, between transactions. Errors: io.
    Result<std::string> check(const Database& file);

  private:
    Result<std::string> remove_oldest(const Database& file, std::int64_t there);

    std::int64_t max_bytes_;
    bool warned_ = false;
    bool exceeded_ = false;  ///< it was written that the newest `min_entries` exceed the quota
};

/// Returns the bytes that entries and kept values occupy.
std::int64_t bytes_used(const Database& file);

}  // namespace motionrack::journal
