// Executes the functions of rtc5sim.h: one at a time, each on its card. Errors become sentences and error bits of the
// board; no exception leaves a function.
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

inline constexpr std::int64_t us_per_tick = 10;  ///< duration of a tick of the cards

/// Encoder of a conveyor with a constant count rate, read by the board's counters.
class Belt final : public rtc5::Inputs {
  public:
    /// Sets the rate: from `tick` on, the encoder counts from `count` at this rate.
    void set(std::size_t encoder, std::int64_t tick, std::int64_t count, double counts_per_s) {
        lines_[encoder] = {tick, count, counts_per_s};
    }
    double speed(std::size_t encoder) const { return lines_[encoder].counts_per_s; }
    bool moves() const { return lines_[0].counts_per_s != 0 || lines_[1].counts_per_s != 0; }
    std::int64_t count(std::size_t encoder, std::int64_t tick) const;
    void counts(int encoder, std::int64_t first, std::span<std::int32_t> out) override;

  private:
    struct SpeedLine {
        std::int64_t tick = 0, count = 0;
        double counts_per_s = 0;
    };
    std::array<SpeedLine, rtc5::encoder_count> lines_;
};

struct Card {
    /// Makes a stand-alone card.
    explicit Card(UINT n) : number(n), own(std::make_unique<rtc5::Engine>()), engine(*own) {}
    /// Makes a card of a rack.
    Card(UINT n, rtc5::Card& card) : number(n), wired(&card), engine(card.engine()) {}

    UINT number = 0;  ///< from 1
    std::unique_ptr<rtc5::Engine> own;
    rtc5::Card* wired = nullptr;  ///< nullptr: the card has no wires
    rtc5::Engine& engine;
    Belt belt;
    UINT errors = 0, last_error = 0;  ///< error bits of the board
};

/// Cards of the process, which share one time.
class CardTable {
  public:
    /// Returns a card. The first use creates as many cards as RTC5SIM_CARDS gives, else 1.
    Result<Card*> card(UINT number);
    Result<UINT> count();
    Result<void> select(UINT number);
    UINT selected = 1;
    std::int64_t question_ticks = 1;  ///< duration of a query at the card, ticks

    /// Runs all cards for `ticks` and passes their samples to the handler.
    Result<void> pass(std::int64_t ticks);
    /// Runs until all cards are idle; false if they are not within `ticks`.
    Result<bool> run_to_rest(std::int64_t ticks);
    Result<std::int64_t> tick();
    /// Closes the cards; the next use creates new ones.
    void close();
    /// Replaces the cards by those of type rtc5 in this rack (its file or text), in the order of the file.
    Result<void> open_rack(std::string_view path_or_text);
    Result<rack::Session*> rack();

    rtc5sim_samples_handler samples = nullptr;
    void* samples_user = nullptr;

  private:
    Result<void> open();
    Result<void> pass_rack(std::int64_t ticks);
    std::unique_ptr<rack::Session> rack_;  ///< nullptr: stand-alone cards
    std::vector<std::unique_ptr<Card>> cards_;
};

calls::Process<CardTable>& process();

/// True while this thread runs a samples handler, in which library functions are refused.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
extern thread_local bool inside_handler;

/// Stores the sentence for this thread, prefixed with the function's name, and calls the handler. Requires the lock to
/// be free.
void failed(std::string_view who, std::string_view sentence) noexcept;

/// Returns the number of the card that functions without n_ use.
UINT selected() noexcept;

/// Runs `call` with the bench; `call` returns a Result<Value>.
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

/// Runs `call` with a card; `call` returns a Result<Value>. The card stores the error bits. A query first lets time
/// pass.
template <class Value, class Call>
Value with_card(std::string_view who, UINT number, Value otherwise, Call call, bool asks = false) noexcept {
    return with_bench(who, otherwise, [&](CardTable& bench) -> Result<Value> {
        MOTIONRACK_TRY(Card * card, bench.card(number));
        if (asks) MOTIONRACK_CHECK(bench.pass(bench.question_ticks));
        Result<Value> result = call(*card);
        card->last_error = result ? 0 : rtc5::error_bits_of(result.error().kind);
        card->errors |= card->last_error;
        return result;
    });
}

/// Runs `call` with a card, as with_card(), for functions without a return value: `call` returns a Result<void>.
template <class Call>
void command(std::string_view who, UINT number, Call call) noexcept {
    with_card(who, number, false, [&](Card& card) -> Result<bool> {
        MOTIONRACK_CHECK(call(card));
        return true;
    });
}

/// Returns the part of the engine that a command belongs to, or the engine itself.
template <class Part>
Part& part_of(rtc5::Engine& engine) {
    if constexpr (std::is_same_v<Part, rtc5::ListMemory>)
        return engine.parts().lists;
    else if constexpr (std::is_same_v<Part, rtc5::ListExecution>)
        return engine.parts().execution;
    else if constexpr (std::is_same_v<Part, rtc5::BeltEncoders>)
        return engine.parts().encoders;
    else if constexpr (std::is_same_v<Part, rtc5::ExternalStarts>)
        return engine.parts().starts;
    else if constexpr (std::is_same_v<Part, rtc5::LaserControl>)
        return engine.parts().laser;
    else if constexpr (std::is_same_v<Part, rtc5::FlyCorrection>)
        return engine.parts().fly;
    else if constexpr (std::is_same_v<Part, rtc5::HeadTransforms>)
        return engine.parts().heads;
    else if constexpr (std::is_same_v<Part, rtc5::SignalRecorder>)
        return engine.parts().recorder;
    else
        return engine;
}

/// Executes a command that is one call of the card's engine, or of a part of it.
template <class Part, class Answer, class... Declared, class... Parameters>
void call(std::string_view who, UINT number, Answer (Part::*member)(Declared...), Parameters... parameters) noexcept {
    command(who, number, [&](Card& card) -> Result<void> {
        if constexpr (std::is_void_v<Answer>) {
            std::invoke(member, part_of<Part>(card.engine), parameters...);
            return {};
        } else {
            return std::invoke(member, part_of<Part>(card.engine), parameters...);
        }
    });
}

/// Runs a query `call` with a card, as with_card(): time advances first by `question_ticks`. `call` returns a
/// Result<Value>.
template <class Value, class Call>
Value question(std::string_view who, UINT number, Value otherwise, Call call) noexcept {
    return with_card(who, number, otherwise, call, true);
}

void put_list(UINT number, rtc5::Op op, std::span<const double> parameters) noexcept;

/// Appends a list command; the engine checks its parameters.
template <class... Parameters>
void put(UINT number, rtc5::Op op, Parameters... parameters) noexcept {
    const std::array<double, sizeof...(parameters)> all{static_cast<double>(parameters)...};
    put_list(number, op, all);
}

/// Checks that the list command of the same meaning would accept these parameters.
Result<void> checked(rtc5::Op op, double parameter);

inline rtc5::Point point(long x, long y) {
    return {static_cast<double>(x), static_cast<double>(y)};
}
/// Converts a number to a 32-bit integer. Errors: refused if it does not fit.
Result<std::int32_t> whole32(std::string_view what, long value);
using calls::check_pointer;
/// Converts a number to the engine's int; a number above 1,000,000 becomes 1,000,000, which the engine rejects.
int small(UINT value);

/// Converts the error of `result` to the board's error kind `trouble`.
template <class Value>
Result<Value> as(ErrorKind trouble, Result<Value> result) {
    if (!result) result.error().kind = trouble;
    return result;
}

}  // namespace motionrack::rtc5sim
