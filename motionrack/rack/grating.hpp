// Grating-bus cards in a rack file: their keys, the model settings made from them, and conflicts between cards.
#pragma once

#include <cstdint>
#include <motionrack/cards/grating_bus/model/settings.hpp>
#include <motionrack/rack/card_types.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace motionrack::rack {

/// Role of a grating-bus card; by default the first card of a rack is the host.
enum class GratingRole : std::uint8_t { first_is_host, host, slave, remote };
/// Direction of a level shifter of such a card.
enum class GratingShifter : std::uint8_t { as_role, out, in };

/// Settings of a card of type grating_bus; the model's are in cards/grating_bus/model/settings.hpp.
struct GratingBusSettings {
    GratingRole role = GratingRole::first_is_host;
    std::int64_t scales = 4;                                   ///< scales in a frame, 1 .. 128
    std::int64_t first = 0;                                    ///< address of the first scale, 0 .. 127
    std::string addresses;                                     ///< list of addresses, see addresses_from_text
    double t1_ns = 20, t2_ns = 30, t3_ns = 30, clock_ns = 10;  ///< 0.1 .. 6,000 ns
    double period_us = 200;                                    ///< frame period, 1 .. 100,000 us
    double offset_ns = 0;                                      ///< host: first pulse, 0 .. 1e8 ns, at most one period
    GratingShifter clock_shifter = GratingShifter::as_role;
    GratingShifter address_shifter = GratingShifter::as_role;
    bool verify_lines = true;
    std::int64_t seed = 1;            ///< seed of the jitter, 0 .. 2^31 - 1
    std::int64_t bus_access_ns = 40;  ///< 0 .. 100,000 ns
};

/// Settings of a card of type grating_decoder.
struct GratingDecoderSettings {
    std::int64_t scales = 4;           ///< scales at its inputs, 1 .. 128
    double latch_ns = 10;              ///< from HOLD to valid counts, 0 .. 6,000 ns
    double output_ns = 20;             ///< 0.1 .. 6,000 ns
    std::int64_t bus_access_ns = 500;  ///< 0 .. 100,000 ns
};

inline const GratingBusSettings& grating_bus_in(const RackCard& card) {
    return card.settings.get<GratingBusSettings>();
}
inline const GratingDecoderSettings& grating_decoder_in(const RackCard& card) {
    return card.settings.get<GratingDecoderSettings>();
}

/// Returns the addresses of the scales that a card reads, in order; empty if its list is invalid (grating_bus_flaw
/// gives the reason).
std::vector<int> wanted_scales(const RackCard& card);

/// Converts a card of the rack file to the model's settings. `first`: it is the first card of its kind in the rack.
grating_bus::CardSettings grating_settings(const RackCard& card, bool first);
grating_bus::DecoderSettings decoder_settings(const RackCard& card);

std::optional<CardFlaw> grating_bus_flaw(const RackCard& card, std::span<const RackCard> before);
std::optional<CardFlaw> grating_decoder_flaw(const RackCard& card, std::span<const RackCard> before);
std::size_t grating_decoder_pin_count(const RackCard& card);

}  // namespace motionrack::rack
