// System functions for reading files; base/windows implements them for Windows.
#pragma once

namespace motionrack {

/// Opens a file for binary reading, without waiting for a FIFO's writer. Returns its descriptor, or -1 with errno.
int open_to_read(const char* path);

/// Waits until an open file has a byte to read, or ends.
void wait_to_read(int file);

}  // namespace motionrack
