// Cutting a text into lines.
#pragma once

#include <cstdint>
#include <string_view>

namespace motionrack::control::gcode {

/// Cuts a text into lines at LF, CR LF or CR, and leaves out a byte order mark at the beginning. A copy is a place in
/// the text to which one can come back.
class ProgramLines {
  public:
    explicit ProgramLines(std::string_view text);

    /// The next line, without its end; false: there is none. Of a line longer than `max_line_length` only the first
    /// max_line_length + 1 characters are given, and the rest is skipped at the next call.
    bool next(std::string_view& line);

    std::int32_t number() const { return number_; }  ///< of the line that next() gave, from 1
    bool at_end() const { return at_ == end_ && !skip_; }

  private:
    const char* at_;
    const char* end_;
    std::int32_t number_ = 0;
    bool skip_ = false;
};

}  // namespace motionrack::control::gcode
