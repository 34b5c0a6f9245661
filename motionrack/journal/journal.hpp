// Journal of a rack: events in order, written to disk before they are acknowledged.
//
//  any thread ──write──► [ queue ] ──► writing thread: one transaction for all queued ──fsync──► done(number)
//              ──keep───►  newest of each key ──┘
//
//   run 7   17:02:11  job       part.ngc began, 118 lines
//           17:02:40  alarm     limit plus of X
//           17:02:40  position  X 12.5, Y 3
//  (killed)                                        ◄── the next run finds no end of this run: LastRun::clean is false
//
// The file is an SQLite database with a write-ahead log, written by one program at a time. Kept values carry a checksum
// and entries form a hash chain (tables.hpp), so that the next start detects damage and manual changes.
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
    std::int64_t utc_ms = 0;  ///< ms since 1970-01-01
    Instant at{};             ///< simulated time
    std::string kind;         ///< "run", "job", "command", "state", "alarm", "position", "setting", "audit"
    std::string text;         ///< a sentence
    std::string data;         ///< JSON; may be empty
};

/// State in which the previous run left the file.
struct LastRun {
    std::int64_t run = 0;
    bool clean = false;        ///< ended regularly; otherwise killed or power lost
    std::int64_t last_ms = 0;  ///< utc_ms of the last write
    std::map<std::string, std::string> kept;
    /// Reasons not to rely on the kept values or the regular end, e.g. "the end of run 7 does not fit its checksum".
    /// Values with a wrong checksum are not in `kept`.
    std::vector<std::string> doubts;
    std::string damage;  ///< sentence if entries were changed or removed; empty: intact
};

/// Result of verifying the hash chain: each entry carries a hash of itself and its predecessor.
struct ChainCheck {
    std::int64_t entries = 0;
    std::string problem;  ///< first problem, "entry 17 was changed after it was written"; empty: intact
};

struct JournalQuery {
    std::int64_t after = 0;  ///< only entries with larger numbers
    std::string kind = {};   ///< empty: all
    int limit = 100;         ///< 1 .. 10000; limits to the newest entries
};

struct JournalSettings {
    std::int64_t max_bytes = 1'000'000'000;  ///< quota of the entries; beyond it the oldest are removed
    /// Called when the quota is nearly or fully used; on the writing thread, must not block.
    std::function<void(const std::string&)> on_quota = {};
};

class Journal {
  public:
    /// Callback for a written entry, on the writing thread.
    using Done = std::function<void(const Result<std::int64_t>& number)>;

    /// Reads the state left by the previous run; the run itself starts with begin(). `name` may be a link. Errors: io
    /// if the file cannot be created, is not a journal, or belongs to a running program; it is left unchanged.
    static Result<std::unique_ptr<Journal>> prepare(const std::string& name, JournalSettings settings = {});
    /// Starts the run; call it once, when nothing else can prevent the start. Until then entries and kept values wait,
    /// and are dropped if it never begins. Errors: io; the state left by the previous run remains.
    Result<void> begin();
    /// Prepares a journal and begins its run. Errors: those of both.
    static Result<std::unique_ptr<Journal>> open(const std::string& path, JournalSettings settings = {});
    /// Writes the queued entries. Unless close() was called, a run that has begun has no regular end, as after a crash.
    ~Journal();

    /// Any thread, never blocks. `done` receives the entry's number once it is on disk, or an error (io).
    void write(Instant at, std::string kind, std::string text, std::string data = {}, Done done = {});
    /// Any thread: replaces the value kept under this key.
    void keep(std::string key, std::string value);
    /// Writes the queued entries and ends the run regularly. Errors: io, also for any earlier write error.
    Result<void> close();

    /// Any thread: returns the newest matching entries, oldest first. Errors: io, invalid_input (limit).
    Result<std::vector<Entry>> read(const JournalQuery& question) const;
    /// Any thread: reads all entries and verifies their chain. Errors: io.
    Result<ChainCheck> check() const;
    /// Any thread, blocks only briefly: sentence of the first write failure; empty without failures. It persists: later
    /// entries may still be written, but the run gets no regular end. A deleted, replaced or truncated file is noticed
    /// within half a second.
    std::string failure() const;
    /// Returns the state left by the previous run; empty in the first run.
    const std::optional<LastRun>& before() const { return before_; }
    std::int64_t run() const { return run_; }

    /// Entries beyond the newest `max_entries` are removed when a run starts.
    static constexpr std::int64_t max_entries = 1'000'000;
    /// Number of newest entries whose chain is verified when a run starts, which takes 0.1 s. check() reads all.
    static constexpr std::int64_t checked_at_start = 20'000;
    /// Maximum length of the queue. Beyond it entries are refused, because the disk is too slow.
    static constexpr std::size_t max_waiting = 100'000;

  private:
    struct PendingEntry {
        Entry entry;
        Done done;
    };
    Journal(std::string path, JournalSettings settings, std::unique_ptr<FileLock> lock,
            std::unique_ptr<Database> writer, std::unique_ptr<Database> reader);
    Result<void> read_file();
    Result<void> insert_run();
    Result<void> watch_files();
    Result<void> read_last_run();
    Result<void> read_kept(LastRun& last);
    void work();
    bool end_work();
    void failed(const std::string& what);
    void keep_quota(Instant at);
    Result<void> store(std::vector<PendingEntry>& entries, const std::map<std::string, std::string>& kept);

    std::string path_;
    JournalSettings settings_;
    std::unique_ptr<Quota> quota_;
    std::unique_ptr<FileLock> lock_;
    std::unique_ptr<FileWatch> files_;
    std::unique_ptr<Database> writer_, reader_;
    std::int64_t run_ = 0;
    std::int64_t last_number_ = 0;  ///< number of the newest entry, with its chain link
    std::string last_link_;
    std::map<std::string, std::string> seals_;  ///< seals of all kept values
    std::optional<LastRun> before_;
    mutable std::mutex reading_;
    mutable std::mutex alone_;
    std::condition_variable wake_up_;
    std::vector<PendingEntry> waiting_;
    std::map<std::string, std::string> keeping_;
    bool quit_ = false;
    std::string failure_;
    std::atomic<bool> has_failed_{false};
    std::thread thread_;
};

}  // namespace motionrack::journal
