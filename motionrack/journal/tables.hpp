// The tables of a journal's file, and the chain of its entries.
//
//   entry 1 ──► 2 ──► 3 ──► 4      each link is the SHA-256 of the link before it and of the entry's own fields
//        ▲                  ▲
//   chain 'base'       chain 'head'   the link before the oldest entry that is kept; the newest one
#pragma once

#include <cstdint>
#include <motionrack/journal/database.hpp>
#include <motionrack/journal/journal.hpp>
#include <string>

namespace motionrack::journal {

/// Makes the tables of a new file, checks an old one and brings its tables up to date. Errors: io, a sentence with the
/// path or SQLite's own words; the file is left as it is.
Result<void> prepare_tables(const Database& database, const std::string& path);

struct ChainEnd {
    std::int64_t number = 0;  ///< of its entry; 0: none yet
    std::string link;
};
ChainEnd chain_head(const Database& database);
Result<void> set_chain_end(const Database& database, const char* name, const ChainEnd& end);
/// Removes all but the newest `kept` entries; the chain begins behind them then.
Result<void> remove_old_entries(const Database& database, std::int64_t kept);
/// Reads the newest entries, so many; 0: all. Errors: io.
Result<ChainCheck> check_chain(const Database& database, std::int64_t newest = 0);

}  // namespace motionrack::journal
