// A card's interrupt line as UIO gives it: a read of four bytes waits for the next interrupt and counts them all; a
// write of 1 lets the next one come, where the kernel's driver shuts the line off when it has one.
#pragma once

#include <motionrack/base/time.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/live/file.hpp>
#include <optional>

namespace motionrack::live {

class InterruptLine {
  public:
    static Result<InterruptLine> open(const std::string& path);
    /// True if the line is or becomes active within `timeout`. Where the driver cannot open the line again (no write),
    /// an interrupt from before the call counts too.
    bool wait(Duration timeout, Clock& clock);

  private:
    explicit InterruptLine(File file) : file_(std::move(file)) {}
    bool take();

    File file_;
    bool opens_ = true;  ///< a write of 1 opens the line
};

}  // namespace motionrack::live
