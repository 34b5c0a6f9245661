#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <motionrack/rack/template.hpp>
#include <tests/swarm/racks.hpp>

namespace motionrack::swarm {

namespace {

const std::string two_axes =
    "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n"
    "[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n";
const char* const belt_and_laser =
    "[card.scan]\ntype = \"rtc5\"\nlist_memory = 256\n[belt.line]\ncard = \"scan\"\nvelocity_mm_s = 50\n"
    "counts_per_mm = 100\n[scanner.head]\ncard = \"scan\"\nconveyor = \"line\"\nbits_per_mm = 5184\n";

}  // namespace

rack::RackConfig draw_rack(Draws& draws, std::string& what) {
    const int kind = draws.pick(11);
    const char* name =
        std::array{"two axes", "two axes", "single",   "single",   "router", "router",
                   "router",   "router",   "carriage", "carriage", "line"}[static_cast<std::size_t>(kind)];
    const char* profile = draws.one_in(2) ? "trapezoid" : "jerk_limited";
    rack::RackConfig out;
    const bool has_text = kind < 2 || kind == 10;
    out = *rack::read_rack_text(has_text ? two_axes + std::string(kind == 10 ? belt_and_laser : "")
                                         : *rack::rack_template(name))
               .config;
    out.safety.door = draws.one_in(3);
    out.safety.estop_channels = draws.one_in(3) ? 2 : 1;
    if (!out.point_to_point()) out.controller.profile = profile;
    what += fmt::format("{}, {}{}{}", name, profile, out.safety.door ? ", door" : "",
                        out.safety.estop_channels == 2 ? ", two channels" : "");
    return out;
}

}  // namespace motionrack::swarm
