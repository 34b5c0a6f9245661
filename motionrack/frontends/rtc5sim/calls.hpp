// How every function of rtc5sim.h runs: one at a time, on its card; an error becomes a sentence and the board's bits,
// nothing is thrown out.
#pragma once

#include <rtc5sim.h>

#include <array>
#include <functional>
#include <memory>
#include <motionrack/cards/rtc5/model/card.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/frontends/calls/calls.hpp>
#include <motionrack/rack/session.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace motionrack::rtc5sim {

/// A belt's encoder: counts that go on evenly. The board's counters see them.
class Belt final : public rtc5::Inputs {
  public:
    /// From `tick` on the line counts on from `count` with this speed.
    void set(std::size_t encoder, std::int64_t tick, std::int64_t count, double counts_per_s) {
        lines_[encoder] = {tick, count, counts_per_s};
    }
    double speed(std::size_t encoder) const { return lines_[encoder].counts_per_s; }
    bool moves() const { return lines_[0].counts_per_s != 0 || lines_[1].counts_per_s != 0; }
    std::int64_t count(std::size_t encoder, std::int64_t tick) const;
    void counts(int encoder, std::int64_t first, std::span<std::int32_t> out) override;

  private:
    struct Line {
        std::int64_t tick = 0, count = 0;
        double counts_per_s = 0;
    };
    std::array<Line, rtc5::encoder_count> lines_;
};

struct Card {
    /// A card by itself.
    explicit Card(UINT n) : number(n), own(std::make_unique<rtc5::Engine>()), engine(*own) {}
    /// A card of a rack.
    Card(UINT n, rtc5::Card& card) : number(n), wired(&card), engine(card.engine()) {}

    UINT number = 0;  ///< from 1
    std::unique_ptr<rtc5::Engine> own;
    rtc5::Card* wired = nullptr;  ///< nullptr: it has no wires
    rtc5::Engine& engine;
    Belt belt;
    UINT errors = 0, last_error = 0;  ///< the board's bits
};

/// The cards of the process. Time is one for all of them.
class Bench {
  public:
    /// The cards: as many as RTC5SIM_CARDS says when they are first used, else 1.
    Result<Card*> card(UINT number);
    Result<UINT> count();
    Result<void> select(UINT number);
    UINT selected = 1;
    std::int64_t question_ticks = 1;  ///< what an answer of the card takes

    /// Runs all cards so many ticks, and hands their samples to the handler.
    Result<void> pass(std::int64_t ticks);
    /// Until all cards rest; false: they did not in so many ticks.
    Result<bool> run_to_rest(std::int64_t ticks);
    Result<std::int64_t> tick();
    /// The cards end; the next use makes others.
    void close();
    /// The cards end, and those of type rtc5 of this rack (its file or text) take their places, in the file's order.
    Result<void> open_rack(std::string_view path_or_text);
    Result<rack::Session*> rack();

    rtc5sim_samples_handler samples = nullptr;
    void* samples_user = nullptr;

  private:
    Result<void> open();
    Result<void> pass_rack(std::int64_t ticks);
    std::unique_ptr<rack::Session> rack_;  ///< nullptr: the cards are by themselves
    std::vector<std::unique_ptr<Card>> cards_;
};

calls::Process<Bench>& process();

/// This thread is in a samples handler: functions of the library are refused there.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
extern thread_local bool inside_handler;

/// Keeps the sentence for this thread, with the function's name in front, and calls the handler. The lock must be free.
void failed(std::string_view who, std::string_view sentence) noexcept;

/// The card of functions without n_.
UINT selected() noexcept;

/// Runs `call` with the bench; it gives a Result<Value>.
template <class Value, class Call>
Value with_bench(std::string_view who, Value otherwise, Call call) noexcept {
    return calls::guarded(
        [&]() -> Result<Value> {
            if (inside_handler)
                return fail(ErrorKind::refused,
                            "it was called by the samples handler, while the cards run. Nothing was "
                            "done; call it after them.");
            return process().alone(call);
        },
        [&](ErrorKind, std::string_view sentence) { return failed(who, sentence), otherwise; });
}

/// Runs `call` with a card; it gives a Result<Value>. The card keeps the error's bits. One that asks takes time before.
template <class Value, class Call>
Value with_card(std::string_view who, UINT number, Value otherwise, Call call, bool asks = false) noexcept {
    return with_bench(who, otherwise, [&](Bench& bench) -> Result<Value> {
        MOTIONRACK_TRY(Card * card, bench.card(number));
        if (asks) MOTIONRACK_CHECK(bench.pass(bench.question_ticks));
        Result<Value> result = call(*card);
        card->last_error = result ? 0 : rtc5::error_bits_of(result.error().kind);
        card->errors |= card->last_error;
        return result;
    });
}

/// The same for what has no answer: `call` gives a Result<void>.
template <class Call>
void command(std::string_view who, UINT number, Call call) noexcept {
    with_card(who, number, false, [&](Card& card) -> Result<bool> {
        MOTIONRACK_CHECK(call(card));
        return true;
    });
}

/// A command that is one call of the card's engine.
template <class Member, class... Parameters>
void call(std::string_view who, UINT number, Member member, Parameters... parameters) noexcept {
    command(who, number, [&](Card& card) -> Result<void> {
        if constexpr (std::is_void_v<std::invoke_result_t<Member, rtc5::Engine&, Parameters...>>) {
            std::invoke(member, card.engine, parameters...);
            return {};
        } else {
            return std::invoke(member, card.engine, parameters...);
        }
    });
}

/// The same for a question: it takes its time first, in which the cards go on. `call` gives a Result<Value>.
template <class Value, class Call>
Value question(std::string_view who, UINT number, Value otherwise, Call call) noexcept {
    return with_card(who, number, otherwise, call, true);
}

void put_list(UINT number, rtc5::Op op, std::span<const double> parameters) noexcept;

/// Puts a list command; the engine looks its parameters through.
template <class... Parameters>
void put(UINT number, rtc5::Op op, Parameters... parameters) noexcept {
    const std::array<double, sizeof...(parameters)> all{static_cast<double>(parameters)...};
    put_list(number, op, all);
}

/// Whether the list command of the same meaning would take these parameters.
Result<void> checked(rtc5::Op op, double parameter);

inline rtc5::Point point(long x, long y) {
    return {static_cast<double>(x), static_cast<double>(y)};
}
/// A whole number of 32 bits.
Result<std::int32_t> whole32(std::string_view what, long value);
using calls::check_pointer;
/// A whole number that the engine takes as int; what is greater is refused by it.
int small(UINT value);

/// The error of `result` as one of the board's kind `trouble`.
template <class Value>
Result<Value> as(ErrorKind trouble, Result<Value> result) {
    if (!result) result.error().kind = trouble;
    return result;
}

}  // namespace motionrack::rtc5sim
