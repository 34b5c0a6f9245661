// Tables of a journal file and the hash chain of its entries.
//
//   entry 1 ──► 2 ──► 3 ──► 4      each link is the SHA-256 of the link before it and of the entry's own fields
//        ▲                  ▲
//  chain 'base'       chain 'head'   the link before the oldest remaining entry; the newest link
#pragma once

#include <cstdint>
#include <motionrack/journal/database.hpp>
#include <motionrack/journal/journal.hpp>
#include <string>

namespace motionrack::journal {

/// Creates the tables of a new file; checks and upgrades those of an existing one. Errors: io, a sentence with the path
/// or the SQLite message; the file is left unchanged.
Result<void> prepare_tables(const Database& database, const std::string& path);

struct ChainEnd {
    std::int64_t number = 0;  ///< number of its entry; 0: none yet
    std::string link;
};
ChainEnd chain_head(const Database& database);
Result<void> set_chain_end(const Database& database, const char* name, const ChainEnd& end);
/// Removes all but the newest `kept` entries and moves the base of the chain behind the removed ones.
Result<void> remove_old_entries(const Database& database, std::int64_t kept);
/// Checks the `newest` entries; 0: all. Errors: io.
Result<ChainCheck> check_chain(const Database& database, std::int64_t newest = 0);

}  // namespace motionrack::journal
