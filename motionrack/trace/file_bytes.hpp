// Reads a file sequentially, byte by byte, through a buffer.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <motionrack/base/result.hpp>
#include <string>
#include <vector>

namespace motionrack::trace {

class FileBytes {
  public:
    /// Errors: io.
    static Result<FileBytes> open(const std::string& path);

    /// Returns the next byte; -1 at the end or on a read error, see check().
    int get() { return at_ < end_ || fill() ? static_cast<unsigned char>(buffer_[at_++]) : -1; }
    /// Returns the next byte without consuming it; -1 at the end.
    int peek() { return at_ < end_ || fill() ? static_cast<unsigned char>(buffer_[at_]) : -1; }
    /// Returns the part of the file read so far, 0 .. 1.
    double part() const { return total_ > 0 ? static_cast<double>(read_) / static_cast<double>(total_) : 1; }
    /// Errors: io, if a read failed.
    Result<void> check() const;
    const std::string& path() const { return path_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    bool fill();

    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<char> buffer_;
    std::size_t at_ = 0, end_ = 0;
    std::uint64_t read_ = 0, total_ = 0;
    int trouble_ = 0;
};

}  // namespace motionrack::trace
