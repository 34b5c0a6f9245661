// Computes the levels of the lines, and lists conflicts.
#include <bit>
#include <motionrack/cards/grating_bus/model/lines.hpp>

namespace motionrack::grating_bus {

std::uint32_t Lines::driven(std::size_t i, std::uint32_t& any) const {
    std::uint32_t all = 0xFFFFFFFF;
    any = 0;
    for (std::uint64_t left = driving_[i]; left != 0; left &= left - 1) {
        const std::uint32_t value = value_[i][static_cast<std::size_t>(std::countr_zero(left))];
        all &= value;
        any |= value;
    }
    return all;
}

void Lines::settle() {
    std::uint32_t any = 0;
    for (std::size_t i = 0; i < line_count; ++i) {
        const std::uint32_t level = driving_[i] == 0 ? line_types[i].rest : driven(i, any);
        level_[i] = (level & ~forced_[i]) | stuck_[i];
    }
}

unsigned Lines::note_conflicts(Instant now) {
    unsigned begun = 0;
    for (std::size_t i = 0; i < line_count; ++i) begun |= note_conflicts(i, now);
    return begun;
}

unsigned Lines::note_conflicts(std::size_t i, Instant now) {
    const unsigned bit = 1u << i;
    std::uint32_t any = 0;
    const std::uint32_t all = driven(i, any), differ = driving_[i] == 0 ? 0 : any & ~all;
    if (differ == 0) {
        if ((in_conflict_ & bit) != 0) end_conflict(i, now);
        in_conflict_ &= ~bit;
        return 0;
    }
    const bool again = (in_conflict_ & bit) == 0 && ended_now(i, now);  // it ended just now
    const bool begins = (in_conflict_ & bit) == 0 && !again;
    in_conflict_ |= bit;
    if (again) list_[open_[i] % slots].end = never;
    if (begins) {
        open_[i] = count_++;
        ++reported_[i];
        list_[open_[i] % slots] = {now, never, 0, 0, i};
    }
    if (!listed(open_[i])) return 0;
    Conflict& conflict = list_[open_[i] % slots];
    for (std::uint64_t left = driving_[i]; left != 0; left &= left - 1) {
        const int driver = std::countr_zero(left);
        const std::uint32_t value = value_[i][static_cast<std::size_t>(driver)];
        if ((value & differ) != 0) conflict.high |= std::uint64_t{1} << driver;
        if ((~value & differ) != 0) conflict.low |= std::uint64_t{1} << driver;
    }
    return begins ? bit : 0;
}

bool Lines::ended_now(std::size_t i, Instant now) const {
    if (reported_[i] == 0 || open_[i] >= count_ || !listed(open_[i])) return false;
    const Conflict& last = list_[open_[i] % slots];
    return last.line == i && last.end == now;
}

void Lines::end_conflict(std::size_t i, Instant now) {
    if (!listed(open_[i])) return;
    Conflict& conflict = list_[open_[i] % slots];
    if (conflict.begin < now) {
        conflict.end = now;
        return;
    }
    // Removes a conflict without duration. Later conflicts, also those of this instant, move up.
    for (std::uint64_t n = open_[i] + 1; n < count_; ++n) {
        list_[(n - 1) % slots] = list_[n % slots];
        open_[list_[n % slots].line] = n - 1;
    }
    --count_;
    --reported_[i];
}

}  // namespace motionrack::grating_bus
