// Loading HDF5.
#include <dlfcn.h>
#include <fmt/format.h>

#include <motionrack/trace/hdf5_library.hpp>
#include <optional>

namespace motionrack::trace::hdf5 {

namespace {

struct Loaded {
    std::optional<Library> library;
    std::string why;
};

template <class T>
bool find(void* file, const char* name, T& out) {
    out = reinterpret_cast<T>(::dlsym(file, name));
    return out != nullptr;
}

Loaded load() {
    Loaded out;
    void* const file = ::dlopen(MOTIONRACK_HDF5_SONAME, RTLD_NOW | RTLD_LOCAL);
    Library all;
    bool whole = file != nullptr;
#define MOTIONRACK_HDF5_FIND(name) whole = whole && find(file, #name, all.name##_);
    MOTIONRACK_HDF5_FUNCTIONS(MOTIONRACK_HDF5_FIND)
    MOTIONRACK_HDF5_NUMBERS(MOTIONRACK_HDF5_FIND)
#undef MOTIONRACK_HDF5_FIND
    if (whole)
        out.library = all;
    else if (const char* const said = ::dlerror(); said != nullptr)
        out.why = said;
    return out;
}

const Loaded& loaded() {
    static const Loaded once = load();
    return once;
}

}  // namespace

Result<void> load_library() {
    if (loaded().library) return {};
    return fail(Trouble::io, fmt::format("The HDF5 library cannot be loaded: {}. Nothing was recorded or read; install "
                                         "it (on Debian 12: apt install libhdf5-103-1).",
                                         loaded().why));
}

const Library& library() {
    MOTIONRACK_ASSERT(loaded().library);
    return *loaded().library;
}

}  // namespace motionrack::trace::hdf5
