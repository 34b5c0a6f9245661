// An open file that closes itself, and messages for errors of Linux.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <string>
#include <utility>

namespace motionrack::live {

class File {
  public:
    /// Opens a file for reading and writing. Errors: io, with the remedy.
    static Result<File> open(const std::string& path, int flags = 0);
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    File& operator=(File&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~File();
    int descriptor() const { return descriptor_; }
    /// Locks these bytes of the file against other Files that lock them, in this or another program, until it is closed
    /// or the process ends. `named`: name of the file in messages. Errors: refused, another File has locked them; io.
    Result<void> keep(std::uint64_t from, std::uint64_t length, const std::string& named) const;

  private:
    explicit File(int descriptor) : descriptor_(descriptor) {}
    int descriptor_;
};

}  // namespace motionrack::live
