// One axis of the position project: A, B, Z and Cal sampled every 100 ns, filtered, decoded, counted, calibrated.
//
//   wire ──► raw ──(sample)──► sampled ──(FILTER + 1 samples)──► taken ──► count, index, Cal
//
// Unchanged samples cost no time: samples between two changes of wires are processed on demand. Only the samples at
// which the filter accepts a level are computed.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/ioflex02/map.hpp>
#include <type_traits>

namespace motionrack::ioflex02 {

inline constexpr std::int64_t no_sample = -1;
inline constexpr int line_count = 4;  ///< A, B, Z, Cal

struct LineState {
    std::int64_t from = 0;  ///< first sample that shows `sampled`
    std::uint16_t raw = 0;
    std::uint16_t sampled = 0;
    std::uint16_t taken = 0;
    std::uint16_t reserved = 0;
};

/// State of an axis; sample k is at k * 100 ns since power-up.
struct EncoderAxisState {
    std::array<LineState, line_count> lines{};
    std::int64_t pending = 0;       ///< first sample at which the decoder uses the changed input levels
    std::int64_t done = no_sample;  ///< processed samples
    std::int64_t position = 0;
    std::int64_t raw = 0;
    std::int64_t edge = no_sample;            ///< sample of the last count
    std::int64_t index_at = 0;                ///< raw count at the last index
    std::int64_t illegal_at = 0;              ///< raw count at the last illegal transition
    std::int64_t illegal_sample = no_sample;  ///< instant of the first illegal transition since CLEAR_ERRORS
    std::uint16_t illegal = 0;                ///< stays at FFFFh
    std::uint16_t edges_a = 0, edges_b = 0, indexes = 0;
    std::uint16_t mode = 0;
    CalState cal = CalState::calibrated;
    std::uint8_t begun = 0;     ///< the first sample has been taken
    std::uint8_t down = 0;      ///< the last count was downwards
    std::uint8_t reported = 0;  ///< the illegal transitions were reported
    std::array<std::uint8_t, 2> reserved{};
};
static_assert(std::has_unique_object_representations_v<EncoderAxisState>, "padding would get into the state's hash");

/// Clears all counts and keeps the lines' levels. The next sample is the first after `done`; it only initialises the
/// state.
void begin_axis(EncoderAxisState& axis, std::uint16_t mode, std::int64_t done);
/// Records a new level of a wire. Its first sample is `sample`, or the next one if that is already processed.
void wire_changed(EncoderAxisState& axis, int line, bool level, std::int64_t sample);
/// Processes the samples up to `sample`.
void advance(EncoderAxisState& axis, std::int64_t sample);
/// The first sample at which A and B may be accepted together, `none` if the present wires exclude it.
std::int64_t illegal_from(const EncoderAxisState& axis, std::int64_t none);
/// Executes a calibration command after the samples up to now.
void command_axis(EncoderAxisState& axis, tIOFlexCmd command);
/// Returns the word of the register LINES.
std::uint16_t lines_word(const EncoderAxisState& axis);

}  // namespace motionrack::ioflex02
