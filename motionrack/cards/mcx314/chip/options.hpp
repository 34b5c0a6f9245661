// What a chip is built as; none of it changes while it runs.
#pragma once

#include <cstdint>

namespace motionrack::mcx314 {

enum class Variant : std::uint8_t {
    mcx314,   ///< the original
    mcx314as  ///< with filters, home search, synchronous actions, wide ranges (RULES.md, "The MCX314As")
};

/// What a drive with V <= SV does: the maker's sample program and a compatible chip's manual do not agree.
enum class SlowDrive : std::uint8_t {
    at_v,  ///< drives at V
    at_sv  ///< drives at SV
};

/// Where a software limit begins: the texts on RR2 and on RR1 do not agree.
enum class SoftwareLimit : std::uint8_t {
    beyond,  ///< + drives stop beyond COMP+, as RR2 SLMT+
    at       ///< + drives stop at COMP+, as RR1 CMP+
};

struct ChipOptions {
    Variant variant = Variant::mcx314;
    SlowDrive slow_drive = SlowDrive::at_v;
    SoftwareLimit software_limit = SoftwareLimit::beyond;
    std::uint16_t offset_after_reset = 8;  ///< AO, pulses
};

}  // namespace motionrack::mcx314
