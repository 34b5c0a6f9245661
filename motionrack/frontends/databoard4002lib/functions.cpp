// The functions of databoard4002lib.h. Those of the card's declaration are called by their names.
#include <databoard4002lib.h>
#include <fmt/format.h>

#include <initializer_list>
#include <memory>
#include <motionrack/frontends/databoard4002lib/calls.hpp>
#include <mutex>

namespace motionrack::databoard4002lib {

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
thread_local std::string last_sentence;

}  // namespace

calls::Process<DataboardTable>& process() {
    static calls::Process<DataboardTable> one;
    return one;
}

void failed(const char* who, std::string_view sentence) noexcept {
    process().failed(last_sentence, who, sentence);
}

}  // namespace motionrack::databoard4002lib

namespace {

using namespace motionrack::databoard4002lib;
using motionrack::ErrorKind;
using motionrack::fail;
using motionrack::Result;
using motionrack::calls::check_pointer;
using Values = std::initializer_list<std::int64_t>;

namespace own = motionrack::databoard4002;
static_assert(DATABOARD4002_STAT_INT == own::stat::INT && DATABOARD4002_STAT_EVENT == own::stat::EVENT &&
              DATABOARD4002_STAT_ZERO == own::stat::ZERO && DATABOARD4002_STAT_REF == own::stat::REF &&
              DATABOARD4002_STAT_EMS == own::stat::EMS && DATABOARD4002_STAT_ESR == own::stat::ESR &&
              DATABOARD4002_STAT_ESL == own::stat::ESL && DATABOARD4002_STAT_READY == own::stat::READY);
static_assert(DATABOARD4002_POSITION == own::event::POSITION && DATABOARD4002_ZERO == own::event::ZERO &&
              DATABOARD4002_REF == own::event::REF && DATABOARD4002_STOP == own::event::STOP &&
              DATABOARD4002_WATCH_OUT == own::event::WATCH_OUT);

constexpr int max_advance_ms = 600'000;

/// "move_to" for databoard4002_move_to.
std::string_view declared_name(std::string_view who) {
    return who.substr(std::string_view("databoard4002_").size());
}

/// Calls the function of the declaration with the name of `who`. A stop refuses it.
int command(const char* who, int card, Values values = {}) noexcept {
    return with_card(who, card, [&](OpenDataboard& board) -> Result<void> {
        MOTIONRACK_CHECK(board.check_stop("Nothing was done."));
        MOTIONRACK_CHECK(board.call(declared_name(who), values));
        return board.check_stop("The call may be incomplete.");
    });
}

/// As command(), with the function's number, also while a stop holds.
int ask(const char* who, int card, int* answer, Values values = {}) noexcept {
    return with_card(who, card, [&](OpenDataboard& board) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(answer, "The address of the answer"));
        MOTIONRACK_TRY(const std::int64_t number, board.call(declared_name(who), values));
        *answer = static_cast<int>(number);
        return {};
    });
}

}  // namespace

// ---- cards

int databoard4002_open(const char* place, int number) {
    return run<int>(__func__,
                    [&] { return process().alone([&](DataboardTable& table) { return table.open(place, number); }); });
}

int databoard4002_close(int card) {
    return run<int>(__func__, [&]() -> Result<int> {
        MOTIONRACK_TRY(const std::shared_ptr<OpenDataboard> board, find_card(card));
        const std::lock_guard<std::mutex> alone(board->calls());
        MOTIONRACK_CHECK(find_card(card));
        return process().alone([card](DataboardTable& table) -> Result<int> { return table.close(card), 0; });
    });
}

// ---- stops

int databoard4002_stop(int card) {
    stop_flags().set(card);  // ends the call that another thread waits in
    return with_card(__func__, card, [](OpenDataboard& board) { return board.stop(); });
}

int databoard4002_reset_stop(int card) {
    return with_card(__func__, card, [](OpenDataboard& board) -> Result<void> {
        board.reset_stop();
        return {};
    });
}

// ---- errors

const char* databoard4002_last_error(void) {
    return motionrack::databoard4002lib::last_sentence.c_str();
}
void databoard4002_clear_error(void) {
    motionrack::databoard4002lib::last_sentence.clear();
}

// ---- commands

int databoard4002_athome(int card) {
    return command(__func__, card);
}
int databoard4002_set_deviation(int card, int counts) {
    return command(__func__, card, {counts});
}
int databoard4002_deviation(int card, int* counts) {
    return ask(__func__, card, counts);
}
int databoard4002_go(int card) {
    return command(__func__, card);
}
int databoard4002_initialise(int card) {
    return command(__func__, card);
}
int databoard4002_lock(int card) {
    return command(__func__, card);
}
int databoard4002_manual(int card) {
    return command(__func__, card);
}
int databoard4002_set_number(int card, int counts) {
    return command(__func__, card, {counts});
}
int databoard4002_on_regulation(int card) {
    return command(__func__, card);
}
int databoard4002_set_target(int card, int counts) {
    return command(__func__, card, {counts});
}
int databoard4002_position(int card, int* counts) {
    return ask(__func__, card, counts);
}
int databoard4002_quit(int card) {
    int none = 0;
    return ask(__func__, card, &none);
}
int databoard4002_set_rate(int card, int rate) {
    return command(__func__, card, {rate});
}
int databoard4002_rate(int card, int* rate) {
    return ask(__func__, card, rate);
}
int databoard4002_version(int card, int* version) {
    return ask(__func__, card, version);
}
int databoard4002_clear_watch_out(int card) {
    return command(__func__, card);
}

// ---- status and events

int databoard4002_status(int card, int* word) {
    return ask(__func__, card, word);
}
int databoard4002_enable_events(int card, int events, int* word) {
    return ask(__func__, card, word, {events});
}
int databoard4002_disable_events(int card, int* word) {
    return ask(__func__, card, word);
}

int databoard4002_reset(int card) {
    return with_card(__func__, card, [](OpenDataboard& board) -> Result<void> {
        MOTIONRACK_CHECK(board.check_stop("Nothing was done."));
        MOTIONRACK_CHECK(board.reset());
        return board.check_stop("The call may be incomplete.");
    });
}

// ---- complete moves, the slope

int databoard4002_move_to(int card, int counts, int milliseconds) {
    return command(__func__, card, {counts, milliseconds});
}
int databoard4002_move_by(int card, int counts, int milliseconds) {
    return command(__func__, card, {counts, milliseconds});
}
int databoard4002_find_zero(int card, int marks, int last, int rate, int milliseconds) {
    return command(__func__, card, {marks, last, rate, milliseconds});
}
int databoard4002_design_slope(int card, int speed, int acceleration, int counts_per_1000_pulses, int counts_per_volt) {
    return command(__func__, card, {speed, acceleration, counts_per_1000_pulses, counts_per_volt});
}

// ---- time

int databoard4002_advance_ms(int card, int milliseconds) {
    return with_card(__func__, card, [&](OpenDataboard& board) -> Result<void> {
        if (milliseconds < 0 || milliseconds > max_advance_ms)
            return fail(ErrorKind::invalid_input, fmt::format("the time is {} ms; it must be 0 to {} ms. Nothing was "
                                                              "run.",
                                                              milliseconds, max_advance_ms));
        MOTIONRACK_CHECK(board.advance(motionrack::milliseconds(milliseconds)));
        return board.check_live();
    });
}

int64_t databoard4002_now_us(int card) {
    return value_of_card<std::int64_t>(__func__, card, [](OpenDataboard& board) -> Result<std::int64_t> {
        return board.now() / motionrack::microseconds(1);
    });
}

// ---- the virtual card

int databoard4002_peek(int card, const char* name, int64_t* value) {
    return with_card(__func__, card, [&](OpenDataboard& board) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(name, "The name"));
        MOTIONRACK_CHECK(check_pointer(value, "The address of the value"));
        MOTIONRACK_TRY(const motionrack::rack::Card* peeked,
                       board.virtual_card("registers that are visible without access"));
        MOTIONRACK_TRY(*value, peeked->inspect(name));
        return {};
    });
}

int databoard4002_set_wire(int card, const char* wire, double value) {
    return with_card(__func__, card, [&](OpenDataboard& board) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(wire, "The wire"));
        return board.set_wire(wire, value);
    });
}
