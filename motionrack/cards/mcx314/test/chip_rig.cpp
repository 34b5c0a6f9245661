// Runs register programs on the event-driven chip: accesses between runs of the kernel, and wires forced between ticks
// or changed exactly at a tick.
#include <array>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/test/chip_rig.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::mcx314::twin {

namespace {

constexpr Duration one_tick = nanoseconds(125);

// Changes wires at an instant, before the chip reads them.
class Hand final : public sim::Device {
  public:
    explicit Hand(sim::Kernel& kernel) : kernel_(kernel), id_(kernel.add(*this, sim::Phase::wires, "hand")) {}
    /// Adds a change; all pending changes must be for the same instant.
    void move(sim::WireId wire, int level, Instant at) {
        moves_.emplace_back(wire, level);
        kernel_.schedule(id_, at);
    }
    bool idle() const { return moves_.empty(); }
    void on_scheduled(Instant) override {
        for (const auto& [wire, level] : moves_) kernel_.set_wire(wire, level);
        moves_.clear();
    }

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<std::pair<sim::WireId, int>> moves_;
};

// Records the edges of one axis.
class Edges final : public sim::EdgeListener {
  public:
    Edges(std::vector<Pulse>& pulses, int axis) : pulses_(pulses), axis_(axis) {}
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            const Instant at = batch.origin + batch.at[i] * batch.tick;
            const bool on_a_tick = at % one_tick == Duration{0};
            pulses_.push_back({on_a_tick ? at / one_tick : -1, axis_, batch.step});
        }
    }

  private:
    std::vector<Pulse>& pulses_;
    int axis_;
};

// Records the changes of the interrupt line.
class Requests final : public sim::Kernel::WireObserver {
  public:
    void wire_changed(sim::WireId changed, int level, Instant now) override {
        if (changed == wire) list.push_back({now / (one_tick / 2), level == 0});
    }
    sim::WireId wire{};
    std::vector<Request> list;
};

// Subscribes to changes of output pins, as a connected part would, and records them.
class Follower final : public sim::Device {
  public:
    Follower(sim::Kernel& kernel, std::vector<Change>& changes)
        : kernel_(kernel), id_(kernel.add(*this, sim::Phase::parts, "follower")), changes_(changes) {}
    void listen(sim::WireId wire, int axis, int pin) { kernel_.listen(wire, id_, 16 * axis + pin); }
    void want(sim::WireId wire) { kernel_.subscribe(wire, id_, true); }
    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override {
        changes_.push_back({now / (one_tick / 2), pin / 16, pin % 16, level != 0});
    }

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<Change>& changes_;
};

// Watches consecutive ranges of one axis' count.
class Watcher final : public sim::PositionListener {
  public:
    void begin(sim::PositionFunction& motion, int axis) {
        motion_ = &motion;
        axis_ = axis;
        slot_ = motion.add_listener(*this);
    }
    void watch(std::int64_t count) {
        const std::int64_t far = reach(axis_, list.size());
        motion_->watch(slot_, count - far, count + far);
    }
    void crossed(Instant now) override {
        const std::int64_t count = motion_->count(now);
        list.push_back({now % one_tick == Duration{0} ? now / one_tick : -1, axis_, count});
        watch(count);
    }
    void rate_changed(double, double, Instant) override {}
    std::vector<Crossing> list;

  private:
    sim::PositionFunction* motion_ = nullptr;
    int axis_ = 0;
    int slot_ = 0;
};

// A kernel with one chip, its wires and, optionally, an edge listener.
class Bench {
  public:
    explicit Bench(const Program& program) : program_(program), random_(program.way.slices) {
        const Way& way = program.way;
        static constexpr const char* pins[] = {"in0",  "in1",   "in2",   "in3",  "expp",
                                               "expm", "inpos", "alarm", "lmtp", "lmtm"};
        for (int a = 0; a < axis_count; ++a)
            for (int p = 0; p < pin_count; ++p)
                wires_[a][p] = kernel_.find_wire(std::string("c.") + "xyzu"[a] + pins[p]);
        static constexpr const char* outputs[] = {"pp",   "pm",   "out4", "out5", "out6", "out7",
                                                  "out0", "out1", "out2", "out3", "drive"};
        for (int a = 0; a < axis_count; ++a)
            for (int p = 0; p < output_count; ++p)
                output_wires_[a][p] = kernel_.find_wire(std::string("c.") + "xyzu"[a] + outputs[p]);
        emgn_ = kernel_.find_wire("c.emgn");
        step_ = kernel_.find_wire("c.expls_n");
        for (int a = 0; a < axis_count; ++a)
            for (int line = 0; line < 2; ++line)
                encoder_wires_[a][line] =
                    kernel_.find_wire(std::string("c.") + "xyzu"[a] + (line == 0 ? "eca" : "ecb"));
        requests_.wire = chip_.interrupt_wire();
        kernel_.observe_wires(&requests_);
        for (int a = 0; a < axis_count && way.watch; ++a) watchers_[a].begin(chip_.pulses(a), a);
        for (int a = 0; a < axis_count && way.follow; ++a)
            for (int p = 0; p < output_count; ++p) follower_.listen(output_wires_[a][p], a, p);
        kernel_.start();
        for (int a = 0; a < axis_count && way.follow; ++a)
            for (const sim::WireId wire : output_wires_[a]) follower_.want(wire);
        for (int a = 0; a < axis_count && way.watch; ++a) watchers_[a].watch(0);
        for (int a = 0; a < axis_count && way.listen; ++a)
            chip_.pulses(a).set_edge_listener(&edges_[static_cast<std::size_t>(a)]);
    }

    Outcome run() {
        for (std::size_t i = 0; i < program_.ops.size(); ++i) {
            const Op& op = program_.ops[i];
            const bool more = i + 1 < program_.ops.size() && program_.ops[i + 1].order() == op.order();
            out_.sights.push_back(op.is_wire() ? move_wire(op, more) : access(op));
            if (i >= program_.snapshot_at && !disturbed_ && hand_.idle()) disturb(op);
        }
        sort_pulses(out_.pulses);
        sort_changes(out_.changes);
        out_.requests = std::move(requests_.list);
        out_.conditions = kernel_.conditions().size() + kernel_.dropped_conditions();
        for (int a = 0; a < axis_count; ++a) out_.crossings[a] = std::move(watchers_[a].list);
        return std::move(out_);
    }

  private:
    // A falling interrupt line ends a run early.
    void run_on(Instant until) {
        while (kernel_.run_until(until) == sim::RunEnd::broken) continue;
    }

    void run_to(Instant until) {
        while (program_.way.slices != 0 && random_.one_in(2)) {
            const std::int64_t left = (until - kernel_.now()).count();
            if (left <= 1) break;
            run_on(kernel_.now() + Duration{random_.between(0, left)});
        }
        run_on(until);
    }

    static Instant instant_of(const Op& op) { return op.tick * one_tick + (op.between ? one_tick / 2 : Duration{0}); }

    sim::WireId wire_of(const Op& op) const {
        if (op.kind == Op::Kind::emergency) return emgn_;
        if (op.kind == Op::Kind::step) return step_;
        if (op.kind == Op::Kind::encoder) return encoder_wires_[op.axis][op.offset];
        return wires_[op.axis][static_cast<int>(op.pin)];
    }

    // Changes a wire. `more`: the next op changes a wire at the same instant, so the tick must not be executed yet.
    Sight move_wire(const Op& op, bool more) {
        hand_.move(wire_of(op), op.value, instant_of(op));
        if (!more) run_to(instant_of(op));
        return {};
    }

    Sight access(const Op& op) {
        Sight sight;
        run_to(instant_of(op));
        if (op.kind == Op::Kind::write)
            chip_.write(op.offset, op.value);
        else if (op.kind == Op::Kind::write_byte)
            chip_.write_byte(op.offset, static_cast<std::uint8_t>(op.value));
        else if (op.kind == Op::Kind::read_byte)
            sight.value = chip_.read_byte(op.offset);
        else
            sight.value = read(op.offset);
        kernel_.settle();
        sight.interrupt = kernel_.level(chip_.interrupt_wire()) == 0;
        for (int a = 0; a < axis_count; ++a) {
            sight.count[a] = chip_.pulses(a).count(kernel_.now());
            for (int p = 0; p < output_count; ++p)
                sight.outputs[a] |= static_cast<unsigned>(kernel_.level(output_wires_[a][p])) << p;
        }
        return sight;
    }

    // Reads a register. A peek before the read must change nothing and return the same value; otherwise the result is
    // inverted.
    std::uint16_t read(std::uint8_t offset) {
        const std::uint16_t peeked = chip_.peek(offset), value = chip_.read(offset);
        return peeked == value ? value : static_cast<std::uint16_t>(~value);
    }

    void disturb(const Op& op) {
        disturbed_ = true;
        oracle::disturb_and_restore(
            kernel_,
            [&] {
                chip_.write(14, 0), chip_.write(12, 100), chip_.write(0, 0x0F06), chip_.write(0, 0x0F20);
                run_on(kernel_.now() + 5000 * one_tick);
                chip_.write(0, 0x0F27);
                run_on(kernel_.now() + one_tick * (1 + op.tick % 700));
            },
            out_.pulses, out_.changes, requests_.list);
    }

    const Program& program_;
    Random random_;
    Outcome out_;
    Requests requests_;
    sim::Kernel kernel_;
    Hand hand_{kernel_};
    Chip chip_{kernel_, "c", program_.options};
    Follower follower_{kernel_, out_.changes};
    std::array<Edges, axis_count> edges_{Edges{out_.pulses, 0}, Edges{out_.pulses, 1}, Edges{out_.pulses, 2},
                                         Edges{out_.pulses, 3}};
    std::array<std::array<sim::WireId, pin_count>, axis_count> wires_{};
    std::array<std::array<sim::WireId, output_count>, axis_count> output_wires_{};
    std::array<std::array<sim::WireId, 2>, axis_count> encoder_wires_{};
    std::array<Watcher, axis_count> watchers_;
    sim::WireId emgn_{}, step_{};
    bool disturbed_ = false;
};

}  // namespace

Outcome run_on_chip(const Program& program) {
    return Bench(program).run();
}

void run_both(const Program& program, oracle::Comparison& both) {
    const Way& way = program.way;
    const Outcome twin = run_on_twin(program), chip = run_on_chip(program);
    for (std::size_t a = 0; a < axis_count && way.watch; ++a)
        both.same_elements("watched count", twin.crossings[a], chip.crossings[a]);
    if (way.listen) both.same_elements("pulse", twin.pulses, chip.pulses);
    if (way.follow) both.same_elements("output pin", twin.changes, chip.changes);
    both.same_elements("interrupt", twin.requests, chip.requests);
    both.same_elements("after op", twin.sights, chip.sights);
    both.same("conditions", twin.conditions, chip.conditions);
    both.count("accesses and wire changes", program.ops.size());
    both.count("ticks", program.ops.back().tick);
    both.count("pulses", twin.pulses.size());
    both.count("changes of the interrupt line", twin.requests.size());
    both.count("changes of output pins", twin.changes.size());
}

}  // namespace motionrack::mcx314::twin
