// A shared library that is loaded by its name on first use, not at the program's start.
#pragma once

#include <string>

namespace motionrack {

/// Loads the library; a loaded library stays until the end of the process.
class LateLibrary {
  public:
    /// `soname`: name for the loader, such as "libnats.so.3.4".
    explicit LateLibrary(const char* soname);

    /// Points `out` to the symbol `name` of the library.
    template <class T>
    void find(const char* name, T& out) {
        out = reinterpret_cast<T>(symbol(name));
    }
    /// Empty if the library is loaded and has all requested symbols.
    const std::string& trouble() const { return trouble_; }

  private:
    void* symbol(const char* name);

    void* library_;
    std::string trouble_;
};

/// A library with its used functions: a `Table` has `find_in(LateLibrary&)`.
template <class Table>
class LateTable {
  public:
    /// Loads the library at the first call; `soname` is always the same.
    static const LateTable& loaded(const char* soname) {
        static const LateTable once(soname);
        return once;
    }
    const std::string& trouble() const { return library_.trouble(); }
    /// Requires that trouble() is empty.
    const Table& table() const { return table_; }

  private:
    explicit LateTable(const char* soname) : library_(soname) { table_.find_in(library_); }

    LateLibrary library_;
    Table table_;
};

}  // namespace motionrack
