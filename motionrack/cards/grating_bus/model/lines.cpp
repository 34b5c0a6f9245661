// Levels of the lines, and the list of conflicts.
#include <bit>
#include <motionrack/cards/grating_bus/model/lines.hpp>

namespace motionrack::grating_bus {

unsigned Lines::settle(Instant now) {
    unsigned begun = 0;
    for (std::size_t i = 0; i < line_count; ++i) begun |= settle(static_cast<Line>(i), now);
    return begun;
}

unsigned Lines::settle(Line line, Instant now) {
    const std::size_t i = at(line);
    const unsigned bit = 1u << i;
    std::uint32_t all = 0xFFFFFFFF, any = 0;
    for (std::uint64_t left = driving_[i]; left != 0; left &= left - 1) {
        const std::uint32_t value = value_[i][static_cast<std::size_t>(std::countr_zero(left))];
        all &= value;
        any |= value;
    }
    level_[i] = driving_[i] == 0 ? line_types[i].rest : all;
    level_[i] = (level_[i] & ~forced_[i]) | stuck_[i];
    const std::uint32_t differ = driving_[i] == 0 ? 0 : any & ~all;
    if (differ == 0) {
        if ((in_conflict_ & bit) != 0) end_conflict(i, now);
        in_conflict_ &= ~bit;
        return 0;
    }
    const bool begins = (in_conflict_ & bit) == 0;
    if (begins) {
        open_[i] = count_++;
        ++told_[i];
        list_[open_[i] % kept] = {now, never, 0, 0, i};
        in_conflict_ |= bit;
    }
    if (!listed(open_[i])) return 0;
    Conflict& conflict = list_[open_[i] % kept];
    for (std::uint64_t left = driving_[i]; left != 0; left &= left - 1) {
        const int driver = std::countr_zero(left);
        const std::uint32_t value = value_[i][static_cast<std::size_t>(driver)];
        if ((value & differ) != 0) conflict.high |= std::uint64_t{1} << driver;
        if ((~value & differ) != 0) conflict.low |= std::uint64_t{1} << driver;
    }
    return begins ? bit : 0;
}

void Lines::end_conflict(std::size_t i, Instant now) {
    if (!listed(open_[i])) return;
    Conflict& conflict = list_[open_[i] % kept];
    if (conflict.begin < now || open_[i] + 1 != count_) {
        conflict.end = now;
    } else {  // of no length: none
        --count_;
        --told_[i];
    }
}

}  // namespace motionrack::grating_bus
