// Random programs of accesses, edges and stops give the same result on the card and its twin.
//
// tests/oracle/harness.hpp names the variables of the environment that select other and more programs.
#include <gtest/gtest.h>

#include <motionrack/cards/io8255/test/rig.hpp>
#include <motionrack/cards/io8255/test/twin.hpp>
#include <random>
#include <tests/oracle/harness.hpp>

namespace motionrack::io8255 {

namespace twin {
/// For messages of failed tests.
void PrintTo(const Note& note, std::ostream* out) {
    *out << "{" << note.code << ", " << note.a << ", " << note.b << "}";
}
}  // namespace twin

namespace {

struct Op {
    enum Kind { wire, write, read, stop } kind = wire;
    int a = 0, b = 0;
};

void PrintTo(const Op& op, std::ostream* out) {
    constexpr const char* kinds[] = {"wire", "write", "read", "stop"};
    *out << fmt::format("{} {} {}", kinds[op.kind], op.a, op.b);
}

struct Program {
    std::vector<Op> ops;
    std::size_t snapshot_at = oracle::never;
};

std::string listing_of(const Program& program) {
    return oracle::text_of_steps(program.ops);
}

class Maker {
  public:
    explicit Maker(std::uint64_t seed) : random_(seed) {}

    Program make() {
        Program out;
        out.ops.push_back({Op::write, 3, 0x80 | below(64)});
        const std::size_t length = 20 + static_cast<std::size_t>(below(200));
        while (out.ops.size() < length) out.ops.push_back(one());
        out.ops.push_back({Op::read, 2});
        return out;
    }

  private:
    int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
    Op one() {
        const int what = below(100);
        if (what < 40) {  // mostly strobes
            constexpr int strobes[] = {18, 20, 22};
            return {Op::wire, below(2) == 0 ? strobes[below(3)] : below(24), below(2)};
        }
        if (what < 65) return {Op::read, below(40) == 0 ? below(256) : below(3)};
        if (what < 80) return {Op::write, below(3), below(4) == 0 ? 0 : below(256)};
        if (what < 95) return {Op::write, 3, below(16)};
        if (what < 97) return {Op::stop};
        if (what < 99) return {Op::write, 3, 0x80 | below(128)};
        return {Op::write, below(256), below(256)};
    }

    std::mt19937_64 random_;
};

/// Complete outcome of a program: bytes read and levels of the outputs, then the conditions.
struct Outcome {
    std::vector<int> words;
    std::vector<twin::Note> notes;
};

Outcome on_twin(const Program& program) {
    twin::Twin twin;
    Outcome out;
    for (const Op& op : program.ops) {
        if (op.kind == Op::wire) twin.wire(op.a, op.b != 0);
        if (op.kind == Op::write) twin.write(op.a, op.b);
        if (op.kind == Op::read) out.words.push_back(twin.read(op.a));
        if (op.kind == Op::stop) twin.stop();
        out.words.push_back(twin.outputs());
    }
    out.notes = twin.notes();
    return out;
}

void execute(Rig& rig, const Op& op, std::vector<int>& words) {
    constexpr std::size_t first_input = 24;
    if (op.kind == Op::wire) rig.set(std::string(map::pins[first_input + static_cast<std::size_t>(op.a)].name), op.b);
    if (op.kind == Op::write) rig.port.out(static_cast<std::uint8_t>(op.a), static_cast<std::uint8_t>(op.b));
    if (op.kind == Op::read) words.push_back(rig.port.in(static_cast<std::uint8_t>(op.a)));
    if (op.kind == Op::stop) {
        rig.card.clear_outputs();
        rig.kernel.settle();
    }
    const unsigned levels = rig.driven("a") | rig.driven("b") << 8 | rig.driven("c") << 16;
    words.push_back(static_cast<int>(levels | static_cast<unsigned>(rig.level("int")) << 24));
}

Outcome on_card(const Program& program) {
    Rig rig;
    rig.start();
    Outcome out;
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        if (i == program.snapshot_at)
            oracle::disturb_and_restore(
                rig.kernel,
                [&] {
                    for (const int value : {0x80, 0x09, 0xFF}) execute(rig, {Op::write, 3, value}, out.words);
                    execute(rig, {Op::wire, 20, 0}, out.words);
                },
                out.words);
        execute(rig, program.ops[i], out.words);
    }
    for (const sim::Condition& condition : rig.kernel.conditions())
        out.notes.push_back({condition.code, condition.a, condition.b});
    return out;
}

void run_both(const Program& program, oracle::Comparison& both) {
    const Outcome twin = on_twin(program), card = on_card(program);
    both.same_elements("word", twin.words, card.words);
    both.same_elements("condition", twin.notes, card.notes);
    both.count("accesses and wire changes", program.ops.size());
    both.count("conditions", twin.notes.size());
}

TEST(Io8255Oracle, RandomProgramsGiveTheSameReadingsOnTheCardAndItsTwin) {
    oracle::compare({0, oracle::programs(2'000), 8'255},
                    [](std::uint64_t seed, std::uint64_t number) { return Maker(seed + number).make(); });
}

TEST(Io8255Oracle, ARestoredSnapshotContinuesIdentically) {
    constexpr std::uint64_t first = 1'000'000;
    oracle::compare({first, 200, 8'255}, [](std::uint64_t seed, std::uint64_t number) {
        Program program = Maker(seed + number).make();
        program.snapshot_at = (number - first) % program.ops.size();
        return program;
    });
}

}  // namespace
}  // namespace motionrack::io8255
