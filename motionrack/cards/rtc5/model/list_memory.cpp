// Loads lists.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <motionrack/cards/rtc5/model/list_memory.hpp>

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

Result<void> ListMemory::configure(std::int64_t list1, std::int64_t list2) {
    if (lists_.running)
        return fail(ErrorKind::refused,
                    "config_list: a list is running. The memory was not changed. Stop the list first");
    const std::int64_t rest = settings_.list_memory - std::clamp<std::int64_t>(list1, 0, settings_.list_memory);
    Settings changed = settings_;
    changed.list1 = list1, changed.list2 = list2 == -1 ? rest : list2;
    MOTIONRACK_CHECK(check(changed));
    lists_.begin = {0, list1, list1 + changed.list2, settings_.list_memory};
    lists_.subroutines = {};
    lists_.list3_used = 0;
    return set_start_list(1);
}

namespace {

Result<void> check_position(std::int64_t position) {
    if (position >= 0 && position < max_list_memory) return {};
    return fail(ErrorKind::refused, fmt::format("the list position is {}; it must be 0 to {}. Nothing was changed",
                                                position, max_list_memory - 1));
}

/// Returns the hash of a command at its position; 0 for an empty position.
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

/// Stores a command. The hash of the memory is the sum of the hashes of its positions, so a new command costs two
/// hashes instead of one over 42 MB.
void store(std::span<Command> memory, std::uint64_t& memory_hash, std::int64_t position, const Command& command) {
    Command& stored = memory[static_cast<std::size_t>(position)];
    memory_hash += hash_at(position, command) - hash_at(position, stored);
    stored = command;
}

/// Returns index 0 for list 1 (odd numbers), 1 for list 2 (even numbers); 0 if list 2 has no memory.
std::size_t list_of(std::uint32_t number, const Lists& l) {
    return number % 2 == 0 && l.begin[2] > l.begin[1] ? 1 : 0;
}
/// Returns the memory position of `position` in the list with index `list`.
std::int64_t place(std::size_t list, std::int64_t position, const Lists& l) {
    const std::int64_t begin = l.begin[list];
    return position < l.begin[list + 1] - begin ? begin + position : begin;
}

}  // namespace

Result<void> ListMemory::set_start_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_CHECK(check_position(position));
    Lists& l = lists_;
    const std::size_t number = list_of(list, l);
    open(place(number, position, l), l.begin[number + 1]);
    l.loaded &= ~(std::int64_t{list_status_bit("READY1") | list_status_bit("USED1")} << number);
    l.loaded |= std::int64_t{list_status_bit("LOAD1")} << number;
    return {};
}

void ListMemory::open(std::int64_t input, std::int64_t end) {
    Lists& l = lists_;
    l.input = input, l.input_end = end;
    l.loading = 0;
    l.loaded &= ~std::int64_t{list_status_bit("LOAD1") | list_status_bit("LOAD2")};
}

Result<void> ListMemory::load_sub(std::uint32_t index) {
    Lists& l = lists_;
    if (index >= subroutine_count)
        return fail(ErrorKind::refused, fmt::format("load_sub: subroutine {} must be 0 to {}. Nothing was changed",
                                                    index, subroutine_count - 1));
    open(l.begin[2] + l.list3_used, l.begin[3]);
    l.loading = index + 1;
    return {};
}

Result<std::uint32_t> ListMemory::load_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_CHECK(check_position(position));
    Lists& l = lists_;
    const std::uint32_t status = this->status();
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

Result<void> ListMemory::put(const Command& command) {
    Lists& l = lists_;
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
    store(commands_.span(), memory_hash_, l.input, command);
    for (int i = 1; i < what.positions; ++i) store(commands_.span(), memory_hash_, l.input + i, {});
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

void ListMemory::clear() {
    std::ranges::fill(commands_.span(), Command{});
}

Result<std::int64_t> ListMemory::find_position(std::uint32_t list, std::int64_t position) const {
    MOTIONRACK_CHECK(check_position(position));
    return place(list_of(list, lists_), position, lists_);
}

std::uint32_t ListMemory::status() const {
    const Lists& l = lists_;
    const std::uint32_t busy = l.running ? list_status_bit("BUSY1") << (l.current < l.begin[1] ? 0 : 1) : 0;
    return static_cast<std::uint32_t>(l.loaded) | busy;
}

}  // namespace motionrack::rtc5
