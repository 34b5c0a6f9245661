// One axis of the position project: A, B, Z and Cal sampled every 100 ns, filtered, decoded, counted, calibrated.
//
//   wire ──► raw ──(sample)──► sampled ──(FILTER + 1 samples)──► taken ──► count, index, Cal
//
// Nothing is done for a sample that changes nothing: samples between two changes of wires are worked off when somebody
// asks, those at which a level becomes a taken one are found, the others skipped.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/ioflex02/map.hpp>
#include <type_traits>

namespace motionrack::ioflex02 {

inline constexpr std::int64_t no_sample = -1;
inline constexpr int line_count = 4;  ///< A, B, Z, Cal

struct LineState {
    std::int64_t from = 0;  ///< the sample since which `sampled` has been seen
    std::uint16_t raw = 0;
    std::uint16_t sampled = 0;
    std::uint16_t taken = 0;
    std::uint16_t reserved = 0;
};

/// What an axis remembers; samples have numbers, sample k is at k * 100 ns since power-up.
struct AxisState {
    std::array<LineState, line_count> lines{};
    std::int64_t pending = 0;       ///< the first sample that sees the raw levels
    std::int64_t done = no_sample;  ///< samples up to this one have been worked off
    std::int64_t position = 0;
    std::int64_t raw = 0;
    std::int64_t edge = no_sample;            ///< sample of the last count
    std::int64_t index_at = 0;                ///< raw count at the last index
    std::int64_t illegal_at = 0;              ///< raw count at the last illegal transition
    std::int64_t illegal_sample = no_sample;  ///< the first one since CLEAR_ERRORS
    std::uint16_t illegal = 0;                ///< stays at FFFFh
    std::uint16_t edges_a = 0, edges_b = 0, indexes = 0;
    std::uint16_t mode = 0;
    CalState cal = CalState::calibrated;
    std::uint8_t begun = 0;  ///< the first sample has been taken
    std::uint8_t down = 0;   ///< the last count was downwards
    std::uint8_t told = 0;   ///< the illegal transitions were reported
    std::array<std::uint8_t, 2> reserved{};
};
static_assert(std::has_unique_object_representations_v<AxisState>, "padding would get into the state's hash");

/// All counts gone, the lines' levels kept; the next sample is the first after `done`, it only sets the state.
void begin_axis(AxisState& axis, std::uint16_t mode, std::int64_t done);
/// A wire has a new level; the first sample that sees it is `sample`, or the next one if that is worked off.
void wire_changed(AxisState& axis, int line, bool level, std::int64_t sample);
/// Works off the samples up to `sample`.
void advance(AxisState& axis, std::int64_t sample);
/// The first sample at which A and B may be taken together, `none` where they cannot as the wires are.
std::int64_t illegal_from(const AxisState& axis, std::int64_t none);
/// A calibration command, after the samples up to now.
void command_axis(AxisState& axis, tIOFlexCmd command);
/// The word LINES.
std::uint16_t lines_word(const AxisState& axis);

}  // namespace motionrack::ioflex02
