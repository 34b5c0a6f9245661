// A real card as Python has it: a live port with a stop that holds, and Ctrl-C heard while a call waits.
//
//   Python ──► RackLock ──► LiveCard ──► Driver, Library ──► GuardedPort ──► live::CardPort ──► card
//   Ctrl-C, quick_stop() ──► stop flag ──► Ears, QuickStops ── all axes, at once ──► ┘
//
// A stop is taken in every state and from every thread. It ends the call that runs, and nothing is written to the card
// from then on but the stop, until reset_stop().
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/cards/mcx314/library/library.hpp>
#include <motionrack/live/card_port.hpp>
#include <python/src/host.hpp>
#include <python/src/rack_lock.hpp>
#include <string>

namespace motionrack::python {

class LiveCard final : public Host {
  public:
    /// Opens the port; no register is touched. Throws invalid_input (the place, the type), io, refused.
    LiveCard(const std::string& place, const std::string& type);
    /// As close(), without a word.
    ~LiveCard() override;
    LiveCard(const LiveCard&) = delete;
    LiveCard& operator=(const LiveCard&) = delete;

    const std::string& place() const { return place_; }
    const CardMap& map() const { return map_; }
    /// Since it was opened. Throws a refusal once it was closed.
    Instant now() override { return open_port().now(); }
    /// Throws a refusal once it was closed, the error of the port, and stopped while a stop holds.
    void check_call() const override;
    /// Writes the stop, where there is one. Throws io where the computer refused an access.
    void end_call() override;

    /// All axes end their pulses, at once, and so does a call of another thread. Throws io where the computer refuses
    /// the write.
    void quick_stop();
    void reset_stop() { stop_ = false; }
    /// Stops all axes and lets the card go, for other programs too. Throws io where the stop could not be written; it
    /// is closed all the same.
    void close();
    bool closed() const { return port_ == nullptr; }

    /// The registers of a driver, whose writes end with a stop. Once: a second driver would not know the settings of
    /// the first. Throws a refusal.
    void claim(const std::string& driver);
    RegisterPort& registers() { return guarded_; }
    Interrupt& interrupt() { return stops_; }

    /// Accesses by hand, at the offset of a register that can be read or written. Throw invalid_input.
    std::uint16_t read(std::uint32_t offset);
    void write(std::uint32_t offset, std::int64_t value);
    /// All registers, in words; writes WR0, with NOP and read commands, also while a stop holds.
    std::string view(bool clearing);
    /// Throws a refusal where the port has no interrupt.
    bool wait_interrupt(Duration timeout);

  private:
    /// The computer's time for drivers: waits look whether a signal came.
    class Ears final : public Interrupt {
      public:
        explicit Ears(LiveCard& card) : card_(card) {}
        bool wait(Duration timeout) override;
        void pass(Duration duration) override;
        Instant now() const override { return card_.port_->now(); }
        bool stop_requested() const override { return card_.stopped(); }

      private:
        LiveCard& card_;
        SignalLook signals_;
    };
    /// The port, which is there while the card is open.
    class Registers final : public RegisterPort {
      public:
        explicit Registers(LiveCard& card) : card_(card) {}
        void write(std::uint32_t offset, std::uint16_t value) override { card_.port_->write(offset, value); }
        std::uint16_t read(std::uint32_t offset) override { return card_.port_->read(offset); }

      private:
        LiveCard& card_;
    };

    live::CardPort& open_port() const;
    void check_trouble() const;
    void check_offset(std::uint32_t offset, bool written) const;

    std::string place_;
    const CardMap& map_;
    std::unique_ptr<live::CardPort> port_;
    Registers port_now_{*this};
    Ears ears_{*this};
    mcx314::QuickStops stops_{port_now_, ears_};
    mcx314::GuardedPort guarded_{port_now_, ears_};
    std::string driver_;
};

}  // namespace motionrack::python
