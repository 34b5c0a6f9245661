// The bus and interrupt line of a virtual card: every access takes bus time, every wait runs the simulation.
//
//   driver ──► VirtualPort (16-bit registers) ──┐
//   driver ──► VirtualBytePort (8-bit ports) ───┴─► VirtualHost ──► Kernel::run_until
#pragma once

#include <atomic>
#include <functional>
#include <motionrack/base/port.hpp>
#include <motionrack/sim/byte_device.hpp>
#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/register_device.hpp>

namespace motionrack::sim {

/// Time and interrupt input of a host.
class VirtualHost : public Interrupt {
  public:
    bool wait(Duration timeout) override;
    void pass(Duration duration) override;
    Instant now() const override { return kernel_.now(); }
    bool stop_requested() const override { return is_set(stop_) || is_set(halted_); }

    /// Sets the flag by which a signal handler (Ctrl-C) requests a stop; may be nullptr.
    void set_stop_flag(const std::atomic<bool>* stop) { stop_ = stop; }
    /// Sets the flag of the rack's stop latch, which also requests a stop; may be nullptr.
    void set_halted_flag(const std::atomic<bool>* halted) { halted_ = halted; }
    /// Delay of the host from an interrupt to its next step; initially 0.
    void set_latency(Duration latency) { latency_ = latency; }
    /// Called between runs: every `slice` of virtual time, and where a device breaks a run, which does not shift the
    /// slices. For progress, draining of recorders.
    void on_slice(Duration slice, std::function<void()> call) { slice_ = slice, on_slice_ = std::move(call); }

  protected:
    /// `interrupt`: the card's line, `active`: its level while an interrupt is requested. `access`: duration of one
    /// access (>= 0). `log` may be nullptr.
    VirtualHost(Kernel& kernel, DeviceId id, WireId interrupt, int active, Duration access, InputLog* log);
    /// Advances the time of an access and logs it.
    void begin_access(InputKind kind, std::uint32_t offset, std::uint16_t value);

    Kernel& kernel_;

  private:
    static bool is_set(const std::atomic<bool>* flag) {
        return flag != nullptr && flag->load(std::memory_order_relaxed);
    }
    void run_to(Instant until, bool until_interrupt);

    DeviceId id_;
    WireId interrupt_;
    int active_;
    Duration access_;
    Duration latency_{};
    InputLog* log_;
    const std::atomic<bool>* stop_ = nullptr;
    const std::atomic<bool>* halted_ = nullptr;
    Duration slice_ = milliseconds(50);
    Instant next_slice_{};
    std::function<void()> on_slice_;
};

/// A 16-bit register bus; its interrupt line is active low.
class VirtualPort final : public RegisterPort, public VirtualHost {
  public:
    VirtualPort(Kernel& kernel, RegisterDevice& device, DeviceId id, WireId interrupt, Duration access,
                InputLog* log = nullptr);

    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t read(std::uint32_t offset) override;

  private:
    RegisterDevice& device_;
};

/// An 8-bit port space; its interrupt line is active high.
class VirtualBytePort final : public BytePort, public VirtualHost {
  public:
    VirtualBytePort(Kernel& kernel, ByteDevice& device, DeviceId id, WireId interrupt, Duration access,
                    InputLog* log = nullptr);

    void out(std::uint8_t port, std::uint8_t value) override;
    std::uint8_t in(std::uint8_t port) override;

  private:
    ByteDevice& device_;
};

}  // namespace motionrack::sim
