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
#include <motionrack/journal/file_watch.hpp>
#include <motionrack/journal/journal.hpp>
#include <motionrack/journal/quota.hpp>
#include <motionrack/journal/seal.hpp>
#include <motionrack/journal/tables.hpp>
#include <utility>

namespace motionrack::journal {

namespace {

/// Interval of the file checks while nothing is written.
constexpr std::chrono::milliseconds poll_period{250};

std::int64_t utc_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

/// Positions, names and addresses are private to the owner. SQLite gives its auxiliary files the same rights.
Result<void> make_private(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0600);
    if (file < 0)
        return fail(ErrorKind::io, fmt::format("The journal '{}' cannot be opened: {}. Name another file.", path,
                                               std::strerror(errno)));
    struct stat about {};
    (void)::fstat(file, &about);  // on an error it is not a file
    const bool is_file = S_ISREG(about.st_mode);
    if (is_file && (about.st_mode & 0077) != 0 && about.st_uid == ::geteuid()) ::fchmod(file, 0600);
    ::close(file);
    if (is_file) return {};
    return fail(ErrorKind::io, fmt::format("The journal '{}' is not a file. Name another one.", path));
}

tl::unexpected<Error> not_written(const std::string& path, const std::string& why) {
    return fail(ErrorKind::io,
                fmt::format("The journal '{}' cannot be written: {}. Free the disk or name another file.", path, why));
}

}  // namespace

/// Lock file beside the journal, released when the program ends for any reason.
class FileLock {
  public:
    static Result<std::unique_ptr<FileLock>> take(const std::string& journal) {
        const std::string path = journal + ".lock";
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (file < 0)
            return fail(ErrorKind::io,
                        fmt::format("The journal '{}' cannot be created: {}.", journal, std::strerror(errno)));
        std::unique_ptr<FileLock> lock(new FileLock(file));
        if (::flock(file, LOCK_EX | LOCK_NB) != 0)
            return fail(
                ErrorKind::io,
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

Journal::Journal(std::string path, JournalSettings settings, std::unique_ptr<FileLock> lock,
                 std::unique_ptr<Database> writer, std::unique_ptr<Database> reader)
    : path_(std::move(path)),
      settings_(std::move(settings)),
      quota_(std::make_unique<Quota>(settings_.max_bytes)),
      lock_(std::move(lock)),
      writer_(std::move(writer)),
      reader_(std::move(reader)) {}

Result<std::unique_ptr<Journal>> Journal::open(const std::string& path, JournalSettings settings) {
    MOTIONRACK_TRY(std::unique_ptr<Journal> journal, prepare(path, std::move(settings)));
    MOTIONRACK_CHECK(journal->begin());
    return journal;
}

Result<std::unique_ptr<Journal>> Journal::prepare(const std::string& name, JournalSettings settings) {
    // SQLite puts its log beside the file, not beside a link, and the lock must be the same under all names.
    const std::string path = file_behind(name);
    MOTIONRACK_TRY(auto lock, FileLock::take(path));
    MOTIONRACK_CHECK(make_private(path));
    MOTIONRACK_TRY(Database writer, Database::open(path, Database::Use::write));
    if (Result<void> made = prepare_tables(writer, path); !made) {
        if (made.error().message.find(path) != std::string::npos) return tl::unexpected<Error>(made.error());
        return fail(ErrorKind::io,
                    fmt::format("'{}' cannot be used as a journal: {}. It was not changed; name another file.", path,
                                made.error().message));
    }
    MOTIONRACK_TRY(Database reader, Database::open(path, Database::Use::read));
    std::unique_ptr<Journal> journal(new Journal(path, std::move(settings), std::move(lock),
                                                 std::make_unique<Database>(std::move(writer)),
                                                 std::make_unique<Database>(std::move(reader))));
    if (const Result<void> read = journal->read_file(); !read) return not_written(path, read.error().message);
    return journal;
}

Result<void> Journal::begin() {
    Result<void> begun = insert_run();
    if (begun) begun = watch_files();
    if (!begun) {
        // A run that did not begin must not look like one without an end.
        (void)writer_->run("ROLLBACK");
        (void)writer_->run(fmt::format("DELETE FROM run WHERE number = {}", run_).c_str());
        return begun;
    }
    writer_->set_log_kept(false);
    thread_ = std::thread([this] { work(); });
    return {};
}

Result<void> Journal::watch_files() {
    files_ = std::make_unique<FileWatch>();
    for (const char* end : {"", "-wal", ".lock"})
        if (const Result<void> added = files_->add(path_ + end); !added)
            return fail(ErrorKind::io,
                        fmt::format("The journal '{}' {}. Nothing was started; start again, or name another file.",
                                    path_, added.error().message));
    return {};
}

/// Reads the state left by the previous run.
Result<void> Journal::read_file() {
    const Database& file = *writer_;
    MOTIONRACK_CHECK(read_last_run());
    run_ = (before_ ? before_->run : 0) + 1;
    MOTIONRACK_TRY(const ChainCheck chain, check_chain(file, checked_at_start));
    if (before_ && !chain.problem.empty())
        before_->damage =
            fmt::format("The journal was changed: {}. Find the program that changed the file.", chain.problem);
    ChainEnd head = chain_head(file);
    last_number_ = head.number;
    last_link_ = std::move(head.link);
    return file.check_reads();
}

Result<void> Journal::insert_run() {
    const Database& file = *writer_;
    Result<void> inserted = file.run(
        fmt::format("BEGIN IMMEDIATE; INSERT INTO run (number, begun_ms) VALUES ({}, {})", run_, utc_ms()).c_str());
    if (inserted) inserted = remove_old_entries(file, max_entries);
    if (inserted) inserted = file.run("COMMIT");
    if (!inserted) return not_written(path_, inserted.error().message);
    // The file itself shows the new run, so that it cannot pass for the clean end of the previous one without its -wal.
    Statement merge(file.get(), "PRAGMA wal_checkpoint(TRUNCATE)");
    if (!merge.row()) return not_written(path_, file.what());
    if (merge.number(0) == 0) return {};
    return fail(ErrorKind::io,
                fmt::format("The journal '{}' was read by another program for more than {} s. Nothing was started; "
                            "close that program, then start again.",
                            path_, Database::busy_timeout.count()));
}

/// Reads how the previous run ended and its kept values, as far as their seals match.
Result<void> Journal::read_last_run() {
    const Database& file = *writer_;
    Statement last(file.get(),
                   "SELECT number, begun_ms, ended_ms IS NOT NULL, coalesce(ended_ms, 0), seal FROM run ORDER BY "
                   "number DESC LIMIT 1");
    if (!file.first_row(last)) return file.check_reads();
    const std::int64_t run = last.number(0), begun = last.number(1), ended = last.number(3);
    before_ = LastRun{run, last.number(2) != 0, std::max(begun, ended), {}, {}, {}};
    before_->last_ms = std::max(before_->last_ms, file.number("SELECT max(utc_ms) FROM entry"));
    MOTIONRACK_CHECK(read_kept(*before_));
    if (before_->clean && last.text(4) != seal_of_run(run, begun, ended, seals_, chain_head(file).link))
        before_->doubts.push_back(fmt::format("the end of run {} does not fit its checksum", run));
    return file.check_reads();
}

Result<void> Journal::read_kept(LastRun& last) {
    Statement kept(writer_->get(), "SELECT key, value, run, utc_ms, seal FROM kept");
    while (kept.row()) {
        const std::string key = kept.text(0), value = kept.text(1);
        seals_[key] = seal_of_kept(key, value, kept.number(2), kept.number(3));
        if (kept.text(4) != seals_[key]) {
            last.doubts.push_back(fmt::format("the stored value of '{}' does not fit its checksum", key));
            continue;
        }
        if (kept.number(2) != last.run)
            last.doubts.push_back(fmt::format("the stored value of '{}' is of run {}, not of the last one, {}", key,
                                              kept.number(2), last.run));
        last.kept[key] = value;
        last.last_ms = std::max(last.last_ms, kept.number(3));
    }
    if (!kept.ok()) return fail(ErrorKind::io, writer_->what());
    return {};
}

Journal::~Journal() {
    end_work();
}

/// Writes the queued entries first. Returns false if the run had already ended.
bool Journal::end_work() {
    {
        const std::lock_guard<std::mutex> guard(alone_);
        quit_ = true;
    }
    wake_up_.notify_one();
    if (!thread_.joinable()) return false;
    thread_.join();
    return true;
}

void Journal::write(Instant at, std::string kind, std::string text, std::string data, Done done) {
    bool is_queued = true, closed = false;
    {
        const std::lock_guard<std::mutex> guard(alone_);
        closed = quit_;
        is_queued = waiting_.size() < max_waiting && !closed;
        if (is_queued)
            waiting_.push_back(
                {{0, run_, utc_ms(), at, std::move(kind), std::move(text), std::move(data)}, std::move(done)});
    }
    if (is_queued) return wake_up_.notify_one();
    if (!closed) failed(fmt::format("is delayed: {} entries wait for the disk", max_waiting));
    if (!done) return;  // NOLINT(bugprone-use-after-move): moved only if the queue had space
    done(fail(ErrorKind::io,
              closed
                  ? "It was not written to the journal, which is closed."
                  : fmt::format("It was not written to the journal: {} entries wait for the disk, which is the limit.",
                                max_waiting)));
}

void Journal::keep(std::string key, std::string value) {
    {
        const std::lock_guard<std::mutex> guard(alone_);
        keeping_[std::move(key)] = std::move(value);
    }
    wake_up_.notify_one();
}

void Journal::work() {
    for (;;) {
        std::vector<PendingEntry> entries;
        std::map<std::string, std::string> kept;
        {
            std::unique_lock<std::mutex> guard(alone_);
            const auto changed = [this] { return quit_ || !waiting_.empty() || !keeping_.empty(); };
            if (!wake_up_.wait_for(guard, poll_period, changed)) {
                guard.unlock();
                if (const Result<void> there = files_->check(); !there) failed(there.error().message);
                continue;
            }
            if (waiting_.empty() && keeping_.empty()) return;
            entries.swap(waiting_);
            kept.swap(keeping_);
        }
        // Does not acknowledge entries written to a file that was deleted in the meantime.
        Result<void> stored = store(entries, kept);
        if (!stored) {
            (void)writer_->run("ROLLBACK");
            failed(fmt::format("could not be written: {}", stored.error().message));
        } else if (stored = files_->check(); !stored) {
            failed(stored.error().message);
        }
        if (stored && !entries.empty()) keep_quota(entries.back().entry.at);
        for (const PendingEntry& one : entries)
            if (one.done) one.done(stored ? Result<std::int64_t>(one.entry.number) : fail(ErrorKind::io, failure()));
    }
}

void Journal::keep_quota(Instant at) {
    const Result<std::string> changed = quota_->check(*writer_);
    if (!changed) {
        (void)writer_->run("ROLLBACK");
        return failed(fmt::format("could not be kept within its quota: {}", changed.error().message));
    }
    if (changed->empty()) return;
    write(at, "journal", *changed);
    if (settings_.on_quota) settings_.on_quota(*changed);
}

/// Any thread. Keeps the first failure; later ones are consequences.
void Journal::failed(const std::string& what) {
    const std::lock_guard<std::mutex> guard(alone_);
    if (failure_.empty()) failure_ = fmt::format("The journal '{}' {}.", path_, what);
    has_failed_ = true;
}

std::string Journal::failure() const {
    if (!has_failed_) return {};
    const std::lock_guard<std::mutex> guard(alone_);
    return failure_;
}

Result<void> Journal::store(std::vector<PendingEntry>& entries, const std::map<std::string, std::string>& kept) {
    const auto failed = [this] { return fail(ErrorKind::io, writer_->what()); };
    MOTIONRACK_CHECK(writer_->run("BEGIN IMMEDIATE"));
    Statement insert(writer_->get(),
                     "INSERT INTO entry (number, run, utc_ms, at, kind, text, data, link) VALUES (?1, ?2, ?3, ?4, ?5, "
                     "?6, ?7, ?8)");
    ChainEnd head{last_number_, last_link_};
    for (PendingEntry& one : entries) {
        Entry& entry = one.entry;
        entry.number = ++head.number;
        head.link = link_of(head.link, entry);
        insert.bind(1, entry.number)
            .bind(2, entry.run)
            .bind(3, entry.utc_ms)
            .bind(4, entry.at.count())
            .bind(5, entry.kind)
            .bind(6, entry.text)
            .bind(7, entry.data)
            .bind(8, head.link);
        (void)insert.row();
        if (!insert.ok()) return failed();
        insert.again();
    }
    if (!entries.empty()) MOTIONRACK_CHECK(set_chain_end(*writer_, "head", head));
    Statement replace(writer_->get(),
                      "INSERT OR REPLACE INTO kept (key, value, run, utc_ms, seal) VALUES (?1, ?2, ?3, ?4, ?5)");
    std::map<std::string, std::string> seals = seals_;
    for (const auto& [key, value] : kept) {
        const std::int64_t now = utc_ms();
        const std::string seal = seals[key] = seal_of_kept(key, value, run_, now);
        replace.bind(1, key).bind(2, value).bind(3, run_).bind(4, now).bind(5, seal);
        (void)replace.row();
        if (!replace.ok()) return failed();
        replace.again();
    }
    MOTIONRACK_CHECK(writer_->run("COMMIT"));
    last_number_ = head.number;
    last_link_ = std::move(head.link);
    seals_ = std::move(seals);
    return {};
}

Result<void> Journal::close() {
    if (!end_work()) return {};
    if (const Result<void> there = files_->check(); !there) failed(there.error().message);
    if (!has_failed_) {
        const std::int64_t begun =
                               writer_->number(fmt::format("SELECT begun_ms FROM run WHERE number = {}", run_).c_str()),
                           now = utc_ms();
        Result<void> ended = writer_->check_reads();
        if (ended)
            ended = writer_->run(fmt::format("UPDATE run SET ended_ms = {}, seal = '{}' WHERE number = {}", now,
                                             seal_of_run(run_, begun, now, seals_, last_link_), run_)
                                     .c_str());
        if (!ended) failed(fmt::format("could not be written: {}", ended.error().message));
    }
    if (!has_failed_) return {};
    return fail(ErrorKind::io,
                failure() + " The end of this run is not in it: no position is valid at the next start.");
}

Result<ChainCheck> Journal::check() const {
    const std::lock_guard<std::mutex> guard(reading_);
    return check_chain(*reader_);
}

Result<std::vector<Entry>> Journal::read(const JournalQuery& question) const {
    if (question.limit < 1 || question.limit > 10000)
        return fail(ErrorKind::invalid_input,
                    fmt::format("The limit of a journal query is {}; it must be 1 to 10000.", question.limit));
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
    if (!select.ok()) return fail(ErrorKind::io, fmt::format("The journal cannot be read: {}.", reader_->what()));
    std::reverse(out.begin(), out.end());
    return out;
}

}  // namespace motionrack::journal
