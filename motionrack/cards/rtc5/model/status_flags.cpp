// Sets the flags of positions outside the field or the limits.
#include <algorithm>
#include <array>
#include <bit>
#include <motionrack/cards/rtc5/model/status_flags.hpp>

namespace motionrack::rtc5 {

namespace {

/// Bits of the marking info for an axis below and above the limits of set_fly_limits or set_fly_limits_z.
struct LimitBits {
    std::uint32_t below = 0, above = 0;
};
constexpr std::array<LimitBits, 3> limit_bits = {{{marking_bit("LIMIT_X_MIN"), marking_bit("LIMIT_X_MAX")},
                                                  {marking_bit("LIMIT_Y_MIN"), marking_bit("LIMIT_Y_MAX")},
                                                  {marking_bit("LIMIT_Z_MIN"), marking_bit("LIMIT_Z_MAX")}}};

}  // namespace

void StatusFlags::raise(std::uint32_t bits, std::int64_t tick) {
    for (std::uint32_t left = bits & ~static_cast<std::uint32_t>(flags_.marking_info); left != 0; left &= left - 1)
        flags_.flag_tick[static_cast<std::size_t>(std::countr_zero(left))] = tick;
    flags_.marking_info |= bits;
}

void StatusFlags::check(const BlockBuffers& b, const PlanExtent& e, std::int64_t first) {
    struct Bound {
        std::uint32_t flag;
        const BlockBuffers::Doubles* values;
        double bound, min, max;
        bool upper;
    };
    const auto limit = [&](std::size_t i) { return static_cast<double>(limits_[i]); };
    const Bound bounds[] = {
        {marking_bit("FLY_X_UNDERFLOW"), &b.x, min_field, e.min_x, e.max_x, false},
        {marking_bit("FLY_X_OVERFLOW"), &b.x, max_field, e.min_x, e.max_x, true},
        {marking_bit("FLY_Y_UNDERFLOW"), &b.y, min_field, e.min_y, e.max_y, false},
        {marking_bit("FLY_Y_OVERFLOW"), &b.y, max_field, e.min_y, e.max_y, true},
        {marking_bit("LIMIT_X_MIN"), &b.x, limit(0), e.min_x, e.max_x, false},
        {marking_bit("LIMIT_X_MAX"), &b.x, limit(1), e.min_x, e.max_x, true},
        {marking_bit("LIMIT_Y_MIN"), &b.y, limit(2), e.min_y, e.max_y, false},
        {marking_bit("LIMIT_Y_MAX"), &b.y, limit(3), e.min_y, e.max_y, true},
    };
    for (const Bound& c : bounds) {
        if (!(c.upper ? c.max > c.bound : c.min < c.bound) || (flags_.marking_info & c.flag)) continue;
        std::size_t i = 0;
        while (!(c.upper ? (*c.values)[i] > c.bound : (*c.values)[i] < c.bound)) ++i;
        raise(c.flag, first + static_cast<std::int64_t>(i));
    }
}

void StatusFlags::check_z(double z, std::int64_t tick) {
    std::uint32_t bits = 0;
    if (z < min_z) bits |= marking_bit("FLY_Z_UNDERFLOW");
    if (z > max_z) bits |= marking_bit("FLY_Z_OVERFLOW");
    if (z < static_cast<double>(limits_[4])) bits |= marking_bit("LIMIT_Z_MIN");
    if (z > static_cast<double>(limits_[5])) bits |= marking_bit("LIMIT_Z_MAX");
    if (bits != 0) raise(bits, tick);
}

bool StatusFlags::is_inside(double bits, std::size_t axis) const {
    const double min_bits = std::max(min_field, static_cast<double>(limits_[2 * axis])) + 1;
    const double max_bits = std::min(max_field, static_cast<double>(limits_[2 * axis + 1])) - 1;
    return bits > min_bits && bits < max_bits;
}

void StatusFlags::set_limits(const Command& c) {
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    if (c.op == Op::set_fly_limits_z)
        limits_[4] = whole(0), limits_[5] = whole(1);
    else
        for (std::size_t i = 0; i < 4; ++i) limits_[i] = whole(i);
}

void StatusFlags::clear_limit_flags(std::int64_t mode) {
    for (std::size_t axis = 0; axis < limit_bits.size(); ++axis)
        if (mode == 0 || (mode >> axis & 1))
            flags_.marking_info &= ~std::int64_t{limit_bits[axis].below | limit_bits[axis].above};
}

bool StatusFlags::take_condition(const Command& c) {
    const auto number = static_cast<std::uint32_t>(c.op) - static_cast<std::uint32_t>(Op::if_fly_x_overflow);
    const auto [below, above] = limit_bits[number % 3];
    const std::int64_t bits = c.p[0] > 0 ? above : c.p[0] < 0 ? below : below | above;
    const bool holds = ((flags_.marking_info & bits) != 0) == (number < 3);
    flags_.marking_info &= ~bits;
    return holds;
}

std::uint32_t StatusFlags::take_marking_info() {
    const auto out = static_cast<std::uint32_t>(flags_.marking_info);
    flags_.marking_info &= kept_when_read;
    return out;
}

}  // namespace motionrack::rtc5
