// Interface of LiveCard to a real card, one class per kind of card: accesses, the stop, and the ports of drivers.
//
//   LiveCard ──► LiveDevice ──► LiveMcx314 ──► live::CardPort          registers of 16 bits
//                          └──► LiveDataboard4002 ──► live::ByteCardPort   ports of 8 bits
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/cards/databoard4002/library/library.hpp>
#include <motionrack/cards/mcx314/library/library.hpp>
#include <motionrack/live/byte_card_port.hpp>
#include <motionrack/live/card_port.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <string>

namespace motionrack::python {

class LiveDevice {
  public:
    virtual ~LiveDevice() = default;
    virtual const live::LivePort& port() const = 0;
    virtual live::LivePort& port() = 0;
    /// Returns the width of an access: 8 or 16 bits.
    virtual int width() const = 0;
    virtual std::uint16_t read(std::uint32_t offset) = 0;
    /// Writes nothing while `host` requests a stop.
    virtual void write(std::uint32_t offset, std::uint16_t value) = 0;
    /// Stops all axes at once. Errors: machine if the card does not take the stop.
    virtual Result<void> stop() = 0;
    /// Returns the decoded registers, also while a stop is requested.
    virtual Result<rack::RegisterView> view(bool clearing) = 0;
};

class LiveMcx314 final : public LiveDevice {
  public:
    /// Opens the port and checks that a card answers. `host`: waits, and the stop. Errors: as live::CardPort.
    static Result<std::unique_ptr<LiveMcx314>> open(const live::PortSpec& spec, Interrupt& host);

    const live::LivePort& port() const override { return *port_; }
    live::LivePort& port() override { return *port_; }
    int width() const override { return 16; }
    std::uint16_t read(std::uint32_t offset) override { return port_->read(offset); }
    void write(std::uint32_t offset, std::uint16_t value) override { guarded_.write(offset, value); }
    Result<void> stop() override { return stops_.stop(), Result<void>{}; }
    Result<rack::RegisterView> view(bool clearing) override;

    // ---- for its drivers: a stop ends their waits and their writes
    RegisterPort& registers() { return guarded_; }
    Interrupt& interrupt() { return stops_; }

  private:
    LiveMcx314(std::unique_ptr<live::CardPort> port, Interrupt& host)
        : port_(std::move(port)), stops_(*port_, host), guarded_(*port_, host) {}

    std::unique_ptr<live::CardPort> port_;
    mcx314::QuickStops stops_;
    mcx314::GuardedPort guarded_;
};

class LiveDataboard4002 final : public LiveDevice {
  public:
    /// Opens the port; no access is made. `select`: number of the card on its bus. Errors: as live::ByteCardPort.
    static Result<std::unique_ptr<LiveDataboard4002>> open(const live::PortSpec& spec, Interrupt& host,
                                                           std::uint8_t select);

    const live::LivePort& port() const override { return *port_; }
    live::LivePort& port() override { return *port_; }
    int width() const override { return 8; }
    std::uint16_t read(std::uint32_t offset) override { return port_->in(static_cast<std::uint8_t>(offset)); }
    void write(std::uint32_t offset, std::uint16_t value) override {
        guarded_.out(static_cast<std::uint8_t>(offset), static_cast<std::uint8_t>(value));
    }
    Result<void> stop() override;
    Result<rack::RegisterView> view(bool clearing) override;

    // ---- for its driver
    BytePort& ports() { return guarded_; }
    Interrupt& interrupt() { return host_; }
    std::uint8_t select() const { return select_; }

  private:
    LiveDataboard4002(std::unique_ptr<live::ByteCardPort> port, Interrupt& host, std::uint8_t select)
        : port_(std::move(port)), host_(host), guarded_(*port_, host), select_(select) {}

    std::unique_ptr<live::ByteCardPort> port_;
    Interrupt& host_;
    databoard4002::GuardedBytePort guarded_;
    std::uint8_t select_;
};

}  // namespace motionrack::python
