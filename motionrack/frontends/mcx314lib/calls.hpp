// Runs every function of mcx314lib.h: one at a time, on the selected chip; errors as sentences, no exception out.
#pragma once

#include <motionrack/frontends/calls/calls.hpp>
#include <motionrack/frontends/mcx314lib/chip_table.hpp>
#include <string_view>

namespace motionrack::mcx314lib {

calls::Process<ChipTable>& process();

/// Stores the sentence for this thread, prefixed with the function's name, and calls the handler. Requires the lock to
/// be free.
void failed(const char* who, std::string_view sentence) noexcept;

/// Runs `call` with the bench; `call` returns a Result<Value>.
template <class Value, class Call>
Value with_bench(const char* who, Value otherwise, Call call) noexcept {
    return calls::guarded([&]() -> Result<Value> { return process().alone(call); },
                          [&](ErrorKind, std::string_view sentence) { return failed(who, sentence), otherwise; });
}

/// Runs `call` with the selected chip; `call` returns a Result<Value>.
template <class Value, class Call>
Value with_chip(const char* who, Value otherwise, Call call) noexcept {
    return with_bench(who, otherwise, [&](ChipTable& bench) -> Result<Value> {
        MOTIONRACK_TRY(OpenChip * chip, bench.selected());
        MOTIONRACK_CHECK(bench.pass(*chip, Duration{0}));  // polls manual operations; refused at the end of time
        Result<Value> answer = call(*chip);
        MOTIONRACK_CHECK(chip->check_live());
        return answer;
    });
}

/// Runs `call`, a Result<void>, with the selected chip. Returns 0, or -1 on an error.
template <class Call>
int done(const char* who, Call call) noexcept {
    return with_chip(who, -1, [&](OpenChip& chip) -> Result<int> {
        MOTIONRACK_CHECK(call(chip));
        return 0;
    });
}

/// Converts an axis mask of the library; channel_of converts one axis to a channel, 0 X .. 3 U.
Result<unsigned> mask_of(int axis);
Result<int> channel_of(int axis);
/// Converts a WR1 word for homing.
Result<unsigned> mode_word(int word);
using calls::check_pointer;

/// As above with an axis mask: `call` receives the chip and the mask.
template <class Call>
int on_axes(const char* who, int axis, Call call) noexcept {
    return done(who, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_TRY(const unsigned axes, mask_of(axis));
        return call(chip, axes);
    });
}

}  // namespace motionrack::mcx314lib
