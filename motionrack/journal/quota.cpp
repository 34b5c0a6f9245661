#include <fmt/format.h>

#include <algorithm>
#include <motionrack/journal/database.hpp>
#include <motionrack/journal/quota.hpp>
#include <motionrack/journal/tables.hpp>
#include <utility>

namespace motionrack::journal {

namespace {

constexpr double per_mb = 1e-6;

}  // namespace

std::int64_t bytes_used(const Database& file) {
    return file.number("PRAGMA page_size") * (file.number("PRAGMA page_count") - file.number("PRAGMA freelist_count"));
}

/// Removes tenths until the rest is within the quota, or `min_entries` remain: a note after each of them would take the
/// place of entries.
Result<std::string> Quota::remove_oldest(const Database& file, std::int64_t there) {
    MOTIONRACK_CHECK(file.run("BEGIN IMMEDIATE"));
    std::int64_t kept = there;
    bool is_within = false;
    while (!is_within && kept > min_entries) {
        kept = std::max(kept - kept / 10 - 1, min_entries);
        MOTIONRACK_CHECK(remove_old_entries(file, kept));
        is_within = bytes_used(file) < max_bytes_;
    }
    MOTIONRACK_CHECK(file.run("COMMIT"));
    if (!is_within && std::exchange(exceeded_, true)) return std::string();
    return fmt::format("The journal has reached its quota of {:g} MB: entries before number {} were removed.{}",
                       static_cast<double>(max_bytes_) * per_mb, file.number("SELECT min(number) FROM entry"),
                       is_within
                           ? ""
                           : fmt::format(" The newest {} alone exceed it: from now on each new entry replaces the "
                                         "oldest one. Restart with a larger quota to keep more.",
                                         min_entries));
}

Result<std::string> Quota::check(const Database& file) {
    const std::int64_t used = bytes_used(file);
    MOTIONRACK_CHECK(file.check_reads());
    const double share = static_cast<double>(used) / static_cast<double>(max_bytes_);
    if (share >= 1) {
        const std::int64_t there = file.number("SELECT count(*) FROM entry");
        return there > min_entries ? remove_oldest(file, there) : std::string();
    }
    if (share < 0.8 || warned_) return std::string();
    warned_ = true;
    return fmt::format(
        "The journal has {:.1f} MB, {:.0f} % of its quota of {:g} MB. Beyond it the oldest entries are removed: copy "
        "the file first if they are needed.",
        static_cast<double>(used) * per_mb, share * 100, static_cast<double>(max_bytes_) * per_mb);
}

}  // namespace motionrack::journal
