// By default Windows translates line ends and the byte 1Ah; it does not open folders.
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

/// Does nothing: on Windows a read blocks until there is a byte.
void wait_to_read(int) {}

}  // namespace motionrack
