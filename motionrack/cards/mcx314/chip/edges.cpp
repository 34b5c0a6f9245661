// Single pulses, made only for who listens: the instants follow from the generator's phase, the axes from the path.
#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

bool Chip::edges_wanted(int a) const {
    const std::uint32_t moved = moved_by(a);
    for (int i = 0; i < axes_of_chip; ++i)
        if ((moved >> i & 1u) && outputs_[i].edge_listener) return true;
    return false;
}

void Chip::listen_edges(int axis, sim::EdgeListener* listener) {
    advance_to(tick_of(kernel_.now()));
    if (outputs_[axis].edge_listener) flush_edges(axis);
    outputs_[axis].edge_listener = listener;
    outputs_[axis].batch.size = 0;
}

void Chip::flush_edges(int axis) {
    sim::EdgeBatch& batch = outputs_[axis].batch;
    if (batch.size == 0) return;
    outputs_[axis].edge_listener->edges(batch);
    batch.size = 0;
}

void Chip::add_edge(int axis, std::int64_t tick_of_edge, int direction) {
    sim::EdgeBatch& batch = outputs_[axis].batch;
    const std::int64_t offset = tick_of_edge - batch.origin.count() / rules::tick_100ps;
    if (batch.size > 0 && (batch.step != direction || batch.size == sim::EdgeBatch::capacity || offset > 0xFFFF'FFFFll)) flush_edges(axis);
    if (batch.size == 0) {
        batch.origin = Instant{tick_of_edge * rules::tick_100ps};
        batch.tick = Duration{rules::tick_100ps};
        batch.step = direction;
        batch.first_count = state_.axis[axis].count;
        batch.at[batch.size++] = 0;
        return;
    }
    batch.at[batch.size++] = static_cast<std::uint32_t>(offset);
}

/// The next `pulses` basic pulses of generator `a`, which begins to work after `waited` more ticks; called before its state moves on.
void Chip::make_edges(int a, std::int64_t waited, std::int64_t pulses) {
    if (state_.axis[a].gen.drive == Drive::path)
        make_path_edges(pulses);
    else
        make_own_edges(a, waited, pulses);
}

/// Pulse j comes at the tick at which acc has grown by j * R: a division once, then quotient and remainder are added.
void Chip::make_own_edges(int a, std::int64_t waited, std::int64_t pulses) {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    sim::EdgeBatch& batch = outputs_[a].batch;
    const std::int64_t quotient = gen.range_now / gen.speed, remainder = gen.range_now % gen.speed;
    std::int64_t at = state_.tick + waited + rules::ceil_div(gen.range_now - gen.acc, gen.speed);
    std::int64_t slack = (at - state_.tick - waited) * gen.speed - (gen.range_now - gen.acc);
    std::int64_t made = 0;
    while (made < pulses) {
        if (batch.size > 0 && (batch.step != axis.direction || batch.size == sim::EdgeBatch::capacity ||
                               at - batch.origin.count() / rules::tick_100ps > 0x7FFF'FFFF)) flush_edges(a);
        if (batch.size == 0) {
            batch.origin = Instant{at * rules::tick_100ps};
            batch.tick = Duration{rules::tick_100ps};
            batch.step = axis.direction;
            batch.first_count = axis.count + (made + 1) * axis.direction;
        }
        const std::int64_t room = static_cast<std::int64_t>(sim::EdgeBatch::capacity - batch.size);
        const std::int64_t count = std::min(room, pulses - made);
        auto offset = static_cast<std::uint32_t>(at - batch.origin.count() / rules::tick_100ps);
        auto short_slack = static_cast<std::int32_t>(slack);
        const auto q = static_cast<std::uint32_t>(quotient);
        const auto r = static_cast<std::int32_t>(remainder), v = static_cast<std::int32_t>(gen.speed);
        std::uint32_t* out = batch.at.data() + batch.size;
        const std::uint32_t before = offset;
        for (std::int64_t i = 0; i < count; ++i) {
            out[i] = offset;
            short_slack -= r;
            const std::int32_t late = short_slack >> 31;  // all ones if the remainder needs one more tick
            offset += q - static_cast<std::uint32_t>(late);
            short_slack += late & v;
        }
        at += offset - before;
        slack = short_slack;
        batch.size += static_cast<std::uint32_t>(count);
        made += count;
    }
}

/// Along a line or within an octant of an arc: each basic pulse's tick, and the axes that step with it.
void Chip::make_path_edges(std::int64_t pulses) {
    const Generator& gen = state_.axis[state_.master].gen;
    const Path& path = state_.path;
    std::array<std::int64_t, 3> count{}, error{}, twice{};
    const bool arc = path.command.arc();
    for (int i = 0; i < path.command.count; ++i) {
        count[i] = state_.axis[path.command.axis[i]].count;
        if (arc) continue;
        twice[i] = 2 * rules::magnitude(path.command.finish[i]);
        error[i] = (gen.n * twice[i] + path.longest) % (2 * path.longest);
    }
    std::array<std::int64_t, 2> at = path.arc.at;
    std::int64_t need = gen.range_now - gen.acc, ticks = state_.tick;
    for (std::int64_t j = 1; j <= pulses; ++j) {
        const std::int64_t k = rules::ceil_div(need, gen.speed);
        ticks += k;
        int stepped = 0;
        std::array<int, 3> step{};
        if (arc) {
            const auto to = path.arc.after(j);
            step[0] = static_cast<int>(to[0] - at[0]);
            step[1] = static_cast<int>(path.arc.clockwise ? at[1] - to[1] : to[1] - at[1]);
            at = to;
        } else {
            for (int i = 0; i < path.command.count; ++i) {
                error[i] += twice[i];
                if (error[i] < 2 * path.longest) continue;
                error[i] -= 2 * path.longest;
                step[i] = path.command.finish[i] < 0 ? -1 : 1;
            }
        }
        for (int i = 0; i < path.command.count; ++i) {
            if (step[i] == 0) continue;
            ++stepped;
            count[i] += step[i];
            const int axis = path.command.axis[i];
            if (!outputs_[axis].edge_listener) continue;
            const bool first = outputs_[axis].batch.size == 0 || outputs_[axis].batch.size == sim::EdgeBatch::capacity ||
                               outputs_[axis].batch.step != step[i];
            add_edge(axis, ticks, step[i]);
            if (first) outputs_[axis].batch.first_count = count[i];
        }
        need += path.range_for[static_cast<std::size_t>(stepped - 1)] - k * gen.speed;
    }
}

}  // namespace motionrack::mcx314
