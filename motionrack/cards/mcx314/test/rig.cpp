// Runs register programs on the twin, and formats outcomes as text.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <motionrack/cards/mcx314/test/rig.hpp>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

namespace motionrack::mcx314::twin {

void sort_pulses(std::vector<Pulse>& pulses) {
    std::stable_sort(pulses.begin(), pulses.end(), [](const Pulse& a, const Pulse& b) {
        return a.tick != b.tick ? a.tick < b.tick : a.axis < b.axis;
    });
}

// Sorts changes and drops those that have no duration: wires that change more than once at an instant may change an
// output with them, but only the final level counts. A pulse that begins with a change to rest counts.
void sort_changes(std::vector<Change>& changes) {
    const auto place = [](const Change& c) { return std::tuple(c.half_tick, c.axis, c.pin); };
    std::stable_sort(changes.begin(), changes.end(),
                     [&](const Change& a, const Change& b) { return place(a) < place(b); });
    std::vector<Change> settled;
    for (const Change& change : changes) {
        if (change.pin >= pulse_pins && !settled.empty() && place(settled.back()) == place(change))
            settled.pop_back();  // the pin has its previous level again
        else
            settled.push_back(change);
    }
    changes = std::move(settled);
}

namespace {

// Records the changes of the twin's output pins.
class Pins {
  public:
    Pins(const Twin& twin, std::vector<Change>& changes) : twin_(twin), changes_(changes) {}
    void poll(std::int64_t half_tick) {
        for (int a = 0; a < axis_count; ++a) {
            const unsigned now = twin_.outputs(a), before = std::exchange(levels_[a], now);
            // A pulse that comes during the previous one begins with a change to rest.
            const bool pulse = std::exchange(made_[a], twin_.made(a)) != twin_.made(a);
            const unsigned rest = twin_.outputs_at_rest(a);
            for (int pin = 0; pin < output_count; ++pin) {
                const bool level = (now >> pin & 1u) != 0;
                if (((before ^ now) >> pin & 1u) != 0)
                    changes_.push_back({half_tick, a, pin, level});
                else if (pulse && ((now ^ rest) >> pin & 1u) != 0)
                    changes_.insert(changes_.end(), {{half_tick, a, pin, !level}, {half_tick, a, pin, level}});
            }
        }
    }

  private:
    const Twin& twin_;
    std::vector<Change>& changes_;
    std::array<unsigned, axis_count> levels_{};
    std::array<std::int64_t, axis_count> made_{};
};

// Executes an op; returns the value of a read, 0 for other ops.
std::uint16_t apply(Twin& twin, const Op& op) {
    const bool level = op.value != 0;
    if (op.kind == Op::Kind::read) return twin.read(op.offset);
    if (op.kind == Op::Kind::read_byte) return twin.read_byte(op.offset);
    if (op.kind == Op::Kind::write) twin.write(op.offset, op.value);
    if (op.kind == Op::Kind::write_byte) twin.write_byte(op.offset, static_cast<std::uint8_t>(op.value));
    if (op.kind == Op::Kind::encoder) twin.set_encoder(op.axis, op.offset, level);
    if (op.kind == Op::Kind::step) twin.set_step(level);
    if (op.kind == Op::Kind::input) twin.set_input(op.axis, op.pin, level);
    if (op.kind == Op::Kind::emergency) twin.set_emergency(level);
    return 0;
}

// Computes from the pulses the instants at which watched ranges are left.
void find_crossings(Outcome& out) {
    std::array<std::int64_t, axis_count> count{}, middle{};
    for (const Pulse& pulse : out.pulses) {
        const int a = pulse.axis;
        std::vector<Crossing>& crossings = out.crossings[static_cast<std::size_t>(a)];
        count[a] += pulse.direction;
        if (std::abs(count[a] - middle[a]) < reach(a, crossings.size())) continue;
        crossings.push_back({pulse.tick, a, count[a]});
        middle[a] = count[a];
    }
}

}  // namespace

Outcome run_on_twin(const Program& program) {
    const bool follow = program.way.follow;
    Twin twin(program.options);
    Outcome out;
    Pins pins(twin, out.changes);
    bool requested = false;
    const auto note_request = [&](std::int64_t half_tick) {
        if (twin.interrupt() == requested) return;
        requested = !requested;
        out.requests.push_back({half_tick, requested});
    };
    const auto run_to = [&](std::int64_t tick) {
        while (twin.now() < tick) {
            twin.tick();
            note_request(2 * twin.now());
            if (follow) pins.poll(2 * twin.now());
        }
    };
    out.sights.reserve(program.ops.size());
    for (const Op& op : program.ops) {
        const bool wire = op.is_wire();
        const std::int64_t before =
            op.tick - (wire && !op.between ? 1 : 0);  // a wire changed exactly at a tick belongs to that tick
        run_to(before);
        Sight sight;
        sight.value = apply(twin, op);
        if (wire && (&op == &program.ops.back() || (&op)[1].order() != op.order())) twin.hear_encoders();
        if (!wire) {
            sight.interrupt = twin.interrupt();
            for (int a = 0; a < axis_count; ++a) sight.count[a] = twin.count(a), sight.outputs[a] = twin.outputs(a);
        }
        note_request(2 * op.tick + op.between);
        if (follow && (!wire || op.between)) pins.poll(2 * op.tick + op.between);
        out.sights.push_back(sight);
    }
    if (!program.ops.empty()) run_to(program.ops.back().tick);
    out.pulses = twin.pulses();
    out.conditions = twin.conditions();
    sort_pulses(out.pulses);
    sort_changes(out.changes);
    find_crossings(out);
    return out;
}

namespace {

/// Formats an instant given in half ticks.
std::string text_of_instant(std::int64_t half_tick) {
    return fmt::format("at tick {}{}", half_tick / 2, half_tick & 1 ? ".5" : "");
}

}  // namespace

void PrintTo(const Sight& sight, std::ostream* out) {
    *out << fmt::format("read {:04X} interrupt {:d}", sight.value, sight.interrupt);
    for (std::size_t a = 0; a < axis_count; ++a)
        *out << fmt::format(", {} count {} PP PM OUT4-7 OUT0-3 DRIVE {:011b}", "XYZU"[a], sight.count[a],
                            sight.outputs[a]);
}
void PrintTo(const Pulse& pulse, std::ostream* out) {
    *out << fmt::format("{}{} at tick {}", "XYZU"[pulse.axis], pulse.direction > 0 ? '+' : '-', pulse.tick);
}
void PrintTo(const Request& request, std::ostream* out) {
    *out << (request.active ? "requested " : "cleared ") << text_of_instant(request.half_tick);
}
void PrintTo(const Crossing& crossing, std::ostream* out) {
    *out << fmt::format("{} = {} at tick {}", "XYZU"[crossing.axis], crossing.count, crossing.tick);
}
void PrintTo(const Change& change, std::ostream* out) {
    static constexpr const char* pins[output_count] = {"PP",   "PM",   "OUT4", "OUT5", "OUT6", "OUT7",
                                                       "OUT0", "OUT1", "OUT2", "OUT3", "DRIVE"};
    *out << fmt::format("{}{} {} {}", "XYZU"[change.axis], pins[change.pin], change.level ? "High" : "Low",
                        text_of_instant(change.half_tick));
}

}  // namespace motionrack::mcx314::twin
