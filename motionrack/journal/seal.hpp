// Checksums of rows: a byte that changed on the disk, or by hand, is noticed. They are no signatures: a program that
// writes rows and seals anew is not noticed.
#pragma once

#include <cstdint>
#include <map>
#include <motionrack/journal/journal.hpp>
#include <string>
#include <string_view>

namespace motionrack::journal {

/// SHA-256 over fields, each with its length in front, so that none runs into the next.
class Seal {
  public:
    Seal& add(std::string_view text);
    Seal& add(std::int64_t value) { return add(std::string_view(std::to_string(value))); }
    /// Hexadecimal.
    std::string text() const;

  private:
    std::string fields_;
};

std::string seal_of_kept(std::string_view key, std::string_view value, std::int64_t run, std::int64_t utc_ms);
/// The end of a run vouches for all that is kept, by the seals, and for the newest entry, by its link: an older state
/// of them, which fits its own seals, does not fit this one.
std::string seal_of_run(std::int64_t run, std::int64_t begun_ms, std::int64_t ended_ms,
                        const std::map<std::string, std::string>& seals, std::string_view link);
/// The link of an entry in the chain of all entries: it covers the entry and the link before it.
std::string link_of(std::string_view before, const Entry& entry);

}  // namespace motionrack::journal
