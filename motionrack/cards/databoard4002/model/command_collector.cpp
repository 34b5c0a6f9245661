// Execution of commands, arguments, answers and enables.
#include <cstdlib>
#include <motionrack/cards/databoard4002/model/command_collector.hpp>

namespace motionrack::databoard4002 {

namespace {

std::int32_t argument_bytes(std::uint8_t code) {
    for (const CommandInfo& info : card_map().commands)
        if (info.code == code) return info.data_bytes;
    return 0;
}

}  // namespace

CommandCollector::CommandCollector(CollectorState& state, std::uint8_t& latch, const Settings& settings,
                                   const ConditionReporter& conditions, const PositionCounter& counter,
                                   EventRegister& events, Positioner& positioner, const OutputStage& outputs)
    : state_(state),
      latch_(latch),
      settings_(settings),
      conditions_(conditions),
      counter_(counter),
      events_(events),
      positioner_(positioner),
      outputs_(outputs) {}

// ---- commands

void CommandCollector::open(std::uint8_t code, Collecting collecting) {
    state_.collecting = collecting;
    state_.code = code;
    state_.collected = 0;
    state_.argument = 0;
}

void CommandCollector::open_answer(std::uint8_t code, Collecting collecting, std::int64_t value, int bytes) {
    open(code, collecting);
    latch_ = static_cast<std::uint8_t>(value);
    state_.answer = static_cast<std::uint32_t>(value >> 8);
    state_.answer_left = static_cast<std::uint8_t>(bytes - 1);
}

void CommandCollector::take_command(std::uint8_t code, Instant now) {
    if (state_.collecting == Collecting::collecting && state_.collected > 0)
        conditions_.report(CardCondition::arguments_dropped, state_.code, state_.collected);
    state_.collecting = Collecting::idle;
    state_.answer_left = 0;
    switch (code) {
        case command("A"):
            report_during_move(code);
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
            report_during_move(code);
            return open(code, Collecting::collecting);
        case command("O"):
            return positioner_.select_slope();
        case command("P"):
            return open_answer(code, Collecting::either, signed24(counter_.value(now)), 3);
        case command("Q"):
            return positioner_.quit(settings_.quit_zeroes);
        case command("R"):
            return open_answer(code, Collecting::either, outputs_.signed_rate(), 2);
        case command("V"):
            return open_answer(code, Collecting::answering, settings_.version, 1);
        case command("W"):
            events_.clear(event::WATCH_OUT);
            return;
        default:
            conditions_.report(CardCondition::unknown_command, code);
    }
}

void CommandCollector::report_during_move(std::uint8_t code) {
    if (positioner_.moving()) conditions_.report(CardCondition::during_move, code);
}

// ---- arguments and answers

void CommandCollector::take_argument(std::uint8_t value) {
    if (state_.collecting == Collecting::either) {
        state_.collecting = Collecting::collecting;
        state_.answer_left = 0;
    }
    if (state_.collecting != Collecting::collecting) return conditions_.report(CardCondition::data_unexpected, value);
    if (state_.code == command("S"))
        positioner_.set_table_byte(state_.collected, value);
    else
        state_.argument |= std::uint32_t{value} << (8 * state_.collected);
    if (++state_.collected == argument_bytes(state_.code)) {
        state_.collecting = Collecting::idle;
        arguments_complete(state_.code);
    }
}

void CommandCollector::arguments_complete(std::uint8_t code) {
    switch (code) {
        case command("D"):
            return positioner_.set_window(std::abs(signed24(state_.argument)));
        case command("N"):
            return positioner_.set_number(signed24(state_.argument));
        case command("P"):
            report_during_move(code);
            return positioner_.set_target(signed24(state_.argument));
        case command("R"):
            return positioner_.set_rate(static_cast<std::int32_t>(state_.argument) & rate_mask);
        default:
            return;
    }
}

void CommandCollector::next_answer() {
    if (state_.collecting == Collecting::either) state_.collecting = Collecting::answering;
    if (state_.collecting != Collecting::answering) return;
    if (state_.answer_left == 0) {
        state_.collecting = Collecting::idle;
        return;
    }
    latch_ = static_cast<std::uint8_t>(state_.answer);
    state_.answer >>= 8;
    --state_.answer_left;
}

// ---- C4

void CommandCollector::enable_events(std::uint8_t value) {
    latch_ = events_.enable(value);
    state_.answer_left = 0;
    if (state_.collecting == Collecting::answering) state_.collecting = Collecting::idle;
    if (state_.collecting == Collecting::either) state_.collecting = Collecting::collecting;
    events_.subscribe_zero();
    events_.check();
}

}  // namespace motionrack::databoard4002
