// The complete state of the card; trivially copyable, so a snapshot is one assignment.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/cards/ioflex02/model/axis.hpp>
#include <type_traits>

namespace motionrack::ioflex02 {

/// State of the programmable array; the values are in the order of the map's states.
enum class ArrayState : std::uint32_t { empty, loading, starting, running, failed };

/// The programmable array and the image that is being received.
struct Configuration {
    ArrayState array = ArrayState::empty;
    std::uint32_t crc = 0;  ///< CRC of the bytes received
    std::uint32_t received = 0;
    CfgError error = CfgError::none;
    std::uint16_t known = 0;  ///< 1 if the model supports the loaded project, else 0
    ImageHeader header;
    std::array<std::uint8_t, min_payload> payload{};  ///< beginning of the payload
    std::array<std::uint8_t, 4> reserved{};
    Instant starts_at = never;  ///< instant at which the array is configured
    std::array<std::uint16_t, axis_count> modes{};
};

/// Values of an axis that STROBE latches.
struct CapturedAxis {
    std::uint32_t position = 0, raw = 0, age = 0;
    std::uint32_t index_at = 0, illegal_at = 0;
    std::uint16_t lines = 0, edges_a = 0, edges_b = 0, indexes = 0, illegal = 0;
    std::uint16_t down = 0;
};
struct Captured {
    std::uint32_t time = 0;
    std::array<CapturedAxis, axis_count> axes{};
    std::uint32_t reserved = 0;
};

struct State {
    Configuration configuration;
    Instant origin{};          ///< start of the project: phase of the time
    std::int64_t cleared = 0;  ///< ticks since origin at the last CLEAR_TIME
    std::array<EncoderAxisState, axis_count> axes{};
    Captured captured;
    std::uint16_t outputs = 0;
    std::uint16_t axis = 0;  ///< number of the axis that the register AXIS selects, 0 .. 3
    std::uint16_t reported_no_project = 0;
    std::uint16_t begun = 0;
    std::uint32_t held = 0;  ///< outputs that a stop of the machine cleared, until the host writes them low
    std::uint32_t reported_held = 0;
};

static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

}  // namespace motionrack::ioflex02
