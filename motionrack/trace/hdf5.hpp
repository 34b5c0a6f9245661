// Files of HDF5 (1.10 or later), as recordings need them: groups, attributes, texts, and columns that grow at their
// end.
//
//   create ──► groups, texts, columns ──► begin_streaming ──► append, flush, append, flush ...  ──► close
//                                              │ from here on nothing else may be made (SWMR: one writes, many read);
//                                              │ what was flushed stays readable, whatever becomes of the writer
//   reopen ──► more groups, texts ──► close: read back whole, and put in its place
//   open   ──► read; a file that its writer never closed opens, too, and says so
//
// Everything is compressed and carries checksums, the library's own structures too, so that damage is found and told.
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

/// Something of the library that is closed by itself.
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
    /// False: it could not be closed, so what it held may not be on disk.
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

/// A column that does not exist yet.
struct ColumnSettings {
    Type type = Type::int64;
    std::size_t text_bytes = 0;   ///< of each element, if it is text
    std::size_t chunk = 1 << 14;  ///< elements that are compressed and written together
    std::string unit;             ///< "s", "mm", "count"; empty: none
    double scale = 1;             ///< a stored number times this is in the unit
};

/// How a column or an attribute must be found when the file is read back.
struct Written {
    Type type = Type::int64;
    std::uint64_t size = 0;      ///< elements; bytes of an attribute
    std::size_t text_bytes = 0;  ///< of each element, if it is text
    unsigned long checksum = 0;  ///< CRC-32 of its bytes

    void add(const void* data, std::size_t bytes);
};

/// One dataset that is written at its end.
class Writer {
  public:
    /// `data`: `count` elements of its type. False: it could not be written (see File::trouble).
    bool append(const void* data, std::size_t count);
    std::uint64_t size() const { return size_; }
    std::size_t text_bytes() const { return text_bytes_; }

  private:
    friend class File;
    Handle set_;
    Type type_ = Type::int64;
    std::size_t text_bytes_ = 0;
    std::uint64_t size_ = 0;
    std::shared_ptr<Written> written_;
};

/// One dataset that is read in pieces.
class Reader {
  public:
    std::uint64_t size() const { return size_; }
    /// Elements [from, from + count) as T, whatever number they were stored as. Errors: io, damage among them.
    template <class T>
    Result<void> read(std::uint64_t from, std::size_t count, T* out) const {
        return read(type_of<T>, from, count, out);
    }
    /// Element `at`, a text without the zeros at its end. Errors: io, invalid_input (it is none).
    Result<std::string> text(std::uint64_t at) const;

  private:
    friend class File;
    Result<void> read(Type type, std::uint64_t from, std::size_t count, void* out) const;
    tl::unexpected<Error> damaged() const;

    Handle set_;
    std::string file_, path_;
    std::uint64_t size_ = 0;
};

class File {
  public:
    /// It takes its name when it is closed: what was there stays until then. Errors: io.
    static Result<File> create(const std::string& path);
    /// For reading. Errors: io (it is not there, it cannot be read), invalid_input (it is no such file, it is damaged).
    static Result<File> open(const std::string& path);

    /// Of a file that was opened for reading: its writer has not closed it, it was cut off or goes on.
    bool unfinished() const { return unfinished_; }
    const std::string& path() const { return path_; }

    // ---- writing; what goes wrong is remembered: see trouble()
    /// With all groups above it: "axes/x/steps".
    void make_group(const std::string& path);
    Writer make_column(const std::string& path, const ColumnSettings& settings);
    void write_text(const std::string& path, std::string_view text);
    /// `object`: a group or a column; "/": the file.
    void set(const std::string& object, const char* name, std::string_view text);
    void set(const std::string& object, const char* name, double value);
    void set(const std::string& object, const char* name, std::int64_t value);
    /// From now on columns grow, and nothing else may be made. What there is of the file stays from now on, beside its
    /// name, whatever becomes of the writer.
    void begin_streaming();
    /// All that was appended can be read from now on, even if this program is killed.
    void flush();
    /// Ends the streaming: more may be made. Columns and other handles must be gone. Errors: as close.
    Result<void> reopen();
    /// Columns and other handles must be gone. All of the file is read once more before it takes its name. Errors: io,
    /// the first trouble since the file was created.
    Result<void> close();
    const std::string& trouble() const { return trouble_; }
    /// What close() tells if there was none before: "could not be written".
    void set_trouble(const std::string& text) {
        if (trouble_.empty()) trouble_ = text;
    }

    // ---- reading
    bool has(const std::string& path) const;
    /// Errors: invalid_input, there is no such column or its size cannot be true.
    Result<Reader> column(const std::string& path) const;
    /// Errors: as column, io.
    Result<std::string> text(const std::string& path) const;
    /// An attribute of the file itself or of a group; empty, or 0: it has none.
    std::string attribute_text(const char* name, const std::string& group = "/") const;
    std::int64_t attribute_number(const char* name) const;

  private:
    bool good(std::int64_t code, const char* what);
    Result<void> close_library();
    bool is_as_written() const;
    void put_attribute(const std::string& object, const char* name, std::int64_t type, const void* value);

    std::string path_;
    disk::NewFile made_;  ///< of one that is written
    Handle file_;         ///< of the library; closed first
    bool unfinished_ = false;
    std::string trouble_;
    std::map<std::string, std::shared_ptr<Written>> columns_;            ///< by their paths
    std::map<std::pair<std::string, std::string>, Written> attributes_;  ///< by object and name
};

}  // namespace motionrack::trace::hdf5
