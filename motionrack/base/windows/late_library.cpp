// Windows' loader. A bare name is searched in the program's and the system's folder, not in the current one.
#define WIN32_LEAN_AND_MEAN
#include <fmt/format.h>
#include <windows.h>

#include <motionrack/base/late_library.hpp>
#include <string_view>

namespace motionrack {

namespace {

std::string loader_error() {
    const DWORD code = ::GetLastError();
    switch (code) {
        case ERROR_MOD_NOT_FOUND:
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
            return "it, or a library that it needs, was not found";
        case ERROR_BAD_EXE_FORMAT:
            return "it is built for another word size (32 or 64 bits)";
        default:
            return fmt::format("Windows refuses it with error {}", code);
    }
}

}  // namespace

LateLibrary::LateLibrary(const char* soname) : library_(nullptr) {
    const bool has_folder = std::string_view(soname).find_first_of("\\/:") != std::string_view::npos;
    library_ = ::LoadLibraryExA(soname, nullptr,
                                has_folder ? LOAD_WITH_ALTERED_SEARCH_PATH : LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
    if (library_ == nullptr) trouble_ = loader_error();
}

void* LateLibrary::symbol(const char* name) {
    if (library_ == nullptr) return nullptr;
    void* const out = reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library_), name));
    if (out == nullptr && trouble_.empty()) trouble_ = fmt::format("it has no function {}", name);
    return out;
}

}  // namespace motionrack
