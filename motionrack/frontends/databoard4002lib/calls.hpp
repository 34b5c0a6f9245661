// Runs every function of databoard4002lib.h: one at a time for a card; errors as sentences, no exception out.
#pragma once

#include <motionrack/frontends/calls/calls.hpp>
#include <motionrack/frontends/databoard4002lib/card_table.hpp>
#include <string_view>

namespace motionrack::databoard4002lib {

calls::Process<DataboardTable>& process();

/// Stores the sentence for this thread, prefixed with the function's name. Requires the lock to be free.
void failed(const char* who, std::string_view sentence) noexcept;

/// Runs `call`, which returns a Result<Value>. On an error returns -1.
template <class Value, class Call>
Value run(const char* who, Call call) noexcept {
    return calls::guarded([&]() -> Result<Value> { return call(); },
                          [&](ErrorKind, std::string_view sentence) { return failed(who, sentence), Value{-1}; });
}

/// The open card with this handle. Errors: invalid_input, as DataboardTable::find.
inline Result<std::shared_ptr<OpenDataboard>> find_card(int card) {
    return process().alone([card](DataboardTable& table) { return table.find(card); });
}

/// Runs `call`, which returns a Result<Value>, with an open card and its bus. On an error returns -1.
template <class Value, class Call>
Value value_of_card(const char* who, int card, Call call) noexcept {
    return run<Value>(who, [&]() -> Result<Value> {
        MOTIONRACK_TRY(const std::shared_ptr<OpenDataboard> board, find_card(card));
        const std::lock_guard<std::mutex> alone(board->calls());
        MOTIONRACK_CHECK(find_card(card));  // another thread may have closed it
        const std::lock_guard<TurnLock> accesses(board->shared_bus()->accesses);
        MOTIONRACK_CHECK(board->check_live());
        return call(*board);
    });
}

/// As above for a Result<void>. Returns 0, or -1 on an error.
template <class Call>
int with_card(const char* who, int card, Call call) noexcept {
    return value_of_card<int>(who, card, [&](OpenDataboard& board) -> Result<int> {
        MOTIONRACK_CHECK(call(board));
        return 0;
    });
}

}  // namespace motionrack::databoard4002lib
