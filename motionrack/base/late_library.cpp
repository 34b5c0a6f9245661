// Loads libraries through the system's loader.
#include <dlfcn.h>

#include <motionrack/base/late_library.hpp>

namespace motionrack {

LateLibrary::LateLibrary(const char* soname) : library_(::dlopen(soname, RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) trouble_ = ::dlerror();
}

void* LateLibrary::symbol(const char* name) {
    void* const out = library_ == nullptr ? nullptr : ::dlsym(library_, name);
    if (library_ != nullptr && out == nullptr && trouble_.empty()) trouble_ = ::dlerror();
    return out;
}

}  // namespace motionrack
