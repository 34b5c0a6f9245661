// The bus and interrupt line of a virtual card: every access takes bus time, waiting lets the world run.
#pragma once

#include <atomic>
#include <functional>
#include <motionrack/base/port.hpp>
#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/register_device.hpp>

namespace motionrack::sim {

class VirtualPort final : public RegisterPort, public Interrupt {
  public:
    /// `access`: the time one register access takes (0 or more). `interrupt`: the card's line, active low. `log` may be nullptr.
    VirtualPort(Kernel& kernel, RegisterDevice& device, DeviceId id, WireId interrupt, Duration access, InputLog* log = nullptr);

    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t read(std::uint32_t offset) override;
    bool wait(Duration timeout) override;
    void pass(Duration duration) override;
    Instant now() const override { return kernel_.now(); }
    bool stop_requested() const override { return stop_ && stop_->load(std::memory_order_relaxed); }

    /// The flag a signal handler sets (Ctrl-C); may be nullptr.
    void set_stop_flag(const std::atomic<bool>* stop) { stop_ = stop; }
    /// Called between runs at least every `slice` of virtual time: progress, draining of recorders.
    void on_slice(Duration slice, std::function<void()> call) { slice_ = slice, on_slice_ = std::move(call); }

  private:
    void run_to(Instant until, bool until_interrupt);

    Kernel& kernel_;
    RegisterDevice& device_;
    DeviceId id_;
    WireId interrupt_;
    Duration access_;
    InputLog* log_;
    const std::atomic<bool>* stop_ = nullptr;
    Duration slice_ = milliseconds(50);
    Instant next_slice_{};
    std::function<void()> on_slice_;
};

}  // namespace motionrack::sim
