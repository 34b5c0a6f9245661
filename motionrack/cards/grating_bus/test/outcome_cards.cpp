// Runs a random program on the event-driven cards.
#include <algorithm>
#include <map>
#include <memory>
#include <motionrack/cards/grating_bus/test/outcome.hpp>
#include <motionrack/cards/grating_bus/test/rig.hpp>

namespace motionrack::grating_bus::twin {

namespace {

class StepMotion final : public sim::PositionFunction {
  public:
    explicit StepMotion(const Course& motion) : motion_(motion) {}
    std::int64_t count(Instant t) const override { return motion_.at(t.count()); }
    double rate(Instant) const override { return 0; }
    void watch(int, std::int64_t, std::int64_t) override {}
    int add_listener(sim::PositionListener&) override { return 0; }
    void set_edge_listener(sim::EdgeListener*) override {}
    void deliver_edges() override {}

  private:
    Course motion_;
};

class Changes final : public sim::Kernel::WireObserver {
  public:
    explicit Changes(const std::vector<sim::WireId>& wires) {
        for (const sim::WireId wire : wires) numbers_.emplace(wire, static_cast<int>(numbers_.size()));
    }
    void wire_changed(sim::WireId wire, int level, Instant now) override {
        if (const auto at = numbers_.find(wire); at != numbers_.end()) raw.push_back({now.count(), at->second, level});
    }
    std::vector<oracle::Change> raw;

  private:
    std::map<sim::WireId, int> numbers_;
};

grating_bus::CardSettings settings_of(const CardSettings& from, std::uint32_t seed) {
    grating_bus::CardSettings out;
    out.role = from.host ? CardRole::host : CardRole::slave;
    out.scales = from.words, out.first = from.first, out.addresses = from.list;
    out.timing = {Duration{from.t1}, Duration{from.t2}, Duration{from.t3}, Duration{from.clock}};
    out.period = Duration{from.period}, out.offset = Duration{from.offset};
    out.clock_shifter = from.clock_out ? Shifter::out : Shifter::in;
    out.address_shifter = from.address_out ? Shifter::out : Shifter::in;
    out.verify_lines = from.verify_lines;
    out.seed = seed;
    return out;
}

std::string text_of_cards(const Frame& frame) {
    return row({frame.sequence, frame.time, frame.words, frame.crc}).append(words_of(frame));
}

/// A kernel with the program's cards and its decoder.
struct World {
    explicit World(const Program& program) {
        for (std::size_t i = 0; i < program.cards.size(); ++i) {
            const std::string name = std::string("c").append(std::to_string(i));
            cards.push_back(std::make_unique<Card>(kernel, name, bus, settings_of(program.cards[i], program.seeds[i])));
            listeners.push_back(std::make_unique<RecordingListener>());
            cards.back()->add_listener(*listeners.back());
        }
        grating_bus::DecoderSettings settings;
        settings.scales = program.decoder.scales;
        settings.latch = Duration{program.decoder.latch}, settings.output = Duration{program.decoder.output};
        decoder = std::make_unique<Decoder>(kernel, "decoder", bus, settings);
        for (std::size_t i = 0; i < program.scales.size(); ++i) {
            motions.push_back(std::make_unique<StepMotion>(program.scales[i]));
            decoder->connect(static_cast<int>(i), motions.back().get());
        }
        for (int line = 0; line < line_count; ++line)
            for (int bit = 0; bit < width[line]; ++bit)
                wires.push_back(wire(static_cast<Line>(line), width[line] > 1 ? bit : -1));
        for (std::size_t i = 0; i < cards.size(); ++i)
            for (const char* pin : {".state", ".frame_done"})
                wires.push_back(kernel.find_wire(std::string("c").append(std::to_string(i)).append(pin)));
        watcher.connect();
        kernel.start();
    }
    sim::WireId wire(Line line, int bit) const {
        constexpr const char* names[] = {"bus.clk", "bus.hold", "bus.read_n", "bus.addr", "bus.data"};
        return kernel.find_wire(bit < 0 ? names[line] : names[line] + std::to_string(bit));
    }
    void run_to(Instant at) {
        while (kernel.run_until(at) == sim::RunEnd::broken) {
        }
    }
    void settle() {
        while (kernel.run_until(kernel.now()) == sim::RunEnd::broken) {
        }
    }
    void carry_out(const Op& op);
    /// Lets the cards continue, then restores them and the recorded changes.
    void disturb(Ticks at, std::vector<oracle::Change>& changes);
    void poll(Outcome& out, Ticks at) const;

    sim::Kernel kernel;
    Bus bus{kernel};
    Watcher watcher{kernel};
    std::unique_ptr<Decoder> decoder;
    std::vector<std::unique_ptr<StepMotion>> motions;
    std::vector<std::unique_ptr<RecordingListener>> listeners;
    std::vector<std::unique_ptr<Card>> cards;
    std::vector<sim::WireId> wires;
};

void World::carry_out(const Op& op) {
    const Instant now = kernel.now();
    const double ns = static_cast<double>(op.a) / 10;
    const auto control = [&](const char* field) {
        for (const FieldInfo& info : map::control_fields)
            if (info.name == std::string_view(field))
                cards[op.who]->write(offset("CONTROL"), static_cast<std::uint16_t>(info.mask));
    };
    Card& card = *cards[op.who];
    bool done = true;
    if (op.kind == Op::off) done = card.fault("off", static_cast<double>(op.a), now);
    if (op.kind == Op::reset && op.a == 0) control("RESET");
    if (op.kind == Op::reset && op.a != 0) done = card.fault("reset", 1, now);
    if (op.kind == Op::late) done = card.fault("late", ns, now);
    if (op.kind == Op::miss_edges) done = card.fault("miss_edge", static_cast<double>(op.a), now);
    if (op.kind == Op::jitter) done = card.fault("jitter", ns, now);
    if (op.kind == Op::no_latch) done = decoder->fault("no_latch", static_cast<double>(op.a), now);
    if (op.kind == Op::force) kernel.force(wire(op.line, op.bit), static_cast<int>(op.a));
    if (op.kind == Op::release) kernel.release(wire(op.line, op.bit));
    if (op.kind == Op::claim) control("CLAIM");
    if (op.kind == Op::give_back) control("RELEASE");
    if (op.kind == Op::clear) control("CLEAR_ERRORS");
    MOTIONRACK_ASSERT(done);
    settle();
}

void World::disturb(Ticks at, std::vector<oracle::Change>& changes) {
    std::vector<RecordingListener> heard;
    for (const auto& listener : listeners) heard.push_back(*listener);
    oracle::disturb_and_restore(
        kernel,
        [&] {
            carry_out({at, Op::force, 0, 1, hold, -1});
            run_to(kernel.now() + microseconds(3));
        },
        changes);
    for (std::size_t card = 0; card < heard.size(); ++card) listeners[card]->heard = heard[card].heard;
}

void World::poll(Outcome& out, Ticks at) const {
    std::string text = row({at});
    for (int line = 0; line < line_count; ++line) text.append(row({bus.level(static_cast<grating_bus::Line>(line))}));
    out.looks.push_back(text);
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const Card& card = *cards[i];
        const auto two = [&card](std::uint32_t where) {
            return card.peek(where) | std::int64_t{card.peek(where + 2)} << 16;
        };
        const std::uint16_t status = card.peek(offset("STATUS"));
        text = row({at, static_cast<std::int64_t>(i), status & 1, status >> 1 & 1, status >> 2 & 1, status >> 4 & 1,
                    status >> 5 & 1, card.peek(offset("STATE")) & 15, two(offset("FRAMES_L"))});
        for (std::uint32_t where = offset("BROKEN"); where <= offset("OVERRUN"); where += 2)
            text.append(row({card.peek(where)}));
        const std::int64_t words = card.peek(offset("WORDS"));
        text.append(row({two(offset("SEQUENCE_L")), two(offset("TIME_0")) | two(offset("TIME_2")) << 32, words,
                         two(offset("CRC_L"))}));
        for (std::uint32_t k = 0; k < words; ++k)
            text.append(row({card.peek(addresses_at + 2 * k), two(counts_at + 4 * k)}));
        out.looks.push_back(text);
    }
}

}  // namespace

Outcome on_cards(const Program& program, Watch watch) {
    World world(program);
    std::vector<std::int64_t> levels;
    for (const sim::WireId wire : world.wires) levels.push_back(world.kernel.level(wire));
    Changes changes(world.wires);
    if (watch == Watch::everybody) {
        world.watcher.watch(true);
        world.kernel.observe_wires(&changes);
    }
    Outcome out;
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        const Op& op = program.ops[i];
        world.run_to(std::max(world.kernel.now(), Instant{op.at - static_cast<std::int64_t>(i % 3)}));
        world.run_to(Instant{op.at});
        if (watch == Watch::now_and_then && op.kind == Op::poll) world.watcher.watch(op.a != 0);
        world.carry_out(op);
        world.poll(out, op.at);
        if (i == program.snapshot_at) world.disturb(op.at, changes.raw);
    }
    for (std::size_t i = 0; i < world.cards.size(); ++i)
        for (const Heard& heard : world.listeners[i]->heard)
            out.frames.push_back(
                row({static_cast<std::int64_t>(i), heard.at.count()}).append(text_of_cards(heard.frame)));
    for (const sim::Condition& c : world.kernel.conditions())
        for (std::size_t i = 0; i < world.cards.size(); ++i)
            if (c.device == world.cards[i]->id() && (c.code == 2 || c.code == 5))
                out.reports.push_back(row({static_cast<std::int64_t>(i), c.at.count(), c.code}));
    std::sort(out.reports.begin(), out.reports.end());
    const Lines& lines = world.bus.lines();
    out.conflict_count = lines.all_conflicts();
    std::vector<grating_bus::Conflict> conflicts;
    for (std::uint64_t n = lines.all_conflicts() - std::min<std::uint64_t>(lines.all_conflicts(), Lines::kept);
         n < lines.all_conflicts(); ++n)
        conflicts.push_back(lines.conflict(n));
    std::stable_sort(conflicts.begin(), conflicts.end(), [](const auto& a, const auto& b) {
        return std::tie(a.begin, a.line) < std::tie(b.begin, b.line);
    });
    const std::size_t forgotten = out.conflict_count - conflicts.size();
    for (std::size_t i = first_compared(out.conflict_count) - forgotten; i < conflicts.size(); ++i) {
        const grating_bus::Conflict& c = conflicts[i];
        const auto number = [](std::uint64_t n) { return static_cast<std::int64_t>(n); };
        out.conflicts.push_back(row({c.begin.count(), c.end.count(), number(c.line), number(c.high), number(c.low)}));
    }
    out.changes = oracle::settled(std::move(changes.raw), std::move(levels));
    return out;
}

}  // namespace motionrack::grating_bus::twin
