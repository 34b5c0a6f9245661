// Lists: their memory, loading, beginning and ending them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

Result<void> check(const Settings& s) {
    if (s.list_memory < 16 || s.list_memory > greatest_list_memory)
        return fail(Trouble::refused, fmt::format("a list memory of {} positions: 16 to {} are possible", s.list_memory,
                                                  greatest_list_memory));
    if (s.list1 < 1 || s.list2 < 0 || s.list1 + s.list2 > s.list_memory)
        return fail(Trouble::refused, fmt::format("lists of {} and {} positions do not fit a memory of {}", s.list1,
                                                  s.list2, s.list_memory));
    return {};
}

Result<void> Engine::config_list(std::int64_t list1, std::int64_t list2) {
    if (state_.lists.running)
        return fail(Trouble::refused,
                    "config_list: a list is running; the memory was left as it is. Stop the list first");
    Settings changed = settings_;
    changed.list1 = list1, changed.list2 = list2;
    MOTIONRACK_CHECK(check(changed));
    state_.lists.begin = {0, list1, list1 + list2, settings_.list_memory};
    state_.lists.input = 0;
    state_.lists.input_end = list1;
    return {};
}

Result<void> Engine::set_start_list(int list) {
    if (list < 1 || list > 3)
        return fail(Trouble::refused, fmt::format("set_start_list: there is no list {}; 1, 2 or 3", list));
    Lists& l = state_.lists;
    const auto number = static_cast<std::size_t>(list);
    if (l.running && l.next > l.begin[number - 1] && l.next <= l.begin[number])
        return fail(
            Trouble::refused,
            fmt::format("set_start_list: list {} is running; nothing was changed. Load the other list, or wait", list));
    l.input = l.begin[number - 1];
    l.input_end = l.begin[number];
    return {};
}

Result<void> Engine::put(const Command& command) {
    Lists& l = state_.lists;
    const ListCommandInfo& what = info(command.op);
    if (l.input + what.positions > l.input_end)
        return fail(Trouble::refused, fmt::format("{}: the list is full at position {}; the command was not put into "
                                                  "it. Split the job over two lists (auto_change), or give "
                                                  "the list more memory (config_list)",
                                                  what.name, l.input));
    memory_[static_cast<std::size_t>(l.input)] = command;
    for (int i = 1; i < what.positions; ++i) memory_[static_cast<std::size_t>(l.input + i)] = {};
    l.input += what.positions;
    return {};
}

Result<void> Engine::execute_list(int list) {
    if (list < 1 || list > 2)
        return fail(Trouble::refused, fmt::format("execute_list: there is no list {}; 1 or 2", list));
    return execute_at(state_.lists.begin[static_cast<std::size_t>(list - 1)]);
}

Result<void> Engine::execute_at(std::int64_t position) {
    Lists& l = state_.lists;
    if (l.running || l.moving_alone)
        return fail(
            Trouble::refused,
            "execute_list: a list is running, or the card moves; nothing was started. Wait until it is not busy");
    if (position < 0 || position >= l.begin[3])
        return fail(Trouble::refused,
                    fmt::format("execute_at_pointer: position {} is outside 0 to {}; nothing was started", position,
                                l.begin[3] - 1));
    l.running = 1;
    l.next = l.current = position;
    return {};
}

/// The list that runs is over; the other one may follow.
void Engine::end_list(bool written, std::int64_t tick) {
    Lists& l = state_.lists;
    l.skip = 0;
    if (!written) ++l.ended_unwritten;
    const std::int64_t at = l.current;
    // Lists that take no time would follow each other for ever: once a tick is enough.
    if (written && (l.auto_change || l.loop) && at < l.begin[2] && l.changed_at != tick) {
        l.auto_change = 0;
        l.changed_at = tick;
        l.next = at < l.begin[1] ? l.begin[1] : l.begin[0];
        return;
    }
    l.running = 0;
}

void Engine::stop_execution() {
    State& s = state_;
    Lists& l = s.lists;
    l.running = l.paused = l.skip = l.again = l.marking = l.moving_alone = l.auto_change = l.loop = 0;
    s.activity = {};
    leave_fly();
    s.starts.waiting = s.starts.triggers = s.starts.asked_count = 0;
    s.starts.queue = s.starts.asked = {};
    filled_ = s.tick;
    s.laser.count = 0;
    switch_laser(s.tick * half_us_per_tick, false, s.tick);
}

void Engine::pause_list() {
    Lists& l = state_.lists;
    if (!l.running || l.paused) return;
    l.paused = 1;
    l.paused_laser = l.marking;
    filled_ = state_.tick;
    if (l.marking) switch_laser(state_.tick * half_us_per_tick, false, state_.tick);
}

void Engine::restart_list() {
    Lists& l = state_.lists;
    if (!l.paused) return;
    l.paused = 0;
    filled_ = state_.tick;
    if (l.paused_laser) switch_laser(state_.tick * half_us_per_tick, true, state_.tick);
}

Result<void> Engine::goto_xy(double x, double y) {
    if (state_.lists.running || state_.activity.kind != ActivityKind::none)
        return fail(Trouble::refused,
                    "goto_xy: a list is running, or the card moves; nothing was moved. Wait until it is not busy");
    MOTIONRACK_TRY(const Command jump, list_command(Op::jump_abs, {x, y}));
    jump_to({jump.p[0], jump.p[1]});
    state_.lists.moving_alone = 1;
    return {};
}

}  // namespace motionrack::rtc5
