// Bus accesses and waiting in virtual time.
#include <motionrack/sim/virtual_port.hpp>

#include <algorithm>

namespace motionrack::sim {

VirtualPort::VirtualPort(Kernel& kernel, RegisterDevice& device, DeviceId id, WireId interrupt, Duration access, InputLog* log)
    : kernel_(kernel), device_(device), id_(id), interrupt_(interrupt), access_(access), log_(log) {}

void VirtualPort::write(std::uint32_t offset, std::uint16_t value) {
    run_to(kernel_.now() + access_, false);
    if (log_) log_->add({kernel_.now(), InputKind::register_write, static_cast<std::uint16_t>(id_), offset, value});
    device_.write(offset, value);
    kernel_.settle();
}

std::uint16_t VirtualPort::read(std::uint32_t offset) {
    run_to(kernel_.now() + access_, false);
    if (log_) log_->add({kernel_.now(), InputKind::register_read, static_cast<std::uint16_t>(id_), offset, 0});
    const std::uint16_t value = device_.read(offset);
    kernel_.settle();
    return value;
}

bool VirtualPort::wait(Duration timeout) {
    run_to(kernel_.now() + timeout, true);
    return kernel_.level(interrupt_) == 0;
}

void VirtualPort::pass(Duration duration) { run_to(kernel_.now() + duration, false); }

void VirtualPort::run_to(Instant until, bool until_interrupt) {
    while (true) {
        if (until_interrupt && (kernel_.level(interrupt_) == 0 || stop_requested())) return;
        const Instant stop = on_slice_ ? std::min(until, std::max(next_slice_, kernel_.now())) : until;
        const RunEnd end = kernel_.run_until(stop);
        if (on_slice_ && (end == RunEnd::broken || kernel_.now() >= next_slice_)) {  // broken: perhaps a full buffer
            on_slice_();
            next_slice_ = kernel_.now() + slice_;
        }
        if (kernel_.now() >= until) return;
    }
}

}  // namespace motionrack::sim
