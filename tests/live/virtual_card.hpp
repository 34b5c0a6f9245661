// Cards of the server: a virtual MCX314 or DataBoard 4002, in simulated or in real time.
#pragma once

#include <atomic>
#include <motionrack/cards/databoard4002/model/bus.hpp>
#include <motionrack/cards/databoard4002/model/card.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <mutex>
#include <optional>

namespace motionrack::live_test {

class VirtualCard {
  public:
    virtual ~VirtualCard() = default;

    /// One bus access; `width` is 16, or 8 at a byte port.
    std::uint16_t read(std::uint32_t offset, unsigned width) {
        const std::lock_guard lock(mutex_);
        begin_access();
        const std::uint16_t value = read_now(offset, width);
        kernel_.settle();
        return value;
    }
    void write(std::uint32_t offset, unsigned width, std::uint16_t value) {
        const std::lock_guard lock(mutex_);
        begin_access();
        write_now(offset, width, value);
        kernel_.settle();
    }
    void pass(Duration duration) {
        const std::lock_guard lock(mutex_);
        pass_locked(duration);
    }
    /// Advances time until the interrupt line is active, `max_duration` at most; returns true if it is.
    bool run_to_interrupt(Duration max_duration) {
        const std::lock_guard lock(mutex_);
        const bool active = host().wait(max_duration);
        now_ = kernel_.now().count();
        return active;
    }
    bool interrupt() {
        const std::lock_guard lock(mutex_);
        catch_up();
        return asks_for_interrupt();
    }

  protected:
    /// `access`: duration of a bus access. `real_time`: the card follows the computer's clock; otherwise time advances
    /// only on request. Stores it in `now`.
    VirtualCard(Duration access, bool real_time, std::atomic<std::int64_t>& now)
        : bus_time_(access), real_time_(real_time), now_(now) {}
    /// Call it when the card is in the kernel.
    void start() {
        kernel_.start();
        if (real_time_) clock_.emplace();
    }
    const sim::Kernel& kernel() const { return kernel_; }
    sim::Kernel& kernel() { return kernel_; }

  private:
    virtual std::uint16_t read_now(std::uint32_t offset, unsigned width) = 0;
    virtual void write_now(std::uint32_t offset, unsigned width, std::uint16_t value) = 0;
    virtual sim::VirtualHost& host() = 0;
    virtual bool asks_for_interrupt() const = 0;

    void catch_up() {
        if (!clock_) return;
        if (const Duration behind = clock_->now() - kernel_.now(); behind > Duration{0}) pass_locked(behind);
    }
    void begin_access() {
        if (clock_)
            catch_up();
        else
            pass_locked(bus_time_);
    }
    void pass_locked(Duration duration) {
        host().pass(duration);
        now_ = kernel_.now().count();
    }

    Duration bus_time_;
    bool real_time_;
    std::mutex mutex_;
    std::atomic<std::int64_t>& now_;
    sim::Kernel kernel_;
    std::optional<live::MonotonicClock> clock_;
};

class VirtualMcx314 final : public VirtualCard {
  public:
    VirtualMcx314(bool real_time, std::atomic<std::int64_t>& now)
        : VirtualCard(bus_time, real_time, now),
          chip_(kernel(), "c"),
          port_(kernel(), chip_, chip_.id(), chip_.interrupt_wire(), bus_time) {
        start();
    }

  private:
    static constexpr Duration bus_time = nanoseconds(250);

    std::uint16_t read_now(std::uint32_t offset, unsigned width) override {
        return width == 16 ? chip_.read(offset) : chip_.read_byte(offset);
    }
    void write_now(std::uint32_t offset, unsigned width, std::uint16_t value) override {
        if (width == 16)
            chip_.write(offset, value);
        else
            chip_.write_byte(offset, static_cast<std::uint8_t>(value));
    }
    sim::VirtualHost& host() override { return port_; }
    bool asks_for_interrupt() const override { return kernel().level(chip_.interrupt_wire()) == 0; }

    mcx314::Chip chip_;
    sim::VirtualPort port_;
};

/// Card 13 of its bus; an ideal motor follows its pulses.
class VirtualDataboard4002 final : public VirtualCard {
  public:
    VirtualDataboard4002(bool real_time, std::atomic<std::int64_t>& now)
        : VirtualCard(bus_time, real_time, now),
          card_(kernel(), "board"),
          bus_(kernel(), "bus"),
          port_(kernel(), bus_, bus_.id(), bus_.interrupt_wire(), bus_time) {
        bus_.plug(card_, 13);
        card_.connect_encoder(card_.pulses());
        start();
    }

  private:
    static constexpr Duration bus_time = microseconds(1);

    std::uint16_t read_now(std::uint32_t offset, unsigned) override {
        return bus_.in(static_cast<std::uint8_t>(offset));
    }
    void write_now(std::uint32_t offset, unsigned, std::uint16_t value) override {
        bus_.out(static_cast<std::uint8_t>(offset), static_cast<std::uint8_t>(value));
    }
    sim::VirtualHost& host() override { return port_; }
    bool asks_for_interrupt() const override { return kernel().level(bus_.interrupt_wire()) == 1; }

    databoard4002::Card card_;
    databoard4002::Bus bus_;
    sim::VirtualBytePort port_;
};

}  // namespace motionrack::live_test
