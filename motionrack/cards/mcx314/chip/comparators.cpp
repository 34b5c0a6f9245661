// Comparisons of LP or EP with COMP+ and COMP-.
#include <motionrack/cards/mcx314/chip/comparators.hpp>

namespace motionrack::mcx314 {

bool compares(const Axis& axis) {
    return axis.comparisons != 0 || wr2::SLMTP.test(axis.wr2) || wr2::SLMTM.test(axis.wr2) ||
           (axis.outputs_wanted && wr3::OUTSL.test(axis.wr3));
}

std::int64_t steps_to_comparison(const Axis& axis, std::int32_t counter, int direction) {
    const std::int64_t at = counter, plus = axis.comp_plus, minus = axis.comp_minus;
    std::int64_t steps = direction > 0 ? (std::int64_t{1} << 31) - at : at + (std::int64_t{1} << 31) + 1;
    for (const std::int64_t first : {plus, plus + 1, minus}) {  // comparisons differ below and from `first` on
        const std::int64_t distance = direction > 0 ? first - at : at - first + 1;
        if (distance >= 1) steps = std::min(steps, distance);
    }
    if (axis.ring) {
        const std::int64_t place = static_cast<std::uint32_t>(counter);
        const std::int64_t end = static_cast<std::uint32_t>(axis.comp_plus);
        steps = std::min(steps, direction > 0 ? end - place + 1 : place + 1);
    }
    return steps;
}

}  // namespace motionrack::mcx314
