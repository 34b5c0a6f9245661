// A file in a private folder, for libraries that read files only: in memory if the system has /dev/shm. The folder and
// its content are removed at the end of the program.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <tests/fuzz/require.hpp>

namespace motionrack::fuzz {

class ScratchFile {
  public:
    explicit ScratchFile(const std::string& name) {
        const bool has_memory = ::access("/dev/shm", W_OK) == 0;
        std::string folder = has_memory ? "/dev/shm" : std::filesystem::temp_directory_path().string();
        folder += "/motionrack-fuzz-XXXXXX";
        require(::mkdtemp(folder.data()) != nullptr, "a folder can be made for the file");
        folder_ = folder;
        path_ = (folder_ / name).string();
    }
    ~ScratchFile() {
        std::error_code error;
        std::filesystem::remove_all(folder_, error);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    const std::string& path() const { return path_; }
    /// Path of another file in the folder.
    std::string beside(const std::string& name) const { return (folder_ / name).string(); }

    /// Writes the file with owner-only rights and removes all other files in the folder.
    void write(std::string_view bytes) const {
        clear();
        std::ofstream file(path_, std::ios::binary);
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        file.close();
        require(file.good(), "the file can be written");
        std::filesystem::permissions(path_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    }
    /// Empty if the file does not exist.
    std::string bytes() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }
    /// Removes all files in the folder.
    void clear() const {
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) std::filesystem::remove_all(entry);
    }

  private:
    std::filesystem::path folder_;
    std::string path_;
};

}  // namespace motionrack::fuzz
