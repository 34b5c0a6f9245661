// How every function of mcx314lib.h runs: one at a time, on the selected chip; an error becomes a sentence, nothing is
// thrown out.
#pragma once

#include <motionrack/frontends/calls/calls.hpp>
#include <motionrack/frontends/mcx314lib/chip_table.hpp>
#include <string_view>

namespace motionrack::mcx314lib {

calls::Process<Bench>& process();

/// Keeps the sentence for this thread, with the function's name in front, and calls the handler. The lock must be free.
void failed(const char* who, std::string_view sentence) noexcept;

/// Runs `call` with the bench; it gives a Result<Value>.
template <class Value, class Call>
Value with_bench(const char* who, Value otherwise, Call call) noexcept {
    return calls::guarded([&]() -> Result<Value> { return process().alone(call); },
                          [&](ErrorKind, std::string_view sentence) { return failed(who, sentence), otherwise; });
}

/// Runs `call` with the selected chip; it gives a Result<Value>.
template <class Value, class Call>
Value with_chip(const char* who, Value otherwise, Call call) noexcept {
    return with_bench(who, otherwise, [&](Bench& bench) -> Result<Value> {
        MOTIONRACK_TRY(Chip * chip, bench.selected());
        MOTIONRACK_CHECK(bench.pass(*chip, Duration{0}));  // manual operations look; refused at the end of time
        Result<Value> answer = call(*chip);
        MOTIONRACK_CHECK(chip->check_live());
        return answer;
    });
}

/// Runs `call` with the selected chip; it gives a Result<void>. 0, or -1 where it failed.
template <class Call>
int done(const char* who, Call call) noexcept {
    return with_chip(who, -1, [&](Chip& chip) -> Result<int> {
        MOTIONRACK_CHECK(call(chip));
        return 0;
    });
}

/// An axis mask as the library takes it; channel_of: of one axis, as a channel 0 X .. 3 U.
Result<unsigned> mask_of(int axis);
Result<int> channel_of(int axis);
/// WR1 as homing takes it.
Result<unsigned> mode_word(int word);
using calls::check_pointer;

/// The same with an axis mask: `call` takes the chip and the mask.
template <class Call>
int on_axes(const char* who, int axis, Call call) noexcept {
    return done(who, [&](Chip& chip) -> Result<void> {
        MOTIONRACK_TRY(const unsigned axes, mask_of(axis));
        return call(chip, axes);
    });
}

}  // namespace motionrack::mcx314lib
