// Comparisons of LP or EP with COMP+ and COMP-.
#include <motionrack/cards/mcx314/chip/comparators.hpp>

namespace motionrack::mcx314 {

/// Returns the counter, LP or EP, that is compared with COMP+ and COMP-.
std::int32_t Comparators::compared_counter(int a) const {
    const Axis& axis = state_.axis[a];
    return wr2::CMPSL.test(axis.wr2) ? encoders_.position(axis, a) : axis.lp;
}

bool Comparators::beyond_software_limit(int a) const {
    const Axis& axis = state_.axis[a];
    const bool plus = axis.direction > 0;
    if (!(plus ? wr2::SLMTP : wr2::SLMTM).test(axis.wr2)) return false;
    const std::int64_t counter = compared_counter(a);
    return plus ? counter > axis.comp_plus - limit_begins_ : counter < axis.comp_minus;
}

void Comparators::compare(int a) {
    Axis& axis = state_.axis[a];
    const std::int32_t counter = compared_counter(a);
    unsigned now = counter >= axis.comp_minus ? rr3::PGECM.mask : rr3::PLCM.mask;
    now |= counter >= axis.comp_plus ? rr3::PGECP.mask : rr3::PLCP.mask;
    const unsigned risen = now & ~axis.compared;
    axis.compared = static_cast<std::uint16_t>(now);
    request_interrupt(axis, risen);
    if (extended_) conditions_.note_comparisons(a, risen);
}

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
