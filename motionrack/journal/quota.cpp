#include <fmt/format.h>

#include <algorithm>
#include <motionrack/journal/database.hpp>
#include <motionrack/journal/quota.hpp>
#include <motionrack/journal/tables.hpp>

namespace motionrack::journal {

std::int64_t bytes_used(const Database& file) {
    return file.number("PRAGMA page_size") * (file.number("PRAGMA page_count") - file.number("PRAGMA freelist_count"));
}

Result<std::string> Quota::check(const Database& file) {
    const std::int64_t used = bytes_used(file);
    const double share = static_cast<double>(used) / static_cast<double>(max_bytes_), of_mb = 1e-6;
    if (share >= 1) {
        const std::int64_t there = file.number("SELECT count(*) FROM entry"),
                           kept = std::max(there - there / 10 - 1, min_entries);
        if (kept >= there) return std::string();
        MOTIONRACK_CHECK(file.run("BEGIN IMMEDIATE"));
        MOTIONRACK_CHECK(remove_old_entries(file, kept));
        MOTIONRACK_CHECK(file.run("COMMIT"));
        return fmt::format("The journal has reached its quota of {:g} MB: entries before number {} were removed.",
                           static_cast<double>(max_bytes_) * of_mb, file.number("SELECT min(number) FROM entry"));
    }
    if (share < 0.8 || warned_) return std::string();
    warned_ = true;
    return fmt::format(
        "The journal has {:.1f} MB, {:.0f} % of its quota of {:g} MB. Beyond it the oldest entries are removed: copy "
        "the file first if they are needed.",
        static_cast<double>(used) * of_mb, share * 100, static_cast<double>(max_bytes_) * of_mb);
}

}  // namespace motionrack::journal
