#include <fcntl.h>
#include <poll.h>

#include <motionrack/base/open_to_read.hpp>

namespace motionrack {

int open_to_read(const char* path) {
    return ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
}

void wait_to_read(int file) {
    pollfd waits{file, POLLIN, 0};
    ::poll(&waits, 1, -1);
}

}  // namespace motionrack
