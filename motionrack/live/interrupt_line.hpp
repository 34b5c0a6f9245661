// A card's interrupt line through UIO: a read of four bytes waits for the next interrupt and returns their count. A
// write of 1 enables the next one, if the kernel's driver disables the line at an interrupt.
#pragma once

#include <motionrack/base/time.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/live/file.hpp>
#include <optional>

namespace motionrack::live {

class InterruptLine {
  public:
    static Result<InterruptLine> open(const std::string& path);
    /// Returns true if the line is or becomes active within `timeout`. If the driver cannot enable the line again (no
    /// write), an interrupt from before the call counts too.
    bool wait(Duration timeout, Clock& clock);

  private:
    explicit InterruptLine(File file) : file_(std::move(file)) {}
    bool take();

    File file_;
    bool opens_ = true;  ///< a write of 1 enables the line
};

}  // namespace motionrack::live
