// Sampling, filter, decoder and calibration of one axis.
#include <algorithm>
#include <motionrack/cards/ioflex02/model/axis.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>

namespace motionrack::ioflex02 {

namespace {

enum Line : std::size_t { a_line, b_line, z_line, cal_line };

sim::Edges edges_of(std::uint16_t word) {
    const unsigned edges = mode::EDGES.get(word);
    return edges == 0 ? sim::Edges::all : edges == 1 ? sim::Edges::both_of_a : sim::Edges::rising_a;
}

void calibrate(EncoderAxisState& axis, CalEvent event) {
    const CalStep step = calibration_step(axis.cal, event);
    axis.cal = step.next;
    if (step.zero) axis.position = 0;
}

void count(EncoderAxisState& axis, unsigned before, unsigned after, std::int64_t sample) {
    const unsigned changed = before ^ after;
    if (changed & 1) ++axis.edges_a;
    if (changed & 2) ++axis.edges_b;
    if (changed == 3) {
        if (axis.illegal == 0) axis.illegal_sample = sample;
        if (axis.illegal < 0xFFFF) ++axis.illegal;
        axis.illegal_at = axis.raw;
        return;
    }
    int change = sim::QuadratureDecoder(edges_of(axis.mode), static_cast<std::uint8_t>(before))
                     .lines(static_cast<std::uint8_t>(after));
    if (change == 0) return;
    if (mode::REVERSED.test(axis.mode)) change = -change;
    axis.position += change;
    axis.raw += change;
    axis.edge = sample;
    axis.down = change < 0;
}

/// The sample at which the next change may happen, `none` if no change is pending.
std::int64_t next_of(const EncoderAxisState& axis, std::int64_t none) {
    const auto filter = static_cast<std::int64_t>(mode::FILTER.get(axis.mode));
    std::int64_t next = none;
    for (const LineState& line : axis.lines) {
        if (line.raw != line.sampled) next = std::min(next, std::max(axis.pending, axis.done + 1));
        if (line.sampled != line.taken) next = std::min(next, std::max(line.from + filter, axis.done + 1));
    }
    return next;
}

void take(EncoderAxisState& axis, std::int64_t sample) {
    const auto filter = static_cast<std::int64_t>(mode::FILTER.get(axis.mode));
    const unsigned before = lines_word(axis);
    for (LineState& line : axis.lines) {
        if (line.raw != line.sampled && axis.pending <= sample) {
            line.sampled = line.raw;
            line.from = sample;
        }
        if (line.sampled != line.taken && sample - line.from >= filter) line.taken = line.sampled;
    }
    const unsigned after = lines_word(axis);
    count(axis, before & 3, after & 3, sample);
    const bool index = (after >> z_line & 1) != mode::INDEX_LOW.get(axis.mode);
    if (((before ^ after) >> z_line & 1) != 0 && index) {
        ++axis.indexes;
        axis.index_at = axis.raw;
        calibrate(axis, CalEvent::index);
    }
    // After the index: an index of the same sample precedes this edge.
    if ((after & ~before) >> cal_line & 1) calibrate(axis, CalEvent::cal);
}

}  // namespace

std::uint16_t lines_word(const EncoderAxisState& axis) {
    unsigned out = 0;
    for (std::size_t i = 0; i < line_count; ++i) out |= unsigned{axis.lines[i].taken} << i;
    return static_cast<std::uint16_t>(out);
}

void begin_axis(EncoderAxisState& axis, std::uint16_t mode, std::int64_t done) {
    EncoderAxisState fresh;
    for (std::size_t i = 0; i < line_count; ++i) fresh.lines[i].raw = axis.lines[i].raw;
    fresh.mode = mode & mode::all;
    fresh.done = done;
    axis = fresh;
}

void wire_changed(EncoderAxisState& axis, int line, bool level, std::int64_t sample) {
    LineState& l = axis.lines[static_cast<std::size_t>(line)];
    advance(axis, sample - 1);
    l.raw = level ? 1 : 0;
    axis.pending = sample;
}

void advance(EncoderAxisState& axis, std::int64_t sample) {
    if (sample <= axis.done) return;
    if (!axis.begun) {
        axis.begun = 1;
        ++axis.done;
        for (LineState& line : axis.lines) {
            line.sampled = line.taken = line.raw;
            line.from = axis.done;
        }
    }
    for (std::int64_t next = 0; (next = next_of(axis, sample + 1)) <= sample;) {
        take(axis, next);
        axis.done = next;
    }
    axis.done = std::max(axis.done, sample);
}

std::int64_t illegal_from(const EncoderAxisState& axis, std::int64_t none) {
    const auto changes = [&](Line line) {
        const LineState& l = axis.lines[line];
        return l.raw != l.taken || l.sampled != l.taken;
    };
    return axis.begun != 0 && changes(a_line) && changes(b_line) ? next_of(axis, none) : none;
}

void command_axis(EncoderAxisState& axis, tIOFlexCmd command) {
    calibrate(axis, static_cast<CalEvent>(command));
}

}  // namespace motionrack::ioflex02
