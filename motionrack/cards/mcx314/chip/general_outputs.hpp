// The general outputs nOUT0..7 of a chip: bits of WR4 and WR3.
#pragma once

#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

struct Chip::GeneralOutputs {
    /// Sets all of them low, as a reset of the chip does, without an access of the bus. Each that was high stays low
    /// until the host writes it low, then high: a word that the host remembers from before switches nothing on. Outputs
    /// that show the status of the drive (OUTSL) continue to show it. Between runs only.
    static void clear(Chip& chip);
    /// The host writes WR4. Reports the first output that stays low.
    static void write(Chip& chip, const sim::MaskedWrite& put);
    /// The host writes WR3 of an axis. As write.
    static void write_modes(Chip& chip, int axis, const sim::MaskedWrite& put);

  private:
    /// `low`: bits of WR`number` that stay low.
    static void report(Chip& chip, int number, std::uint32_t low);
};

}  // namespace motionrack::mcx314
