// Variants of a chip; constant while it runs.
#pragma once

#include <cstdint>

namespace motionrack::mcx314 {

enum class Variant : std::uint8_t {
    mcx314,   ///< the original
    mcx314as  ///< with filters, home search, synchronous actions, wide ranges (RULES.md, "The MCX314As")
};

/// Speed of a drive with V <= SV: the maker's sample program and a compatible chip's manual disagree.
enum class SlowDrive : std::uint8_t {
    at_v,  ///< drives at V
    at_sv  ///< drives at SV
};

/// Start of a software limit: the texts on RR2 and on RR1 disagree.
enum class SoftwareLimit : std::uint8_t {
    beyond,  ///< + drives stop beyond COMP+, by RR2 SLMT+
    at       ///< + drives stop at COMP+, by RR1 CMP+
};

struct ChipOptions {
    Variant variant = Variant::mcx314;
    SlowDrive slow_drive = SlowDrive::at_v;
    SoftwareLimit software_limit = SoftwareLimit::beyond;
    std::uint16_t offset_after_reset = 8;  ///< AO, pulses

    bool extended() const { return variant == Variant::mcx314as; }
};

}  // namespace motionrack::mcx314
