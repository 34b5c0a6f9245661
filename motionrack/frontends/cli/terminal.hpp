// Terminal output: colours only on a terminal, progress on one line; files are written completely or an error is
// reported.
#pragma once

#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack::cli {

/// Returns true if standard error (2) or standard output (1) is a terminal with colours (respects NO_COLOR and
/// TERM=dumb).
bool is_terminal(int descriptor);

/// Prints "error: ..." to standard error, in red on a terminal.
void print_error(std::string_view sentence);
void print_warning(std::string_view sentence);

/// Reads a whole file ("-": standard input). Errors: as read_whole_file.
Result<std::string> read_text(const std::string& path, const ReadLimit& limit = read_limits::program);
/// Checks, before the work starts, that a file can be written to this path; changes nothing. Errors: io.
Result<void> check_writable(const std::string& path);
/// Writes a whole file. Errors: io.
Result<void> write_text(const std::string& path, std::string_view text);

/// Prints the error and returns its exit code.
int report(const Error& error);

/// Progress line, rewritten during a long job. Prints nothing if standard error is not a terminal or `quiet` is set.
class ProgressLine {
  public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine() { clear(); }
    /// `part`: progress, 0 .. 1.
    void show(double part, std::string_view text);
    void clear();

  private:
    bool on_;
    bool shown_ = false;
    double last_part_ = -1;
};

}  // namespace motionrack::cli
