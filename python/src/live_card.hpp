// A real card in Python: a live port with a latching stop; Ctrl-C is handled while a call waits.
//
//   Python ──► RackLock ──► LiveCard ──► Driver, Library ──► LiveDevice ──► live::LivePort ──► card
//   Ctrl-C, quick_stop() ──► stop flag ──► RealTimeHost, LiveDevice::stop ── all axes ──► ┘
//
// A stop is accepted in every state and from every thread. It ends the running call. Until reset_stop(), only stops are
// written to the card.
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <python/src/host.hpp>
#include <python/src/live_device.hpp>
#include <python/src/rack_lock.hpp>
#include <string>

namespace motionrack::python {

class LiveCard final : public Host {
  public:
    /// Opens the port without writing a register. `select`: number of a card on its bus, 0 to 255. Throws invalid_input
    /// (address, type), io, refused.
    LiveCard(const std::string& place, const std::string& type, int select);
    /// As close(), without throwing.
    ~LiveCard() override;
    LiveCard(const LiveCard&) = delete;
    LiveCard& operator=(const LiveCard&) = delete;

    const std::string& place() const { return place_; }
    const CardMap& map() const { return map_; }
    /// Time since opening. Throws refused after close().
    Instant now() override { return open_device().port().now(); }
    /// Throws refused after close(), the error of the port, and stopped while a stop is latched.
    void check_call() const override;
    /// Writes the pending stop, if any. Throws io if the computer refused an access.
    void end_call() override;

    /// Stops all axes at once and ends the call of another thread. Throws io if the write is refused, machine if the
    /// card does not take the stop.
    void quick_stop();
    void reset_stop() { stop_ = false; }
    /// Stops all axes and releases the card for other programs. Throws io if the stop could not be written; closes the
    /// card in any case.
    void close();
    bool closed() const { return device_ == nullptr; }

    /// Registers of a driver; a stop ends its writes. Allowed once: a second driver would not know the settings of the
    /// first. Throws refused.
    void claim(const std::string& driver);
    /// Returns the card for the driver `who`. Throws refused if it is of another kind, or closed.
    template <class Device>
    Device& device(const char* who) const {
        auto* const own = dynamic_cast<Device*>(&open_device());
        if (own == nullptr) refuse_device(who);
        return *own;
    }

    /// Manual access at the offset of a readable or writable register. Throws invalid_input.
    std::uint16_t read(std::uint32_t offset);
    void write(std::uint32_t offset, std::int64_t value);
    /// Returns the decoded registers, also while a stop is latched: see rack::CardPlugin::view.
    std::string view(bool clearing);
    /// Throws refused if the port has no interrupt.
    bool wait_interrupt(Duration timeout);

  private:
    /// Real time for drivers; waits check for signals.
    class RealTimeHost final : public Interrupt {
      public:
        explicit RealTimeHost(LiveCard& card) : card_(card) {}
        bool wait(Duration timeout) override;
        void pass(Duration duration) override;
        Instant now() const override { return card_.device_->port().now(); }
        bool stop_requested() const override { return card_.stopped(); }

      private:
        LiveCard& card_;
        SignalPoll signals_;
    };
    [[noreturn]] void refuse_device(const char* who) const;
    LiveDevice& open_device() const;
    void check_trouble() const;
    void check_offset(std::uint32_t offset, bool written) const;

    std::string place_;
    const CardMap& map_;
    RealTimeHost host_{*this};
    std::unique_ptr<LiveDevice> device_;
    std::string driver_;
};

}  // namespace motionrack::python
