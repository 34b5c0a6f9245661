// The DataBoard 4002 in a rack file and in a running rack; its description is in databoard4002_plugin.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/cards/databoard4002/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::rack {

extern const CardPlugin databoard4002_plugin;

/// How O1 and O2 of a DataBoard 4002 are counted: edges per period of the encoder.
enum class Databoard4002CountMode : std::uint8_t { quadrature_4, quadrature_2, quadrature_1, up_down };

/// Settings of a card of type databoard4002: straps, firmware version, bus address.
struct Databoard4002Settings {
    std::int64_t card_number = 13;  ///< number on the common bus, 0 .. 31
    Databoard4002CountMode count_mode = Databoard4002CountMode::quadrature_4;
    std::int64_t first_pair = 0;           ///< 0 .. 3: strap pair A-B, C-D, E-F, G-H
    bool single_ended = false;             ///< encoder lines up to 50 kHz instead of 100 kHz
    bool zeroing = true;                   ///< enabling the zero or reference event arms the zeroing
    bool quit_zeroes = true;               ///< the command Q zeroes what P and N have set
    std::string trim;                      ///< see databoard4002::trim_from_text
    std::int64_t version = 32;             ///< answer to the command V, 0 .. 255
    std::int64_t firmware_pass_ticks = 1;  ///< one pass of the firmware, 1 .. 4,000 ticks of 2.5 us
    std::int64_t byte_time_ns = 100'000;   ///< firmware time for an access, 2,500 .. 100,000,000 ns
    std::int64_t bus_access_ns = 1'000;    ///< duration of a host access, 0 .. 100,000 ns
};

inline const Databoard4002Settings& databoard4002_in(const RackCard& card) {
    return card.settings.get<Databoard4002Settings>();
}

/// See CardPlugin::make.
std::unique_ptr<Card> make_databoard4002(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                         std::span<const std::unique_ptr<Card>> before);

/// Returns the card of that name; nullptr if the rack has no such card or the card is of another type.
const databoard4002::Card* databoard4002_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
