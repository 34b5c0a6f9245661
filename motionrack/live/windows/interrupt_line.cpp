// Windows does not deliver a card's interrupts to a program without the card's own driver.
#include <fmt/format.h>

#include <motionrack/live/interrupt_line.hpp>

namespace motionrack::live {

Result<InterruptLine> InterruptLine::open(const std::string& path) {
    return fail(ErrorKind::refused, fmt::format("interrupt={} is not available on Windows, which delivers no card "
                                                "interrupts to programs. Nothing was opened. Leave interrupt= out.",
                                                path));
}

bool InterruptLine::wait(Duration timeout, Clock& clock) {
    clock.sleep(timeout);
    return false;
}

}  // namespace motionrack::live
