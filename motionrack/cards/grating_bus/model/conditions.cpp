// Formats the messages of the conditions of cards and bus.
#include <fmt/format.h>

#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/cards/grating_bus/model/conditions.hpp>
#include <vector>

namespace motionrack::grating_bus {

namespace {

std::string reasons(std::int64_t bits) {
    std::vector<std::string_view> out;
    if (bits & bad_missed) out.push_back("read_n was high when data was to be taken");
    if (bits & bad_alien) out.push_back("another address than the expected one was on the bus");
    if (bits & bad_lines) out.push_back("clk, hold or read_n did not have the level that it should have");
    if (bits & bad_content) out.push_back("its CRC or its number of scales is wrong");
    return fmt::format("{}", fmt::join(out, ", and "));
}

std::string what_happened(const sim::Condition& c) {
    switch (static_cast<BusCondition>(c.code)) {
        case BusCondition::wrong_direction:
            return fmt::format(
                "the card is set as a {}, but its shifter of clk, hold and read_n is set {} and that of addr {}; a "
                "host drives with "
                "both, a slave with none. Set the shifters to fit the role",
                c.a != 0 ? "host" : "slave", c.b & 1 ? "outwards" : "inwards", c.b & 2 ? "outwards" : "inwards");
        case BusCondition::bad_frame:
            return fmt::format(
                "frame {} was not published: {}. The last good frame is kept; more bad frames in a row are only "
                "counted (BROKEN)",
                c.a, reasons(c.b));
        case BusCondition::missed_edges:
            return fmt::format(
                "{} edge{} of clk before frame {} {} missed; no frame was read in that time, and the sequence counts "
                "them",
                c.a, c.a == 1 ? "" : "s", c.b, c.a == 1 ? "was" : "were");
        case BusCondition::overrun:
            return fmt::format(
                "the pulse of frame {} came while a frame was still being read; it was lost. More of them are only "
                "counted (OVERRUN)",
                c.a);
        case BusCondition::stale:
            if (c.a < 0)
                return "no frame has come for two periods since the start; no position is known. Check that the bus "
                       "has a running host.";
            return fmt::format(
                "no good frame for two periods since frame {} of {:.7f} s; its positions are stale and must not be "
                "used",
                c.a, to_seconds(Duration{c.b}));
        case BusCondition::no_register:
            if (c.b < 0) return fmt::format("a read from {:02X}h, which has no register, returned FFFFh", c.a);
            return fmt::format("{:04X}h was written to {:02X}h, which is read-only; nothing was changed", c.b, c.a);
        case BusCondition::other_scale:
            return fmt::format(
                "word {} of a frame is that of scale {}, as the host has addressed it, but the card's own list has {} "
                "there. The frame was published with the addresses that were read; more such words are only counted "
                "(ALIEN). Give the card the list of the host, or look each scale up by its address",
                c.a, c.b >> 8, c.b & 255);
        case BusCondition::conflict:
            break;
    }
    return fmt::format("condition {} ({}, {})", c.code, c.a, c.b);
}

}  // namespace

std::string describe(const sim::Condition& condition, std::string_view card) {
    return fmt::format("card {}: at {:.7f} s {}", card, to_seconds(condition.at), what_happened(condition));
}

std::string describe(const sim::Condition& c, const Bus& bus) {
    return fmt::format(
        "bus: at {:.7f} s two cards drive {} at once, {} high and {} low: a conflict; low wins, and the read value is "
        "wrong. More on this line are only listed. A bus has one host",
        to_seconds(c.at), line_types[static_cast<std::size_t>(c.a)].name,
        bus.driver_name(static_cast<int>(c.b / max_drivers)), bus.driver_name(static_cast<int>(c.b % max_drivers)));
}

}  // namespace motionrack::grating_bus
