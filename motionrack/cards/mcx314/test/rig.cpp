// Register programs on the twin, and the comparison of outcomes.
#include <motionrack/cards/mcx314/test/rig.hpp>

#include <algorithm>
#include <cstdio>

namespace motionrack::mcx314::twin {

void sort_pulses(std::vector<Pulse>& pulses) {
    std::stable_sort(pulses.begin(), pulses.end(),
                     [](const Pulse& a, const Pulse& b) { return a.tick != b.tick ? a.tick < b.tick : a.axis < b.axis; });
}

Outcome run_on_twin(const Program& program) {
    Twin twin;
    Outcome out;
    out.sights.reserve(program.ops.size());
    for (const Op& op : program.ops) {
        const bool wire = op.kind == Op::Kind::input || op.kind == Op::Kind::emergency;
        const std::int64_t before = op.tick - (wire && !op.between ? 1 : 0);  // a wire at the instant of a tick counts for it
        if (before > twin.now()) twin.run(before - twin.now());
        Sight sight;
        switch (op.kind) {
            case Op::Kind::write: twin.write(op.offset, op.value); break;
            case Op::Kind::read: sight.value = twin.read(op.offset); break;
            case Op::Kind::input: twin.set_input(op.axis, op.pin, op.value != 0); break;
            case Op::Kind::emergency: twin.set_emergency(op.value != 0); break;
        }
        if (!wire) {
            sight.interrupt = twin.interrupt();
            for (int a = 0; a < axis_count; ++a) sight.count[a] = twin.count(a);
        }
        out.sights.push_back(sight);
    }
    if (!program.ops.empty()) twin.run(std::max<std::int64_t>(program.ops.back().tick - twin.now(), 0));
    out.pulses = twin.pulses();
    sort_pulses(out.pulses);
    return out;
}

namespace {

std::string text_of(const Pulse& pulse) {
    return std::string(1, "XYZU"[pulse.axis]) + (pulse.direction > 0 ? "+" : "-") + " at tick " + std::to_string(pulse.tick);
}

std::string first_pulse_difference(const std::vector<Pulse>& twin, const std::vector<Pulse>& chip) {
    const auto [a, b] = std::mismatch(twin.begin(), twin.end(), chip.begin(), chip.end());
    if (a == twin.end() && b == chip.end()) return "";
    return "pulse " + std::to_string(a - twin.begin()) + ": twin " + (a == twin.end() ? "has no more" : text_of(*a)) + ", chip " +
           (b == chip.end() ? "has no more" : text_of(*b)) + "\n";
}

}  // namespace

std::string difference(const Program& program, const Outcome& twin, const Outcome& chip, bool pulses) {
    std::string out;
    if (pulses) out = first_pulse_difference(twin.pulses, chip.pulses);
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        const Sight &t = twin.sights[i], &c = chip.sights[i];
        if (t == c) continue;
        const Op& op = program.ops[i];
        out += "op " + std::to_string(i) + " at tick " + std::to_string(op.tick) + (op.between ? ".5" : "") + ": ";
        if (t.value != c.value) {
            char line[80];
            std::snprintf(line, sizeof line, "RR%d twin %04X chip %04X; ", op.offset / 2, t.value, c.value);
            out += line;
        }
        if (t.interrupt != c.interrupt) out += std::string("interrupt twin ") + (t.interrupt ? "1" : "0") + " chip " + (c.interrupt ? "1; " : "0; ");
        for (int a = 0; a < axis_count; ++a)
            if (t.count[a] != c.count[a])
                out += std::string(1, "XYZU"[a]) + " count twin " + std::to_string(t.count[a]) + " chip " + std::to_string(c.count[a]) + "; ";
        return out + "\n";
    }
    return out;
}

}  // namespace motionrack::mcx314::twin
