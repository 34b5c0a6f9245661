// RAII handles and error sentences over the C interface of HDF5.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <motionrack/trace/hdf5.hpp>
#include <motionrack/trace/hdf5_library.hpp>
#include <motionrack/trace/hdf5_parts.hpp>
#include <system_error>

namespace motionrack::trace::hdf5 {

namespace {

constexpr unsigned deflate_level = 2;  // of 9; higher levels take twice the time to save a tenth

/// Disables the error output of the library, per thread. Also disables its exit handler. After a full disk that handler
/// would close files a second time and crash; here, each file is closed by its handle.
void be_quiet() {
    static const herr_t once = H5dont_atexit();  // effective only if the library was not yet used in this program
    static_cast<void>(once);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

herr_t keep_deepest(unsigned n, const H5E_error2_t* error, void* out) {
    if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
    return 0;
}

/// Returns the library's last error; for system errors only the system's part: "errno = 28, error message = '...'".
std::string why() {
    std::string text;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_deepest, &text);
    static constexpr std::string_view before = "error message = '";
    if (const std::size_t begin = text.find(before); begin != std::string::npos) {
        const std::size_t end = text.find('\'', begin + before.size());
        return text.substr(begin + before.size(), end == std::string::npos ? end : end - begin - before.size());
    }
    return text.empty() ? "the HDF5 library gives no reason" : text;
}

/// Selects the format of HDF5 1.10, the first with checksums and reading during writing.
Handle access_settings() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
    H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
    return access;
}

Handle link_settings() {
    Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.get(), 1);
    return links;
}

Handle column_settings(std::size_t chunk) {
    Handle settings(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const hsize_t size = chunk;
    H5Pset_chunk(settings.get(), 1, &size);
    H5Pset_shuffle(settings.get());
    H5Pset_deflate(settings.get(), deflate_level);
    H5Pset_fletcher32(settings.get());
    // Without times, so that equal columns give equal bytes at any time.
    H5Pset_obj_track_times(settings.get(), false);
    return settings;
}

}  // namespace

Handle text_type(std::size_t bytes) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), std::max<std::size_t>(bytes, 1));
    // The content is UTF-8 but not declared so: Octave rejects text declared as UTF-8.
    H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    return type;
}

std::int64_t number_type(Type type) {
    switch (type) {
        case Type::int8:
            return H5T_NATIVE_INT8;
        case Type::int32:
            return H5T_NATIVE_INT32;
        case Type::int64:
            return H5T_NATIVE_INT64;
        case Type::float32:
            return H5T_NATIVE_FLOAT;
        case Type::float64:
            return H5T_NATIVE_DOUBLE;
        case Type::text:
            break;
    }
    return H5T_C_S1;
}

// ---- growing columns

bool Writer::append(const void* data, std::size_t count) {
    if (!set_) return false;
    if (count == 0) return true;
    const hsize_t from = size_, added = count, size = size_ + count;
    if (H5Dset_extent(set_.get(), &size) < 0) return false;
    const Handle space(H5Dget_space(set_.get()), H5Sclose), memory(H5Screate_simple(1, &added, nullptr), H5Sclose);
    if (!space || !memory || H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &from, nullptr, &added, nullptr) < 0)
        return false;
    Handle text;
    if (type_ == Type::text) text = text_type(text_bytes_);
    const hid_t type = type_ == Type::text ? text.get() : number_type(type_);
    if (H5Dwrite(set_.get(), type, memory.get(), space.get(), H5P_DEFAULT, data) < 0) return false;
    size_ = size;
    if (written_) {
        written_->size = size;
        written_->add(data, count * H5Tget_size(type));
    }
    return true;
}

Writer Hdf5File::make_column(const std::string& path, const ColumnSettings& settings) {
    Writer out;
    out.type_ = settings.type;
    out.text_bytes_ = settings.text_bytes;
    Handle text;
    if (settings.type == Type::text) text = text_type(settings.text_bytes);
    const hid_t type = settings.type == Type::text ? text.get() : number_type(settings.type);
    const hsize_t none = 0, endless = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &none, &endless), H5Sclose), links = link_settings(),
                                                                        create = column_settings(settings.chunk);
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_chunk_cache(access.get(), 3, 2 * settings.chunk * std::max<std::size_t>(H5Tget_size(type), 1), 1.0);
    out.set_ = Handle(H5Dcreate2(file_.get(), path.c_str(), type, space.get(), links.get(), create.get(), access.get()),
                      H5Dclose);
    if (!good(out.set_.get(), "make a column")) return out;
    out.written_ = columns_[path] =
        std::make_shared<ExpectedData>(ExpectedData{settings.type, 0, settings.text_bytes, 0});
    if (settings.unit.empty()) return out;
    set(path, "unit", settings.unit);
    set(path, "scale", settings.scale);
    return out;
}

// ---- the file

bool Hdf5File::good(std::int64_t code, const char* what) {
    if (code >= 0) return true;
    if (trouble_.empty()) trouble_ = fmt::format("could not {}: {}", what, why());
    return false;
}

Result<Hdf5File> Hdf5File::create(const std::string& path) {
    MOTIONRACK_CHECK(load_library());
    be_quiet();
    // System errors are more specific than library errors if the file cannot be created.
    Result<disk::NewFile> made = disk::NewFile::create(path);
    const auto not_made = [&](const std::string& reason) {
        return fail(ErrorKind::io, fmt::format("The recording could not be created: {}. Choose another place.", reason),
                    {}, path);
    };
    if (!made) return not_made(made.error().message);
    Hdf5File out;
    out.path_ = path;
    out.made_ = std::move(*made);
    const Handle access = access_settings();
    const Handle settings(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(settings.get(), false);
    out.file_ =
        Handle(H5Fcreate(out.made_.path_until_whole().c_str(), H5F_ACC_TRUNC, settings.get(), access.get()), H5Fclose);
    if (!out.file_) return not_made(why());
    return out;
}

Result<void> Hdf5File::reopen() {
    MOTIONRACK_CHECK(close_library());
    const Handle access = access_settings();
    file_ = Handle(H5Fopen(made_.path_until_whole().c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
    if (file_) return {};
    return fail(ErrorKind::io,
                fmt::format("The recording could not be ended: {}. The written part is kept in {}.", why(),
                            made_.path_until_whole()),
                {}, path_);
}

void Hdf5File::make_group(const std::string& path) {
    const Handle links = link_settings();
    const Handle group(H5Gcreate2(file_.get(), path.c_str(), links.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    good(group.get(), "make a group");
}

void Hdf5File::write_text(const std::string& path, std::string_view text) {
    const Handle type = text_type(text.size());
    const hsize_t one = 1;
    const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose), links = link_settings(),
                                                                      create = column_settings(1);
    const Handle set(
        H5Dcreate2(file_.get(), path.c_str(), type.get(), space.get(), links.get(), create.get(), H5P_DEFAULT),
        H5Dclose);
    if (!good(set.get(), "make a text")) return;
    std::string bytes(text);
    if (bytes.empty()) bytes.push_back('\0');
    good(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), "write a text");
    columns_[path] = std::make_shared<ExpectedData>(ExpectedData{Type::text, 1, bytes.size(), 0});
    columns_[path]->add(bytes.data(), bytes.size());
}

void Hdf5File::put_attribute(const std::string& object, const char* name, std::int64_t type, const void* value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle made(
        H5Acreate_by_name(file_.get(), object.c_str(), name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    if (!good(made.get(), "make an attribute")) return;
    good(H5Awrite(made.get(), type, value), "write an attribute");
    ExpectedData& written = attributes_[{object, name}] = ExpectedData();
    written.size = H5Tget_size(type);
    written.add(value, written.size);
}

void Hdf5File::set(const std::string& object, const char* name, std::string_view text) {
    const Handle type = text_type(text.size());
    put_attribute(object, name, type.get(), text.empty() ? "" : text.data());
}

void Hdf5File::set(const std::string& object, const char* name, double value) {
    put_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5File::set(const std::string& object, const char* name, std::int64_t value) {
    put_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::begin_streaming() {
    made_.keep_part();
    good(H5Fstart_swmr_write(file_.get()), "begin");
}
void Hdf5File::flush() {
    good(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), "be written");
}

Result<void> Hdf5File::close_library() {
    if (!file_.close() && trouble_.empty()) trouble_ = "could not be closed: " + why();
    if (trouble_.empty()) return {};
    const std::string kept =
        made_.is_part_kept() ? " Perhaps some of it can be read in " + made_.path_until_whole() + "." : "";
    return fail(ErrorKind::io,
                fmt::format("The recording {}. It is incomplete and was not renamed.{} Make room or choose another "
                            "place, and run again.",
                            trouble_, kept),
                {}, path_);
}

Result<void> Hdf5File::close() {
    MOTIONRACK_CHECK(close_library());
    const bool device = made_.path_until_whole() == path_;
    if (!device && !is_as_written()) {
        trouble_ = "could not be read back as it was written";
        return close_library();
    }
    if (const Result<void> done = made_.commit(); !done && trouble_.empty())
        trouble_ = "could not be written: " + done.error().message;
    return close_library();
}

// ---- opening for reading

namespace {

constexpr unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1A, '\n'};

/// Checks the signature of the file. Errors: io, invalid_input.
Result<void> check_signature(const std::string& path) {
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (file == nullptr) {
        const int why_not = errno;
        const std::string part = path + disk::beside;
        if (why_not == ENOENT && ::access(part.c_str(), F_OK) == 0)
            return fail(
                ErrorKind::io,
                fmt::format("The file does not exist, but an incomplete one does, cut off or being written: {}.", part),
                {}, path);
        return fail(ErrorKind::io,
                    fmt::format("The file cannot be read: {}. Check the name and the permissions.",
                                std::generic_category().message(why_not)),
                    {}, path);
    }
    unsigned char begin[sizeof signature];
    errno = 0;
    const std::size_t got = std::fread(begin, 1, sizeof begin, file);
    const int trouble = std::ferror(file) ? errno : 0;
    std::fclose(file);
    if (trouble != 0)
        return fail(ErrorKind::io,
                    fmt::format("The file cannot be read: {}.", std::generic_category().message(trouble)), {}, path);
    if (got == sizeof begin && std::memcmp(begin, signature, sizeof begin) == 0) return {};
    return fail(
        ErrorKind::invalid_input,
        got == 0 ? "The file is empty." : "The file is not a recording: it does not begin as an HDF5 file does.", {},
        path);
}

}  // namespace

Result<Hdf5File> Hdf5File::open(const std::string& path) {
    MOTIONRACK_CHECK(load_library());
    be_quiet();
    MOTIONRACK_CHECK(check_signature(path));
    Hdf5File out;
    out.path_ = path;
    const Handle access = access_settings();
    // A disk may fail once, which says nothing about the recording; the mark of a writer stays.
    for (int attempt = 0; attempt < 2; ++attempt) {
        out.file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
        if (out.file_) return out;
    }
    const std::string first = why();
    // While a writer is active, the library re-reads inconsistent metadata with doubling delays: 20 attempts take 1 ms.
    H5Pset_metadata_read_attempts(access.get(), 20);
    out.file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.get()), H5Fclose);
    out.unfinished_ = true;
    if (out.file_) return out;
    return fail(ErrorKind::invalid_input,
                fmt::format("The recording is damaged, or was cut off before anything was in it: {}.", first), {},
                path);
}

}  // namespace motionrack::trace::hdf5
