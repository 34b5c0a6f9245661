// Bus accesses and waiting in virtual time.
#include <algorithm>
#include <motionrack/sim/virtual_port.hpp>

namespace motionrack::sim {

// ---- time

VirtualHost::VirtualHost(Kernel& kernel, DeviceId id, WireId interrupt, int active, Duration access, InputLog* log)
    : kernel_(kernel), id_(id), interrupt_(interrupt), active_(active), access_(access), log_(log) {}

void VirtualHost::begin_access(InputKind kind, std::uint32_t offset, std::uint16_t value) {
    run_to(kernel_.now() + access_, false);
    if (log_) log_->add({kernel_.now(), kind, static_cast<std::uint16_t>(id_), offset, value});
}

bool VirtualHost::wait(Duration timeout) {
    const bool sleeps = kernel_.level(interrupt_) != active_ && !stop_requested();
    run_to(later(kernel_.now(), timeout), true);
    const bool woken = kernel_.level(interrupt_) == active_;
    if (sleeps && woken && latency_ > Duration{}) run_to(kernel_.now() + latency_, false);
    return woken;
}

void VirtualHost::pass(Duration duration) {
    run_to(later(kernel_.now(), duration), false);
}

void VirtualHost::run_to(Instant until, bool until_interrupt) {
    while (true) {
        if (until_interrupt && (kernel_.level(interrupt_) == active_ || stop_requested())) return;
        const Instant stop = on_slice_ ? std::min(until, std::max(next_slice_, kernel_.now())) : until;
        const RunEnd end = kernel_.run_until(stop);
        const bool reached = kernel_.now() >= next_slice_;
        if (on_slice_ && (end == RunEnd::broken || reached)) {  // broken: perhaps a full buffer
            on_slice_();
            if (reached) next_slice_ = kernel_.now() + slice_;
        }
        if (kernel_.now() >= until) return;
    }
}

// ---- accesses

VirtualPort::VirtualPort(Kernel& kernel, RegisterDevice& device, DeviceId id, WireId interrupt, Duration access,
                         InputLog* log)
    : VirtualHost(kernel, id, interrupt, 0, access, log), device_(device) {}

void VirtualPort::write(std::uint32_t offset, std::uint16_t value) {
    begin_access(InputKind::register_write, offset, value);
    device_.write(offset, value);
    kernel_.settle();
}

std::uint16_t VirtualPort::read(std::uint32_t offset) {
    begin_access(InputKind::register_read, offset, 0);
    const std::uint16_t value = device_.read(offset);
    kernel_.settle();
    return value;
}

VirtualBytePort::VirtualBytePort(Kernel& kernel, ByteDevice& device, DeviceId id, WireId interrupt, Duration access,
                                 InputLog* log)
    : VirtualHost(kernel, id, interrupt, 1, access, log), device_(device) {}

void VirtualBytePort::out(std::uint8_t port, std::uint8_t value) {
    begin_access(InputKind::register_write, port, value);
    device_.out(port, value);
    kernel_.settle();
}

std::uint8_t VirtualBytePort::in(std::uint8_t port) {
    begin_access(InputKind::register_read, port, 0);
    const std::uint8_t value = device_.in(port);
    kernel_.settle();
    return value;
}

}  // namespace motionrack::sim
