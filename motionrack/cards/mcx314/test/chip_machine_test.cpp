// The declared state machines against the chip: checked after every access and every tick, it follows only transitions
// of their tables, and takes every one of them.
#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <motionrack/cards/mcx314/test/program.hpp>
#include <set>
#include <utility>

namespace motionrack::mcx314::outside {
namespace {

struct Machine {
    std::string_view name;     // name in the map
    std::string_view value;    // name of the value that Chip::inspect returns
    int instances;             // number of axes, or 1
    std::string_view passing;  // states that may be passed at once: "a b c"
};
// Why states may be passed: a drive whose end is reached at its first working tick ends at once, and is in position at
// once if that input is disabled. A queued segment without pulses takes over and ends in one tick. A step may be
// requested just after the command of its segment.
constexpr Machine machines[] = {
    {"drive", "DRIVE_STATE", 4, "driving final in_position"},
    {"continuous interpolation", "QUEUE_STATE", 1, "running"},
    {"bit pattern", "PATTERN_STATE", 1, ""},
    {"bit-pattern stack", "STACK_STATE", 1, ""},
    {"single steps", "STEP_STATE", 1, "waiting"},
    {"drive by wire", "EXPP_STATE", 4, ""},
    {"drive by wire", "EXPM_STATE", 4, ""},
    {"home search", "HOME_STATE", 4, ""},
    {"input filter", "FILTER_STATE", 4, ""},
    {"deviation counter clear", "CLEAR_STATE", 4, ""},
    {"synchronous action", "ACTION_STATE", 4, ""},
};
constexpr std::size_t machines_of_original = 7;

const MachineInfo& declared_machine(std::string_view name) {
    for (const MachineInfo& each : card_map().machines)
        if (each.name == name) return each;
    throw std::out_of_range(std::string(name));
}

// Returns true if the table leads from one state to another, with only passing states in between.
bool leads(const MachineInfo& info, std::string_view passing, int from, int to) {
    std::set<int> reached = {from}, looked;
    while (reached.size() > looked.size())
        for (const int at : std::set<int>(reached)) {
            if (!looked.insert(at).second) continue;
            if (at != from && passing.find(info.states[static_cast<std::size_t>(at)].name) == std::string_view::npos)
                continue;
            for (const TransitionInfo& t : info.transitions)
                if (state_index(info, t.from) == at) reached.insert(state_index(info, t.to));
        }
    return reached.count(to) == 1;
}

class Watched {
  public:
    Watched(std::set<std::string>& taken, Variant variant) : b_(variant), taken_(taken) {
        b_.start();
        for (std::size_t m = 0; m < std::size(machines); ++m)
            for (int a = 0; a < machines[m].instances; ++a) before_[m][a] = state(m, a);
    }
    void run(const twin::Program& program) {
        for (const twin::Op& op : program.ops) {
            while (b_.kernel.now() + tick <= op.tick * tick) {
                b_.advance(tick);
                poll(false);
            }
            apply(op);
            poll(op.kind == twin::Op::Kind::write && op.offset == 0 && (op.value & 0x8000) != 0);
        }
    }
    std::string problem;

  private:
    void apply(const twin::Op& op) {
        static constexpr const char* pins[] = {"in0",  "in1",   "in2",   "in3",  "expp",
                                               "expm", "inpos", "alarm", "lmtp", "lmtm"};
        switch (op.kind) {
            case twin::Op::Kind::write:
                return b_.chip.write(op.offset, op.value), b_.kernel.settle();
            case twin::Op::Kind::write_byte:
                return b_.chip.write_byte(op.offset, static_cast<std::uint8_t>(op.value)), b_.kernel.settle();
            case twin::Op::Kind::input:
                return b_.wire(std::string(1, "xyzu"[op.axis]) + pins[static_cast<int>(op.pin)], op.value);
            case twin::Op::Kind::step:
                return b_.wire("expls_n", op.value);
            default:
                return;
        }
    }
    int state(std::size_t m, int a) const { return static_cast<int>(*b_.chip.inspect(machines[m].value, a)); }
    void poll(bool reset) {
        for (std::size_t m = 0; m < std::size(machines); ++m) {
            const MachineInfo& info = declared_machine(machines[m].name);
            for (int a = 0; a < machines[m].instances; ++a) {
                const int from = std::exchange(before_[m][a], state(m, a)), to = before_[m][a];
                if (from == to) continue;
                const std::string way = std::string(info.name) + ": " + std::string(info.states[from].name) + " -> " +
                                        std::string(info.states[to].name);
                taken_.insert(way);
                if (reset ? to != 0 : !leads(info, machines[m].passing, from, to))
                    problem = way + " at tick " + std::to_string(b_.kernel.now() / tick);
            }
        }
    }

    Bench b_;
    std::set<std::string>& taken_;
    std::array<std::array<int, 4>, std::size(machines)> before_{};
};

void watch_programs(std::set<std::string>& taken, std::uint64_t first, std::uint64_t count, Variant variant) {
    constexpr std::uint64_t seed = 1;
    std::cout << "seed " << seed << ", programs " << first << " .. " << first + count - 1 << std::endl;
    for (std::uint64_t number = first; number < first + count; ++number) {
        const twin::Program program = twin::make_program(seed, number, {variant});
        if (program.ticks > 20'000) continue;
        Watched watched(taken, variant);
        watched.run(program);
        ASSERT_EQ(watched.problem, "") << twin::listing_of(program);
    }
}
void expect_every_way(const std::set<std::string>& taken, std::size_t from, std::size_t to) {
    for (std::size_t m = from; m < to; ++m) {
        const MachineInfo& info = declared_machine(machines[m].name);
        for (const TransitionInfo& t : info.transitions) {
            if (t.from == t.to) continue;
            const std::string way = std::string(info.name) + ": " + std::string(t.from) + " -> " + std::string(t.to);
            EXPECT_EQ(taken.count(way), 1u) << way << " was never taken";
        }
    }
}

TEST(ChipStateTables, TheChipTakesEveryTransitionOfItsStateTablesAndNoOther) {
    std::set<std::string> taken;
    watch_programs(taken, 4'000'000, 500, Variant::mcx314);
    for (int axis = 0; axis < 4; ++axis) {  // transitions that last one tick only
        using Kind = twin::Op::Kind;
        const auto select = static_cast<std::uint16_t>(0x010F << axis);
        const auto n = static_cast<std::int8_t>(axis);
        twin::Program program;
        program.ops = {{0, false, Kind::write, 0, select},
                       {0, false, Kind::write, 6, 0x0008},
                       {5, true, Kind::input, 0, 0, n, twin::Pin::exp_plus},
                       {6, false, Kind::write, 6, 0x0000},
                       {8, false, Kind::input, 0, 1, n, twin::Pin::exp_plus}};
        Watched watched(taken, Variant::mcx314);
        watched.run(program);
        EXPECT_EQ(watched.problem, "");
    }
    expect_every_way(taken, 0, machines_of_original);
}

TEST(ChipStateTables, TheMcx314AsTakesEveryTransitionOfItsStateTablesAndNoOther) {
    std::set<std::string> taken;
    watch_programs(taken, 14'000'000, 600, Variant::mcx314as);
    expect_every_way(taken, machines_of_original, std::size(machines));
}

}  // namespace
}  // namespace motionrack::mcx314::outside
