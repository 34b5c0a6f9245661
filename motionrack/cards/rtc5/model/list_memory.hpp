// Memory of the lists: list 1, list 2, and list 3 with the subroutines; the input pointer gives the next command's
// position.
#pragma once

#include <cstdint>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <motionrack/cards/rtc5/model/zeroed_array.hpp>
#include <span>

namespace motionrack::rtc5 {

class ListMemory {
  public:
    /// `lists` and `memory_hash`: parts of the card's state, which must outlive this.
    ListMemory(Lists& lists, std::uint64_t& memory_hash, const Settings& settings)
        : lists_(lists),
          memory_hash_(memory_hash),
          settings_(settings),
          commands_(static_cast<std::size_t>(settings.list_memory)) {
        static_assert(static_cast<int>(Op::none) == 0);  // zeros are empty positions
    }

    const Command& operator[](std::int64_t position) const { return commands_[static_cast<std::size_t>(position)]; }
    std::span<Command> commands() { return commands_.span(); }
    /// Makes all positions empty.
    void clear();

    /// Sets the sizes of list 1 and list 2 in positions; `list2` -1: the remaining memory.
    Result<void> configure(std::int64_t list1, std::int64_t list2);
    Result<void> set_start_list(std::uint32_t list, std::int64_t position = 0);
    /// Opens a list that is not running, as set_start_list() does: list 1, 2, a free one (0), or a free one that ran to
    /// its end (3). Returns the opened list; 0: none, and put() is refused until a list is opened.
    Result<std::uint32_t> load_list(std::uint32_t list, std::int64_t position);
    /// Stores the commands up to list_return as subroutine `index` (0 .. 1023) in list 3; without commands the
    /// subroutine is deleted.
    Result<void> load_sub(std::uint32_t index);
    Result<void> put(const Command& command);
    /// Returns the memory position of `position` in list 1 (odd numbers) or 2 (even numbers).
    Result<std::int64_t> find_position(std::uint32_t list, std::int64_t position) const;
    /// Returns the answer of read_status, whose bits map::list_status_bits names.
    std::uint32_t status() const;

  private:
    void open(std::int64_t input, std::int64_t end);

    Lists& lists_;
    std::uint64_t& memory_hash_;
    const Settings& settings_;
    ZeroedArray<Command> commands_;
};

}  // namespace motionrack::rtc5
