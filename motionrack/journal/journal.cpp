#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <motionrack/journal/database.hpp>
#include <motionrack/journal/journal.hpp>
#include <utility>

namespace motionrack::journal {

namespace {

constexpr std::int64_t version = 1;
constexpr std::int64_t mark = 0x4D4A524E;  // "MJRN": tells a journal from other files of SQLite

constexpr const char* tables = R"(
    CREATE TABLE run (number INTEGER PRIMARY KEY, begun_ms INTEGER NOT NULL, ended_ms INTEGER);
    CREATE TABLE entry (number INTEGER PRIMARY KEY AUTOINCREMENT, run INTEGER NOT NULL, utc_ms INTEGER NOT NULL,
                        at INTEGER NOT NULL, kind TEXT NOT NULL, text TEXT NOT NULL, data TEXT NOT NULL);
    CREATE INDEX entry_kind ON entry (kind, number);
    CREATE TABLE kept (key TEXT PRIMARY KEY, value TEXT NOT NULL, run INTEGER NOT NULL,
                       utc_ms INTEGER NOT NULL) WITHOUT ROWID;
)";

std::int64_t utc_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

Result<void> make_tables(const Database& database, const std::string& path) {
    const std::int64_t id = database.number("PRAGMA application_id");
    if (id == 0 && database.number("SELECT count(*) FROM sqlite_master") == 0) {
        MOTIONRACK_CHECK(database.run("PRAGMA journal_mode = WAL"));
        const std::string all = fmt::format(
            "BEGIN IMMEDIATE; {} PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT;", tables, mark, version);
        return database.run(all.c_str());
    }
    if (id != mark)
        return fail(
            Trouble::io,
            fmt::format("'{}' is a file of SQLite, but no journal. It was left as it is; name another file.", path));
    if (const std::int64_t seen = database.number("PRAGMA user_version"); seen != version)
        return fail(Trouble::io, fmt::format("The journal '{}' has version {}; this program knows version {}. It was "
                                             "left as it is; name another file.",
                                             path, seen, version));
    return {};
}

/// Positions, names and addresses are its owner's; the files that SQLite makes beside it have the same rights.
Result<void> make_private(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0600);
    if (file < 0)
        return fail(Trouble::io, fmt::format("The journal '{}' cannot be opened: {}. Name another file.", path,
                                             std::strerror(errno)));
    struct stat about {};
    const bool is_file = ::fstat(file, &about) == 0 && S_ISREG(about.st_mode);
    if (is_file && (about.st_mode & 0077) != 0 && about.st_uid == ::geteuid()) ::fchmod(file, 0600);
    ::close(file);
    if (is_file) return {};
    return fail(Trouble::io, fmt::format("The journal '{}' is not a file. Name another one.", path));
}

}  // namespace

/// Beside the journal, so that it ends with the program however that ends.
class FileLock {
  public:
    static Result<std::unique_ptr<FileLock>> take(const std::string& journal) {
        const std::string path = journal + ".lock";
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (file < 0)
            return fail(Trouble::io,
                        fmt::format("The journal '{}' cannot be made: {}.", journal, std::strerror(errno)));
        std::unique_ptr<FileLock> lock(new FileLock(file));
        if (::flock(file, LOCK_EX | LOCK_NB) != 0)
            return fail(
                Trouble::io,
                fmt::format(
                    "The journal '{}' belongs to another program that runs. Name another file, or end that program.",
                    journal));
        return lock;
    }
    ~FileLock() { ::close(file_); }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    explicit FileLock(int file) : file_(file) {}
    int file_;
};

Journal::Journal(std::unique_ptr<FileLock> lock, std::unique_ptr<Database> writer, std::unique_ptr<Database> reader)
    : lock_(std::move(lock)), writer_(std::move(writer)), reader_(std::move(reader)) {}

Result<std::unique_ptr<Journal>> Journal::open(const std::string& path) {
    MOTIONRACK_TRY(auto lock, FileLock::take(path));
    MOTIONRACK_CHECK(make_private(path));
    MOTIONRACK_TRY(Database writer, Database::open(path, Database::Use::write));
    if (Result<void> made = make_tables(writer, path); !made) {
        if (made.error().message.find(path) != std::string::npos) return tl::unexpected<Error>(made.error());
        return fail(Trouble::io,
                    fmt::format("'{}' cannot be used as a journal: {}. It was left as it is; name another file.", path,
                                made.error().message));
    }
    MOTIONRACK_CHECK(writer.run("PRAGMA synchronous = FULL"));
    MOTIONRACK_TRY(Database reader, Database::open(path, Database::Use::read));
    std::unique_ptr<Journal> journal(new Journal(std::move(lock), std::make_unique<Database>(std::move(writer)),
                                                 std::make_unique<Database>(std::move(reader))));
    if (Result<void> begun = journal->begin(); !begun)
        return fail(Trouble::io,
                    fmt::format("The journal '{}' cannot be written: {}. Free the disk or name another file.", path,
                                begun.error().message));
    journal->thread_ = std::thread([one = journal.get()] { one->work(); });
    return journal;
}

Result<void> Journal::begin() {
    const Database& file = *writer_;
    if (Statement last(file.get(),
                       "SELECT number, ended_ms IS NOT NULL, max(begun_ms, coalesce(ended_ms, 0)) FROM run ORDER BY "
                       "number DESC LIMIT 1");
        last.row()) {
        before_ = LastRun{last.number(0), last.number(1) != 0, last.number(2), {}};
        const std::int64_t written = file.number("SELECT max(utc_ms) FROM entry");
        before_->last_ms = std::max(before_->last_ms, written);
        Statement kept(file.get(), "SELECT key, value, utc_ms FROM kept");
        while (kept.row()) {
            before_->kept[kept.text(0)] = kept.text(1);
            before_->last_ms = std::max(before_->last_ms, kept.number(2));
        }
    }
    run_ = (before_ ? before_->run : 0) + 1;
    MOTIONRACK_CHECK(
        file.run(fmt::format("BEGIN IMMEDIATE; INSERT INTO run (number, begun_ms) VALUES ({}, {});"
                             "DELETE FROM entry WHERE number <= (SELECT max(number) FROM entry) - {}; COMMIT;",
                             run_, utc_ms(), most_entries)
                     .c_str()));
    return {};
}

Journal::~Journal() {
    end_work();
}

/// What waits is written first. False: it had ended already.
bool Journal::end_work() {
    {
        const std::lock_guard<std::mutex> guard(alone_);
        quit_ = true;
    }
    news_.notify_one();
    if (!thread_.joinable()) return false;
    thread_.join();
    return true;
}

void Journal::write(Instant at, std::string kind, std::string text, std::string data, Done done) {
    bool room = true, closed = false;
    {
        const std::lock_guard<std::mutex> guard(alone_);
        closed = quit_;
        room = waiting_.size() < most_waiting && !closed;
        if (room)
            waiting_.push_back(
                {{0, run_, utc_ms(), at, std::move(kind), std::move(text), std::move(data)}, std::move(done)});
    }
    if (room) return news_.notify_one();
    if (!done) return;  // NOLINT(bugprone-use-after-move): it was moved only where there was room
    done(fail(
        Trouble::io,
        closed ? "It was not written to the journal, which is closed."
               : fmt::format("It was not written to the journal: {} entries wait for the disk, and no more are taken.",
                             most_waiting)));
}

void Journal::keep(std::string key, std::string value) {
    {
        const std::lock_guard<std::mutex> guard(alone_);
        keeping_[std::move(key)] = std::move(value);
    }
    news_.notify_one();
}

void Journal::work() {
    for (;;) {
        std::vector<Waiting> entries;
        std::map<std::string, std::string> kept;
        {
            std::unique_lock<std::mutex> guard(alone_);
            news_.wait(guard, [this] { return quit_ || !waiting_.empty() || !keeping_.empty(); });
            if (waiting_.empty() && keeping_.empty()) return;
            entries.swap(waiting_);
            kept.swap(keeping_);
        }
        const Result<void> stored = store(entries, kept);
        if (!stored) (void)writer_->run("ROLLBACK");
        for (const Waiting& one : entries) {
            if (!one.done) continue;
            if (stored)
                one.done(one.entry.number);
            else
                one.done(
                    fail(Trouble::io, fmt::format("It was not written to the journal: {}.", stored.error().message)));
        }
    }
}

Result<void> Journal::store(std::vector<Waiting>& entries, const std::map<std::string, std::string>& kept) {
    const auto failed = [this] { return fail(Trouble::io, writer_->what()); };
    MOTIONRACK_CHECK(writer_->run("BEGIN IMMEDIATE"));
    Statement insert(writer_->get(),
                     "INSERT INTO entry (run, utc_ms, at, kind, text, data) VALUES (?1, ?2, ?3, ?4, ?5, ?6)");
    for (Waiting& one : entries) {
        Entry& entry = one.entry;
        insert.bind(1, entry.run)
            .bind(2, entry.utc_ms)
            .bind(3, entry.at.count())
            .bind(4, entry.kind)
            .bind(5, entry.text)
            .bind(6, entry.data);
        (void)insert.row();
        if (!insert.ok()) return failed();
        entry.number = sqlite3_last_insert_rowid(writer_->get());
        insert.again();
    }
    Statement replace(writer_->get(), "INSERT OR REPLACE INTO kept (key, value, run, utc_ms) VALUES (?1, ?2, ?3, ?4)");
    for (const auto& [key, value] : kept) {
        replace.bind(1, key).bind(2, value).bind(3, run_).bind(4, utc_ms());
        (void)replace.row();
        if (!replace.ok()) return failed();
        replace.again();
    }
    return writer_->run("COMMIT");
}

Result<void> Journal::close() {
    if (!end_work()) return {};
    return writer_->run(fmt::format("UPDATE run SET ended_ms = {} WHERE number = {}", utc_ms(), run_).c_str());
}

Result<std::vector<Entry>> Journal::read(const Question& question) const {
    if (question.limit < 1 || question.limit > 10000)
        return fail(Trouble::bad_input,
                    fmt::format("The journal gives 1 to 10000 entries at once, not {}.", question.limit));
    const std::lock_guard<std::mutex> guard(reading_);
    Statement select(
        reader_->get(),
        "SELECT number, run, utc_ms, at, kind, text, data FROM entry WHERE number > ?1 AND (?2 = '' OR kind = ?2)"
        " ORDER BY number DESC LIMIT ?3");
    select.bind(1, question.after).bind(2, question.kind).bind(3, question.limit);
    std::vector<Entry> out;
    while (select.row())
        out.push_back({select.number(0), select.number(1), select.number(2), Instant{select.number(3)}, select.text(4),
                       select.text(5), select.text(6)});
    if (!select.ok()) return fail(Trouble::io, fmt::format("The journal cannot be read: {}.", reader_->what()));
    std::reverse(out.begin(), out.end());
    return out;
}

}  // namespace motionrack::journal
