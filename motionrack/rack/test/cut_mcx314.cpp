// Commands to an MCX314: drives, S-curves, paths and homing on machines of two axes, with faults; and the register
// programs of the comparison between the chip and its twin, which reach all of its modes.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <motionrack/cards/mcx314/test/program.hpp>
#include <motionrack/rack/test/cut.hpp>

namespace motionrack::rack::cut {
namespace {

using mcx314::ChipOptions;
using mcx314::twin::Op;

constexpr double released = std::numeric_limits<double>::quiet_NaN();

void command(Orders& out, std::uint64_t axes, std::uint64_t code) {
    out.push_back(bus("c1", 16, 0x00, axes << 8 | code));
}

void data(Orders& out, std::uint64_t axes, std::uint64_t code, std::uint64_t value) {
    out.push_back(bus("c1", 16, 0x0E, value >> 16 & 0xFFFF));
    out.push_back(bus("c1", 16, 0x0C, value & 0xFFFF));
    command(out, axes, code);
}

/// Writes WR1 .. WR3 of some axes.
void mode(Orders& out, std::uint64_t axes, std::uint32_t number, std::uint64_t value) {
    command(out, axes, 0x0F);
    out.push_back(bus("c1", 16, 2 * number, value));
}

void speeds(Orders& out, std::uint64_t axes, Random& random) {
    data(out, axes, 0x00, drawn(random, 16'000, 8'000'000));
    data(out, axes, 0x01, drawn(random, 1, 65'535));
    data(out, axes, 0x02, drawn(random, 1, 8'000));
    data(out, axes, 0x03, drawn(random, 1, 8'000));
    data(out, axes, 0x04, drawn(random, 1, 500));
    data(out, axes, 0x05, drawn(random, 1, 8'000));
}

/// Writes a line or an arc, queued behind the running one if there is one.
void path(Orders& out, Random& random) {
    for (unsigned axis = 1; axis <= 2; axis <<= 1) {
        data(out, axis, 0x06, below(random, 4'000) - 2'000);
        data(out, axis, 0x08, below(random, 4'000) - 2'000);
    }
    out.push_back(bus("c1", 16, 0x0A, 0x0004 | below(random, 4) << 8));
    command(out, 0, drawn(random, 0x30, 0x33));
}

/// Writes a bit pattern of one to three words, sometimes without an end, then its drive command.
void pattern(Orders& out, Random& random) {
    command(out, 0, 0x36);
    for (std::uint64_t words = drawn(random, 1, 3); words > 0; --words) {
        for (std::uint32_t offset = 0x04; offset <= 0x0E; offset += 2) {
            const std::uint64_t steps = random() & 0xFFFF;
            out.push_back(bus("c1", 16, offset, offset % 4 == 0 ? steps & 0x5555 : steps & 0xAAAA));
        }
        if (words == 1 && below(random, 2) == 0)
            for (const std::uint32_t offset : {0x04u, 0x06u}) out.push_back(bus("c1", 16, offset, 0x8000));
        command(out, 0, 0x38);
    }
    command(out, 0, 0x37);
    out.push_back(bus("c1", 16, 0x0A, 0x0004));
    command(out, 0, 0x34);
}

/// Starts a homing that only the MCX314As supports; the original refuses it.
void search_home(Orders& out, std::uint64_t axes, Random& random) {
    data(out, axes, 0x60, random());
    data(out, axes, 0x61, drawn(random, 1, 1'000));
    command(out, axes, drawn(random, 0x62, 0x63));
}

void move_wire(Orders& out, Random& random) {
    static constexpr std::array inputs = {"in0",   "in1",   "in2",  "in3",  "expp", "expm",
                                          "inpos", "alarm", "lmtp", "lmtm", "eca",  "ecb"};
    const char axis = "xyzu"[below(random, 4)];
    const std::string pin = below(random, 12) == 0  ? "emgn"
                            : below(random, 8) == 0 ? "expls_n"
                                                    : axis + std::string(inputs[below(random, inputs.size())]);
    const std::uint64_t to = below(random, 4);
    out.push_back(level("c1." + pin, to == 0 ? 0.0 : to == 1 ? 1.0 : released));
}

void break_machine(Orders& out, Random& random) {
    static constexpr std::array faults = {"motor.stall",     "motor.stall=0",      "motor.push=30",
                                          "motor.push=-39",  "motor.lose_steps=3", "encoder.broken_a",
                                          "encoder.swapped", "encoder.swapped=0",  "limit_plus.stuck_closed",
                                          "home.stuck_open", "home.stuck_open=0"};
    const char* const what = faults[below(random, faults.size())];
    out.push_back(fault(what, below(random, 3) == 0 ? "B" : "X"));
}

Story on_machine(std::uint64_t seed, const char* settings) {
    Random random(seed);
    return {mcx314_machine(settings), steps_of(random, 60, &anything_to_pulse_chip)};
}

// ---- register programs

Order order_of(const Op& op) {
    const char axis = "xyzu"[static_cast<int>(op.axis) & 3];
    static constexpr std::array inputs = {"in0", "in1", "in2", "in3", "expp", "expm", "inpos", "alarm", "lmtp", "lmtm"};
    switch (op.kind) {
        case Op::Kind::write:
            return bus("c1", 16, op.offset, op.value);
        case Op::Kind::read:
            return peek("c1", 16, op.offset);
        case Op::Kind::write_byte:
            return bus("c1", 8, op.offset, op.value);
        case Op::Kind::read_byte:
            return peek("c1", 8, op.offset);
        case Op::Kind::emergency:
            return level("c1.emgn", op.value);
        case Op::Kind::step:
            return level("c1.expls_n", op.value);
        case Op::Kind::encoder:
            return level(fmt::format("c1.{}{}", axis, op.offset == 0 ? "eca" : "ecb"), op.value);
        default:
            return level(fmt::format("c1.{}{}", axis, inputs[static_cast<std::size_t>(op.pin)]), op.value);
    }
}

/// Returns register program `seed` for a chip alone or on a machine, with accesses that take no time.
Story register_program(std::uint64_t seed, ChipOptions options) {
    constexpr std::uint64_t tick_ns = 125;
    const mcx314::twin::Program program = mcx314::twin::make_program(0xC07, seed, options);
    const bool by_bytes = std::any_of(program.ops.begin(), program.ops.end(),
                                      [](const Op& op) { return op.kind == Op::Kind::write_byte; });
    const std::string settings = fmt::format("variant = \"{}\"\nbus = \"{}\"\nbus_access_ns = 0\n",
                                             program.extended() ? "mcx314as" : "mcx314", by_bytes ? "8-bit" : "16-bit");
    Story out;
    out.text = seed % 2 == 0 ? mcx314_machine(settings) : "[card.c1]\ntype = \"mcx314\"\n" + settings;
    out.steps.emplace_back();
    std::uint64_t now = 0;
    const auto pass_to = [&](std::uint64_t then) {
        out.steps.back().ns = then - now;
        now = then;
        out.steps.emplace_back();
    };
    for (const Op& op : program.ops) {
        const std::uint64_t then = static_cast<std::uint64_t>(op.tick) * tick_ns + (op.between ? tick_ns / 2 : 0);
        if (then > now) pass_to(then);
        out.steps.back().orders.push_back(order_of(op));
    }
    out.steps.back().ns = 10'000'000;
    return out;
}

}  // namespace

std::string mcx314_machine(std::string_view settings) {
    return fmt::format(R"([card.c1]
type = "mcx314"
{}[axis.X]
card = "c1"
channel = "x"
initial_position_mm = 3
[axis.X.switches]
limit_minus_mm = -2
limit_plus_mm = 5
home_mm = 1
[axis.B]
card = "c1"
channel = "y"
)",
                       settings);
}

Orders anything_to_pulse_chip(Random& random) {
    Orders out;
    const std::uint64_t axes = drawn(random, 1, 15);
    switch (below(random, 16)) {
        case 0:
            speeds(out, axes, random);
            break;
        case 1:
        case 2:  // a drive of a fixed number of pulses
            mode(out, axes, 3, below(random, 8) | below(random, 2) << 7);
            data(out, axes, 0x06, below(random, 4'000));
            data(out, axes, 0x07, below(random, 4'000));
            command(out, axes, drawn(random, 0x20, 0x21));
            break;
        case 3:  // an endless drive and a change of its velocity
            command(out, axes, drawn(random, 0x22, 0x23));
            data(out, axes, 0x05, drawn(random, 1, 4'000));
            break;
        case 4:
            command(out, axes, drawn(random, 0x24, 0x27));
            break;
        case 5:
        case 6:
            path(out, random);
            break;
        case 7:
            pattern(out, random);
            break;
        case 8:
            search_home(out, axes, random);
            break;
        case 9:
        case 10:
            out.push_back(peek("c1", 16, 2 * static_cast<std::uint32_t>(below(random, 8))));
            break;
        case 11:
        case 12:
            move_wire(out, random);
            break;
        case 13:
            break_machine(out, random);
            break;
        case 14: {  // stops, interrupts, limits, comparisons, drives by wire
            const auto number = static_cast<std::uint32_t>(drawn(random, 1, 3));
            mode(out, axes, number, random() & 0xFFFF);
            data(out, axes, drawn(random, 0x09, 0x0D), below(random, 2'000) - 1'000);
            break;
        }
        default: {
            const auto offset = 2 * static_cast<std::uint32_t>(below(random, 8));
            out.push_back(bus("c1", 16, offset, random() & 0xFFFF));
        }
    }
    return out;
}

std::vector<Bench> mcx314_benches() {
    using mcx314::Variant;
    return {
        {"mcx314", [](std::uint64_t seed) { return on_machine(seed, ""); }},
        {"mcx314as", [](std::uint64_t seed) { return on_machine(seed, "variant = \"mcx314as\"\n"); }},
        {"mcx314_programs", [](std::uint64_t seed) { return register_program(seed, {}); }},
        {"mcx314as_programs",
         [](std::uint64_t seed) { return register_program(seed, {.variant = Variant::mcx314as}); }},
    };
}

}  // namespace motionrack::rack::cut
