// What reading files needs of the system: base/windows has the same for Windows.
#pragma once

namespace motionrack {

/// Opens a file for reading, bytes as they are, without waiting for a FIFO's writer. Its descriptor, or -1 with errno.
int open_to_read(const char* path);

/// Waits until the next byte of an open file is there, or its end.
void wait_to_read(int file);

}  // namespace motionrack
