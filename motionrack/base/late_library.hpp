// A shared library that is loaded by its name once something of it is needed, not at the program's start.
#pragma once

#include <string>

namespace motionrack {

/// Loads it; once loaded it stays to the end of the process.
class LateLibrary {
  public:
    /// `soname`: as the loader finds it, such as "libnats.so.3.4".
    explicit LateLibrary(const char* soname);

    /// Points `out` to what the library calls `name`.
    template <class T>
    void find(const char* name, T& out) {
        out = reinterpret_cast<T>(symbol(name));
    }
    /// Empty when the library is loaded and has everything that was sought in it.
    const std::string& trouble() const { return trouble_; }

  private:
    void* symbol(const char* name);

    void* library_;
    std::string trouble_;
};

}  // namespace motionrack
