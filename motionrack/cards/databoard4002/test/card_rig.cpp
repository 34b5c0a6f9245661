// Running a random program on the event-driven card.
#include <memory>
#include <motionrack/cards/databoard4002/model/card.hpp>
#include <motionrack/cards/databoard4002/test/program.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>
#include <utility>

namespace motionrack::databoard4002::twin {

namespace {

constexpr Duration slice_time = nanoseconds(500);

Settings settings_of(const Strapping& s) {
    Settings out;
    out.firmware_pass_ticks = s.firmware_pass_ticks;
    out.byte_time = slice_time * s.byte_slices;
    out.version = static_cast<std::uint8_t>(s.version);
    out.zeroing = s.zeroing;
    out.quit_zeroes = s.quit_zeroes;
    out.counting = s.up_down ? Counting::up_down : Counting::quadrature;
    out.folding = static_cast<sim::Edges>(s.folding);
    out.first_pair = s.first_pair;
    out.single_ended = s.single_ended;
    return out;
}

/// Follows a wire.
class Follower final : public sim::Device {
  public:
    explicit Follower(sim::Kernel& kernel) : id(kernel.add(*this, sim::Phase::observers, "follower")) {}
    void on_scheduled(Instant) override {}
    sim::DeviceId id;
};

struct World final : sim::Kernel::WireObserver {
    explicit World(const Program& program)
        : pulses(kernel, {}), card(kernel, "c", settings_of(program.strapping)), follower(kernel) {
        if (program.strapping.source == Strapping::Source::laws) card.connect_encoder(pulses);
        if (program.strapping.source == Strapping::Source::own_output) card.connect_encoder(card.pulses());
        for (int i = 0; i < 7; ++i) inputs[i] = kernel.find_wire("c." + std::string(card_map().pins[i].name));
        for (const char* name : {"c.vout", "c.sign", "c.relay", "c.rst", "c.int"})
            outputs.push_back(kernel.find_wire(name));
        kernel.listen(kernel.find_wire("c.fout"), follower.id, 0);
        kernel.observe_wires(this);
        kernel.start();
    }
    void wire_changed(sim::WireId wire, int level, Instant now) override {
        for (std::size_t i = 0; i < outputs.size(); ++i)
            if (outputs[i] == wire) raw.push_back({now / slice_time, static_cast<int>(i), level});
    }
    void run(Instant until) {
        while (kernel.run_until(until) == sim::RunEnd::broken) {
        }
    }
    void disturb() {
        card.out(ports::C3, 0);
        run(kernel.now() + milliseconds(3));
        card.out(ports::C2, 'O');
        run(kernel.now() + milliseconds(3));
    }
    Sight apply(const Op& op) {
        Sight sight;
        const Instant now = kernel.now();
        constexpr const char* faults[] = {"", "", "", "ref.broken", "ems.broken", "esr.broken", "esl.broken"};
        if (op.kind == Op::out) card.out(static_cast<std::uint8_t>(op.a), static_cast<std::uint8_t>(op.b));
        if (op.kind == Op::in) sight.value = card.in(static_cast<std::uint8_t>(op.a));
        if (op.kind == Op::wire) kernel.set_wire(inputs[op.a], static_cast<int>(op.b));
        if (op.kind == Op::law) pulses.drive(Duration{op.a}, op.b);
        if (op.kind == Op::hang) card.fault("watchdog.hang", static_cast<double>(op.a), now);
        if (op.kind == Op::broken) card.fault(faults[op.a], static_cast<double>(op.b), now);
        run(now);
        sight.status = card.peek(ports::STAT);
        sight.latch = card.peek(ports::DATA);
        sight.position = card.position();
        sight.pulses = card.pulses().count(now);
        return sight;
    }
    sim::Kernel kernel;
    sim::FakePulses pulses;
    Card card;
    Follower follower;
    sim::WireId inputs[7];
    std::vector<sim::WireId> outputs;
    std::vector<oracle::Change> raw;
};

}  // namespace

Outcome run_on_card(const Program& program) {
    World world(program);
    Outcome out;
    if (!program.follow_fout) world.kernel.subscribe(world.kernel.find_wire("c.fout"), world.follower.id, false);
    world.run(Instant{0});
    if (program.follow_fout) world.kernel.subscribe(world.kernel.find_wire("c.fout"), world.follower.id, true);
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        world.run(slice_time * program.ops[i].slice);
        out.sights.push_back(world.apply(program.ops[i]));
        if (i == program.snapshot_at)
            oracle::disturb_and_restore(
                world.kernel, [&] { world.disturb(); }, world.raw);
    }
    out.changes = oracle::settled(std::move(world.raw), first_outputs());
    for (const sim::Condition& c : world.kernel.conditions())
        out.notes.push_back({c.at / slice_time, c.code, c.a, c.b});
    return out;
}

}  // namespace motionrack::databoard4002::twin
