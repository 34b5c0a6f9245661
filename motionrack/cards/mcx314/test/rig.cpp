// Register programs on the twin, and the comparison of outcomes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <motionrack/cards/mcx314/test/rig.hpp>
#include <tuple>
#include <utility>

namespace motionrack::mcx314::twin {

void sort_pulses(std::vector<Pulse>& pulses) {
    std::stable_sort(pulses.begin(), pulses.end(), [](const Pulse& a, const Pulse& b) {
        return a.tick != b.tick ? a.tick < b.tick : a.axis < b.axis;
    });
}

// Wires that change more than once at an instant may change an output with them; only the final level counts. A pulse
// that begins with a change to rest does count.
void sort_changes(std::vector<Change>& changes) {
    const auto place = [](const Change& c) { return std::tuple(c.half_tick, c.axis, c.pin); };
    std::stable_sort(changes.begin(), changes.end(),
                     [&](const Change& a, const Change& b) { return place(a) < place(b); });
    std::vector<Change> settled;
    for (const Change& change : changes) {
        if (change.pin >= pulse_pins && !settled.empty() && place(settled.back()) == place(change))
            settled.pop_back();  // there and back again
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

// Instants at which watched ranges are left, from the pulses.
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

Outcome run_on_twin(const Program& program, bool follow) {
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
            op.tick - (wire && !op.between ? 1 : 0);  // a wire at the instant of a tick belongs to it
        run_to(before);
        Sight sight;
        switch (op.kind) {
            case Op::Kind::write:
                twin.write(op.offset, op.value);
                break;
            case Op::Kind::read:
                sight.value = twin.read(op.offset);
                break;
            case Op::Kind::write_byte:
                twin.write_byte(op.offset, static_cast<std::uint8_t>(op.value));
                break;
            case Op::Kind::read_byte:
                sight.value = twin.read_byte(op.offset);
                break;
            case Op::Kind::encoder:
                twin.set_encoder(op.axis, op.offset, op.value != 0);
                break;
            case Op::Kind::step:
                twin.set_step(op.value != 0);
                break;
            case Op::Kind::input:
                twin.set_input(op.axis, op.pin, op.value != 0);
                break;
            case Op::Kind::emergency:
                twin.set_emergency(op.value != 0);
                break;
        }
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

std::string text_of_sample(const Pulse& pulse) {
    return std::string(1, "XYZU"[pulse.axis]) + (pulse.direction > 0 ? "+" : "-") + " at tick " +
           std::to_string(pulse.tick);
}

std::string first_pulse_difference(const std::vector<Pulse>& twin, const std::vector<Pulse>& chip) {
    const auto [a, b] = std::mismatch(twin.begin(), twin.end(), chip.begin(), chip.end());
    if (a == twin.end() && b == chip.end()) return "";
    return "pulse " + std::to_string(a - twin.begin()) + ": twin " +
           (a == twin.end() ? "has no more" : text_of_sample(*a)) + ", chip " +
           (b == chip.end() ? "has no more" : text_of_sample(*b)) + "\n";
}

std::string first_request_difference(const std::vector<Request>& twin, const std::vector<Request>& chip) {
    const auto [a, b] = std::mismatch(twin.begin(), twin.end(), chip.begin(), chip.end());
    if (a == twin.end() && b == chip.end()) return "";
    const auto text = [](const Request& r) {
        return std::string(r.active ? "requested" : "cleared") + " at tick " + std::to_string(r.half_tick / 2) +
               (r.half_tick & 1 ? ".5" : "");
    };
    return "interrupt: twin " + (a == twin.end() ? "no more" : text(*a)) + ", chip " +
           (b == chip.end() ? "no more" : text(*b)) + "\n";
}

std::string first_change_difference(const std::vector<Change>& twin, const std::vector<Change>& chip) {
    const auto [a, b] = std::mismatch(twin.begin(), twin.end(), chip.begin(), chip.end());
    if (a == twin.end() && b == chip.end()) return "";
    const auto text = [](const Change& c) {
        static constexpr const char* pins[output_count] = {"PP",   "PM",   "OUT4", "OUT5", "OUT6", "OUT7",
                                                           "OUT0", "OUT1", "OUT2", "OUT3", "DRIVE"};
        return std::string(1, "XYZU"[c.axis]) + pins[c.pin] + (c.level ? " High" : " Low") + " at tick " +
               std::to_string(c.half_tick / 2) + (c.half_tick & 1 ? ".5" : "");
    };
    return "output pin: twin " + (a == twin.end() ? "no more" : text(*a)) + ", chip " +
           (b == chip.end() ? "no more" : text(*b)) + "\n";
}

std::string first_crossing_difference(const std::vector<Crossing>& twin, const std::vector<Crossing>& chip) {
    const auto [a, b] = std::mismatch(twin.begin(), twin.end(), chip.begin(), chip.end());
    if (a == twin.end() && b == chip.end()) return "";
    const auto text = [](const Crossing& c) {
        return std::string(1, "XYZU"[c.axis]) + " = " + std::to_string(c.count) + " at tick " + std::to_string(c.tick);
    };
    return "watched count: twin " + (a == twin.end() ? "no more" : text(*a)) + ", chip " +
           (b == chip.end() ? "no more" : text(*b)) + "\n";
}

}  // namespace

std::string difference(const Program& program, const Outcome& twin, const Outcome& chip, const Way& way) {
    std::string out;
    for (int a = 0; a < axis_count && way.watch; ++a)
        out += first_crossing_difference(twin.crossings[a], chip.crossings[a]);
    if (way.listen) out = first_pulse_difference(twin.pulses, chip.pulses);
    if (way.follow) out += first_change_difference(twin.changes, chip.changes);
    out += first_request_difference(twin.requests, chip.requests);
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        const Sight &t = twin.sights[i], &c = chip.sights[i];
        if (t == c) continue;
        const Op& op = program.ops[i];
        out += "op " + std::to_string(i) + " at tick " + std::to_string(op.tick) + (op.between ? ".5" : "") + ": ";
        if (t.value != c.value) {
            char line[80];
            std::snprintf(line, sizeof line, "RR%d%s twin %04X chip %04X; ", op.offset / 2,
                          op.kind == Op::Kind::read ? ""
                          : op.offset % 2 != 0      ? "H"
                                                    : "L",
                          t.value, c.value);
            out += line;
        }
        if (t.interrupt != c.interrupt)
            out +=
                std::string("interrupt twin ") + (t.interrupt ? "1" : "0") + " chip " + (c.interrupt ? "1; " : "0; ");
        for (int a = 0; a < axis_count; ++a)
            if (t.count[a] != c.count[a])
                out += std::string(1, "XYZU"[a]) + " count twin " + std::to_string(t.count[a]) + " chip " +
                       std::to_string(c.count[a]) + "; ";
        for (int a = 0; a < axis_count; ++a)
            if (t.outputs[a] != c.outputs[a])
                out += std::string(1, "XYZU"[a]) + " outputs (PP PM OUT4-7 OUT0-3 DRIVE from bit 0) twin " +
                       std::to_string(t.outputs[a]) + " chip " + std::to_string(c.outputs[a]) + "; ";
        return out + "\n";
    }
    if (twin.conditions != chip.conditions)
        out +=
            "conditions: twin " + std::to_string(twin.conditions) + " chip " + std::to_string(chip.conditions) + "\n";
    return out;
}

}  // namespace motionrack::mcx314::twin
