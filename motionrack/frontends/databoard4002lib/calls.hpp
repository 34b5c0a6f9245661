// Runs every function of databoard4002lib.h: one at a time; errors as sentences, no exception out.
#pragma once

#include <motionrack/frontends/calls/calls.hpp>
#include <motionrack/frontends/databoard4002lib/card_table.hpp>
#include <string_view>

namespace motionrack::databoard4002lib {

calls::Process<DataboardTable>& process();

/// Stores the sentence for this thread, prefixed with the function's name. Requires the lock to be free.
void failed(const char* who, std::string_view sentence) noexcept;

/// Runs `call` with the table; `call` returns a Result<Value>. On an error returns -1.
template <class Value, class Call>
Value with_table(const char* who, Call call) noexcept {
    return calls::guarded([&]() -> Result<Value> { return process().alone(call); },
                          [&](ErrorKind, std::string_view sentence) { return failed(who, sentence), Value{-1}; });
}

/// Runs `call`, a Result<void>, with an open card. Returns 0, or -1 on an error.
template <class Call>
int with_card(const char* who, int card, Call call) noexcept {
    return with_table<int>(who, [&](DataboardTable& table) -> Result<int> {
        MOTIONRACK_TRY(OpenDataboard * board, table.find(card));
        MOTIONRACK_CHECK(board->check_live());
        MOTIONRACK_CHECK(call(*board));
        return 0;
    });
}

}  // namespace motionrack::databoard4002lib
