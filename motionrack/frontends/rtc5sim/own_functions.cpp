// Additional functions: time, inputs and outputs of a card.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::ErrorKind;
using motionrack::fail;
using motionrack::Result;
namespace rtc5 = motionrack::rtc5;

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
thread_local std::string info_text, note_text;

Result<std::int64_t> ticks_of(std::int64_t us, std::int64_t max_us) {
    if (us >= 0 && us <= max_us && us % us_per_tick == 0) return us / us_per_tick;
    return fail(ErrorKind::refused,
                fmt::format("the time is {} us; it must be 0 to {} us, a multiple of {} us. Nothing was done.", us,
                            max_us, us_per_tick));
}

Result<void> check_encoder(UINT encoder) {
    if (encoder < rtc5::encoder_count) return {};
    return fail(ErrorKind::refused,
                fmt::format("encoder {} is out of range; it must be 0 or 1. Nothing was changed.", encoder));
}

/// Runs `call`, which returns a Result<void>. Returns 0, or -1 on an error.
template <class Call>
int done(const char* who, UINT number, Call call) {
    return with_card(who, number, -1, [&](Card& card) -> Result<int> {
        MOTIONRACK_CHECK(call(card));
        return 0;
    });
}

Result<void> check_unwired(const Card& card) {
    if (card.wired == nullptr) return {};
    return fail(
        ErrorKind::refused,
        "the card belongs to a rack, whose wires drive its encoders. Nothing was changed; set the speed of a belt "
        "by rtc5sim_part_set.");
}

void move(Card& card, std::size_t encoder, std::int64_t count, double counts_per_s) {
    const std::int64_t tick = card.engine.tick();
    card.belt.set(encoder, tick, count, counts_per_s);
    card.engine.set_inputs(card.belt.moves() ? &card.belt : nullptr);
    for (int e = 0; e < rtc5::encoder_count; ++e)
        card.engine.parts().encoders.set_count(
            e,
            static_cast<std::int32_t>(static_cast<std::uint32_t>(card.belt.count(static_cast<std::size_t>(e), tick))));
}

}  // namespace

// ---- time

int rtc5sim_question_us(int64_t us) {
    return with_bench(__func__, -1, [&](CardTable& bench) -> Result<int> {
        MOTIONRACK_TRY(bench.question_ticks, ticks_of(us, 1'000'000'000));
        return 0;
    });
}

int rtc5sim_advance_us(int64_t us) {
    return with_bench(__func__, -1, [&](CardTable& bench) -> Result<int> {
        MOTIONRACK_TRY(const std::int64_t ticks, ticks_of(us, std::numeric_limits<std::int64_t>::max()));
        MOTIONRACK_CHECK(bench.pass(ticks));
        return 0;
    });
}

int rtc5sim_run(int64_t max_us) {
    return with_bench(__func__, -1, [&](CardTable& bench) -> Result<int> {
        MOTIONRACK_TRY(const std::int64_t ticks, ticks_of(max_us, std::numeric_limits<std::int64_t>::max()));
        MOTIONRACK_TRY(const bool rests, bench.run_to_rest(ticks));
        return rests ? 1 : 0;
    });
}

int64_t rtc5sim_now_us(void) {
    return with_bench(__func__, std::int64_t{-1}, [](CardTable& bench) -> Result<std::int64_t> {
        MOTIONRACK_TRY(const std::int64_t tick, bench.tick());
        return tick * us_per_tick;
    });
}

// ---- inputs of a card

int rtc5sim_encoder_speed(UINT CardNo, UINT Encoder, double counts_per_s) {
    return done(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(check_encoder(Encoder));
        MOTIONRACK_CHECK(check_unwired(card));
        if (!(std::abs(counts_per_s) <= 1e9))
            return fail(
                ErrorKind::refused,
                fmt::format("the speed is {} counts/s; it must be -1e9 to 1e9. Nothing was changed.", counts_per_s));
        move(card, Encoder, card.belt.count(Encoder, card.engine.tick()), counts_per_s);
        return {};
    });
}

int rtc5sim_encoder_count(UINT CardNo, UINT Encoder, int32_t count) {
    return done(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(check_encoder(Encoder));
        MOTIONRACK_CHECK(check_unwired(card));
        move(card, Encoder, count, card.belt.speed(Encoder));
        return {};
    });
}

int rtc5sim_receive(UINT CardNo, uint32_t word) {
    return done(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.parts().mcbsp.receive(word);
        return {};
    });
}

int rtc5sim_start(UINT CardNo) {
    return done(__func__, CardNo, [](Card& card) -> Result<void> {
        card.engine.parts().starts.trigger();
        return {};
    });
}

int rtc5sim_stop(UINT CardNo) {
    return done(__func__, CardNo, [](Card& card) -> Result<void> {
        card.engine.external_stop();
        return {};
    });
}

// ---- outputs of a card

int rtc5sim_output(UINT CardNo, int32_t* x, int32_t* y, int* laser) {
    return done(__func__, CardNo, [&](Card& card) -> Result<void> {
        if (x != nullptr) *x = card.engine.output().a[0];
        if (y != nullptr) *y = card.engine.output().a[1];
        if (laser != nullptr) *laser = card.engine.state().laser.on != 0;
        return {};
    });
}

int rtc5sim_sent(UINT CardNo, int32_t* word) {
    return done(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(word, "The address of the word"));
        *word = card.engine.parts().recorder.sent();
        return {};
    });
}

void rtc5sim_on_samples(rtc5sim_samples_handler handler, void* user) {
    with_bench(__func__, false, [&](CardTable& bench) -> Result<bool> {
        bench.samples = handler;
        bench.samples_user = user;
        return true;
    });
}

const char* rtc5sim_table_note(UINT CardNo, UINT TableNo) {
    note_text.clear();
    done(__func__, CardNo, [&](Card& card) -> Result<void> {
        if (TableNo < 1 || TableNo > rtc5::table_count)
            return fail(ErrorKind::refused,
                        fmt::format("table {} must be 1 to {}. Nothing was checked.", TableNo, rtc5::table_count));
        const rtc5::Table* const table = card.engine.parts().heads.table(TableNo);
        if (table != nullptr) note_text = table->note;
        return {};
    });
    return note_text.c_str();
}

const char* rtc5sim_marking_info_text(UINT bits) {
    info_text.clear();
    for (const std::string& line : rtc5::decoded(bits, rtc5::map::marking_info_bits)) info_text += line + "\n";
    return info_text.c_str();
}
