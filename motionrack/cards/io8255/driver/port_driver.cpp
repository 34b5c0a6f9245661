// Accesses, and waits for peripherals.
#include <fmt/format.h>

#include <motionrack/cards/io8255/driver/port_driver.hpp>

namespace motionrack::io8255 {

namespace {

char letter_of(PortGroup group) {
    return group == PortGroup::a ? 'A' : 'B';
}
/// Bus port of the group's 8 lines.
std::uint8_t bus_port_of(PortGroup group) {
    return group == PortGroup::a ? offset("PORT_A") : offset("PORT_B");
}

}  // namespace

PortDriver::PortDriver(BytePort& port, Interrupt& host, Duration poll) : port_(port), host_(host), poll_(poll) {
    MOTIONRACK_ASSERT(poll > Duration{0});
}

void PortDriver::set_modes(const PortModes& modes) {
    port_.out(offset("MODE_SET"), word_of(modes));
    modes_ = modes;
    for (const PortGroup group : {PortGroup::a, PortGroup::b})
        if (modes.is_strobed(group)) set_line(handshake_of(group, modes.is_input(group)).strobe, true);
}

std::uint8_t PortDriver::read(IoPort port) {
    return port_.in(static_cast<std::uint8_t>(port));
}

void PortDriver::write(IoPort port, std::uint8_t value) {
    port_.out(static_cast<std::uint8_t>(port), value);
}

void PortDriver::set_line(int line, bool high) {
    MOTIONRACK_ASSERT(line >= 0 && line < lines_of_port);
    const std::uint16_t number = field("BIT", "NUMBER").set(0, static_cast<unsigned>(line));
    port_.out(offset("BIT"), static_cast<std::uint8_t>(field("BIT", "LEVEL").set(number, high)));
}

Result<void> PortDriver::check_strobed(PortGroup group, bool input) const {
    if (modes_.is_strobed(group) && modes_.is_input(group) == input) return {};
    return fail(ErrorKind::refused,
                fmt::format("Port {} is not an {} in mode 1. Nothing was {}; call set_modes first.", letter_of(group),
                            input ? "input" : "output", input ? "read" : "written"));
}

Result<void> PortDriver::await_request(PortGroup group, Duration timeout) {
    const bool input = modes_.is_input(group);
    const int line = handshake_of(group, input).request;
    const Instant end = later(host_.now(), timeout);
    while ((port_.in(offset("PORT_C")) >> line & 1) == 0) {
        if (host_.stop_requested())
            return fail(ErrorKind::stopped,
                        fmt::format("A stop was requested while port {} waited for its peripheral.", letter_of(group)));
        if (host_.now() >= end)
            return fail(ErrorKind::machine,
                        fmt::format("The peripheral at port {} {} within {:g} s. Nothing was {}.", letter_of(group),
                                    input ? "sent no byte (STB)" : "did not take the byte before (ACK)",
                                    to_seconds(timeout), input ? "read" : "written"));
        host_.pass(poll_);
    }
    return {};
}

Result<void> PortDriver::send(PortGroup group, std::uint8_t value, Duration timeout) {
    MOTIONRACK_CHECK(check_strobed(group, false));
    MOTIONRACK_CHECK(await_request(group, timeout));
    port_.out(bus_port_of(group), value);
    return {};
}

Result<std::uint8_t> PortDriver::receive(PortGroup group, Duration timeout) {
    MOTIONRACK_CHECK(check_strobed(group, true));
    MOTIONRACK_CHECK(await_request(group, timeout));
    return port_.in(bus_port_of(group));
}

}  // namespace motionrack::io8255
