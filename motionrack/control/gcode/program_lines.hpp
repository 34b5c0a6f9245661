// Divides a text into lines.
#pragma once

#include <cstdint>
#include <string_view>

namespace motionrack::control::gcode {

/// Divides a text into lines at LF, CR LF or CR, and skips a byte order mark at the beginning. A copy stores a position
/// to which the reader can return.
class ProgramLines {
  public:
    explicit ProgramLines(std::string_view text);

    /// Returns the next line without its end; false after the last one. A line longer than `max_line_length` is
    /// truncated to max_line_length + 1 characters; the next call skips the rest.
    bool next(std::string_view& line);

    std::int32_t number() const { return number_; }  ///< number of the last line, from 1
    bool at_end() const { return at_ == end_ && !skip_; }

  private:
    const char* at_;
    const char* end_;
    std::int32_t number_ = 0;
    bool skip_ = false;
};

}  // namespace motionrack::control::gcode
