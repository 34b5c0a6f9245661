// A file of SQLite and its prepared statements, closed by themselves.
#pragma once

#include <sqlite3.h>

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
    /// True: there is a row. False: none is left, or see ok().
    bool row();
    bool ok() const { return code_ == SQLITE_OK || code_ == SQLITE_DONE || code_ == SQLITE_ROW; }
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
    /// Errors: io, with what SQLite says.
    static Result<Database> open(const std::string& path, Use use);
    sqlite3* get() const { return database_.get(); }
    /// Whether the log (-wal) stays beside the file when it is closed, as it does at first: a file that is refused is
    /// left as it is. Else what is in the log goes into the file.
    void set_log_kept(bool kept) const;
    /// Errors: io.
    Result<void> run(const char* sql) const;
    /// The first number of the first row; 0 if there is none.
    std::int64_t number(const char* sql) const;
    std::string what() const { return sqlite3_errmsg(database_.get()); }

  private:
    struct Close {
        void operator()(sqlite3* one) const { sqlite3_close(one); }
    };
    explicit Database(sqlite3* database) : database_(database) {}
    std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace motionrack::journal
