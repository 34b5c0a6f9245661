// Whether the files that a program has open are still those in their places: what is written to a file that was
// deleted, or that another one has replaced, is lost when the program ends.
#pragma once

#include <sys/types.h>

#include <motionrack/base/result.hpp>
#include <string>
#include <vector>

namespace motionrack::journal {

class FileWatch {
  public:
    /// From now on `path` is to remain the file that it is. Files that are not there are not watched.
    void add(const std::string& path);
    /// Errors: io; a file was deleted, replaced or cut, in words that follow "The journal '...' ".
    Result<void> check();

  private:
    struct Watched {
        std::string path;
        dev_t device = 0;
        ino_t inode = 0;
        off_t size = 0;  ///< the greatest seen: these files only grow
    };
    std::vector<Watched> files_;
};

}  // namespace motionrack::journal
