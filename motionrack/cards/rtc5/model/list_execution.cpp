// Starts, ends and calls lists.
#include <fmt/format.h>

#include <motionrack/cards/rtc5/model/list_execution.hpp>

namespace motionrack::rtc5 {

std::uint32_t ListExecution::status() const {
    const Lists& l = lists_;
    return (l.running ? status_bit("BUSY") : 0) | (l.moving_alone ? status_bit("INTERNAL_BUSY") : 0) |
           (l.paused ? status_bit("PAUSED") : 0);
}

Result<void> ListExecution::execute_at(std::int64_t position) {
    const Lists& l = lists_;
    if (is_busy())
        return fail(
            ErrorKind::refused,
            "execute_list: a list is running, or the card moves. Nothing was started. Wait until it is not busy");
    if (position < 0 || position >= l.begin[3])
        return fail(ErrorKind::refused,
                    fmt::format("execute_at_pointer: the position is {}; it must be 0 to {}. Nothing was started",
                                position, l.begin[3] - 1));
    begin(position, startstop_bit("INTERNAL_START"));
    return {};
}

void ListExecution::begin(std::int64_t position, std::uint32_t cause) {
    lists_.running = 1;
    lists_.depth = 0;
    lists_.next = lists_.current = position;
    flags_.raise_startstop(cause);
}

void ListExecution::end(bool written, std::int64_t tick) {
    Lists& l = lists_;
    l.skip = 0;
    l.depth = 0;
    if (!written) ++l.ended_unwritten;
    const std::int64_t at = l.current;
    l.loaded |= std::int64_t{list_status_bit("USED1")} << (at < l.begin[1] ? 0 : 1);
    // Allows one change of lists per tick: lists that take no time would otherwise follow each other without end.
    if (written && (l.auto_change || l.loop) && at < l.begin[2] && l.changed_at != tick) {
        l.auto_change = 0;
        l.changed_at = tick;
        l.next = at < l.begin[1] ? l.begin[1] : l.begin[0];
        return;
    }
    l.running = 0;
    if (connections_.listener != nullptr) connections_.listener->ended(tick);
}

bool ListExecution::call(std::int64_t position, std::int64_t tick) {
    Lists& l = lists_;
    if (position < 0 || position == l.current || l.depth == static_cast<std::int64_t>(max_depth)) return false;
    if (l.called_at != tick) l.calls = 0;
    l.called_at = tick;
    // Limits the calls per tick: calls that take no time could follow each other without end.
    if (++l.calls > static_cast<std::int64_t>(calls_per_tick)) {
        l.next = l.current;
        return false;
    }
    l.returns[static_cast<std::size_t>(l.depth++)] = l.next;
    l.next = position;
    return true;
}

std::int64_t ListExecution::subroutine(std::int64_t index) const {
    const std::int64_t begin = lists_.subroutines[static_cast<std::size_t>(index)];
    return begin == 0 ? -1 : begin;
}

bool ListExecution::come_back() {
    Lists& l = lists_;
    if (l.depth == 0) return false;
    l.next = l.returns[static_cast<std::size_t>(--l.depth)];
    return true;
}

void ListExecution::stop() {
    Lists& l = lists_;
    l.running = l.depth = l.paused = l.skip = l.again = l.marking = l.moving_alone = l.auto_change = l.loop = 0;
    l.loaded |= list_status_bit("USED1") | list_status_bit("USED2");
}

bool ListExecution::pause() {
    Lists& l = lists_;
    if (!l.running || l.paused) return false;
    l.paused = 1;
    l.paused_laser = l.marking;
    return l.marking != 0;
}

bool ListExecution::restart() {
    Lists& l = lists_;
    if (!l.paused) return false;
    l.paused = 0;
    return l.paused_laser != 0;
}

}  // namespace motionrack::rtc5
