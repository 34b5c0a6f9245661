// The card's function library for pages and scripts: functions called by name, with whole numbers as arguments.
#pragma once

#include <motionrack/base/function_library.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/cards/databoard4002/driver/driver.hpp>

namespace motionrack::databoard4002 {

/// Returns the library's functions: one for each command of the card, then status and events, complete moves and the
/// slope table.
std::span<const FunctionInfo> library_functions();

/// Port of a driver during a stop: once a stop is requested, passes only Q, the commands that read (D, P, R, V), event
/// enables and reads; drops arguments and all other commands.
class GuardedBytePort final : public BytePort {
  public:
    GuardedBytePort(BytePort& port, const Interrupt& host) : port_(port), host_(host) {}
    void out(std::uint8_t port, std::uint8_t value) override;
    std::uint8_t in(std::uint8_t port) override { return port_.in(port); }

  private:
    BytePort& port_;
    const Interrupt& host_;
};

class CommandLibrary final : public FunctionLibrary {
  public:
    /// Port and host must outlive the library. `select`: the card's number on its bus.
    CommandLibrary(BytePort& port, Interrupt& host, std::uint8_t select);

    std::span<const FunctionInfo> functions() const override;
    /// Resets the card (C3) and connects to it. Errors: as connect().
    Result<void> begin() override;
    /// Waits until the card is Ready, at most 1 s, and connects to it as it is: its reset mark is cleared, its events
    /// are off. Errors: machine if no card answers, or it is not Ready.
    Result<void> connect();
    Result<CallAnswer> call(std::size_t function, std::span<const std::int64_t> values) override;
    /// True while the rate at the output is not 0, or the card does not report it.
    bool moving() override;
    /// Ends the move (command Q).
    void stop_now() override;

  private:
    GuardedBytePort guarded_;
    Interrupt& host_;
    Driver driver_;
    Driver stopper_;  ///< on the unguarded port, for moving() and stop_now()
};

}  // namespace motionrack::databoard4002
