// The general outputs nOUT0..7 of a chip: bits of WR4 and WR3.
#pragma once

#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

struct Chip::GeneralOutputs {
    /// Sets all of them low, as a reset of the chip does, without an access of the bus. Outputs that show the status of
    /// the drive (OUTSL) continue to show it. Between runs only.
    static void clear(Chip& chip);
};

}  // namespace motionrack::mcx314
