// File mapped into memory that is shared with another process.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <string>

namespace motionrack::live_test {

class MappedFile {
  public:
    /// `create`: creates it with that length, zero-filled.
    MappedFile(const std::string& path, std::size_t length, bool create) : length_(length) {
        const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | (create ? O_CREAT | O_TRUNC : 0), 0600);
        if (file < 0) return;
        if (!create || ::ftruncate(file, static_cast<off_t>(length)) == 0)
            data_ = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        ::close(file);
    }
    ~MappedFile() {
        if (data_ != MAP_FAILED) ::munmap(data_, length_);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    explicit operator bool() const { return data_ != MAP_FAILED; }
    template <class T>
    T& as(std::size_t offset = 0) const {
        return *reinterpret_cast<T*>(static_cast<char*>(data_) + offset);
    }

  private:
    std::size_t length_;
    void* data_ = MAP_FAILED;
};

}  // namespace motionrack::live_test
