// Outputs of a card that a stop of the machine cleared: each stays low until the host writes it low, then high. A word
// that the host remembers from before switches nothing on.
#pragma once

#include <cstdint>

namespace motionrack::sim {

/// A register of which the host writes the bits in `mask`.
struct MaskedWrite {
    std::uint16_t value = 0, mask = 0xFFFF;

    void operator()(std::uint16_t& word) const { word = static_cast<std::uint16_t>((word & ~mask) | (value & mask)); }
};

/// Writes `word` without the outputs in `held`, from which those go that are written low. Returns the others that the
/// host writes high.
inline std::uint32_t put_unless_held(const MaskedWrite& put, std::uint16_t& word, std::uint32_t& held) {
    put(word);
    held &= put.value | ~std::uint32_t{put.mask};
    word = static_cast<std::uint16_t>(word & ~held);
    return held & put.mask;
}

}  // namespace motionrack::sim
