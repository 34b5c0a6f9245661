// Verifies a written file against its data. The library detects changed bytes, but not stale data after a lost disk
// write; hence the full comparison.
#include <zlib.h>

#include <algorithm>
#include <motionrack/trace/hdf5_library.hpp>
#include <motionrack/trace/hdf5_parts.hpp>

namespace motionrack::trace::hdf5 {

void ExpectedData::add(const void* data, std::size_t bytes) {
    checksum = ::crc32_z(checksum, static_cast<const unsigned char*>(data), bytes);
}

namespace {

constexpr std::size_t block_bytes = 1 << 20;

bool is_column_as(const ExpectedData& written, std::int64_t set) {
    const Handle space(H5Dget_space(set), H5Sclose), text = text_type(written.text_bytes);
    hsize_t size = 0;
    if (!space || H5Sget_simple_extent_dims(space.get(), &size, nullptr) != 1 || size != written.size) return false;
    const std::int64_t type = written.type == Type::text ? text.get() : number_type(written.type);
    const std::size_t each = std::max<std::size_t>(H5Tget_size(type), 1);
    const hsize_t block = std::max<std::size_t>(block_bytes / each, 1);
    std::vector<char> bytes(each * std::min(block, size));
    ExpectedData found;
    for (hsize_t at = 0; at < size; at += block) {
        const hsize_t count = std::min(block, size - at);
        const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
        if (!memory || H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &at, nullptr, &count, nullptr) < 0 ||
            H5Dread(set, type, memory.get(), space.get(), H5P_DEFAULT, bytes.data()) < 0)
            return false;
        found.add(bytes.data(), each * count);
    }
    return found.checksum == written.checksum;
}

bool is_attribute_as(const ExpectedData& written, std::int64_t attribute) {
    const Handle type(H5Aget_type(attribute), H5Tclose);
    if (!type || H5Tget_size(type.get()) != written.size) return false;
    std::vector<char> bytes(written.size);
    ExpectedData found;
    if (H5Aread(attribute, type.get(), bytes.data()) < 0) return false;
    found.add(bytes.data(), bytes.size());
    return found.checksum == written.checksum;
}

}  // namespace

bool Hdf5File::is_as_written() const {
    const Handle file(H5Fopen(made_.path_until_whole().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file) return false;
    for (const auto& [path, written] : columns_) {
        const Handle set(H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
        if (!set || !is_column_as(*written, set.get())) return false;
    }
    for (const auto& [name, written] : attributes_) {
        const Handle attribute(
            H5Aopen_by_name(file.get(), name.first.c_str(), name.second.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        if (!attribute || !is_attribute_as(written, attribute.get())) return false;
    }
    return true;
}

}  // namespace motionrack::trace::hdf5
