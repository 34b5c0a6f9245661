#include <fmt/format.h>

#include <motionrack/journal/database.hpp>
#include <utility>

namespace motionrack::journal {

Statement::Statement(sqlite3* database, const char* sql) {
    sqlite3_stmt* one = nullptr;
    code_ = sqlite3_prepare_v2(database, sql, -1, &one, nullptr);
    statement_.reset(one);
}

Statement& Statement::bind(int place, std::int64_t value) {
    sqlite3_bind_int64(statement_.get(), place, value);
    return *this;
}

Statement& Statement::bind(int place, std::string_view text) {
    sqlite3_bind_text(statement_.get(), place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
}

bool Statement::row() {
    if (!statement_) return false;
    code_ = sqlite3_step(statement_.get());
    return code_ == SQLITE_ROW;
}

std::string Statement::text(int column) const {
    const auto* begin = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    return begin == nullptr
               ? std::string()
               : std::string(begin, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)));
}

void Statement::again() {
    sqlite3_reset(statement_.get());
}

Result<Database> Database::open(const std::string& path, Use use) {
    sqlite3* one = nullptr;
    const int flags = use == Use::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
    const int code = sqlite3_open_v2(path.c_str(), &one, flags | SQLITE_OPEN_NOMUTEX, nullptr);
    Database database(one);
    if (code != SQLITE_OK)
        return fail(ErrorKind::io, fmt::format("The journal '{}' cannot be opened: {}.", path, sqlite3_errstr(code)));
    sqlite3_busy_timeout(one, static_cast<int>(std::chrono::milliseconds(busy_timeout).count()));
    database.set_log_kept(true);
    return database;
}

void Database::set_log_kept(bool kept) const {
    sqlite3_db_config(get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, kept ? 1 : 0, nullptr);
}

Result<void> Database::run(const char* sql) const {
    if (sqlite3_exec(get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK) return {};
    return fail(ErrorKind::io, what());
}

std::int64_t Database::number(const char* sql) const {
    Statement one(get(), sql);
    return first_row(one) ? one.number(0) : 0;
}

bool Database::first_row(Statement& one) const {
    const bool read = one.row();
    if (!read && !one.ok() && one.fits()) read_error_ = what();
    return read;
}

Result<void> Database::check_reads() const {
    if (read_error_.empty()) return {};
    return fail(ErrorKind::io, std::exchange(read_error_, {}));
}

}  // namespace motionrack::journal
