// Generation of random programs, and their execution on the twin.
#include <fmt/format.h>

#include <cstdlib>
#include <motionrack/cards/databoard4002/test/program.hpp>
#include <ostream>
#include <random>
#include <utility>

namespace motionrack::databoard4002::twin {

namespace {

class Maker {
  public:
    Maker(std::uint64_t seed, std::uint64_t number) : random_(seed * 1'000'003 + number) {
        Strapping& s = program_.strapping;
        s.firmware_pass_ticks = pick({1, 1, 1, 2, 7, 40});
        s.byte_slices = pick({5, 20, 20, 200});
        s.zeroing = !one_in(5);
        s.quit_zeroes = !one_in(3);
        s.up_down = one_in(4);
        s.folding = pick({4, 4, 2, 1});
        s.first_pair = static_cast<int>(below(static_cast<std::uint64_t>(4 / s.folding)));
        s.single_ended = one_in(4);
        s.source = static_cast<Strapping::Source>(pick({0, 1, 1, 2, 2, 2}));
    }

    Program make() {
        const int actions = 12 + static_cast<int>(below(30));
        if (one_in(3)) table();
        for (int i = 0; i < actions; ++i) action();
        wait(2'000 + below(40'000));
        read(1);
        return std::move(program_);
    }

  private:
    std::uint64_t below(std::uint64_t n) { return random_() % n; }
    bool one_in(std::uint64_t n) { return below(n) == 0; }
    int pick(std::initializer_list<int> of) { return of.begin()[below(of.size())]; }

    void wait(std::uint64_t slices) { slice_ += static_cast<std::int64_t>(slices); }
    void add(Op::Kind kind, std::int64_t a, std::int64_t b) {
        if (slice_ % slices_of_tick == 0) ++slice_;  // passes are at whole ticks
        program_.ops.push_back({kind, slice_, a, b});
    }
    /// Usually long enough for Ready.
    void after_access() {
        const Strapping& s = program_.strapping;
        const std::uint64_t busy =
            static_cast<std::uint64_t>(s.byte_slices + s.firmware_pass_ticks * slices_of_tick) + 1;
        wait(one_in(40) ? below(busy) : busy + (one_in(4) ? below(300) : 0));
    }
    void write(int port, std::int64_t value) {
        add(Op::out, port, value & 0xFF);
        after_access();
    }
    void read(int port) {
        add(Op::in, port, 0);
        if (port != 1) after_access();
    }
    void number(std::int64_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) {
            write(0, value >> (8 * i));
            if (one_in(150)) return;  // truncated
            if (one_in(100)) disturbance();
        }
    }
    std::int64_t distance() {
        const auto size = static_cast<std::int64_t>(one_in(10) ? below(1 << 23) : below(1u << (2 + below(10))));
        return one_in(2) ? size : -size;
    }
    int speed() {
        return one_in(8) ? static_cast<int>(below(65'536))
                         : 16'384 - (1 + static_cast<int>(below(1u << (1 + below(9)))));
    }

    void table() {
        write(3, 'S');
        std::int64_t place[2] = {0, 0};
        const std::uint64_t stride = 1u << below(8);
        for (int i = 0; i < 48; ++i) {
            std::int64_t& here = place[i / 24];
            here += static_cast<std::int64_t>(below(stride));
            if (one_in(60)) here -= static_cast<std::int64_t>(below(stride));
            if (one_in(300)) here = static_cast<std::int64_t>(below(1 << 24));
            const int slow = 1 + (47 - i % 24 * 2) * static_cast<int>(1 + below(8));
            const int rate = one_in(400) ? 0 : 16'384 - slow;
            number(rate, 2);
            number(here < 0 ? 0 : here, 3);
        }
        write(3, 'O');
    }

    void action() {
        const std::uint64_t roll = below(22);
        if (roll < 3) {
            write(3, 'P'), number(distance(), 3);
        } else if (roll < 5) {
            write(3, 'N'), number(distance(), 3);
        } else if (roll < 7) {
            write(3, 'R'), number(speed(), 2);
        } else if (roll < 11) {
            write(3, 'G'), wait(below(4) * below(20'000));
        } else if (roll < 12) {
            write(3, "PDRPDR"[below(6)]);
            for (std::uint64_t i = below(5); i > 0; --i) read(0);
        } else if (roll < 15) {
            write(5, pick({0x01, 0x21, 0x81, 0xE7, 0x27, 0x02, 0x04, 0x06, 0x40, static_cast<int>(below(256))}));
            if (one_in(2)) read(0);
        } else if (roll < 16) {
            write(3, 'D'), number(distance() / 8, 3), write(3, 'L'), wait(below(30'000));
        } else if (roll < 17) {
            write(3, "AQMOVWILLQ"[below(10)]);
            if (one_in(2)) read(0);
        } else if (roll < 18) {
            write(static_cast<int>(below(8)), static_cast<std::int64_t>(below(256)));
        } else if (roll < 19) {
            one_in(6) ? read(7) : one_in(4) ? write(4, 0) : one_in(4) ? table() : read(static_cast<int>(below(3)));
        } else {
            for (std::uint64_t i = below(6); i > 0; --i) disturbance();
        }
    }

    /// The machine and the manual operations.
    void disturbance() {
        const Strapping& s = program_.strapping;
        wait(1 + below(400));
        if (one_in(60)) return add(Op::hang, one_in(5) ? 0 : 1, 0), wait(one_in(8) ? 2'100'000 : 10);
        if (one_in(30)) return add(Op::broken, 3 + static_cast<std::int64_t>(below(4)), one_in(3));
        if (s.source == Strapping::Source::laws && !one_in(3)) {
            const std::int64_t period = 20'000 + static_cast<std::int64_t>(below(1u << (12 + below(12))));
            return add(Op::law, one_in(10) ? period / 8 : period, pick({-1, 0, 1, 1}));
        }
        if (s.source == Strapping::Source::wires && !one_in(4)) {
            for (std::uint64_t i = 1 + below(30); i > 0; --i) {
                const int pin = one_in(3) ? static_cast<int>(below(2)) : last_pin_ ^= 1;
                level_[pin] ^= 1;
                add(Op::wire, pin, level_[pin]);
                wait(one_in(20) ? below(12) : 12 + below(20));
            }
            return;
        }
        const int pin = 2 + static_cast<int>(below(5));
        level_[pin] = one_in(3) ? static_cast<int>(below(2)) : 0;
        add(Op::wire, pin, level_[pin] ^= one_in(2));
    }

    std::mt19937_64 random_;
    Program program_;
    std::int64_t slice_ = 1;
    int level_[7] = {};
    int last_pin_ = 0;
};

void note_outputs(const Twin& twin, std::array<int, out_count>& last, std::vector<oracle::Change>& changes) {
    const auto now = twin.outputs();
    for (int i = 0; i < out_count; ++i) {
        if (now[i] == last[i]) continue;
        changes.push_back({twin.now(), i, now[i]});
        last[i] = now[i];
    }
}

}  // namespace

Program make_program(std::uint64_t seed, std::uint64_t number) {
    return Maker(seed, number).make();
}

Outcome run_on_twin(const Program& program) {
    Twin twin(program.strapping);
    Outcome out;
    auto last = twin.outputs();
    for (const Op& op : program.ops) {
        while (twin.now() < op.slice) {
            twin.slice();
            note_outputs(twin, last, out.changes);
        }
        Sight sight;
        const int a = static_cast<int>(op.a), b = static_cast<int>(op.b);
        if (op.kind == Op::out) twin.write(a, b);
        if (op.kind == Op::in) sight.value = twin.read(a);
        if (op.kind == Op::wire) twin.set(static_cast<In>(a), b);
        if (op.kind == Op::law) twin.law(op.a, b);
        if (op.kind == Op::hang) twin.hang(a != 0);
        if (op.kind == Op::broken) twin.break_wire(static_cast<In>(a), b != 0);
        sight.status = twin.status();
        sight.latch = twin.latch();
        sight.position = twin.position();
        sight.pulses = twin.output_pulses();
        out.sights.push_back(sight);
        note_outputs(twin, last, out.changes);
    }
    out.changes = oracle::settled(std::move(out.changes), first_outputs());
    out.notes = twin.notes();
    return out;
}

void run_both(const Program& program, oracle::Comparison& both) {
    const Outcome twin = run_on_twin(program), card = run_on_card(program);
    both.same_elements("after op", twin.sights, card.sights);
    both.same_elements("change of the outputs", twin.changes, card.changes);
    both.same_elements("condition", twin.notes, card.notes);
    both.count("accesses and wire changes", program.ops.size());
    both.count("ms", program.ops.back().slice / 2'000);
    both.count("changes of outputs", twin.changes.size());
    both.count("conditions", twin.notes.size());
    both.count("pulses net", std::llabs(twin.sights.back().pulses));
}

std::string listing_of(const Program& program) {
    const Strapping& s = program.strapping;
    return fmt::format("source {}, pass {} ticks, byte {} slices, folding {} from {}{}{}\n", static_cast<int>(s.source),
                       s.firmware_pass_ticks, s.byte_slices, s.folding, s.first_pair, s.up_down ? ", up/down" : "",
                       program.follow_fout ? ", fout followed" : "") +
           oracle::text_of_steps(program.ops);
}

void PrintTo(const Op& op, std::ostream* out) {
    constexpr const char* kinds[] = {"out", "in", "wire", "law", "hang", "broken"};
    *out << fmt::format("slice {} {} {} {}", op.slice, kinds[op.kind], op.a, op.b);
}
void PrintTo(const Sight& s, std::ostream* out) {
    *out << fmt::format("value {:02X} status {:02X} latch {:02X} position {} pulses {}", s.value, s.status, s.latch,
                        s.position, s.pulses);
}
void PrintTo(const Note& note, std::ostream* out) {
    *out << fmt::format("{} ({}, {}) at slice {}", note.code, note.a, note.b, note.slice);
}

}  // namespace motionrack::databoard4002::twin
