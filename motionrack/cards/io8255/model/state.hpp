// The complete state of the card; trivially copyable, so a snapshot is one assignment.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/io8255/map.hpp>
#include <type_traits>

namespace motionrack::io8255 {

struct State {
    std::uint16_t control = word_of({});  ///< last control word of the modes
    std::array<std::uint16_t, port_count> latch{};
    std::array<std::uint16_t, group_count> taken{};  ///< bytes that the last strobes took
    std::array<std::uint16_t, group_count> full{};   ///< the buffer has a byte: IBF high, OBF low
    std::array<std::uint16_t, group_count> enabled{};
    std::array<std::uint16_t, group_count> reported_lost{};
    std::array<std::uint32_t, port_count> held{};  ///< outputs that a stop of the machine cleared, until written low
    std::uint32_t reported_held = 0;
};

static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

}  // namespace motionrack::io8255
