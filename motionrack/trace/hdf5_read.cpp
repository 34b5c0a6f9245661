// Reads columns, texts and attributes; validates all sizes in the file before use.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/trace/hdf5.hpp>
#include <motionrack/trace/hdf5_library.hpp>
#include <motionrack/trace/hdf5_parts.hpp>

namespace motionrack::trace::hdf5 {

namespace {

/// Maximum expansion of zlib-compressed data.
constexpr std::uint64_t max_growth = 1100;
/// Longer texts were not written by this program.
constexpr std::size_t max_attribute = 1 << 16;
constexpr std::size_t max_text = std::size_t{1} << 30;

tl::unexpected<Error> unreadable_in(const std::string& file, const std::string& what) {
    return fail(ErrorKind::io, fmt::format("The recording is damaged: {} cannot be read.", what), {}, file);
}

}  // namespace

tl::unexpected<Error> Reader::damaged() const {
    return unreadable_in(file_, path_);
}

Result<void> Reader::read(Type type, std::uint64_t from, std::size_t count, void* out) const {
    MOTIONRACK_ASSERT(from <= size_ && count <= size_ - from);
    if (count == 0) return {};
    const hsize_t begin = from, size = count;
    const Handle space(H5Dget_space(set_.get()), H5Sclose), memory(H5Screate_simple(1, &size, nullptr), H5Sclose);
    if (!space || !memory || H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &begin, nullptr, &size, nullptr) < 0)
        return damaged();
    if (H5Dread(set_.get(), number_type(type), memory.get(), space.get(), H5P_DEFAULT, out) < 0) return damaged();
    return {};
}

Result<std::string> Reader::text(std::uint64_t at) const {
    const Handle type(H5Dget_type(set_.get()), H5Tclose);
    const std::size_t bytes = type ? H5Tget_size(type.get()) : 0;
    if (!type || H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0 || bytes == 0 ||
        bytes > max_text || at >= size_)
        return fail(ErrorKind::invalid_input, fmt::format("The recording is damaged: {} is not a text.", path_), {},
                    file_);
    const hsize_t begin = at, one = 1;
    const Handle space(H5Dget_space(set_.get()), H5Sclose), memory(H5Screate_simple(1, &one, nullptr), H5Sclose);
    std::string out(bytes, '\0');
    const Handle wanted = text_type(bytes);
    if (!space || !memory || H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &begin, nullptr, &one, nullptr) < 0)
        return damaged();
    if (H5Dread(set_.get(), wanted.get(), memory.get(), space.get(), H5P_DEFAULT, out.data()) < 0) return damaged();
    out.resize(out.find_last_not_of('\0') + 1);
    return out;
}

Result<Reader> Hdf5File::column(const std::string& path) const {
    const auto refuse = [&](const std::string& what) {
        return fail(ErrorKind::invalid_input, fmt::format("The recording is damaged: {} {}.", path, what), {}, path_);
    };
    MOTIONRACK_TRY(const bool found, has(path));
    if (!found) return refuse("was not found");
    Reader out;
    out.file_ = path_;
    out.path_ = path;
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_chunk_cache(access.get(), 3, std::size_t{1} << 18, 1.0);
    out.set_ = Handle(H5Dopen2(file_.get(), path.c_str(), access.get()), H5Dclose);
    const Handle space(out.set_ ? H5Dget_space(out.set_.get()) : -1, H5Sclose),
        type(out.set_ ? H5Dget_type(out.set_.get()) : -1, H5Tclose);
    hsize_t size = 0;
    if (!space || !type || H5Sget_simple_extent_ndims(space.get()) != 1 ||
        H5Sget_simple_extent_dims(space.get(), &size, nullptr) != 1)
        return refuse("is not a column");
    const H5T_class_t kind = H5Tget_class(type.get());
    const std::uint64_t element = H5Tget_size(type.get());
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_STRING) || element == 0 ||
        (kind != H5T_STRING && element > 8))
        return refuse("is not a column of numbers or texts");
    if (kind == H5T_STRING && element > max_text)
        return refuse(fmt::format("says that its texts have {} bytes", element));
    const std::uint64_t stored = H5Dget_storage_size(out.set_.get());
    if (size > (std::uint64_t{1} << 62) / element || size * element / max_growth > stored)
        return refuse(fmt::format("says that it has {} elements, in {} bytes", size, stored));
    out.size_ = size;
    return out;
}

Result<std::string> Hdf5File::text(const std::string& path) const {
    MOTIONRACK_TRY(const Reader reader, column(path));
    return reader.text(0);
}

tl::unexpected<Error> Hdf5File::unreadable(const std::string& what) const {
    return unreadable_in(path_, what);
}

Result<bool> Hdf5File::has(const std::string& path) const {
    // H5Lexists requires a check of every group along the path.
    for (std::size_t slash = path.find('/');; slash = path.find('/', slash + 1)) {
        const htri_t found = H5Lexists(file_.get(), path.substr(0, slash).c_str(), H5P_DEFAULT);
        if (found < 0) return unreadable(path);
        if (found == 0 || slash == std::string::npos) return found > 0;
    }
}

Result<std::string> Hdf5File::attribute_text(const char* name, const std::string& group) const {
    if (group != "/") {
        MOTIONRACK_TRY(const bool found, has(group));
        if (!found) return {};
    }
    const htri_t found = H5Aexists_by_name(file_.get(), group.c_str(), name, H5P_DEFAULT);
    if (found < 0) return unreadable(name);
    if (found == 0) return {};
    const Handle attribute(H5Aopen_by_name(file_.get(), group.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Handle type(attribute ? H5Aget_type(attribute.get()) : -1, H5Tclose),
        space(attribute ? H5Aget_space(attribute.get()) : -1, H5Sclose);
    if (!type || !space) return unreadable(name);
    const std::size_t bytes = H5Tget_size(type.get());
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0 || bytes == 0 ||
        bytes > max_attribute || H5Sget_simple_extent_npoints(space.get()) != 1)
        return {};
    std::string out(bytes, '\0');
    const Handle wanted = text_type(bytes);
    if (H5Aread(attribute.get(), wanted.get(), out.data()) < 0) return unreadable(name);
    out.resize(out.find_last_not_of('\0') + 1);
    return out;
}

Result<std::int64_t> Hdf5File::attribute_number(const char* name) const {
    const htri_t found = H5Aexists(file_.get(), name);
    if (found < 0) return unreadable(name);
    if (found == 0) return 0;
    const Handle attribute(H5Aopen(file_.get(), name, H5P_DEFAULT), H5Aclose);
    const Handle space(attribute ? H5Aget_space(attribute.get()) : -1, H5Sclose);
    if (!space) return unreadable(name);
    if (H5Sget_simple_extent_npoints(space.get()) != 1) return 0;
    std::int64_t out = 0;
    if (H5Aread(attribute.get(), H5T_NATIVE_INT64, &out) < 0) return unreadable(name);
    return out;
}

}  // namespace motionrack::trace::hdf5
