// Work arrays of the processing pipeline: one value for each tick of a block.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/rtc5/model/kernels.hpp>

namespace motionrack::rtc5 {

/// Values of the present block only, so they are not part of the card's state.
struct BlockBuffers {
    using Doubles = std::array<double, kernels::block>;
    using Counts = std::array<std::int32_t, kernels::block>;
    Doubles x, y;          ///< positions, bits; the correction overwrites them
    Doubles effective[2];  ///< encoder counts or word values that the correction uses
    Doubles head_x, head_y;
    Counts raw[2], counts[2];  ///< encoder counts
    Counts out[4];             ///< x, y of head A and B
    std::array<std::uint32_t, kernels::block> words;
    std::array<std::uint8_t, kernels::block> laser;  ///< half-microseconds with the laser on
};

}  // namespace motionrack::rtc5
