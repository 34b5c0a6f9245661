// The function library by its declaration: functions by name with numbers as arguments, for pages and orders.
#pragma once

#include <motionrack/base/function_library.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

/// The 57 functions of the source, then those that it names without listing them.
std::span<const FunctionInfo> library_functions();

/// The host's time for the library's functions: axes end their pulses at once when a stop is asked for.
class QuickStops final : public Interrupt {
  public:
    QuickStops(RegisterPort& port, Interrupt& inner) : port_(port), inner_(inner) {}
    bool wait(Duration timeout) override {
        look();
        return inner_.wait(timeout);
    }
    void pass(Duration duration) override {
        look();
        inner_.pass(duration);
    }
    Instant now() const override { return inner_.now(); }
    bool stop_requested() const override { return inner_.stop_requested(); }
    /// All axes, at once.
    void stop();

  private:
    void look() {
        if (inner_.stop_requested()) stop();
    }

    RegisterPort& port_;
    Interrupt& inner_;
};

/// The card for the library's functions: nothing is written any more when a stop is asked for, so that no drive begins
/// that a function was about to order.
class GuardedPort final : public RegisterPort {
  public:
    GuardedPort(RegisterPort& port, const Interrupt& host) : port_(port), host_(host) {}
    void write(std::uint32_t offset, std::uint16_t value) override {
        if (!host_.stop_requested()) port_.write(offset, value);
    }
    std::uint16_t read(std::uint32_t offset) override { return port_.read(offset); }

  private:
    RegisterPort& port_;
    const Interrupt& host_;
};

/// What the functions work on.
struct LibraryChip {
    Driver driver;
    unsigned home_axes = axis_x;  ///< of HomeType1 .. 4
};

class Library final : public FunctionLibrary {
  public:
    /// Port and interrupt must outlive it.
    Library(RegisterPort& port, Interrupt& interrupt)
        : stops_(port, interrupt), guarded_(port, interrupt), chip_{Driver(guarded_, stops_)} {}

    std::span<const FunctionInfo> functions() const override;
    Result<void> begin() override;
    Result<CallAnswer> call(std::size_t function, std::span<const std::int64_t> values) override;
    bool moving() override { return chip_.driver.moving(xyzu); }
    void stop_now() override { stops_.stop(); }

  private:
    QuickStops stops_;
    GuardedPort guarded_;
    LibraryChip chip_;
};

}  // namespace motionrack::mcx314
