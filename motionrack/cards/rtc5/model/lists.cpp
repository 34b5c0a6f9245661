// Lists: memory, loading, start and end.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

Result<void> check(const Settings& s) {
    if (s.list_memory < min_list_memory || s.list_memory > max_list_memory)
        return fail(ErrorKind::refused,
                    fmt::format("the list memory has {} positions; it must have {} to {}. Nothing was changed",
                                s.list_memory, min_list_memory, max_list_memory));
    if (s.list1 < 1 || s.list2 < 0 || s.list1 > s.list_memory - s.list2)
        return fail(ErrorKind::refused, fmt::format("lists of {} and {} positions do not fit a memory of {}; nothing "
                                                    "was changed. List 1 needs 1 or more, list 2 may have 0",
                                                    s.list1, s.list2, s.list_memory));
    return {};
}

Result<void> Engine::config_list(std::int64_t list1, std::int64_t list2) {
    if (state_.lists.running)
        return fail(ErrorKind::refused,
                    "config_list: a list is running. The memory was not changed. Stop the list first");
    const std::int64_t rest = settings_.list_memory - std::clamp<std::int64_t>(list1, 0, settings_.list_memory);
    Settings changed = settings_;
    changed.list1 = list1, changed.list2 = list2 == -1 ? rest : list2;
    MOTIONRACK_CHECK(check(changed));
    state_.lists.begin = {0, list1, list1 + changed.list2, settings_.list_memory};
    state_.lists.subroutines = {};
    state_.lists.list3_used = 0;
    return set_start_list(1);
}

namespace {

Result<void> check_position(std::int64_t position) {
    if (position >= 0 && position < max_list_memory) return {};
    return fail(ErrorKind::refused, fmt::format("the list position is {}; it must be 0 to {}. Nothing was changed",
                                                position, max_list_memory - 1));
}

/// Hash of a command at its position; 0 for an empty position.
std::uint64_t hash_at(std::int64_t position, const Command& c) {
    if (c.op == Op::none) return 0;
    std::uint64_t h = static_cast<std::uint64_t>(position) << 16 ^ static_cast<std::uint64_t>(c.op);
    const auto mix = [&h](std::uint64_t value) {
        h = (h ^ value) * 0xD6E8FEB86659FD93ull;
        h ^= h >> 32;
    };
    mix(static_cast<std::uint32_t>(c.head));
    for (const double p : c.p) mix(std::bit_cast<std::uint64_t>(p));
    return h;
}

/// The hash of the memory is the sum over its positions, so a new command costs two hashes instead of 42 MB.
void store(std::span<Command> memory, std::uint64_t& memory_hash, std::int64_t position, const Command& command) {
    Command& stored = memory[static_cast<std::size_t>(position)];
    memory_hash += hash_at(position, command) - hash_at(position, stored);
    stored = command;
}

/// Index 0 for list 1, 1 for list 2; without memory list 2 is list 1.
std::size_t list_of(std::uint32_t number, const Lists& l) {
    return number % 2 == 0 && l.begin[2] > l.begin[1] ? 1 : 0;
}
/// Memory position of `position` in list `list`.
std::int64_t place(std::size_t list, std::int64_t position, const Lists& l) {
    const std::int64_t begin = l.begin[list];
    return position < l.begin[list + 1] - begin ? begin + position : begin;
}

}  // namespace

Result<void> Engine::set_start_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_CHECK(check_position(position));
    Lists& l = state_.lists;
    const std::size_t number = list_of(list, l);
    open(place(number, position, l), l.begin[number + 1]);
    l.loaded &= ~(std::int64_t{list_status_bit("READY1") | list_status_bit("USED1")} << number);
    l.loaded |= std::int64_t{list_status_bit("LOAD1")} << number;
    return {};
}

void Engine::open(std::int64_t input, std::int64_t end) {
    Lists& l = state_.lists;
    l.input = input, l.input_end = end;
    l.loading = 0;
    l.loaded &= ~std::int64_t{list_status_bit("LOAD1") | list_status_bit("LOAD2")};
}

Result<void> Engine::load_sub(std::uint32_t index) {
    Lists& l = state_.lists;
    if (index >= subroutine_count)
        return fail(ErrorKind::refused, fmt::format("load_sub: subroutine {} must be 0 to {}. Nothing was changed",
                                                    index, subroutine_count - 1));
    open(l.begin[2] + l.list3_used, l.begin[3]);
    l.loading = index + 1;
    return {};
}

Result<std::uint32_t> Engine::load_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_CHECK(check_position(position));
    Lists& l = state_.lists;
    const std::uint32_t status = list_status();
    const auto free = [&](std::size_t i, bool used) {
        return !(status & list_status_bit("BUSY1") << i) && (!used || status & list_status_bit("USED1") << i);
    };
    const std::uint32_t wanted = list & 3;
    const std::size_t next = l.current < l.begin[1] ? 1 : 0;  // the list that auto_change would run
    for (const std::size_t i : {wanted == 3 ? next : std::size_t{0}, wanted == 3 ? 1 - next : std::size_t{1}}) {
        if ((wanted == 1 && i == 1) || (wanted == 2 && list_of(2, l) != i) || (i == 1 && list_of(2, l) == 0)) continue;
        if (!free(i, wanted == 3)) continue;
        MOTIONRACK_CHECK(set_start_list(static_cast<std::uint32_t>(i + 1), position));
        return static_cast<std::uint32_t>(i + 1);
    }
    open(-1, -1);
    return 0u;
}

Result<void> Engine::put(const Command& command) {
    Lists& l = state_.lists;
    const ListCommandInfo& what = info(command.op);
    if (l.input < 0)
        return fail(ErrorKind::refused, fmt::format("{}: no list is open; the command was not added. Open a list "
                                                    "(load_list, set_start_list)",
                                                    what.name));
    if (l.input + what.positions > l.input_end)
        return fail(ErrorKind::refused, fmt::format("{}: the list is full at position {}; the command was not added. "
                                                    "Split the job between two lists (auto_change), or give "
                                                    "the list more memory (config_list)",
                                                    what.name, l.input));
    store(memory(), state_.memory_hash, l.input, command);
    for (int i = 1; i < what.positions; ++i) store(memory(), state_.memory_hash, l.input + i, {});
    l.input += what.positions;
    if (command.op == Op::list_return && l.loading) {
        // The subroutine is complete; without commands it is deleted.
        const std::int64_t begin = l.begin[2] + l.list3_used;
        const bool empty = l.input == begin + 1;
        l.subroutines[static_cast<std::size_t>(l.loading - 1)] = empty ? 0 : begin;
        if (!empty) l.list3_used = l.input - l.begin[2];
        open(-1, -1);
    } else if (command.op == Op::set_end_of_list && l.input <= l.begin[2]) {
        const std::size_t number = l.input > l.begin[1] ? 1 : 0;
        l.loaded |= std::int64_t{list_status_bit("READY1")} << number;
        l.loaded &= ~(std::int64_t{list_status_bit("LOAD1")} << number);
    }
    return {};
}

Result<void> Engine::execute_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_CHECK(check_position(position));
    return execute_at(place(list_of(list, state_.lists), position, state_.lists));
}

Result<void> Engine::execute_at(std::int64_t position) {
    Lists& l = state_.lists;
    if (l.running || l.moving_alone)
        return fail(
            ErrorKind::refused,
            "execute_list: a list is running, or the card moves. Nothing was started. Wait until it is not busy");
    if (position < 0 || position >= l.begin[3])
        return fail(ErrorKind::refused,
                    fmt::format("execute_at_pointer: the position is {}; it must be 0 to {}. Nothing was started",
                                position, l.begin[3] - 1));
    l.running = 1;
    l.depth = 0;
    l.next = l.current = position;
    flags_.raise_startstop(startstop_bit("INTERNAL_START"));
    return {};
}

/// Ends the running list; the other list may follow.
void Engine::end_list(bool written, std::int64_t tick) {
    Lists& l = state_.lists;
    l.skip = 0;
    l.depth = 0;
    if (!written) ++l.ended_unwritten;
    const std::int64_t at = l.current;
    l.loaded |= std::int64_t{list_status_bit("USED1")} << (at < l.begin[1] ? 0 : 1);
    // Lists that take no time would follow each other without end: at most one change per tick.
    if (written && (l.auto_change || l.loop) && at < l.begin[2] && l.changed_at != tick) {
        l.auto_change = 0;
        l.changed_at = tick;
        l.next = at < l.begin[1] ? l.begin[1] : l.begin[0];
        return;
    }
    l.running = 0;
    if (connections_.listener != nullptr) connections_.listener->ended(tick);
}

/// A call to an undefined target (-1) is a list_nop.
void Engine::call(std::int64_t position, std::int64_t tick) {
    Lists& l = state_.lists;
    if (position < 0 || position == l.current || l.depth == static_cast<std::int64_t>(max_depth)) return begin_hold(1);
    if (l.called_at != tick) l.calls = 0;
    l.called_at = tick;
    // Calls that take no time could follow each other without end.
    if (++l.calls > static_cast<std::int64_t>(calls_per_tick)) {
        l.next = l.current;
        return begin_hold(1);
    }
    l.returns[static_cast<std::size_t>(l.depth++)] = l.next;
    l.next = position;
}

void Engine::come_back() {
    Lists& l = state_.lists;
    if (l.depth == 0) return begin_hold(1);
    l.next = l.returns[static_cast<std::size_t>(--l.depth)];
}

/// `cause`: bit of the start and stop info.
void Engine::stop(std::uint32_t cause) {
    State& s = state_;
    Lists& l = s.lists;
    l.running = l.depth = l.paused = l.skip = l.again = l.marking = l.moving_alone = l.auto_change = l.loop = 0;
    s.activity = {};
    leave_fly();
    s.starts.waiting = s.starts.triggers = s.starts.asked_count = 0;
    s.starts.queue = s.starts.asked = {};
    laser_.switch_off();
    s.recording.period = 0;
    l.loaded |= list_status_bit("USED1") | list_status_bit("USED2");
    flags_.raise_startstop(cause);
}

void Engine::pause_list() {
    Lists& l = state_.lists;
    if (!l.running || l.paused) return;
    l.paused = 1;
    l.paused_laser = l.marking;
    if (l.marking) laser_.switch_now(false);
}

void Engine::restart_list() {
    Lists& l = state_.lists;
    if (!l.paused) return;
    l.paused = 0;
    if (l.paused_laser) laser_.switch_now(true);
}

Result<void> Engine::goto_xy(double x, double y) {
    if (state_.lists.running || state_.activity.kind != ActivityKind::none)
        return fail(ErrorKind::refused,
                    "goto_xy: a list is running, or the card moves. Nothing was moved. Wait until it is not busy");
    MOTIONRACK_TRY(const Command jump, list_command(Op::jump_abs, {x, y}));
    jump_to({jump.p[0], jump.p[1]});
    state_.lists.moving_alone = 1;
    return {};
}

}  // namespace motionrack::rtc5
