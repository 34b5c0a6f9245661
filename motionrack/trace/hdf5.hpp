// HDF5 files (1.10 or later) for recordings: groups, attributes, texts, and columns that grow at their end.
//
//   create ──► groups, texts, columns ──► begin_streaming ──► append, flush, append, flush ...  ──► close
//                                             │ from here on no new objects (SWMR: one writer, many readers);
//                                             │ flushed data stays readable after a crash of the writer
//  reopen ──► more groups, texts ──► close: verified against the written data, then renamed
//  open   ──► read; also opens a file that its writer never closed, and reports so
//
// All data is compressed and checksummed, including the structures of the library, so that damage is detected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/disk/new_file.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::trace::hdf5 {

/// RAII handle of a library object.
class Handle {
  public:
    using Close = int (*)(std::int64_t);
    Handle() = default;
    Handle(std::int64_t id, Close how) : id_(id), close_(how) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Handle() { close(); }

    std::int64_t get() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }
    /// Returns false if closing failed, so that its data may not be on disk.
    bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

  private:
    std::int64_t id_ = -1;
    Close close_ = nullptr;
};

enum class Type : std::uint8_t { int8, int32, int64, float32, float64, text };

template <class T>
constexpr Type type_of = Type::text;
template <>
inline constexpr Type type_of<std::int8_t> = Type::int8;
template <>
inline constexpr Type type_of<std::int32_t> = Type::int32;
template <>
inline constexpr Type type_of<std::int64_t> = Type::int64;
template <>
inline constexpr Type type_of<float> = Type::float32;
template <>
inline constexpr Type type_of<double> = Type::float64;

/// Settings of a new column.
struct ColumnSettings {
    Type type = Type::int64;
    std::size_t text_bytes = 0;   ///< bytes per element of text
    std::size_t chunk = 1 << 14;  ///< elements compressed and written together
    std::string unit;             ///< "s", "mm", "count"; empty: no unit
    double scale = 1;             ///< value in `unit` = stored number times this
};

/// Expected state of a column or an attribute when the file is read back.
struct ExpectedData {
    Type type = Type::int64;
    std::uint64_t size = 0;      ///< elements; bytes of an attribute
    std::size_t text_bytes = 0;  ///< bytes per element of text
    unsigned long checksum = 0;  ///< CRC-32 of its bytes

    void add(const void* data, std::size_t bytes);
};

/// Dataset that grows at its end.
class Writer {
  public:
    /// Appends `count` elements of the column's type. Returns false on a write error (see Hdf5File::trouble).
    bool append(const void* data, std::size_t count);
    std::uint64_t size() const { return size_; }
    std::size_t text_bytes() const { return text_bytes_; }

  private:
    friend class Hdf5File;
    Handle set_;
    Type type_ = Type::int64;
    std::size_t text_bytes_ = 0;
    std::uint64_t size_ = 0;
    std::shared_ptr<ExpectedData> written_;
};

/// Dataset that is read in pieces.
class Reader {
  public:
    std::uint64_t size() const { return size_; }
    /// Returns elements [from, from + count) converted to T. Errors: io, including damage.
    template <class T>
    Result<void> read(std::uint64_t from, std::size_t count, T* out) const {
        return read(type_of<T>, from, count, out);
    }
    /// Returns text element `at` without trailing zeros. Errors: io, invalid_input (not text).
    Result<std::string> text(std::uint64_t at) const;

  private:
    friend class Hdf5File;
    Result<void> read(Type type, std::uint64_t from, std::size_t count, void* out) const;
    tl::unexpected<Error> damaged() const;

    Handle set_;
    std::string file_, path_;
    std::uint64_t size_ = 0;
};

class Hdf5File {
  public:
    /// Creates a file that gets its final name on close; an existing file stays until then. Errors: io.
    static Result<Hdf5File> create(const std::string& path);
    /// Opens for reading. Errors: io (missing or unreadable), invalid_input (not an HDF5 file, damaged).
    static Result<Hdf5File> open(const std::string& path);

    /// For a file opened for reading: its writer did not close it and was killed or is still running.
    bool unfinished() const { return unfinished_; }
    const std::string& path() const { return path_; }

    // ---- writing; errors are stored, see trouble()
    /// Creates the group and all its parents: "axes/x/steps".
    void make_group(const std::string& path);
    Writer make_column(const std::string& path, const ColumnSettings& settings);
    void write_text(const std::string& path, std::string_view text);
    /// Sets an attribute of `object`: a group or a column; "/" for the file.
    void set(const std::string& object, const char* name, std::string_view text);
    void set(const std::string& object, const char* name, double value);
    void set(const std::string& object, const char* name, std::int64_t value);
    /// From now on columns grow and no other objects can be created. The incomplete file, beside its final name,
    /// survives a crash of the writer.
    void begin_streaming();
    /// Makes all appended data readable, even if the program is killed afterwards.
    void flush();
    /// Ends streaming, so that more objects can be created. Requires that columns and other handles are closed. Errors:
    /// as close.
    Result<void> reopen();
    /// Requires that columns and other handles are closed. Verifies the whole file before renaming it. Errors: io, the
    /// first error since the file was created.
    Result<void> close();
    const std::string& trouble() const { return trouble_; }
    /// Stores the error that close() reports, unless one exists.
    void set_trouble(const std::string& text) {
        if (trouble_.empty()) trouble_ = text;
    }

    // ---- reading
    /// Returns true if the object exists. Errors: io if the file cannot be read, or is damaged there.
    Result<bool> has(const std::string& path) const;
    /// Errors: invalid_input if the column is missing or its size is implausible.
    Result<Reader> column(const std::string& path) const;
    /// Errors: as column, io.
    Result<std::string> text(const std::string& path) const;
    /// Returns an attribute of the file or a group; empty, or 0, if missing, or of another kind. Errors: as has.
    Result<std::string> attribute_text(const char* name, const std::string& group = "/") const;
    Result<std::int64_t> attribute_number(const char* name) const;

  private:
    bool good(std::int64_t code, const char* what);
    Result<void> close_library();
    bool is_as_written() const;
    tl::unexpected<Error> unreadable(const std::string& what) const;
    void put_attribute(const std::string& object, const char* name, std::int64_t type, const void* value);

    std::string path_;
    disk::NewFile made_;  ///< file being written
    Handle file_;         ///< library handle; closed first
    bool unfinished_ = false;
    std::string trouble_;
    std::map<std::string, std::shared_ptr<ExpectedData>> columns_;            ///< by path
    std::map<std::pair<std::string, std::string>, ExpectedData> attributes_;  ///< by object and name
};

}  // namespace motionrack::trace::hdf5
