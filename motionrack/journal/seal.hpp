// Checksums of rows, which reveal bytes changed on disk or by hand. They are not signatures: a program can rewrite rows
// together with their seals.
#pragma once

#include <cstdint>
#include <map>
#include <motionrack/journal/journal.hpp>
#include <string>
#include <string_view>

namespace motionrack::journal {

/// SHA-256 over fields, each prefixed with its length to separate them.
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
/// Seal of a run's end. It covers all kept values by their seals and the newest entry by its link, so that an older
/// state with valid seals does not match.
std::string seal_of_run(std::int64_t run, std::int64_t begun_ms, std::int64_t ended_ms,
                        const std::map<std::string, std::string>& seals, std::string_view link);
/// Chain link of an entry: covers the entry and the link before it.
std::string link_of(std::string_view before, const Entry& entry);

}  // namespace motionrack::journal
