// A file that replaces its target only when complete; until then the existing file stays unchanged.
//
//  create ──► NAME.incomplete ──write──► ... ──commit──► synced, read back, then renamed to NAME
//                 │ an error, or the end of the program
//                 └──► NAME is unchanged; NAME.incomplete is removed, or kept if a partial file is useful
//
// Devices, pipes and paths in /dev and /proc cannot be rename targets; they are written in place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::disk {

/// Suffix of the incomplete file beside its final name.
inline constexpr const char* beside = ".incomplete";

enum class Rights : std::uint8_t {
    usual,  ///< those of the existing file, or by the umask
    owner   ///< readable by the owner only
};

class NewFile {
  public:
    enum class Incomplete : std::uint8_t { remove, keep };  ///< what becomes of an incomplete file

    NewFile() = default;
    NewFile(NewFile&& other) noexcept { swap(other); }
    NewFile& operator=(NewFile&& other) noexcept {
        NewFile taken(std::move(other));
        swap(taken);  // the previous content of this is closed here
        return *this;
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile();

    /// Creates the incomplete file. Errors: io; the message is the reason alone, "No space left on device", for the
    /// caller's sentence.
    static Result<NewFile> create(const std::string& path, Incomplete part = Incomplete::remove,
                                  Rights rights = Rights::usual);
    /// Creates a log, which must exist from its first line: writes in place. Errors: as create().
    static Result<NewFile> create_in_place(const std::string& path);

    explicit operator bool() const { return file_ >= 0; }
    /// Path of the bytes until commit(), for a library that opens files by name. Its data is not read back here.
    const std::string& path_until_whole() const { return made_; }
    /// Returns false on a write error; see trouble(). After an error nothing more is written; written() returns the
    /// bytes written.
    bool write(std::string_view bytes);
    /// Clears an error, so that a caller with the unwritten data can write and commit again. Has no effect on an ended
    /// file.
    void try_again() {
        if (file_ >= 0) trouble_.clear();
    }
    std::uint64_t written() const { return written_; }
    /// First error as a reason; empty: none.
    const std::string& trouble() const { return trouble_; }
    /// From now on, keeps an incomplete file under path_until_whole().
    void keep_part() { part_ = Incomplete::keep; }
    bool is_part_kept() const { return part_ == Incomplete::keep; }
    /// Syncs the file, verifies it against the written bytes, and renames it. Errors: io with the reason alone; a retry
    /// is allowed. After success, later calls do nothing.
    Result<void> commit();
    /// Errors: io, the first error as a sentence, for a file with a kept part; `kind`: "CSV".
    Result<void> reported(std::string_view kind) const;

  private:
    void swap(NewFile& other) noexcept;
    bool fail_with(int code);
    bool is_as_written();
    bool close();

    int file_ = -1;
    std::string path_, made_, trouble_;  ///< final path; path while incomplete (equal for a device); error
    Incomplete part_ = Incomplete::remove;
    std::uint64_t written_ = 0;
    unsigned long checksum_ = 0;  ///< CRC-32 of the bytes written here
};

/// Writes a whole file. Errors: io with the reason alone.
Result<void> write_whole(const std::string& path, std::string_view bytes, Rights rights = Rights::usual);

}  // namespace motionrack::disk
