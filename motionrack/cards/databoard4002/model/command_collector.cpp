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

struct CommandCollector::CollectorSteps {
    /// Events: the next command, then the same command by its data: an answer or arguments (D, P, R), arguments only
    /// (N, S), an answer only (V); accesses to DATA and C4.
    enum class Event : std::uint8_t { next_command, asks_or_sets, sets, asks, out_data, in_data, enables };

    static void open(CommandCollector& c, std::uint8_t code) {
        c.state_.code = code;
        c.state_.collected = 0;
        c.state_.argument = 0;
    }
    static void report_dropped(CommandCollector& c, std::uint8_t) {
        if (c.state_.collected > 0)
            c.conditions_.report(CardCondition::arguments_dropped, c.state_.code, c.state_.collected);
    }
    static bool is_last_argument(const CommandCollector& c, std::uint8_t) {
        return c.state_.collected + 1 == argument_bytes(c.state_.code);
    }
    static void store(CommandCollector& c, std::uint8_t value) {
        CollectorState& s = c.state_;
        if (s.code == command("S"))
            c.positioner_.set_table_byte(s.collected, value);
        else
            s.argument |= std::uint32_t{value} << (8 * s.collected);
        ++s.collected;
    }
    static void begin_arguments(CommandCollector& c, std::uint8_t value) {
        c.state_.answer_left = 0;
        run(c, Event::out_data, value);
    }
    static void end_arguments(CommandCollector& c, std::uint8_t value) {
        store(c, value);
        c.arguments_complete(c.state_.code);
    }
    static bool is_answered(const CommandCollector& c, std::uint8_t) { return c.state_.answer_left == 0; }
    static void begin_answer(CommandCollector& c, std::uint8_t) { run(c, Event::in_data, 0); }
    static void put_answer(CommandCollector& c, std::uint8_t) {
        c.latch_ = static_cast<std::uint8_t>(c.state_.answer);
        c.state_.answer >>= 8;
        --c.state_.answer_left;
    }

    using enum Collecting;
    static constexpr StateRow<CommandCollector, Collecting, Event, std::uint8_t> rows[] = {
        {idle, Event::asks_or_sets, either, nullptr, open},
        {idle, Event::sets, collecting, nullptr, open},
        {idle, Event::asks, answering, nullptr, open},
        {either, Event::next_command, idle},
        {either, Event::out_data, collecting, nullptr, begin_arguments},
        {either, Event::in_data, answering, nullptr, begin_answer},
        {either, Event::enables, collecting},
        {collecting, Event::next_command, idle, nullptr, report_dropped},
        {collecting, Event::out_data, idle, is_last_argument, end_arguments},
        {collecting, Event::out_data, collecting, nullptr, store},
        {answering, Event::next_command, idle},
        {answering, Event::in_data, idle, is_answered},
        {answering, Event::in_data, answering, nullptr, put_answer},
        {answering, Event::enables, idle},
    };
    static_assert(declared<rows_flaw(machine_named(map::machines, "collector"), rows)>());

    /// `byte`: the command's code or the byte of the access. Returns false if the event has no effect.
    static bool run(CommandCollector& c, Event event, std::uint8_t byte) {
        return step(rows, c.state_.collecting, event, c, byte);
    }
};

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

void CommandCollector::open_answer(std::int64_t value, int bytes) {
    latch_ = static_cast<std::uint8_t>(value);
    state_.answer = static_cast<std::uint32_t>(value >> 8);
    state_.answer_left = static_cast<std::uint8_t>(bytes - 1);
}

void CommandCollector::take_command(std::uint8_t code, Instant now) {
    using enum CollectorSteps::Event;
    CollectorSteps::run(*this, CollectorSteps::Event::next_command, code);
    state_.answer_left = 0;
    switch (code) {
        case command("A"):
            report_during_move(code);
            return positioner_.home(now);
        case command("D"):
            CollectorSteps::run(*this, asks_or_sets, code);
            return open_answer(positioner_.deviation(now), 3);
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
            CollectorSteps::run(*this, sets, code);
            return;
        case command("O"):
            return positioner_.select_slope();
        case command("P"):
            CollectorSteps::run(*this, asks_or_sets, code);
            return open_answer(signed24(counter_.value(now)), 3);
        case command("Q"):
            return positioner_.quit(settings_.quit_zeroes);
        case command("R"):
            CollectorSteps::run(*this, asks_or_sets, code);
            return open_answer(outputs_.signed_rate(), 2);
        case command("V"):
            CollectorSteps::run(*this, asks, code);
            return open_answer(settings_.version, 1);
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
    if (!CollectorSteps::run(*this, CollectorSteps::Event::out_data, value))
        conditions_.report(CardCondition::data_unexpected, value);
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
    CollectorSteps::run(*this, CollectorSteps::Event::in_data, 0);
}

// ---- C4

void CommandCollector::enable_events(std::uint8_t value) {
    latch_ = events_.enable(value);
    state_.answer_left = 0;
    CollectorSteps::run(*this, CollectorSteps::Event::enables, value);
    events_.subscribe_zero();
    events_.check();
}

}  // namespace motionrack::databoard4002
