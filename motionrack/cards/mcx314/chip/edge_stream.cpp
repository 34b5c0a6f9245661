// Edges for listeners: the instants follow from the generator's phase, the axes from the path.
#include <cstring>
#include <motionrack/cards/mcx314/chip/edge_stream.hpp>

namespace motionrack::mcx314 {

namespace {
constexpr std::int64_t max_batch_ticks = 0xF000'0000;  // ticks between the first and the last edge of a batch

/// Ticks between even edges: `whole`, or one more when `slack` cannot provide another `part`; `slack` then regains
/// `all` of a tick.
struct Interval {
    std::int32_t whole = 0, part = 0, all = 1;

    Interval times(std::int32_t n) const { return {n * whole + n * part / all, n * part % all, all}; }
};

/// Offset and remaining slack of the next edge, or of one edge per vector lane.
template <class Signed, class Unsigned>
struct PlaceInRow {
    Unsigned offset{};
    Signed slack{};

    void step(const Interval& by) {
        slack -= by.part;
        const Signed late = slack >> 31;  // all ones if the part needs one more tick
        offset += static_cast<std::uint32_t>(by.whole) - (Unsigned)late;
        slack += late & by.all;
    }
};
// SSE2 on every x86-64, scalar code without vector support.
using SignedLanes = std::int32_t __attribute__((vector_size(16)));
using UnsignedLanes = std::uint32_t __attribute__((vector_size(16)));

/// Computes `count` offsets from `next` on, and advances `next`. Each edge depends on the previous one, so the offsets
/// are computed as sixteen rows of every sixteenth edge.
void fill_evenly(std::uint32_t* out, std::int64_t count, PlaceInRow<std::int32_t, std::uint32_t>& next,
                 const Interval& interval) {
    constexpr int rows = 16, lanes = 4;
    std::int64_t i = 0;
    if (count >= 3 * rows) {
        std::array<std::uint32_t, rows> offset;
        std::array<std::int32_t, rows> slack;
        for (int k = 0; k < rows; ++k) {
            offset[k] = next.offset;
            slack[k] = next.slack;
            next.step(interval);
        }
        std::array<PlaceInRow<SignedLanes, UnsignedLanes>, rows / lanes> row;
        for (int k = 0; k < rows / lanes; ++k) {
            std::memcpy(&row[k].offset, &offset[lanes * k], sizeof row[k].offset);
            std::memcpy(&row[k].slack, &slack[lanes * k], sizeof row[k].slack);
        }
        const Interval stride = interval.times(rows);
        for (; i + rows <= count; i += rows)
            for (int k = 0; k < rows / lanes; ++k) {
                std::memcpy(out + i + lanes * k, &row[k].offset, sizeof row[k].offset);
                row[k].step(stride);
            }
        next = {row[0].offset[0], row[0].slack[0]};
    }
    for (; i < count; ++i) {
        out[i] = next.offset;
        next.step(interval);
    }
}

/// The long axis along an arc within an octant: the basic pulses that step it, without a root for each. The long
/// coordinate's magnitude m is nearest to the circle while m * m - m < q = r2 - short^2 <= m * m + m.
class LongAxis {
  public:
    explicit LongAxis(const rules::Arc& arc) {
        const int s = rules::octants[arc.octant].short_axis;
        const std::int64_t short_step = rules::octants[arc.octant].short_step;
        const std::int64_t at = arc.at[s];
        m_ = rules::magnitude(arc.at[1 - s]);
        way_ = at * short_step >= 0 ? -1 : 1;
        q_ = arc.r2 - at * at;
        fall_ = 2 * at * short_step + 1;
        threshold_ = way_ > 0 ? m_ * m_ + m_ : m_ * m_ - m_;
    }
    /// Direction in which m changes: -1 or +1.
    int way() const { return way_; }
    /// Advances by one basic pulse; returns whether m changes.
    bool step() {
        q_ -= fall_;
        fall_ += 2;
        if ((q_ > threshold_) != (way_ > 0)) return false;
        threshold_ += way_ > 0 ? 2 * (m_ + 1) : -2 * (m_ - 1);
        m_ += way_;
        return true;
    }

  private:
    std::int64_t m_ = 0;
    std::int64_t q_ = 0;
    std::int64_t fall_ = 0;       // change of q with the next basic pulse
    std::int64_t threshold_ = 0;  // m changes once q is above it, or no longer above it
    int way_ = 0;
};

/// Returns the generator's next basic pulses at constant speed and range, after `waited` ticks: pulse j occurs when acc
/// has grown by j * R.
EvenPulses even_pulses(const Generator& gen, std::int64_t waited) {
    const std::int64_t need = gen.range_now - gen.acc;
    EvenPulses run;
    run.speed = gen.speed;
    run.quotient = gen.range_now / gen.speed;
    run.remainder = gen.range_now % gen.speed;
    const std::int64_t ticks = rules::ceil_div(need, gen.speed);
    run.at = gen.at + waited + ticks;
    run.slack = ticks * gen.speed - need;
    return run;
}

}  // namespace

bool EdgeStream::wanted_of(int generator) const {
    bool some = false;
    for_each_axis(state_.moved_by(generator) & listeners_.heard, [&](int i) { some = some || wanted(i); });
    return some;
}

void EdgeStream::set_listener(int a, sim::EdgeListener* listener) {
    if (wanted(a)) flush(a);
    outputs_[a].listener = listener;
    outputs_[a].batch.size = 0;
}

void EdgeStream::flush(int a) {
    sim::EdgeBatch& batch = outputs_[a].batch;
    if (batch.size == 0) return;
    outputs_[a].listener->edges(batch);
    batch.size = 0;
}

/// Emits one edge of axis `a` at tick `at`; `count`: position after it, pulses since the start.
void EdgeStream::add(int a, std::int64_t at, int direction, std::int64_t count) {
    sim::EdgeBatch& batch = outputs_[a].batch;
    const std::int64_t offset = at - outputs_[a].batch_tick;
    if (batch.size > 0 &&
        (batch.step != direction || batch.size == sim::EdgeBatch::capacity || offset > max_batch_ticks))
        flush(a);
    if (batch.size > 0) {
        batch.at[batch.size++] = static_cast<std::uint32_t>(offset);
        return;
    }
    begin_batch(a, at, direction, count);
    batch.at[batch.size++] = 0;
}

void EdgeStream::begin_batch(int a, std::int64_t at, int direction, std::int64_t count) {
    BatchedEdges& output = outputs_[a];
    output.batch_tick = at;
    output.batch.origin = Instant{at * rules::tick_100ps};
    output.batch.tick = Duration{rules::tick_100ps};
    output.batch.step = direction;
    output.batch.first_count = count;
}

/// Emits `pulses` evenly spaced edges of axis `a`, at intervals of quotient ticks, or one more if the remainder has
/// used up the slack. The first edge is at `run.at`.
void EdgeStream::make_even_edges(int a, EvenPulses run, std::int64_t pulses, int direction) {
    sim::EdgeBatch& batch = outputs_[a].batch;
    std::int64_t count = state_.axis[a].count;
    while (pulses > 0) {
        if (batch.size > 0 && (batch.step != direction || batch.size == sim::EdgeBatch::capacity)) flush(a);
        if (batch.size > 0 && run.at - outputs_[a].batch_tick > max_batch_ticks) flush(a);
        if (batch.size == 0) begin_batch(a, run.at, direction, count + direction);
        std::int64_t some = std::min<std::int64_t>(sim::EdgeBatch::capacity - batch.size, pulses);
        // Limited by the 32-bit offsets of the batch.
        some = std::min(some, (max_batch_ticks - (run.at - outputs_[a].batch_tick)) / (run.quotient + 1) + 1);
        const auto first = static_cast<std::uint32_t>(run.at - outputs_[a].batch_tick);
        PlaceInRow<std::int32_t, std::uint32_t> next{first, static_cast<std::int32_t>(run.slack)};
        fill_evenly(batch.at.data() + batch.size, some, next,
                    {static_cast<std::int32_t>(run.quotient), static_cast<std::int32_t>(run.remainder),
                     static_cast<std::int32_t>(run.speed)});
        run.at += next.offset - first;
        run.slack = next.slack;
        batch.size += static_cast<std::uint32_t>(some);
        count += some * direction;
        pulses -= some;
    }
}

/// Emits the next `pulses` basic pulses of generator `a`, which starts after `waited` more ticks; called before its
/// state advances.
void EdgeStream::make(int a, std::int64_t waited, std::int64_t pulses) {
    const Generator& gen = state_.axis[a].gen;
    if (gen.drive != Drive::path) return make_even_edges(a, even_pulses(gen, waited), pulses, state_.axis[a].direction);
    const Path& path = state_.path;
    if (path.range_for[1] != path.range_for[0] || path.range_for[2] != path.range_for[0])
        return make_varied_edges(waited, pulses);
    if (path.command.arc()) return make_arc_edges(even_pulses(gen, waited), pulses);
    for (int i = 0; i < path.command.count; ++i) {
        const std::int64_t p = rules::magnitude(path.command.finish[i]);
        const int axis = path.command.axis[i], direction = path.command.finish[i] < 0 ? -1 : 1;
        if (p == 0 || !wanted(axis)) continue;
        if (p == path.max_pulses)
            make_even_edges(axis, even_pulses(gen, waited), pulses, direction);
        else
            make_led_edges(i, even_pulses(gen, waited), pulses);
    }
}

/// Emits the edges of an axis that is not the longest of a line: it steps every k or k + 1 basic pulses. Both intervals
/// are divided once into quotient and remainder.
void EdgeStream::make_led_edges(int i, EvenPulses run, std::int64_t pulses) {
    const Generator& gen = state_.axis[state_.master].gen;
    const Path& path = state_.path;
    const std::int64_t p = rules::magnitude(path.command.finish[i]), max_p = path.max_pulses;
    const int axis = path.command.axis[i], direction = path.command.finish[i] < 0 ? -1 : 1;
    const std::int64_t made = rules::line_steps(gen.n, p, max_p),
                       steps = rules::line_steps(gen.n + pulses, p, max_p) - made;
    if (steps == 0) return;
    const std::int64_t first = rules::line_pulse_of_step(made + 1, p, max_p);
    std::int64_t spare =
        2 * p * first - (2 * made + 1) * max_p;  // of the basic pulse beyond the exact position of the step
    const std::int64_t between = max_p / p, rest = 2 * (max_p % p);
    const std::int64_t phase = (first - gen.n - 1) * gen.range_now - run.slack;
    const std::int64_t ticks = phase > 0 ? rules::ceil_div(phase, gen.speed) : 0;
    std::int64_t at = run.at + ticks, slack = ticks * gen.speed - phase, count = state_.axis[axis].count;
    std::array<std::int64_t, 2> quotient{}, remainder{};
    for (int more = 0; more < 2; ++more) {
        quotient[more] = (between + more) * gen.range_now / gen.speed;
        remainder[more] = (between + more) * gen.range_now % gen.speed;
    }
    for (std::int64_t j = 0; j < steps; ++j) {
        count += direction;
        add(axis, at, direction, count);
        spare -= rest;
        const int more = spare < 0 ? 1 : 0;
        spare += more * 2 * p;
        slack -= remainder[more];
        const std::int64_t late = slack < 0 ? 1 : 0;
        at += quotient[more] + late;
        slack += late * gen.speed;
    }
}

/// Emits the edges of an arc within an octant: one axis steps at every basic pulse, the other when its coordinate
/// nearest to the circle changes.
void EdgeStream::make_arc_edges(EvenPulses run, std::int64_t pulses) {
    const Path& path = state_.path;
    const rules::Octant& octant = rules::octants[path.arc.octant];
    const int s = octant.short_axis, l = 1 - s;
    const auto direction = [&](int i) { return i == 1 && path.arc.clockwise ? -1 : 1; };
    const int short_axis = path.command.axis[s], long_axis = path.command.axis[l];
    if (wanted(short_axis)) make_even_edges(short_axis, run, pulses, octant.short_step * direction(s));
    if (!wanted(long_axis)) return;
    LongAxis along(path.arc);
    std::int64_t count = state_.axis[long_axis].count;
    const int step = along.way() * octant.long_side * direction(l);
    for (std::int64_t j = 0; j < pulses; ++j) {
        if (along.step()) {
            count += step;
            add(long_axis, run.at, step, count);
        }
        run.slack -= run.remainder;
        const std::int64_t late = run.slack < 0 ? 1 : 0;
        run.at += run.quotient + late;
        run.slack += late * run.speed;
    }
}

/// Emits the edges of a path with constant vector speed: the interval of a basic pulse depends on the number of axes
/// that the previous one stepped.
void EdgeStream::make_varied_edges(std::int64_t waited, std::int64_t pulses) {
    const Generator& gen = state_.axis[state_.master].gen;
    const Path& path = state_.path;
    if (path.command.arc()) return make_varied_arc_edges(waited, pulses);
    const int axes = path.command.count;
    std::array<std::int64_t, 3> count{}, error{}, twice{}, quotient{}, remainder{};
    for (int i = 0; i < axes; ++i) {
        count[i] = state_.axis[path.command.axis[i]].count;
        quotient[i] = path.range_for[i] / gen.speed;
        remainder[i] = path.range_for[i] % gen.speed;
        twice[i] = 2 * rules::magnitude(path.command.finish[i]);
        error[i] = static_cast<std::int64_t>(  // below 2^64
            (static_cast<std::uint64_t>(gen.n) * static_cast<std::uint64_t>(twice[i]) +
             static_cast<std::uint64_t>(path.max_pulses)) %
            static_cast<std::uint64_t>(2 * path.max_pulses));
    }
    EvenPulses run = even_pulses(gen, waited);
    for (std::int64_t j = 0; j < pulses; ++j) {
        int stepped = 0;
        for (int i = 0; i < axes; ++i) {
            error[i] += twice[i];
            if (error[i] < 2 * path.max_pulses) continue;
            error[i] -= 2 * path.max_pulses;
            const int step = path.command.finish[i] < 0 ? -1 : 1;
            ++stepped;
            count[i] += step;
            if (wanted(path.command.axis[i])) add(path.command.axis[i], run.at, step, count[i]);
        }
        run.slack -= remainder[stepped - 1];
        const std::int64_t late = run.slack < 0 ? 1 : 0;
        run.at += quotient[stepped - 1] + late;
        run.slack += late * run.speed;
    }
}

/// Emits the edges of an arc with constant vector speed within an octant: one axis steps at every basic pulse, the
/// other at some of them.
void EdgeStream::make_varied_arc_edges(std::int64_t waited, std::int64_t pulses) {
    const Generator& gen = state_.axis[state_.master].gen;
    const Path& path = state_.path;
    const rules::Octant& octant = rules::octants[path.arc.octant];
    const int s = octant.short_axis, l = 1 - s;
    const auto direction = [&](int i) { return i == 1 && path.arc.clockwise ? -1 : 1; };
    const int short_axis = path.command.axis[s], long_axis = path.command.axis[l];
    const bool short_wanted = wanted(short_axis), long_wanted = wanted(long_axis);
    LongAxis along(path.arc);
    const int short_step = octant.short_step * direction(s), long_step = along.way() * octant.long_side * direction(l);
    std::int64_t short_count = state_.axis[short_axis].count, long_count = state_.axis[long_axis].count;
    std::array<std::int64_t, 2> quotient{}, remainder{};
    for (int both = 0; both < 2; ++both) {
        quotient[both] = path.range_for[both] / gen.speed;
        remainder[both] = path.range_for[both] % gen.speed;
    }
    EvenPulses run = even_pulses(gen, waited);
    for (std::int64_t j = 0; j < pulses; ++j) {
        short_count += short_step;
        if (short_wanted) add(short_axis, run.at, short_step, short_count);
        const bool both = along.step();
        if (both) {
            long_count += long_step;
            if (long_wanted) add(long_axis, run.at, long_step, long_count);
        }
        run.slack -= remainder[both];
        const std::int64_t late = run.slack < 0 ? 1 : 0;
        run.at += quotient[both] + late;
        run.slack += late * run.speed;
    }
}

}  // namespace motionrack::mcx314
