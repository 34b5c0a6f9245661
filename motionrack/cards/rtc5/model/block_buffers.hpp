// Values of the ticks of a block, on their way through the card.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/rtc5/model/kernels.hpp>

namespace motionrack::rtc5 {

/// Valid within a block only: not part of the card's state.
struct BlockBuffers {
    using Doubles = std::array<double, kernels::block>;
    using Counts = std::array<std::int32_t, kernels::block>;
    Doubles x, y;          ///< positions, before and after the correction
    Doubles effective[2];  ///< counts or words that the correction uses
    Doubles head_x, head_y;
    Counts raw[2], counts[2];  ///< encoder counts
    Counts out[4];             ///< x, y of head A and B
    std::array<std::uint32_t, kernels::block> words;
    std::array<std::uint8_t, kernels::block> laser;  ///< half-microseconds with the laser on
};

}  // namespace motionrack::rtc5
