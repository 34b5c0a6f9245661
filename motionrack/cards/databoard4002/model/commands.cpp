// Firmware actions of one access: commands, arguments, answers, event enables.
#include <algorithm>
#include <cstdlib>
#include <motionrack/cards/databoard4002/model/card.hpp>

namespace motionrack::databoard4002 {

namespace {

std::int32_t argument_bytes(std::uint8_t code) {
    for (const CommandInfo& info : card_map().commands)
        if (info.code == code) return info.data_bytes;
    return 0;
}

}  // namespace

void Card::work(Instant now) {
    Firmware& f = state_.firmware;
    const Work kind = f.access;
    f.access = Work::none;
    f.access_due = never;
    f.ready = 1;
    if (kind == Work::in_data) next_answer();
    if (kind == Work::out_data) take_argument(f.access_value);
    if (kind == Work::command) take_command(f.access_value, now);
    if (kind == Work::enables) enable_events(f.access_value);
}

// ---- commands

void Card::open(std::uint8_t code, Collecting collecting) {
    Firmware& f = state_.firmware;
    f.collecting = collecting;
    f.collector = code;
    f.collected = 0;
    f.argument = 0;
}

/// Begins the answer `value` of that many bytes; the first byte enters the latch at once.
void Card::open_answer(std::uint8_t code, Collecting collecting, std::int64_t value, int bytes) {
    open(code, collecting);
    Firmware& f = state_.firmware;
    f.latch = static_cast<std::uint8_t>(value);
    f.answer = static_cast<std::uint32_t>(value >> 8);
    f.answer_left = static_cast<std::uint8_t>(bytes - 1);
}

void Card::take_command(std::uint8_t code, Instant now) {
    Firmware& f = state_.firmware;
    if (f.collecting == Collecting::collecting && f.collected > 0)
        conditions_.report(CardCondition::arguments_dropped, f.collector, f.collected);
    f.collecting = Collecting::idle;
    f.answer_left = 0;
    auto heard_while_moving = [&] {
        if (positioner_.moving()) conditions_.report(CardCondition::during_move, code);
    };
    switch (code) {
        case command("A"):
            heard_while_moving();
            return positioner_.home(now);
        case command("D"):
            return open_answer(code, Collecting::either, positioner_.deviation(now), 3);
        case command("G"):
            return positioner_.go(now);
        case command("I"):
            return;
        case command("L"):
            return positioner_.lock();
        case command("M"):
            return positioner_.select_manual();
        case command("N"):
        case command("S"):
            heard_while_moving();
            return open(code, Collecting::collecting);
        case command("O"):
            return positioner_.select_slope();
        case command("P"):
            return open_answer(code, Collecting::either, signed24(counter_.value(now)), 3);
        case command("Q"):
            return positioner_.quit(settings_.quit_zeroes);
        case command("R"):
            return open_answer(code, Collecting::either, output_rate(), 2);
        case command("V"):
            return open_answer(code, Collecting::answering, settings_.version, 1);
        case command("W"):
            events_.clear(event::WATCH_OUT);
            return;
        default:
            conditions_.report(CardCondition::unknown_command, code);
    }
}

// ---- arguments and answers

void Card::take_argument(std::uint8_t value) {
    Firmware& f = state_.firmware;
    if (f.collecting == Collecting::either) {
        f.collecting = Collecting::collecting;
        f.answer_left = 0;
    }
    if (f.collecting != Collecting::collecting) return conditions_.report(CardCondition::data_unexpected, value);
    if (f.collector == command("S"))
        positioner_.set_table_byte(f.collected, value);
    else
        f.argument |= std::uint32_t{value} << (8 * f.collected);
    if (++f.collected == argument_bytes(f.collector)) {
        f.collecting = Collecting::idle;
        arguments_complete(f.collector);
    }
}

void Card::arguments_complete(std::uint8_t code) {
    Firmware& f = state_.firmware;
    switch (code) {
        case command("D"):
            return positioner_.set_window(std::abs(signed24(f.argument)));
        case command("N"):
            return positioner_.set_number(signed24(f.argument));
        case command("P"):
            if (positioner_.moving()) conditions_.report(CardCondition::during_move, code);
            return positioner_.set_target(signed24(f.argument));
        case command("R"):
            return positioner_.set_rate(static_cast<std::int32_t>(f.argument) & rate_mask);
        default:
            return;
    }
}

void Card::next_answer() {
    Firmware& f = state_.firmware;
    if (f.collecting == Collecting::either) f.collecting = Collecting::answering;
    if (f.collecting != Collecting::answering) return;
    if (f.answer_left == 0) {
        f.collecting = Collecting::idle;
        return;
    }
    f.latch = static_cast<std::uint8_t>(f.answer);
    f.answer >>= 8;
    --f.answer_left;
}

// ---- C4

void Card::enable_events(std::uint8_t value) {
    Firmware& f = state_.firmware;
    f.latch = events_.enable(value);
    f.answer_left = 0;
    if (f.collecting == Collecting::answering) f.collecting = Collecting::idle;
    if (f.collecting == Collecting::either) f.collecting = Collecting::collecting;
    events_.subscribe_zero();
    events_.check();
}

}  // namespace motionrack::databoard4002
