// Opens, reads, writes and stops real cards of each kind.
#include <fmt/format.h>

#include <motionrack/rack/databoard4002_card.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <python/src/live_device.hpp>

namespace motionrack::python {

Result<std::unique_ptr<LiveMcx314>> LiveMcx314::open(const live::PortSpec& spec, Interrupt& host) {
    MOTIONRACK_TRY(auto port, live::CardPort::open(spec, mcx314::card_map()));
    MOTIONRACK_CHECK(port->check_answers());
    return std::unique_ptr<LiveMcx314>(new LiveMcx314(std::move(port), host));
}

Result<rack::RegisterView> LiveMcx314::view(bool clearing) {
    return rack::mcx314_plugin.view({.registers = port_.get()}, clearing);
}

Result<std::unique_ptr<LiveDataboard4002>> LiveDataboard4002::open(const live::PortSpec& spec, Interrupt& host,
                                                                   std::uint8_t select) {
    MOTIONRACK_TRY(auto port, live::ByteCardPort::open(spec, databoard4002::card_map()));
    return std::unique_ptr<LiveDataboard4002>(new LiveDataboard4002(std::move(port), host, select));
}

/// Sends Q through the unguarded port, because a stop blocks the guarded one.
Result<void> LiveDataboard4002::stop() {
    databoard4002::DriverSettings settings;
    settings.select = select_;
    return databoard4002::Driver(*port_, *port_, settings).quit();
}

Result<rack::RegisterView> LiveDataboard4002::view(bool) {
    return rack::databoard4002_plugin.view({.bytes = port_.get(), .host = port_.get(), .select = select_}, false);
}

}  // namespace motionrack::python
