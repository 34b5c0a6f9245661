// Creation, upgrade and verification of the tables.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <motionrack/journal/seal.hpp>
#include <motionrack/journal/tables.hpp>

namespace motionrack::journal {

namespace {

constexpr std::int64_t version = 2;
constexpr std::int64_t mark = 0x4D4A524E;  // "MJRN": distinguishes a journal from other SQLite files

constexpr std::uintmax_t page_bytes = 4096;  // SQLite default

constexpr std::int64_t max_number = 1'000'000'000'000'000;  // upper bound of a valid entry or run number

constexpr const char* tables = R"(
    CREATE TABLE run (number INTEGER PRIMARY KEY, begun_ms INTEGER NOT NULL, ended_ms INTEGER,
                      seal TEXT NOT NULL DEFAULT '');
    CREATE TABLE entry (number INTEGER PRIMARY KEY AUTOINCREMENT, run INTEGER NOT NULL, utc_ms INTEGER NOT NULL,
                        at INTEGER NOT NULL, kind TEXT NOT NULL, text TEXT NOT NULL, data TEXT NOT NULL,
                        link TEXT NOT NULL DEFAULT '');
    CREATE INDEX entry_kind ON entry (kind, number);
    CREATE TABLE kept (key TEXT PRIMARY KEY, value TEXT NOT NULL, run INTEGER NOT NULL, utc_ms INTEGER NOT NULL,
                       seal TEXT NOT NULL DEFAULT '') WITHOUT ROWID;
    CREATE TABLE chain (name TEXT PRIMARY KEY, number INTEGER NOT NULL, link TEXT NOT NULL) WITHOUT ROWID;
)";

/// Version 1 had neither seals nor links. Values kept by it stay unsealed, because nothing confirms them.
constexpr const char* from_version_1 = R"(
    ALTER TABLE run ADD COLUMN seal TEXT NOT NULL DEFAULT '';
    ALTER TABLE entry ADD COLUMN link TEXT NOT NULL DEFAULT '';
    ALTER TABLE kept ADD COLUMN seal TEXT NOT NULL DEFAULT '';
    CREATE TABLE chain (name TEXT PRIMARY KEY, number INTEGER NOT NULL, link TEXT NOT NULL) WITHOUT ROWID;
)";

constexpr const char* all_entries =
    "SELECT number, run, utc_ms, at, kind, text, data, link FROM entry WHERE number > ?1 ORDER BY number";

Entry entry_of(const Statement& row) {
    return {row.number(0), row.number(1), row.number(2), Instant{row.number(3)}, row.text(4), row.text(5), row.text(6)};
}

/// Inside a transaction: adds links to entries without one.
Result<void> link_entries(const Database& database) {
    Statement set(database.get(), "UPDATE entry SET link = ?1 WHERE number = ?2");
    Statement rows(database.get(), all_entries);  // the last to be prepared: its error is the one reported below
    rows.bind(1, 0);
    ChainEnd head;
    while (rows.row()) {
        const Entry entry = entry_of(rows);
        if (head.number == 0) MOTIONRACK_CHECK(set_chain_end(database, "base", {entry.number - 1, ""}));
        head = {entry.number, link_of(head.link, entry)};
        set.bind(1, head.link).bind(2, head.number);
        (void)set.row();
        if (!set.ok()) return fail(ErrorKind::io, database.what());
        set.again();
    }
    if (!rows.ok()) return fail(ErrorKind::io, database.what());
    return head.number == 0 ? Result<void>() : set_chain_end(database, "head", head);
}

Result<void> upgrade(const Database& database) {
    MOTIONRACK_CHECK(database.run("BEGIN IMMEDIATE"));
    Result<void> done = database.run(from_version_1);
    if (done) done = link_entries(database);
    if (done) done = database.run(fmt::format("PRAGMA user_version = {}; COMMIT", version).c_str());
    if (!done) (void)database.run("ROLLBACK");
    return done;
}

/// Checks the file structure: pages, records, order of rows. Returns "ok" or the problem.
std::string structure_of(const Database& database) {
    Statement check(database.get(), "PRAGMA quick_check(1)");
    return check.row() ? check.text(0) : database.what();
}

/// Checks the numbers from which later ones continue. Returns "ok" or the problem.
std::string numbers_of(const Database& database) {
    for (const char* sql :
         {"SELECT max(number) FROM entry", "SELECT min(number) FROM entry", "SELECT max(number) FROM run",
          "SELECT min(number) FROM run", "SELECT max(number) FROM chain", "SELECT min(number) FROM chain",
          "SELECT max(seq) FROM sqlite_sequence", "SELECT min(seq) FROM sqlite_sequence"})
        if (const std::int64_t number = database.number(sql); number < 0 || number > max_number)
            return fmt::format("it has a number of {}, outside 0 to {}", number, max_number);
    return "ok";
}

/// Checks that the data belongs to a run; otherwise the file would look like a new journal. Returns "ok" or the
/// problem.
std::string runs_of(const Database& database) {
    if (database.number("SELECT count(*) FROM run") > 0) return "ok";
    for (const char* sql :
         {"SELECT count(*) FROM entry", "SELECT count(*) FROM kept", "SELECT count(*) FROM sqlite_sequence"})
        if (database.number(sql) > 0) return "it has entries without their runs";
    return "ok";
}

tl::unexpected<Error> damaged(const std::string& path, const std::string& how) {
    return fail(ErrorKind::io,
                fmt::format("The journal '{}' is damaged: {}. Nothing was started. Keep the file for an analysis, "
                            "name another one, and home the machine.",
                            path, how));
}

Result<void> quick_check(const Database& database, const std::string& path) {
    std::string found = structure_of(database);
    if (found == "ok") found = numbers_of(database);
    if (found == "ok") found = runs_of(database);
    if (const Result<void> read = database.check_reads(); !read) found = read.error().message;
    if (found == "ok") return {};
    return damaged(path, found);
}

/// A file without tables has one page at most. A larger file has lost the page of its tables.
Result<void> check_new(const std::string& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) return fail(ErrorKind::io, fmt::format("its size cannot be read: {}", error.message()));
    if (bytes <= page_bytes) return {};
    return damaged(path, fmt::format("it has {} bytes and no tables", bytes));
}

ChainEnd chain_end(const Database& database, const char* name) {
    Statement end(database.get(), "SELECT number, link FROM chain WHERE name = ?1");
    end.bind(1, name);
    return database.first_row(end) ? ChainEnd{end.number(0), end.text(1)} : ChainEnd{};
}

}  // namespace

Result<void> prepare_tables(const Database& database, const std::string& path) {
    // Before the first write: a removed file must not reappear after a power cut.
    MOTIONRACK_CHECK(database.run("PRAGMA synchronous = EXTRA"));
    const std::int64_t id = database.number("PRAGMA application_id");
    const bool is_empty = id == 0 && database.number("SELECT count(*) FROM sqlite_master") == 0;
    MOTIONRACK_CHECK(database.check_reads());
    if (is_empty) {
        MOTIONRACK_CHECK(check_new(path));
        MOTIONRACK_CHECK(database.run("PRAGMA journal_mode = WAL"));
        const std::string all = fmt::format(
            "BEGIN IMMEDIATE; {} PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT;", tables, mark, version);
        return database.run(all.c_str());
    }
    if (id != mark)
        return fail(
            ErrorKind::io,
            fmt::format("'{}' is an SQLite file, but not a journal. It was not changed; name another file.", path));
    MOTIONRACK_CHECK(quick_check(database, path));
    const std::int64_t seen = database.number("PRAGMA user_version");
    MOTIONRACK_CHECK(database.check_reads());
    if (seen < 1 || seen > version)
        return fail(ErrorKind::io, fmt::format("The journal '{}' has version {}; this program knows versions up to {}. "
                                               "It was not changed; name another file.",
                                               path, seen, version));
    MOTIONRACK_CHECK(database.run("PRAGMA journal_mode = WAL"));
    return seen == 1 ? upgrade(database) : Result<void>();
}

ChainEnd chain_head(const Database& database) {
    ChainEnd head = chain_end(database, "head");
    // Numbers are never reused, even after entries were removed.
    head.number = std::max({head.number, database.number("SELECT max(number) FROM entry"),
                            database.number("SELECT seq FROM sqlite_sequence WHERE name = 'entry'")});
    return head;
}

Result<void> set_chain_end(const Database& database, const char* name, const ChainEnd& end) {
    Statement set(database.get(), "INSERT OR REPLACE INTO chain (name, number, link) VALUES (?1, ?2, ?3)");
    set.bind(1, name).bind(2, end.number).bind(3, end.link);
    (void)set.row();
    return set.ok() ? Result<void>() : fail(ErrorKind::io, database.what());
}

Result<void> remove_old_entries(const Database& database, std::int64_t kept) {
    const std::int64_t last = database.number("SELECT max(number) FROM entry") - kept;
    // The newest of those to remove; entries that were removed from outside leave gaps.
    Statement found(database.get(), "SELECT number, link FROM entry WHERE number <= ?1 ORDER BY number DESC LIMIT 1");
    found.bind(1, last);
    if (!database.first_row(found)) return database.check_reads();
    MOTIONRACK_CHECK(set_chain_end(database, "base", {found.number(0), found.text(1)}));
    return database.run(fmt::format("DELETE FROM entry WHERE number <= {}", found.number(0)).c_str());
}

namespace {

/// Returns the start of a check of `newest` entries: the entry before them, or the chain's base.
ChainEnd before_newest(const Database& database, std::int64_t last, std::int64_t newest) {
    Statement found(database.get(), "SELECT number, link FROM entry WHERE number <= ?1 ORDER BY number DESC LIMIT 1");
    found.bind(1, last - newest);
    if (newest > 0 && database.first_row(found)) return {found.number(0), found.text(1)};
    return chain_end(database, "base");
}

}  // namespace

Result<ChainCheck> check_chain(const Database& database, std::int64_t newest) {
    ChainCheck out;
    MOTIONRACK_CHECK(database.run("BEGIN"));  // reads one state of the file during concurrent writes
    const ChainEnd head = chain_end(database, "head"), base = before_newest(database, head.number, newest);
    Statement rows(database.get(), all_entries);
    rows.bind(1, newest > 0 ? base.number : 0);
    std::int64_t before = base.number;
    std::string link = base.link;
    const auto broken = [&](const std::string& what) {
        if (out.problem.empty()) out.problem = what;
    };
    for (; rows.row(); ++out.entries) {
        const Entry entry = entry_of(rows);
        const std::string stored = rows.text(7);
        if (entry.number != before + 1)
            broken(fmt::format("entries {} to {} were removed", before + 1, entry.number - 1));
        else if (link_of(link, entry) != stored)
            broken(fmt::format("entry {} was changed after it was written", entry.number));
        before = entry.number;
        link = stored;
    }
    Result<void> read = database.check_reads();
    if (!rows.ok()) read = fail(ErrorKind::io, database.what());
    if (before < head.number)
        broken(fmt::format("entries {} to {} were removed", before + 1, head.number));
    else if (before != head.number || link != head.link)
        broken(fmt::format("entry {} is not the last written one", before));
    (void)database.run("COMMIT");
    if (!read) return fail(ErrorKind::io, fmt::format("The journal cannot be read: {}.", read.error().message));
    return out;
}

}  // namespace motionrack::journal
