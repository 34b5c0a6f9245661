// The MCX314 in a rack file and in a running rack; its description is in mcx314_plugin.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/rack/catalogue.hpp>
#include <span>

namespace motionrack::rack {

extern const CardPlugin mcx314_plugin;

/// Width of a card's bus.
enum class BusWidth : std::uint8_t { bits16, bits8 };
/// Chip variants of a card of type mcx314.
enum class Mcx314Variant : std::uint8_t { mcx314, mcx314as };
/// Points on which the sources disagree: the velocity of a drive with V <= SV, the start of + software limits.
enum class Mcx314LowSpeedDrive : std::uint8_t { at_v, at_sv };
enum class Mcx314SoftwareLimits : std::uint8_t { beyond, at };

/// Settings of a card of type mcx314.
struct Mcx314Settings {
    Mcx314Variant variant = Mcx314Variant::mcx314;
    Mcx314LowSpeedDrive low_speed_drive = Mcx314LowSpeedDrive::at_v;
    Mcx314SoftwareLimits software_limits = Mcx314SoftwareLimits::beyond;
    std::int64_t ao_after_reset = 8;     ///< acceleration offset AO after a reset, 0 .. 65,535 pulses
    std::int64_t clock_hz = 16'000'000;  ///< this value only: the model's tick is 125 ns
    BusWidth bus = BusWidth::bits16;     ///< with 8 bits a register takes two accesses
    std::int64_t bus_access_ns = 250;    ///< duration of an access, 0 .. 100,000 ns
    std::int64_t host_latency_us = 50;   ///< 0 .. 10,000 us from an interrupt to the host's first access
};

inline const Mcx314Settings& mcx314_in(const RackCard& card) {
    return card.settings.get<Mcx314Settings>();
}

/// See CardPlugin::make.
std::unique_ptr<Card> make_mcx314(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>> before);

}  // namespace motionrack::rack
