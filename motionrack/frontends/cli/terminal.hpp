// What the person at the terminal sees: colours only on a terminal, progress on one line, files whole or an error.
#pragma once

#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack::cli {

/// True if standard error (2) or standard output (1) is a terminal that takes colours (NO_COLOR and TERM=dumb are
/// heeded).
bool is_terminal(int descriptor);

/// "error: ..." in red on a terminal, to standard error.
void print_error(std::string_view sentence);
void print_warning(std::string_view sentence);

/// Reads a whole file, "-" is standard input. Errors: as read_whole_file.
Result<std::string> read_text(const std::string& path, const ReadLimit& limit = read_limits::program);
/// Whether a file can be written there, before the work that it is to hold; changes nothing. Errors: io.
Result<void> check_writable(const std::string& path);
/// Writes a whole file. Errors: io.
Result<void> write_text(const std::string& path, std::string_view text);

/// Prints the error and gives the exit code that belongs to it.
int report(const Error& error);

/// One line that is rewritten while a long job runs; nothing where standard error is no terminal or `quiet`.
class ProgressLine {
  public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine() { clear(); }
    /// `part` 0 .. 1.
    void show(double part, std::string_view text);
    void clear();

  private:
    bool on_;
    bool shown_ = false;
    double last_part_ = -1;
};

}  // namespace motionrack::cli
