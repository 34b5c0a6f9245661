// Segments of a move: arcs that the chip can draw, lines, and the limits of the axes on them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>
#include <utility>

namespace motionrack::mcx314 {

void Segmenter::emit_arcs(const PendingMove& work, double from, double to, std::int32_t v, std::int32_t acceleration) {
    if (to <= from) return;
    // At most a third of a turn at once, so the orientation of an end is unambiguous.
    const double sweep = std::fabs(work.path.sweep) * (to - from) / work.path.length;
    const double count = std::max(1.0, std::ceil(sweep / 2.1));
    for (double i = 0; i < count; ++i) {
        const double a = from + (to - from) * i / count;
        const double b = i + 1 < count ? from + (to - from) * (i + 1) / count : to;
        if (!emit_fitted_arc(work, a, b, v, acceleration)) emit_line(work, pulses_at(work, b), v, acceleration);
    }
}

bool Segmenter::emit_fitted_arc(const PendingMove& work, double from, double to, std::int32_t v,
                                std::int32_t acceleration) {
    int a = map_.channel[work.path.first], b = map_.channel[work.path.second];
    double centre_a = work.path.centre_first, centre_b = work.path.centre_second;
    bool clockwise = work.path.sweep < 0;
    // The generator's own axis must not be AX2: its R would be used while two axes step together.
    if (chain_open_ ? b == generator_ : b < a) {
        std::swap(a, b);
        std::swap(centre_a, centre_b);
        clockwise = !clockwise;
    }
    const double scale = map_.limits[work.path.first].pulses_per_unit;
    const Pulses4 end = pulses_at(work, to);
    const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
    const double length = (to - from) * scale;
    if (length < 6) return false;
    const auto arc = fit_arc({{at_[ia], at_[ib]},
                              {end[ia], end[ib]},
                              {centre_a * scale, centre_b * scale},
                              work.path.radius * scale,
                              length,
                              clockwise});
    if (!arc) return false;
    Segment segment;
    segment.kind = clockwise ? SegmentKind::arc_cw : SegmentKind::arc_ccw;
    segment.axis_count = 2;
    segment.axes = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), 0};
    segment.finish = {arc->finish[0], arc->finish[1], 0};
    segment.centre = arc->centre;
    segment.moves = {arc->end[0], arc->end[1], 0};
    segment.constant_vector = true;
    segment.speed = v;
    segment.acceleration = acceleration;
    Pulses4 reached = at_;
    reached[ia] += arc->end[0];
    reached[ib] += arc->end[1];
    append(segment, work, reached);  // if it ends beside its target, the next segment starts there
    return true;
}

/// Selects the channel to leave out of those with pulses before `to`: preferably one that the move itself does not
/// move, and of these the one with the fewest pulses.
std::size_t Segmenter::waits_for_room(const PendingMove& work, const Pulses4& to) const {
    std::size_t out = 0;
    std::pair<bool, std::int64_t> min_rank = {true, std::numeric_limits<std::int64_t>::max()};
    for (std::size_t c = 0; c < to.size(); ++c) {
        const std::int64_t pulses = std::llabs(to[c] - at_[c]);
        if (pulses == 0 || static_cast<int>(c) == work.auxiliary) continue;
        const std::pair<bool, std::int64_t> one = {(work.channels >> c & 1) != 0, pulses};
        if (one < min_rank) min_rank = one, out = c;
    }
    return out;
}

void Segmenter::emit_line(const PendingMove& work, const Pulses4& to, std::int32_t v, std::int32_t acceleration) {
    std::array<int, 4> moving{};
    int count = 0;
    std::int64_t max_delta = 0;
    for (int c = 0; c < channel_count; ++c) {
        const std::int64_t delta = to[static_cast<std::size_t>(c)] - at_[static_cast<std::size_t>(c)];
        if (delta == 0 || c == work.auxiliary) continue;
        moving[static_cast<std::size_t>(count++)] = c;
        max_delta = std::max(max_delta, delta < 0 ? -delta : delta);
    }
    if (count == 0) return;  // less than half a pulse; an auxiliary's pulses stay for the next segment
    // One or two pulses left over by an arc wait for a segment with a free axis, at the latest until standstill. A
    // segment of two axes with constant vector speed has no free axis: a third axis would change the path length of a
    // basic pulse.
    if (count > (work.constant_vector ? 2 : 3)) {
        Pulses4 without = to;
        const std::size_t left = waits_for_room(work, to);
        without[left] = at_[left];
        return emit_line(work, without, v, acceleration);
    }
    if (max_delta > max_line_pulses) {
        Pulses4 half = at_;
        for (std::size_t c = 0; c < half.size(); ++c) half[c] += (to[c] - at_[c]) / 2;
        emit_line(work, half, v, acceleration);
        return emit_line(work, to, v, acceleration);
    }
    if (count == 1) {  // the chip's line has two axes: the second is stationary
        const int other = chain_open_ && generator_ != moving[0] ? generator_ : moving[0] == 0 ? 1 : 0;
        moving[static_cast<std::size_t>(count++)] = other;
        if (other < moving[0] || (chain_open_ && other == generator_)) std::swap(moving[0], moving[1]);
    }
    if (chain_open_)
        for (int i = 1; i < count; ++i)
            if (moving[static_cast<std::size_t>(i)] == generator_)
                std::swap(moving[0], moving[static_cast<std::size_t>(i)]);
    Segment segment;
    segment.kind = SegmentKind::line;
    segment.axis_count = static_cast<std::uint8_t>(count);
    segment.constant_vector = work.constant_vector && count == 2;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        segment.axes[i] = static_cast<std::uint8_t>(moving[i]);
        segment.finish[i] = static_cast<std::int32_t>(to[static_cast<std::size_t>(moving[i])] -
                                                      at_[static_cast<std::size_t>(moving[i])]);
    }
    segment.moves = segment.finish;
    segment.speed = v;
    segment.acceleration = acceleration;
    Pulses4 delta = {};
    for (std::size_t i = 0; i < segment.axis_count; ++i) delta[segment.axes[i]] = segment.finish[i];
    const UnitLimits limits = max_on(delta, segment.constant_vector);
    segment.speed = std::min(segment.speed, limits.speed);
    segment.acceleration = std::min(segment.acceleration, limits.acceleration);
    segment.even = work.move.constant_accel;
    if (work.move.constant_accel) segment.braking = limits.acceleration;
    append(segment, work, to);
}

/// Speed and acceleration within the limits of all axes on this line: in a short line, rounding gives an axis more than
/// its share.
Segmenter::UnitLimits Segmenter::max_on(const Pulses4& delta, bool constant_vector) const {
    double basic = 0, second = 0;
    for (const std::int64_t pulses : delta) {
        const auto size = static_cast<double>(std::llabs(pulses));
        second = std::max(second, std::min(basic, size));
        basic = std::max(basic, size);
    }
    if (constant_vector) basic += both_axes_extra * second;
    UnitLimits limits;
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] < 0 || delta[static_cast<std::size_t>(map_.channel[i])] == 0) continue;
        const auto own = static_cast<double>(std::llabs(delta[static_cast<std::size_t>(map_.channel[i])]));
        const double units = map_.limits[i].pulses_per_unit * basic / own / pulses_per_v_;
        auto at_most = [](double value) {
            return static_cast<std::int32_t>(std::clamp(std::floor(value), 1.0, max_units));
        };
        limits.speed = std::min(limits.speed, at_most(map_.limits[i].max_velocity * units));
        limits.acceleration =
            std::min(limits.acceleration, at_most(map_.limits[i].max_accel * units / rules::rate_unit));
    }
    return limits;
}

void Segmenter::append(Segment segment, const PendingMove& work, const Pulses4& to) {
    if (!chain_open_) {
        chain_open_ = true;
        generator_ = segment.axes[0];
        segment.starts_chain = true;
        segment.initial_speed = speed_units(work.units_in, start_speed(work.path.tangent_in));
    }
    segment.rest_speed = std::min(speed_units(work.units_in, start_speed(work.path.tangent_in)),
                                  speed_units(work.units_out, start_speed(work.path.tangent_out)));
    segment.braking = std::max(segment.braking, segment.acceleration);
    segment.block = work.block;
    segment.line = work.move.move.line;
    if (work.auxiliary >= 0) {
        const auto c = static_cast<std::size_t>(work.auxiliary);
        segment.auxiliary_channel = work.auxiliary;
        segment.auxiliary_pulses = static_cast<std::int32_t>(to[c] - at_[c]);
        for (std::size_t i = 0; i < map_.channel.size(); ++i)
            if (map_.channel[i] == work.auxiliary)
                segment.auxiliary_speed =
                    work.move.exit_velocity * std::fabs(work.path.tangent_out[i]) * map_.limits[i].pulses_per_unit;
    }
    at_ = to;
    ready_.push_back(segment);
}

std::int64_t Segmenter::auxiliary_pulses_ahead(int channel, int direction) const {
    std::int64_t sum = 0;
    for (const Segment& segment : ready_) {
        if (segment.starts_chain || segment.auxiliary_channel != channel || segment.auxiliary_pulses * direction < 0)
            return sum;
        sum += segment.auxiliary_pulses;
        if (segment.ends_chain) return sum;
    }
    if (!chain_open_ || !waiting_ || waiting_->auxiliary != channel) return sum;
    const auto c = static_cast<std::size_t>(channel);
    const std::int64_t last = waiting_->to[c] - at_[c];
    return last * direction < 0 ? sum : sum + last;
}

void Segmenter::note_split(const PendingMove& work, const char* why, double deviation_mm) {
    notes_.push_back({work.move.move.line, why, deviation_mm});
}

}  // namespace motionrack::mcx314
