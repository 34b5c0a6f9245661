// Random programs of register accesses and wire changes give the same result on the event-driven card and its slow
// twin.
//
// tests/oracle/harness.hpp names the variables of the environment that select other and more programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/cards/ioflex02/test/rig.hpp>
#include <motionrack/cards/ioflex02/test/twin.hpp>
#include <random>
#include <tests/oracle/harness.hpp>

namespace motionrack::ioflex02 {

namespace twin {
/// Prints a condition in messages of failed tests.
void PrintTo(const Note& note, std::ostream* out) {
    *out << "{" << note.code << ", " << note.a << ", " << note.b << "}";
}
}  // namespace twin

namespace {

constexpr Duration half = nanoseconds(50);

struct Op {
    std::int64_t at = 0;  ///< in halves of a sample
    enum Kind { wire, input, write, read, poll } kind = wire;
    int a = 0, b = 0, c = 0;
};

void PrintTo(const Op& op, std::ostream* out) {
    constexpr const char* kinds[] = {"wire", "input", "write", "read", "poll"};
    *out << fmt::format("half {} {} {} {} {}", op.at, kinds[op.kind], op.a, op.b, op.c);
}

struct Program {
    bool preloaded = false;
    std::int64_t configuration_halves = 0;
    std::vector<Op> ops;
    std::size_t snapshot_at = oracle::never;
};

std::string listing_of(const Program& program) {
    return fmt::format("{}, configured in {} halves\n", program.preloaded ? "preloaded" : "empty",
                       program.configuration_halves) +
           oracle::text_of_steps(program.ops);
}

class Maker {
  public:
    explicit Maker(std::uint64_t seed) : random_(seed) {}

    Program make() {
        Program out;
        out.preloaded = below(3) != 0;
        out.configuration_halves = static_cast<std::int64_t>(below(4) == 0 ? 0 : below(300));
        program_ = &out;
        activity_ = 1 + below(60);
        if (!out.preloaded) configure();
        const std::size_t length = 30 + below(300);
        while (out.ops.size() < length) one();
        op(Op::poll);
        return out;
    }

  private:
    std::uint64_t below(std::uint64_t n) { return random_() % n; }
    void op(Op::Kind kind, int a = 0, int b = 0, int c = 0) { program_->ops.push_back({at_, kind, a, b, c}); }
    void wait() {
        if (below(5) == 0) return;  // at the same instant
        at_ += static_cast<std::int64_t>(below(20) == 0 ? below(3000) : below(activity_ * 2));
    }

    void configure() {
        ImageContent content;
        if (below(5) == 0) content.project = below(2) ? "stepper" : "positions";
        content.ident = static_cast<std::uint8_t>(below(256));
        content.payload.resize(8 + below(20));
        for (std::uint8_t& b : content.payload) b = static_cast<std::uint8_t>(below(4) ? 0 : below(256));
        std::vector<std::uint8_t> raw = *raw_image(content);
        if (below(4) == 0) raw[below(raw.size())] ^= static_cast<std::uint8_t>(1u << below(8));
        if (below(6) == 0) raw.resize(below(raw.size()));
        op(Op::write, 0x00, 1);
        for (std::size_t i = 0; i < raw.size(); i += 2) {
            if (below(10) == 0) wait();
            op(Op::write, 0x02, raw[i] | (i + 1 < raw.size() ? raw[i + 1] << 8 : static_cast<int>(below(256)) << 8));
        }
        if (below(2)) op(Op::write, 0x00, 2);
    }

    void one() {
        wait();
        const int axis = static_cast<int>(below(4));
        const std::uint64_t what = below(100);
        if (what < 55) {  // an encoder moves, usually correctly
            phase_[axis] += below(8) == 0 ? static_cast<std::int64_t>(below(4)) : (below(6) ? 1 : -1);
            const int lines = lines_of_phase(phase_[axis]);
            op(Op::wire, axis, 0, lines & 1);
            if (below(30) == 0) wait();
            op(Op::wire, axis, 1, lines >> 1);
        } else if (what < 65) {
            op(Op::wire, axis, static_cast<int>(below(4)), static_cast<int>(below(2)));
        } else if (what < 75) {
            op(Op::wire, axis, 2 + static_cast<int>(below(2)), static_cast<int>(below(2)));
        } else if (what < 78) {
            op(Op::input, static_cast<int>(below(16)), static_cast<int>(below(2)));
        } else if (what < 84) {
            op(Op::write, 0x12, static_cast<int>(below(2) ? below(256) : below(65536)));
        } else if (what < 88) {
            op(Op::write, 0x10, static_cast<int>(below(4)));
        } else if (what < 91) {
            op(Op::write, 0x18, axis);
            op(Op::write, 0x62, static_cast<int>(below(2) ? below(16) : below(256)));
        } else if (what < 94) {
            constexpr int registers[] = {0x00, 0x02, 0x14, 0x16, 0x18, 0x03, 0x30, 0xFE};
            const int at = registers[below(8)];
            op(Op::write, at, static_cast<int>(at == 0 ? below(6) ? 8 : 4 : below(65536)));
        } else if (what < 98) {
            op(Op::read, static_cast<int>(below(0x70)));
        } else if (what == 98 && below(3) == 0) {
            configure();
        } else {
            op(Op::poll);
        }
    }

    std::mt19937_64 random_;
    Program* program_ = nullptr;
    std::int64_t at_ = 1;
    std::uint64_t activity_ = 10;
    std::int64_t phase_[4] = {};
};

/// Complete outcome of a program: the values read, then the conditions.
struct Outcome {
    std::vector<int> words;
    std::vector<twin::Note> notes;
};

template <class Read, class Write>
void poll(std::vector<int>& out, Read read, Write write) {
    write(0x10, 1);
    for (int at = 0; at <= 0x44; at += 2) out.push_back(read(at));
    for (int axis = 0; axis < 4; ++axis) {
        write(0x18, axis);
        for (int at = 0x50; at <= 0x62; at += 2) out.push_back(read(at));
    }
}

Outcome on_twin(const Program& program) {
    twin::Twin twin(program.preloaded, position_ident, 7, program.configuration_halves);
    Outcome out;
    const auto read = [&](int at) { return twin.read(at); };
    const auto write = [&](int at, int value) { twin.write(at, value); };
    for (const Op& op : program.ops) {
        twin.run_to(op.at);
        if (op.kind == Op::wire) twin.wire(op.a, op.b, op.c);
        if (op.kind == Op::input) twin.input(op.a, op.b);
        if (op.kind == Op::write) twin.write(op.a, op.b);
        if (op.kind == Op::read) out.words.push_back(twin.read(op.a));
        if (op.kind == Op::poll) poll(out.words, read, write);
        out.words.push_back(twin.outputs());
    }
    out.notes = twin.notes();
    return out;
}

Outcome on_card(const Program& program) {
    sim::Kernel kernel;
    Settings settings;
    settings.serial = 7;
    settings.preloaded = program.preloaded;
    settings.configuration_time = half * program.configuration_halves;
    Card card(kernel, "c", settings);
    kernel.start();
    Outcome out;
    const auto read = [&](int at) {
        const int peeked = card.peek(static_cast<std::uint32_t>(at)), value = card.read(static_cast<std::uint32_t>(at));
        return peeked == value ? value : -1;  // no word
    };
    const auto write = [&](int at, int value) {
        card.write(static_cast<std::uint32_t>(at), static_cast<std::uint16_t>(value));
        kernel.settle();
    };
    const auto wire = [&](const std::string& name, int level) {
        kernel.set_wire(kernel.find_wire("c." + name), level);
        kernel.settle();
    };
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        const Op& op = program.ops[i];
        // In two runs, divided anywhere: this must have no effect.
        kernel.run_until(std::max(kernel.now(), half * (op.at - static_cast<std::int64_t>(i % 3))));
        kernel.run_until(half * op.at);
        if (i == program.snapshot_at)
            oracle::disturb_and_restore(kernel, [&] {
                write(0x00, 1);
                kernel.run_until(kernel.now() + microseconds(5));
            });
        if (op.kind == Op::wire)
            wire(std::string{"abz"[op.b % 3]}.replace(0, op.b == 3, op.b == 3 ? "cal" : "") + std::to_string(op.a),
                 op.c);
        if (op.kind == Op::input) wire("in" + std::to_string(op.a), op.b);
        if (op.kind == Op::write) write(op.a, op.b);
        if (op.kind == Op::read) out.words.push_back(read(op.a));
        if (op.kind == Op::poll) poll(out.words, read, write);
        int outputs = 0;
        for (int n = 0; n < 16; ++n) outputs |= kernel.level(kernel.find_wire("c.out" + std::to_string(n))) << n;
        out.words.push_back(outputs);
    }
    for (const sim::Condition& c : kernel.conditions()) out.notes.push_back({c.code, c.a, c.b});
    return out;
}

void run_both(const Program& program, oracle::Comparison& both) {
    Outcome twin = on_twin(program), card = on_card(program);
    both.same_elements("word", twin.words, card.words);
    // An illegal transition is reported when it is processed, so only the order may differ.
    std::sort(twin.notes.begin(), twin.notes.end());
    std::sort(card.notes.begin(), card.notes.end());
    both.same_elements("condition", twin.notes, card.notes);
    both.count("accesses and wire changes", program.ops.size());
    both.count("words read", twin.words.size());
    both.count("conditions", twin.notes.size());
}

constexpr std::uint64_t usual_seed = 20'261'121;

TEST(Ioflex02Oracle, RandomProgramsGiveTheSameReadingsOnTheCardAndItsTwin) {
    oracle::compare({0, oracle::programs(3000), usual_seed},
                    [](std::uint64_t seed, std::uint64_t number) { return Maker(seed + number).make(); });
}

TEST(Ioflex02Oracle, ARestoredSnapshotContinuesIdentically) {
    constexpr std::uint64_t first = 1'000'000;
    oracle::compare({first, 300, usual_seed}, [](std::uint64_t seed, std::uint64_t number) {
        Program program = Maker(seed + number).make();
        program.snapshot_at = (number - first) % program.ops.size();
        return program;
    });
}

}  // namespace
}  // namespace motionrack::ioflex02
