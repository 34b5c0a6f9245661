// Reads a CSV file (RFC 4180) row by row; skips a byte order mark and empty lines.
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
    /// Opens the file and reads its head. Errors: io, invalid_input (no head).
    static Result<CsvRows> open(const std::string& path);

    const std::vector<std::string>& head() const { return head_; }
    /// Reads the next row into `fields`, as many as the head has; false at the end. Errors: io, invalid_input with the
    /// line: wrong number of fields, or a field above 1 MB.
    Result<bool> next(std::vector<std::string>& fields);
    /// First line of the last row, from 1.
    int line() const { return line_; }
    double part() const { return bytes_.part(); }
    /// Returns true if the file ends inside the last row.
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
