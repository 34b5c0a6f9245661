// A file that takes its name when it is whole: what stood there before stays as it was until then.
//
//   create ──► NAME.new ──write──► ... ──commit──► on the disk, read back, then renamed to NAME
//                  │ an error, or the end of the program
//                  └──► NAME as it was; NAME.new is removed, or kept where a part of it is worth something
//
// Devices, pipes and what lies in /dev and /proc cannot be renamed to: they are written as they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::disk {

/// The ending of a file that is being made, beside the name that it will take.
inline constexpr const char* beside = ".new";

enum class Rights : std::uint8_t {
    usual,  ///< those of the file that was there, or as the user's mask says
    owner   ///< only the owner reads it
};

class NewFile {
  public:
    enum class Part : std::uint8_t { remove, keep };  ///< of a file that does not become whole

    NewFile() = default;
    NewFile(NewFile&& other) noexcept { swap(other); }
    NewFile& operator=(NewFile&& other) noexcept {
        NewFile taken(std::move(other));
        swap(taken);  // what this was ends here
        return *this;
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile();

    /// Errors: io. The message is the reason alone, "No space left on device", for a sentence of the caller's.
    static Result<NewFile> create(const std::string& path, Part part = Part::remove, Rights rights = Rights::usual);
    /// The same of a log, which is there from its first line on: it is written in its place.
    static Result<NewFile> create_in_place(const std::string& path);

    explicit operator bool() const { return file_ >= 0; }
    /// Where the bytes are until commit(): for a library that opens files by their names. What it writes is not read
    /// back here.
    const std::string& path_until_whole() const { return made_; }
    /// False: it could not be written; see trouble(). Nothing is written after a failure; written() says how far it
    /// came.
    bool write(std::string_view bytes);
    /// Forgets a failure: who has kept what was not written writes it now, and commits once more. Nothing of a file
    /// that has ended.
    void try_again() {
        if (file_ >= 0) trouble_.clear();
    }
    std::uint64_t written() const { return written_; }
    /// The first reason of a failure; empty: none.
    const std::string& trouble() const { return trouble_; }
    /// A file that does not become whole stays under path_until_whole(), from now on.
    void keep_part() { part_ = Part::keep; }
    bool is_part_kept() const { return part_ == Part::keep; }
    /// Puts it on the disk, compares what is there with what was written, and gives it its name. Errors: io, with the
    /// reason alone; it may be tried again. Done once; later calls do nothing.
    Result<void> commit();
    /// Errors: io, the first failure as a sentence, for a file whose part is kept; `kind`: "CSV".
    Result<void> told(std::string_view kind) const;

  private:
    void swap(NewFile& other) noexcept;
    bool fail_with(int code);
    bool is_as_written();
    bool close();

    int file_ = -1;
    std::string path_, made_, trouble_;  ///< the name; where it is made, the same for a device
    Part part_ = Part::remove;
    std::uint64_t written_ = 0;
    unsigned long checksum_ = 0;  ///< CRC-32 of what was written here
};

/// A whole file at once. Errors: io, with the reason alone.
Result<void> write_whole(const std::string& path, std::string_view bytes, Rights rights = Rights::usual);

}  // namespace motionrack::disk
