// RAII wrappers of an SQLite file and its prepared statements.
#pragma once

#include <sqlite3.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack::journal {

class Statement {
  public:
    Statement(sqlite3* database, const char* sql);
    Statement& bind(int place, std::int64_t value);
    Statement& bind(int place, std::string_view text);
    /// Returns true if a row was read; false at the end or on an error, see ok().
    bool row();
    /// Returns true if row() has reached the end.
    bool ok() const { return code_ == SQLITE_DONE; }
    /// Returns false if SQLite rejects the statement for this file: one of its tables is missing.
    bool fits() const { return code_ != SQLITE_ERROR; }
    std::int64_t number(int column) const { return sqlite3_column_int64(statement_.get(), column); }
    std::string text(int column) const;
    void again();

  private:
    struct Finalize {
        void operator()(sqlite3_stmt* one) const { sqlite3_finalize(one); }
    };
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    int code_ = SQLITE_OK;
};

class Database {
  public:
    enum class Use { write, read };
    /// How long an access waits for other programs that use the file.
    static constexpr std::chrono::seconds busy_timeout{5};
    /// Errors: io, with the SQLite message.
    static Result<Database> open(const std::string& path, Use use);
    sqlite3* get() const { return database_.get(); }
    /// Sets whether the log (-wal) stays beside the file on close. It does by default, so that a rejected file is left
    /// unchanged. Otherwise the log is merged into the file.
    void set_log_kept(bool kept) const;
    /// Errors: io.
    Result<void> run(const char* sql) const;
    /// Reads the first row of `one`. Returns false without rows or if it cannot be read: see check_reads().
    bool first_row(Statement& one) const;
    /// Returns the first column of the first row; 0 without rows or if it cannot be read: see check_reads().
    std::int64_t number(const char* sql) const;
    /// Errors: io, with the SQLite message, if first_row() or number() could not read since the last call.
    Result<void> check_reads() const;
    std::string what() const { return sqlite3_errmsg(database_.get()); }

  private:
    struct CloseDatabase {
        void operator()(sqlite3* one) const { sqlite3_close(one); }
    };
    explicit Database(sqlite3* database) : database_(database) {}
    std::unique_ptr<sqlite3, CloseDatabase> database_;
    mutable std::string read_error_;
};

}  // namespace motionrack::journal
