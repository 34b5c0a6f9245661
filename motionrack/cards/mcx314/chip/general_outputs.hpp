// The general outputs nOUT0..7 of a chip: bits of WR4 and WR3.
#pragma once

#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

struct Chip::GeneralOutputs {
    /// Sets all outputs low, as a reset of the chip does, without a bus access. An output that was high stays low until
    /// the host writes it low, then high, so a word from before the stop switches nothing on. Outputs that show the
    /// status of the drive (OUTSL) continue to show it. Between runs only.
    static void clear(Chip& chip);
    /// Executes the host's write to WR4. Reports the first time that an output stays low.
    static void write(Chip& chip, const sim::MaskedWrite& put);
    /// Executes the host's write to WR3 of an axis. Reports the first time that an output stays low.
    static void write_modes(Chip& chip, int axis, const sim::MaskedWrite& put);

  private:
    /// Reports outputs that stay low: the bits `low` of WR3 or WR4 (`number`).
    static void report(Chip& chip, int number, std::uint32_t low);
};

}  // namespace motionrack::mcx314
