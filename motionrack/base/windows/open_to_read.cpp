// Windows translates the ends of lines and the byte 1Ah unless it is told not to; it opens no folder.
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <cerrno>
#include <motionrack/base/open_to_read.hpp>

namespace motionrack {

int open_to_read(const char* path) {
    struct stat about {};
    if (::stat(path, &about) == 0 && S_ISDIR(about.st_mode)) {
        errno = EISDIR;
        return -1;
    }
    return ::_open(path, _O_RDONLY | _O_BINARY | _O_NOINHERIT);
}

/// A read waits by itself.
void wait_to_read(int) {}

}  // namespace motionrack
