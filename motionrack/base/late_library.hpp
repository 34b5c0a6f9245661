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

/// A library with the functions that are used of it: a `Table` has `find_in(LateLibrary&)`.
template <class Table>
class LateTable {
  public:
    /// Loads it with the first call; `soname` is always the same.
    static const LateTable& loaded(const char* soname) {
        static const LateTable once(soname);
        return once;
    }
    const std::string& trouble() const { return library_.trouble(); }
    /// Only without trouble.
    const Table& table() const { return table_; }

  private:
    explicit LateTable(const char* soname) : library_(soname) { table_.find_in(library_); }

    LateLibrary library_;
    Table table_;
};

}  // namespace motionrack
