// Runs jobs made from arbitrary numbers, and checks the invariants.
#include <cstring>
#include <limits>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/cards/rtc5/test/card_fuzz.hpp>

namespace motionrack::rtc5::fuzz {

namespace {

class Looker final : public Sink {
  public:
    void samples(const Samples& b) override {
        for (std::size_t i = 0; i < b.x.size(); ++i) {
            const bool inside = b.x[i] >= -524288 && b.x[i] <= 524287 && b.y[i] >= -524288 && b.y[i] <= 524287;
            if (!inside) problem = "an output is outside the field";
            if (b.laser[i] > 20) problem = "the gate is open for more than a tick";
        }
        if (b.first != next) problem = "ticks are missing";
        next = b.first + static_cast<std::int64_t>(b.x.size());
    }
    void laser(std::int64_t, bool on) override {
        if (on == last) problem = "the gate changes to what it is";
        last = on;
    }
    std::string problem;
    std::int64_t next = 0;
    bool last = false;
};

/// Returns any double: mostly small whole numbers, ends of ranges, or arbitrary bits.
double number(Feed& feed) {
    switch (feed.below(8)) {
        case 0:
            return std::numeric_limits<double>::quiet_NaN();
        case 1:
            return std::numeric_limits<double>::infinity();
        case 2: {
            std::uint64_t bits = 0;
            for (int i = 0; i < 4; ++i) bits = bits << 16 | feed.word();
            double out = 0;
            std::memcpy(&out, &bits, sizeof out);
            return out;
        }
        case 3:
            return 4294967295.0;
        case 4:
            return -2147483648.0;
        case 5:
            return static_cast<double>(feed.word()) * 300 - 9'000'000;
        default:
            return static_cast<double>(feed.word() % 2000) - 500;
    }
}

void put_something(Feed& feed, Engine* const (&cards)[2], Verdict& verdict) {
    const auto op = static_cast<Op>(feed.below(static_cast<std::uint32_t>(op_count) + 2));
    double p[max_params] = {};
    for (double& v : p) v = number(feed);
    const std::size_t count =
        static_cast<std::size_t>(op) < op_count ? static_cast<std::size_t>(info(op).param_count()) : 1;
    const auto command = list_command(op, {p, count});
    ++verdict.commands;
    if (!command) {
        ++verdict.refused;
        if (command.error().message.empty()) verdict.problem = "a refusal without a sentence";
        return;
    }
    for (Engine* card : cards)
        if (!card->put(*command)) static_cast<void>(card->set_start_list(1 + static_cast<int>(verdict.commands % 3)));
}

int small_of(std::uint32_t word) {
    return static_cast<int>(word % 6) - 1;
}

void control_lists(std::uint32_t what, Engine& c, std::uint32_t word, std::uint32_t other, double a) {
    const int small = small_of(word);
    if (what == 0) static_cast<void>(c.execute_list(small));
    if (what == 1) c.stop_execution();
    if (what == 2) c.pause_list();
    if (what == 3) c.restart_list();
    if (what == 11) c.set_control_mode(word);
    if (what == 12) static_cast<void>(c.set_ext_start_delay(static_cast<std::int32_t>(word) - 30000, small));
    if (what == 13) c.parts().starts.trigger();
    if (what == 14) c.parts().mcbsp.receive(word << 16 | other);
    if (what == 15) c.parts().encoders.set_count(small & 1, static_cast<std::int32_t>(word << 16 | other));
    if (what == 16) c.parts().execution.auto_change();
    if (what == 17) word % 2 ? c.parts().execution.start_loop() : c.parts().execution.quit_loop();
    if (what == 18) static_cast<void>(c.parts().fly.set_mcbsp_in(small, a));
    if (what == 19) static_cast<void>(c.parts().lists.load_list(word, other % 120));
    if (what == 20) static_cast<void>(c.parts().lists.load_sub(word % 1200));
    if (what == 25) static_cast<void>(c.set_start_list(static_cast<std::uint32_t>(small), other % 120));
}

void control_outputs(std::uint32_t what, Engine& c, std::uint32_t word, std::uint32_t other, double a, double b) {
    const int small = small_of(word);
    if (what == 4) static_cast<void>(c.goto_xy(a, b));
    if (what == 5) static_cast<void>(c.parts().heads.set_matrix(small, {a, b, 1, 0}, small));
    if (what == 6) static_cast<void>(c.parts().heads.set_offset(small, {a, b}, small));
    if (what == 7) static_cast<void>(c.parts().heads.set_hi(small, {a, 1}, {b, 0}));
    if (what == 8) static_cast<void>(c.parts().fly.set_rot_center({a, b}));
    if (what == 9) static_cast<void>(c.parts().encoders.simulate(small));
    if (what == 10) c.parts().encoders.set_tracking_error(static_cast<std::uint16_t>(word), 0);
    if (what == 21) word % 2 ? c.parts().laser.disable() : c.parts().laser.enable();
    if (what == 22) {
        static_cast<void>(c.parts().recorder.send(std::array<std::uint32_t, 2>{word % 48, other % 48}));
        static_cast<void>(c.parts().recorder.sent());
    }
    if (what == 23) {
        static_cast<void>(c.parts().recorder.value(word % 60));
        static_cast<void>(c.parts().mcbsp.store_now());
    }
    if (what == 24) static_cast<void>(word % 2 ? c.parts().fly.set_mcbsp_x(a) : c.parts().fly.set_mcbsp_rot(b));
}

void control_something(Feed& feed, Engine* const (&cards)[2]) {
    const std::uint32_t what = feed.below(26);
    const double a = number(feed), b = number(feed);
    const std::uint32_t word = feed.word(), other = feed.word();
    for (Engine* c : cards) {
        control_lists(what, *c, word, other, a);
        control_outputs(what, *c, word, other, a, b);
    }
}

/// Loads a correction file with a few bytes changed, and a text as a 2D compensation table, into both cards.
void files(Feed& feed, Engine* const (&cards)[2], Verdict& verdict) {
    static const std::vector<std::uint8_t> whole = [] {
        CorrectionFile file = one_to_one();
        file.header[1] = 5184;
        return written_ct5(file);
    }();
    std::vector<std::uint8_t> bytes = whole;
    for (std::uint32_t i = feed.below(4); i > 0; --i)
        bytes[(std::size_t{feed.word()} << 5 | feed.below(32)) % bytes.size()] = static_cast<std::uint8_t>(feed.word());
    if (feed.below(8) == 0) bytes.resize(feed.word());
    if (const auto file = read_ct5(bytes, "fuzz.ct5"))
        for (Engine* c : cards)
            static_cast<void>(c->parts().heads.load_table(table_of(*file), 1)),
                static_cast<void>(c->parts().heads.select_tables(1, 0));
    std::string text = "[Fly2DTable1]\n0 0 0 0\n10 0 1 1\n0 10 2 2\n10 10 3 3\n";
    for (std::uint32_t i = feed.below(4); i > 0; --i)
        text[feed.below(static_cast<std::uint32_t>(text.size()))] = static_cast<char>(feed.word());
    if (const auto table = FlyTable::read(text, 1, "fuzz.txt"))
        for (Engine* c : cards) c->parts().fly.load_table(std::make_shared<const FlyTable>(*table));
    ++verdict.files;
}

}  // namespace

void run(Feed& feed, std::int64_t steps, Verdict& verdict) {
    const Settings settings{300, 100, 100};
    Engine seen(settings), unseen(settings);
    Engine* const cards[2] = {&seen, &unseen};
    Looker looker;
    for (std::int64_t i = 0; i < steps && !feed.empty() && verdict.problem.empty(); ++i) {
        const std::uint32_t what = feed.below(64);
        if (what < 40)
            put_something(feed, cards, verdict);
        else if (what < 54)
            control_something(feed, cards);
        else if (what == 54)
            files(feed, cards, verdict);
        else {
            const std::int64_t ticks = feed.below(900);
            looker.next = seen.tick();
            seen.run_until(seen.tick() + ticks, &looker);
            unseen.run_until(unseen.tick() + ticks);
            looker.last = seen.state().laser.on != 0;
            verdict.ticks += ticks;
            verdict.problem = looker.problem;
            if (std::memcmp(&seen.state(), &unseen.state(), sizeof(State)) != 0)
                verdict.problem = "looking at the samples changes the state";
        }
    }
    if (!verdict.problem.empty()) return;
    seen.load_program_file();
    if (!seen.goto_xy(1234, -77) || !seen.run_to_rest(10'000'000) ||
        seen.output().a != std::array<std::int32_t, 2>{1234, -77})
        verdict.problem = "the card does not go where it is told after a reset";
}

}  // namespace motionrack::rtc5::fuzz
