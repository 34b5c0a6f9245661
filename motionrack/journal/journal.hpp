// The journal of a rack: what happened, in order, safe on disk before anybody is told that it is.
//
//   any thread ──write──► [ queue ] ──► writing thread: one transaction for all that wait ──fsync──► done(number)
//              ──keep───►  newest of each key ──┘
//
//   run 7   17:02:11  job       part.ngc began, 118 lines
//           17:02:40  alarm     limit plus of X
//           17:02:40  position  X 12.5, Y 3
//   (killed)                                        ◄── the next run finds no end of this one: LastRun::clean is false
//
// A file of SQLite with a write-ahead log; one program at a time writes it. What is kept carries a checksum, and
// entries form a chain of hashes (tables.hpp): damage and changes by hand are noticed at the next start.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace motionrack::journal {

class Database;
class FileLock;
class FileWatch;
class Quota;

struct Entry {
    std::int64_t number = 0;  ///< from 1, over all runs
    std::int64_t run = 0;     ///< from 1: the program's runs with this file
    std::int64_t utc_ms = 0;  ///< since 1970
    Instant at{};             ///< the rack's time
    std::string kind;         ///< "run", "job", "order", "state", "alarm", "position", "setting", "audit"
    std::string text;         ///< a sentence
    std::string data;         ///< JSON; may be empty
};

/// How the run before this one left the file.
struct LastRun {
    std::int64_t run = 0;
    bool clean = false;        ///< it ended by itself; else it was killed, or the computer stopped
    std::int64_t last_ms = 0;  ///< utc of the last that it wrote
    std::map<std::string, std::string> kept;
    /// Why what was kept, or that it ended by itself, is not to be trusted: "the end of run 7 does not fit its
    /// checksum". Values that do not fit their checksums are not in `kept`.
    std::vector<std::string> doubts;
    std::string damage;  ///< a sentence: entries were changed or removed; empty: all are as they were written
};

/// Whether all entries are as they were written: each carries a hash over itself and the one before it.
struct ChainCheck {
    std::int64_t entries = 0;
    std::string problem;  ///< "entry 17 was changed after it was written": the first one; empty: none
};

struct JournalQuery {
    std::int64_t after = 0;  ///< entries with greater numbers
    std::string kind = {};   ///< empty: all
    int limit = 100;         ///< 1 .. 10000; the newest ones
};

struct JournalSettings {
    std::int64_t max_bytes = 1'000'000'000;  ///< of its entries; beyond them the oldest go
    /// Hears that the quota is near or reached; on the writing thread, must not wait.
    std::function<void(const std::string&)> on_quota = {};
};

class Journal {
  public:
    /// Called on the writing thread.
    using Done = std::function<void(const Result<std::int64_t>& number)>;

    /// Begins a run. Errors: io (the file cannot be made, is no journal, or belongs to a program that runs; it is left
    /// as it is).
    static Result<std::unique_ptr<Journal>> open(const std::string& path, JournalSettings settings = {});
    /// Ends without a word, as a crash does, unless it was closed; what waits is written.
    ~Journal();

    /// Any thread, never waits. `done` hears the entry's number when it is on disk, or why it is not (io).
    void write(Instant at, std::string kind, std::string text, std::string data = {}, Done done = {});
    /// Any thread: `value` in place of the one that was kept under this key.
    void keep(std::string key, std::string value);
    /// Writes what waits and ends the run clean. Errors: io; also where something could not be written before.
    Result<void> close();

    /// Any thread: the newest entries that fit, oldest first. Errors: io, invalid_input (limit).
    Result<std::vector<Entry>> read(const JournalQuery& question) const;
    /// Any thread: reads all entries and their chain. Errors: io.
    Result<ChainCheck> check() const;
    /// Any thread, never waits long: why something is not in the file, as a sentence; empty: all is. It stays: later
    /// entries may still be written, but the run has no clean end any more. A file that was deleted, replaced or cut is
    /// noticed within half a second.
    std::string failure() const;
    /// Nothing: this is the first run.
    const std::optional<LastRun>& before() const { return before_; }
    std::int64_t run() const { return run_; }

    /// Older entries than these go when a run begins.
    static constexpr std::int64_t max_entries = 1'000'000;
    /// The newest entries, whose chain is checked when a run begins: a tenth of a second. check() reads all.
    static constexpr std::int64_t checked_at_start = 20'000;
    /// More than these waiting are refused: the disk does not follow.
    static constexpr std::size_t max_waiting = 100'000;

  private:
    struct Waiting {
        Entry entry;
        Done done;
    };
    Journal(std::string path, JournalSettings settings, std::unique_ptr<FileLock> lock,
            std::unique_ptr<Database> writer, std::unique_ptr<Database> reader);
    Result<void> begin();
    void read_last_run();
    void read_kept(LastRun& last);
    void work();
    bool end_work();
    void failed(const std::string& what);
    void keep_quota(Instant at);
    Result<void> store(std::vector<Waiting>& entries, const std::map<std::string, std::string>& kept);

    std::string path_;
    JournalSettings settings_;
    std::unique_ptr<Quota> quota_;
    std::unique_ptr<FileLock> lock_;
    std::unique_ptr<FileWatch> files_;
    std::unique_ptr<Database> writer_, reader_;
    std::int64_t run_ = 0;
    std::int64_t last_number_ = 0;  ///< of the newest entry, with its link in the chain
    std::string last_link_;
    std::map<std::string, std::string> seals_;  ///< of all that is kept
    std::optional<LastRun> before_;
    mutable std::mutex reading_;
    mutable std::mutex alone_;
    std::condition_variable news_;
    std::vector<Waiting> waiting_;
    std::map<std::string, std::string> keeping_;
    bool quit_ = false;
    std::string failure_;
    std::atomic<bool> has_failed_{false};
    std::thread thread_;
};

}  // namespace motionrack::journal
