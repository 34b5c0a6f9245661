// A real card in Python: a live port with a latching stop; Ctrl-C is handled while a call waits.
//
//   Python ──► RackLock ──► LiveCard ──► Driver, Library ──► GuardedPort ──► live::CardPort ──► card
//   Ctrl-C, quick_stop() ──► stop flag ──► Ears, QuickStops ── all axes, at once ──► ┘
//
// A stop is accepted in every state and from every thread. It ends the running call. Until reset_stop(), only stops are
// written to the card.
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
    /// Opens the port without touching a register. Throws invalid_input (address, type), io, refused.
    LiveCard(const std::string& place, const std::string& type);
    /// As close(), without throwing.
    ~LiveCard() override;
    LiveCard(const LiveCard&) = delete;
    LiveCard& operator=(const LiveCard&) = delete;

    const std::string& place() const { return place_; }
    const CardMap& map() const { return map_; }
    /// Time since opening. Throws refused after close().
    Instant now() override { return open_port().now(); }
    /// Throws refused after close(), the error of the port, and stopped while a stop is latched.
    void check_call() const override;
    /// Writes the pending stop, if any. Throws io if the computer refused an access.
    void end_call() override;

    /// Stops the pulses of all axes at once and ends the call of another thread. Throws io if the write is refused.
    void quick_stop();
    void reset_stop() { stop_ = false; }
    /// Stops all axes and releases the card for other programs. Throws io if the stop could not be written; closes the
    /// card in any case.
    void close();
    bool closed() const { return port_ == nullptr; }

    /// Registers of a driver; a stop ends its writes. Allowed once: a second driver would not know the settings of the
    /// first. Throws refused.
    void claim(const std::string& driver);
    RegisterPort& registers() { return guarded_; }
    Interrupt& interrupt() { return stops_; }

    /// Manual access at the offset of a readable or writable register. Throws invalid_input.
    std::uint16_t read(std::uint32_t offset);
    void write(std::uint32_t offset, std::int64_t value);
    /// Returns all decoded registers; writes WR0 with NOP and read commands, also while a stop is latched.
    std::string view(bool clearing);
    /// Throws refused if the port has no interrupt.
    bool wait_interrupt(Duration timeout);

  private:
    /// Real time for drivers; waits check for signals.
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
    /// Port of the card; present while the card is open.
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
