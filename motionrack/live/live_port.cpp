// Accesses with a minimum interval, and waits.
#include <fmt/format.h>

#include <cstring>
#include <motionrack/live/live_port.hpp>
#include <utility>

namespace motionrack::live {

Result<LivePort::Parts> LivePort::open_parts(const PortSpec& spec, std::uint64_t length, std::unique_ptr<Clock> clock) {
    Parts out;
    MOTIONRACK_TRY(out.words, open_words(spec, length));
    if (!spec.interrupt.empty()) {
        MOTIONRACK_TRY(out.line, InterruptLine::open(spec.interrupt));
    }
    out.clock = clock ? std::move(clock) : std::make_unique<MonotonicClock>();
    return out;
}

LivePort::LivePort(Parts parts, const PortSpec& spec)
    : words_(std::move(parts.words)),
      line_(std::move(parts.line)),
      clock_(std::move(parts.clock)),
      path_(spec.path),
      gap_(spec.gap) {}

bool LivePort::begin_access() {
    if (trouble_) return false;
    if (accessed_)
        if (const Duration left = *accessed_ + gap_ - clock_->now(); left > Duration{0}) clock_->sleep(left);
    return true;
}

void LivePort::end_access(int error, std::uint32_t offset, const char* what) {
    accessed_ = clock_->now();
    if (error != 0)
        trouble_ =
            Error{ErrorKind::io,
                  fmt::format("The register at {:02X}h could not be {} through {}: {}. No access is made from here on; "
                              "the card continues its current motion.",
                              offset, what, path_, std::strerror(error))};
}

bool LivePort::wait(Duration timeout) {
    if (line_) return line_->wait(timeout, *clock_);
    clock_->sleep(timeout);
    return false;
}

}  // namespace motionrack::live
