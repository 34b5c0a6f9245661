// The function library by its declaration: functions by name with numbers as arguments, for pages and scripts.
#pragma once

#include <motionrack/base/function_library.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

/// The 57 functions of the source, then those that it mentions without listing them.
std::span<const FunctionInfo> library_functions();

/// Host time for the library's functions: a requested stop ends the pulses of all axes at once.
class QuickStops final : public Interrupt {
  public:
    QuickStops(RegisterPort& port, Interrupt& inner) : port_(port), inner_(inner) {}
    bool wait(Duration timeout) override {
        poll();
        return inner_.wait(timeout);
    }
    void pass(Duration duration) override {
        poll();
        inner_.pass(duration);
    }
    Instant now() const override { return inner_.now(); }
    bool stop_requested() const override { return inner_.stop_requested(); }
    /// Stops all axes at once (command 27h).
    void stop();

  private:
    void poll() {
        if (inner_.stop_requested()) stop();
    }

    RegisterPort& port_;
    Interrupt& inner_;
};

/// Card access for the library's functions: writes are blocked once a stop is requested, so that a function cannot
/// start another drive.
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

/// Context of the functions.
struct LibraryChip {
    Driver driver;
    unsigned home_axes = axis_x;  ///< axes of HomeType1 .. 4
};

class Library final : public FunctionLibrary {
  public:
    /// Port and interrupt must outlive the library.
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
