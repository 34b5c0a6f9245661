// Bytes of a capture in pieces, from a file or from memory; and text as lines or words, each with its line number.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::decode {

class Source {
  public:
    virtual ~Source() = default;
    /// Reads up to `size` bytes; returns 0 at the end. Errors: io.
    virtual Result<std::size_t> read(char* to, std::size_t size) = 0;
    /// Total number of bytes; 0 if unknown (a pipe).
    virtual std::uint64_t total() const = 0;
};

/// Opens a file; "-" is standard input. Errors: io.
Result<std::unique_ptr<Source>> open_file(const std::string& path);
/// Returns a source of the bytes of `text`, which must outlive it.
std::unique_ptr<Source> from_memory(std::string_view text);

class TextReader {
  public:
    explicit TextReader(Source& source) : source_(source), buffer_(first_size) {}

    /// The next line without its end, or the next word between white space; valid until the next call. Returns false at
    /// the end or after an error.
    bool line(std::string_view& out);
    bool word(std::string_view& out);
    /// Returns the next byte that is not white space, without taking it; 0 at the end.
    char peek();

    /// Position of the line or word, counted from 1.
    TextPosition location() const { return {static_cast<int>(line_), column_}; }
    /// Returns true if the file ends directly after the last line or word, without a line end: it may be truncated.
    bool cut() const { return cut_; }
    /// Error that ended the reading, if any.
    const std::optional<Error>& error() const { return error_; }
    std::uint64_t bytes() const { return bytes_; }

  private:
    static constexpr std::size_t first_size = 256 * 1024;
    static constexpr std::size_t max_line_bytes = 1024 * 1024;  ///< maximum length of a line or word
    bool more();
    bool skip_white();

    Source& source_;
    std::vector<char> buffer_;
    std::size_t at_ = 0, end_ = 0;
    std::uint64_t bytes_ = 0;
    std::int64_t line_ = 0, next_line_ = 1;
    std::size_t line_start_ = 0;  ///< index of the line's first byte in the buffer; wraps once that is discarded
    int column_ = 0;
    bool cut_ = false, over_ = false;
    std::optional<Error> error_;
};

}  // namespace motionrack::decode
