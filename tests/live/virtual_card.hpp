// Card of the server: a virtual MCX314, in simulated or in real time.
#pragma once

#include <atomic>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <mutex>
#include <optional>

namespace motionrack::live_test {

class VirtualCard {
  public:
    /// `real_time`: the card follows the computer's clock; otherwise time advances only on request. Stores it in `now`.
    VirtualCard(bool real_time, std::atomic<std::int64_t>& now)
        : now_(now), chip_(kernel_, "c"), port_(kernel_, chip_, chip_.id(), chip_.interrupt_wire(), bus_time) {
        kernel_.start();
        if (real_time) clock_.emplace();
    }

    /// One bus access; `width` is 16, or 8 at a byte port.
    std::uint16_t read(std::uint32_t offset, unsigned width) {
        const std::lock_guard lock(mutex_);
        begin_access();
        const std::uint16_t value = width == 16 ? chip_.read(offset) : chip_.read_byte(offset);
        kernel_.settle();
        return value;
    }
    void write(std::uint32_t offset, unsigned width, std::uint16_t value) {
        const std::lock_guard lock(mutex_);
        begin_access();
        if (width == 16)
            chip_.write(offset, value);
        else
            chip_.write_byte(offset, static_cast<std::uint8_t>(value));
        kernel_.settle();
    }
    void pass(Duration duration) {
        const std::lock_guard lock(mutex_);
        pass_locked(duration);
    }
    /// Advances time until the interrupt line is active, `most` at most; returns true if it is.
    bool run_to_interrupt(Duration most) {
        const std::lock_guard lock(mutex_);
        const bool active = port_.wait(most);
        now_ = kernel_.now().count();
        return active;
    }
    bool interrupt() {
        const std::lock_guard lock(mutex_);
        catch_up();
        return kernel_.level(chip_.interrupt_wire()) == 0;
    }

  private:
    static constexpr Duration bus_time = nanoseconds(250);

    void catch_up() {
        if (!clock_) return;
        if (const Duration behind = clock_->now() - kernel_.now(); behind > Duration{0}) pass_locked(behind);
    }
    void begin_access() {
        if (clock_)
            catch_up();
        else
            pass_locked(bus_time);
    }
    void pass_locked(Duration duration) {
        port_.pass(duration);
        now_ = kernel_.now().count();
    }

    std::mutex mutex_;
    std::atomic<std::int64_t>& now_;
    sim::Kernel kernel_;
    mcx314::Chip chip_;
    sim::VirtualPort port_;
    std::optional<live::MonotonicClock> clock_;
};

}  // namespace motionrack::live_test
