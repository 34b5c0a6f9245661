// Loading HDF5.
#include <fmt/format.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/trace/hdf5_library.hpp>

namespace motionrack::trace::hdf5 {

namespace {

struct Loaded {
    LateLibrary file{MOTIONRACK_HDF5_SONAME};
    Library library;
    Loaded() {
#define MOTIONRACK_HDF5_FIND(name) file.find(#name, library.name##_);
        MOTIONRACK_HDF5_FUNCTIONS(MOTIONRACK_HDF5_FIND)
        MOTIONRACK_HDF5_NUMBERS(MOTIONRACK_HDF5_FIND)
#undef MOTIONRACK_HDF5_FIND
    }
};

const Loaded& loaded() {
    static const Loaded once;
    return once;
}

}  // namespace

Result<void> load_library() {
    if (loaded().file.trouble().empty()) return {};
    return fail(Trouble::io, fmt::format("The HDF5 library cannot be loaded: {}. Nothing was recorded or read; install "
                                         "it (on Debian 12: apt install libhdf5-103-1).",
                                         loaded().file.trouble()));
}

const Library& library() {
    MOTIONRACK_ASSERT(loaded().file.trouble().empty());
    return loaded().library;
}

}  // namespace motionrack::trace::hdf5
