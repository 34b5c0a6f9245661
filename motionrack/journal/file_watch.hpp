// Detects that open files were deleted or replaced. Data written to such a file is lost when the program ends.
#pragma once

#include <sys/types.h>

#include <motionrack/base/result.hpp>
#include <string>
#include <vector>

namespace motionrack::journal {

/// Returns the file that is opened under this path: that behind symbolic links, which may be missing.
std::string file_behind(const std::string& path);

class FileWatch {
  public:
    /// Starts to watch the file at `path`. Errors: io, and the file is not watched; the text as that of check().
    Result<void> add(const std::string& path);
    /// Errors: io if a file was deleted, replaced or truncated; the text continues "The journal '...' ".
    Result<void> check();

  private:
    struct WatchedFile {
        std::string path;
        dev_t device = 0;
        ino_t inode = 0;
        off_t size = 0;  ///< largest size seen: these files only grow
    };
    std::vector<WatchedFile> files_;
};

}  // namespace motionrack::journal
