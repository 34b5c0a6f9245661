// Waiting for interrupts of a UIO node.
#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <motionrack/live/interrupt_line.hpp>

namespace motionrack::live {

Result<InterruptLine> InterruptLine::open(const std::string& path) {
    MOTIONRACK_TRY(File file, File::open(path, O_NONBLOCK));
    return InterruptLine(std::move(file));
}

bool InterruptLine::take() {
    std::uint32_t count = 0;
    return ::read(file_.descriptor(), &count, sizeof count) == sizeof count;
}

bool InterruptLine::wait(Duration timeout, Clock& clock) {
    if (opens_) {
        // Interrupts counted before may have been handled since. An unhandled one keeps the line active, and counts
        // again when the line is enabled.
        take();
        const std::uint32_t open = 1;
        opens_ = ::write(file_.descriptor(), &open, sizeof open) == sizeof open;
    }
    return clock.wait_readable(file_.descriptor(), timeout) && take();
}

}  // namespace motionrack::live
