// Loading of the HDF5 library.
#include <fmt/format.h>

#include <motionrack/trace/hdf5_library.hpp>

namespace motionrack::trace::hdf5 {

Result<void> load_library() {
    const std::string& trouble = LateTable<Hdf5Library>::loaded(MOTIONRACK_HDF5_SONAME).trouble();
    if (trouble.empty()) return {};
    return fail(ErrorKind::io,
                fmt::format("The HDF5 library cannot be loaded: {}. Nothing was recorded or read; install "
                            "it (on Debian 12: apt install libhdf5-103-1).",
                            trouble));
}

const Hdf5Library& library() {
    const LateTable<Hdf5Library>& loaded = LateTable<Hdf5Library>::loaded(MOTIONRACK_HDF5_SONAME);
    MOTIONRACK_ASSERT(loaded.trouble().empty());
    return loaded.table();
}

}  // namespace motionrack::trace::hdf5
