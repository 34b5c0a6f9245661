// Encoder diagnosis from edge and index counts.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <motionrack/cards/ioflex02/driver/encoder_check.hpp>

namespace motionrack::ioflex02 {

namespace {

std::int64_t modulo_16(int now, int before) {
    return (now - before) & 0xFFFF;
}

}  // namespace

// ---- lines

void EncoderCheck::look_at_lines(const AxisDetail& now, std::vector<Finding>& out) {
    const std::int64_t illegal = now.illegal >= last_.illegal ? now.illegal - last_.illegal : now.illegal;
    if (illegal > 0) out.push_back({EncoderFault::illegal, illegal, last_.at.raw, now.illegal_at});
    const std::int64_t a = modulo_16(now.edges_a, last_.edges_a), b = modulo_16(now.edges_b, last_.edges_b);
    if ((a > 0 && b > 0) || (a > 0 && b_alone_ > 0) || (b > 0 && a_alone_ > 0)) {
        a_alone_ = b_alone_ = 0;
        reported_alone_ = false;
    }
    if (a_alone_ + b_alone_ == 0) alone_from_ = last_.at.raw;
    if (b == 0) a_alone_ += a;
    if (a == 0) b_alone_ += b;
    const std::int64_t alone = std::max(a_alone_, b_alone_);
    if (reported_alone_ || alone < settings_.edges_alone) return;
    reported_alone_ = true;
    const EncoderFault fault = b_alone_ > 0 ? EncoderFault::line_a_missing : EncoderFault::line_b_missing;
    out.push_back({fault, alone, std::min(alone_from_, now.at.raw), std::max(alone_from_, now.at.raw)});
}

// ---- index

/// Distance from `to` to the nearest point of the grid through `from`.
std::int64_t EncoderCheck::off_grid(std::int64_t from, std::int64_t to) const {
    const std::int64_t rest = std::llabs(to - from) % settings_.counts_per_index;
    return std::min(rest, settings_.counts_per_index - rest);
}

void EncoderCheck::report_spacing(std::int64_t from, std::int64_t to, std::vector<Finding>& out) {
    const std::int64_t spacing = std::llabs(to - from), turn = settings_.counts_per_index;
    const std::int64_t wanted = std::max<std::int64_t>(1, (spacing + turn / 2) / turn) * turn;
    if (spacing == wanted) return;
    out.push_back({spacing < wanted ? EncoderFault::counts_lost : EncoderFault::counts_extra,
                   std::llabs(spacing - wanted), from, to});
}

void EncoderCheck::index_came(std::int64_t at, std::vector<Finding>& out) {
    if (!index_known_) {
        index_known_ = true;
        index_ = at;
        return;
    }
    const bool fits = off_grid(index_, at) <= settings_.tolerance;
    if (!doubtful_known_ && !fits) {
        doubtful_known_ = true;  // the next index decides whether this one was extra
        doubtful_ = at;
        return;
    }
    if (doubtful_known_ && fits) {
        out.push_back({EncoderFault::index_extra, 1, index_, doubtful_});
    } else if (doubtful_known_) {
        report_spacing(index_, doubtful_, out);
        if (off_grid(doubtful_, at) > settings_.tolerance) report_spacing(doubtful_, at, out);
    }
    doubtful_known_ = false;
    index_ = at;
}

void EncoderCheck::look_at_index(const AxisDetail& now, std::vector<Finding>& out) {
    const std::int64_t turn = settings_.counts_per_index, came = modulo_16(now.indexes, last_.indexes);
    if (turn <= 0) return;
    // Without an index, waits for one and an eighth revolutions.
    const std::int64_t here = came > 0 ? now.index_at : now.at.raw,
                       max_wait = came > 0 ? -settings_.tolerance : settings_.tolerance + turn / 8;
    const auto passed = [&] { return std::max<std::int64_t>(0, std::llabs(here - index_) - max_wait) / turn; };
    if (came == 0 && doubtful_known_ && passed() > 1) {
        report_spacing(index_, doubtful_, out);
        doubtful_known_ = false;
        index_ = doubtful_;
    }
    const std::int64_t missing = index_known_ && !doubtful_known_ ? passed() - came : 0;
    if (missing > 0) {
        const std::int64_t due = index_ + (here > index_ ? turn : -turn) * missing;
        out.push_back({EncoderFault::index_missing, missing, index_, came > 0 ? here : due});
        if (came == 0) index_ = due;
    }
    if (came > 0) index_came(here, out);
}

// ---- polls

std::vector<Finding> EncoderCheck::update(const AxisDetail& now) {
    std::vector<Finding> out;
    if (begun_) {
        look_at_lines(now, out);
        look_at_index(now, out);
    }
    begun_ = true;
    last_ = now;
    return out;
}

std::vector<Finding> EncoderCheck::check_move(const AxisDetail& before, const AxisDetail& now,
                                              std::int64_t counts) const {
    std::vector<Finding> out;
    const std::int64_t seen = now.at.raw - before.at.raw;
    const std::int64_t a = modulo_16(now.edges_a, before.edges_a), b = modulo_16(now.edges_b, before.edges_b);
    if (seen * (counts > 0 ? 1 : -1) < -std::llabs(counts) / 2)
        out.push_back({EncoderFault::backwards, std::llabs(seen), before.at.raw, now.at.raw});
    const std::int64_t enough = std::llabs(counts) / 8 * (4 / now.edges);
    if (a <= enough / 8 && b > enough) out.push_back({EncoderFault::line_a_missing, b, before.at.raw, now.at.raw});
    if (b <= enough / 8 && a > enough) out.push_back({EncoderFault::line_b_missing, a, before.at.raw, now.at.raw});
    const std::int64_t more = a + b - (std::max(std::llabs(seen), std::llabs(counts)) + 1) * (4 / now.edges);
    if (more > settings_.edges_alone && out.empty())
        out.push_back({EncoderFault::too_many_edges, more, before.at.raw, now.at.raw});
    return out;
}

// ---- messages

std::string describe(const Finding& f, const AxisDetail& now, const std::string& axis) {
    const std::int64_t from = now.position_of(f.from), to = now.position_of(f.to);
    switch (f.fault) {
        case EncoderFault::illegal:
            return fmt::format(
                "axis {}: lines A and B changed at once {} times, the last time at {}; the position may be off. The "
                "encoder is too fast, or the lines have noise",
                axis, f.number, to);
        case EncoderFault::line_a_missing:
            return fmt::format(
                "axis {}: line A stood at {} while B changed {} times, from {} to {}: A is broken, or the axis "
                "oscillates on an edge of B",
                axis, now.a ? 1 : 0, f.number, from, to);
        case EncoderFault::line_b_missing:
            return fmt::format(
                "axis {}: line B stood at {} while A changed {} times, from {} to {}: B is broken, or the axis "
                "oscillates on an edge of A",
                axis, now.b ? 1 : 0, f.number, from, to);
        case EncoderFault::index_missing:
            return fmt::format(
                "axis {}: {} index {} did not come between {} and {}: Z is broken, or the axis counts without motion",
                axis, f.number, f.number == 1 ? "pulse" : "pulses", from, to);
        case EncoderFault::index_extra:
            return fmt::format("axis {}: an unexpected index pulse came at {}", axis, to);
        case EncoderFault::counts_lost:
            return fmt::format(
                "axis {}: {} counts were lost between the index pulses at {} and {}: lines are dirty there, or the "
                "encoder was too fast. Calibrate again",
                axis, f.number, from, to);
        case EncoderFault::counts_extra:
            return fmt::format(
                "axis {}: {} counts too many between the index pulses at {} and {}: noise on the lines. "
                "Calibrate again",
                axis, f.number, from, to);
        case EncoderFault::backwards:
            return fmt::format(
                "axis {}: it counted {} against the move, from {} to {}: A and B are swapped, or one of them is "
                "inverted. Swap them, "
                "or set the axis reversed",
                axis, f.number, from, to);
        case EncoderFault::too_many_edges:
            return fmt::format(
                "axis {}: {} edges more than the move from {} to {} needs: noise on the lines. Set a filter", axis,
                f.number, from, to);
    }
    return axis;
}

}  // namespace motionrack::ioflex02
