// A CSV file (RFC 4180) read row by row; a byte order mark and empty lines are passed over.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/trace/file_bytes.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::trace {

class CsvRows {
  public:
    /// Reads the head. Errors: io, invalid_input (there is none).
    static Result<CsvRows> open(const std::string& path);

    const std::vector<std::string>& head() const { return head_; }
    /// The next row into `fields`, as many as the head has; false at the end. Errors: io, invalid_input with its line:
    /// another number of fields, a field of more than 1 MB.
    Result<bool> next(std::vector<std::string>& fields);
    /// The line on which the last row began, from 1.
    int line() const { return line_; }
    double part() const { return bytes_.part(); }
    /// The last row was not ended: the file was cut off in it.
    bool cut() const { return cut_; }

  private:
    Result<bool> read(std::vector<std::string>& fields);
    bool is_blank(const std::vector<std::string>& fields) const;
    tl::unexpected<Error> refuse(const std::string& message) const;

    FileBytes bytes_;
    std::vector<std::string> head_;
    int line_ = 0, next_line_ = 1;
    bool cut_ = false;
};

}  // namespace motionrack::trace
