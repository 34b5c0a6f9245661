// Calls of the declaration's rows: pass the arguments in order to the function of the Driver, and format its result.
#pragma once

#include <motionrack/cards/mcx314/library/library.hpp>

namespace motionrack::mcx314::functions {

using Values = std::span<const std::int64_t>;
using Call = Result<CallAnswer> (*)(LibraryChip& chip, Values values);

/// "Written: X and Y." and the like.
CallAnswer written();
CallAnswer begun(LibraryChip& chip, unsigned mask);

FourAxes four(Values v);
inline unsigned axes_of(std::int64_t mask) {
    return static_cast<unsigned>(mask);
}
inline int channel_of_mask(std::int64_t mask) {
    return *channels_of(axes_of(mask)).begin();
}

/// Calls a function of the driver with the arguments (axes, data).
template <Result<void> (Driver::*function)(unsigned, std::int64_t)>
Result<CallAnswer> set(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK((chip.driver.*function)(axes_of(v[0]), v[1]));
    return written();
}
/// Calls a function of the driver with the argument (data), for all axes.
template <Result<void> (Driver::*function)(unsigned, std::int64_t)>
Result<CallAnswer> set_all(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK((chip.driver.*function)(xyzu, v[0]));
    return written();
}
/// Calls a function of the driver with the arguments (n, axes); n is a choice, as of a level.
template <Result<void> (Driver::*function)(int, unsigned)>
Result<CallAnswer> turn(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK((chip.driver.*function)(static_cast<int>(v[0]), axes_of(v[1])));
    return written();
}
/// Calls a function of the driver with the argument (n), for all axes.
template <Result<void> (Driver::*function)(int, unsigned)>
Result<CallAnswer> turn_all(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK((chip.driver.*function)(static_cast<int>(v[0]), xyzu));
    return written();
}
/// Reads a value of the single axis given by the argument (axis).
template <std::int32_t (Driver::*function)(int)>
Result<CallAnswer> read(LibraryChip& chip, Values v) {
    const std::int32_t value = (chip.driver.*function)(channel_of_mask(v[0]));
    return CallAnswer{value, {}};
}
Result<CallAnswer> home(LibraryChip& chip, int type, Values v);
template <int type>
Result<CallAnswer> home(LibraryChip& chip, Values v) {
    return home(chip, type, v);
}

// (V, PX, PY, PZ, PU, axis); with a ramp (SV, V, A, D, ..), with an S-curve (SV, V, A, D, K, ..)
using LineFunction = Result<void> (Driver::*)(const LINEDATA&, unsigned);
Result<CallAnswer> line(LibraryChip& chip, LineFunction function, const LINEDATA& speeds, Values ends);
template <LineFunction function>
Result<CallAnswer> line_c(LibraryChip& chip, Values v) {
    return line(chip, function, {0, v[0], 0, 0, 0, {}}, v.subspan(1));
}
template <LineFunction function>
Result<CallAnswer> line_t(LibraryChip& chip, Values v) {
    return line(chip, function, {v[0], v[1], v[2], v[3], 0, {}}, v.subspan(4));
}
template <LineFunction function>
Result<CallAnswer> line_s(LibraryChip& chip, Values v) {
    return line(chip, function, {v[0], v[1], v[2], v[3], v[4], {}}, v.subspan(5));
}

// (V, PX .. PU, CX .. CU, axis); with a ramp (SV, V, A, D, ..)
using ArcFunction = Result<void> (Driver::*)(const CIRCLEDATA&, unsigned);
Result<CallAnswer> arc(LibraryChip& chip, ArcFunction function, const CIRCLEDATA& speeds, Values places);
template <ArcFunction function>
Result<CallAnswer> arc_c(LibraryChip& chip, Values v) {
    return arc(chip, function, {0, v[0], 0, 0, {}, {}}, v.subspan(1));
}
template <ArcFunction function>
Result<CallAnswer> arc_t(LibraryChip& chip, Values v) {
    return arc(chip, function, {v[0], v[1], v[2], v[3], {}, {}}, v.subspan(4));
}

/// A row of the declaration with its call.
struct FunctionRow {
    FunctionInfo info;
    Call call = nullptr;
};
std::span<const FunctionRow> function_rows();
/// Functions that the source does not list; their names follow the source's.
std::span<const FunctionRow> own_rows();

}  // namespace motionrack::mcx314::functions
