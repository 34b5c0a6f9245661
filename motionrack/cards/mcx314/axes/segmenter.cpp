// How each planned move is drawn by the chip, and the speeds of its pieces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>

namespace motionrack::mcx314 {

namespace {

// The planner keeps a little of each axis' acceleration back (Axes::kept_back); this much of it is given to the chip,
// so that its whole-number steps are never slower than the plan.
constexpr double acceleration_reserve = 1.015;
// Register accesses between the interrupt at a joint and the new speed being written.
constexpr double accesses_to_write_speed = 8;
constexpr std::int64_t longest_line = 8'000'000;

}  // namespace

std::int32_t Segmenter::best_range(const AxisMap& map) {
    double fastest = 1;
    for (std::size_t i = 0; i < map.channel.size(); ++i)
        if (map.channel[i] >= 0) fastest = std::max(fastest, map.limits[i].max_speed * map.limits[i].pulses_per_unit);
    const double range = rules::clock_hz * most_units / (fastest * 1.4143);
    return static_cast<std::int32_t>(
        std::clamp(std::floor(range), static_cast<double>(param::R.least), static_cast<double>(param::R.greatest)));
}

Segmenter::Segmenter(const AxisMap& map, std::int32_t range, const Pulses4& start, Duration access)
    : map_(map),
      range_(range),
      pulses_per_v_(rules::clock_hz / range),
      latency_seconds_(accesses_to_write_speed * to_seconds(access)),
      at_(start) {}

void Segmenter::add(const control::PlannedMove& move) {
    Work work = classify(move);
    if (waiting_ && work.move.even) look_at_next(*waiting_, work);
    if (waiting_) emit(*waiting_, work.shape == Shape::pause ? std::nullopt : std::optional(work.units_in));
    // A move's start is where the one before it really ends, which only emit knows.
    waiting_ = std::move(work);
}

void Segmenter::finish() {
    if (waiting_) emit(*waiting_, std::nullopt);
    waiting_.reset();
}

// ---- what a move is

Segmenter::Work Segmenter::classify(const control::PlannedMove& move) {
    Work work;
    work.move = move;
    work.block = next_block_++;
    work.path = control::geometry_of(move.move, move.start);
    work.to = map_.pulses(move.move.end);
    if (work.path.shape == control::PathShape::nothing) {
        work.shape = Shape::pause;
        return work;
    }
    const Drawing drawing = drawing_of(map_, work.path, move.axes);
    work.companion = drawing.companion;
    // From piece to piece of a ride a basic pulse must stay what it is: pulses of the longest axis.
    work.constant_vector = drawing.constant_vector && !move.even;
    if (work.path.shape == control::PathShape::arc)
        work.shape = drawing.constant_vector ? Shape::chip_arc : Shape::chords;
    work.units_in = units_along(work, work.path.tangent_in);
    work.units_out = units_along(work, work.path.tangent_out);
    if (work.shape == Shape::chip_arc)  // with constant vector speed the path is never faster than this
        work.units_in = work.units_out = map_.limits[work.path.first].pulses_per_unit / pulses_per_v_;
    return work;
}

double Segmenter::units_along(const Work& work, const control::Point& tangent) const {
    return basic_pulses_along(map_, {work.constant_vector, work.companion}, tangent) / pulses_per_v_;
}

std::int32_t Segmenter::speed_units(double units, double speed) const {
    return static_cast<std::int32_t>(std::clamp(std::floor(units * speed), 1.0, most_units));
}

std::int32_t Segmenter::acceleration_units(double units, double acceleration) const {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(units * acceleration * acceleration_reserve / rules::rate_unit), 1.0, most_units));
}

/// The speed to start and stop with: half of what each axis may jump, because a stop and a start the other way may
/// follow at once.
double Segmenter::start_speed(const control::Point& tangent) const {
    double speed = 1e9;
    for (std::size_t i = 0; i < tangent.size(); ++i)
        if (map_.channel[i] >= 0 && std::fabs(tangent[i]) > 1e-12)
            speed = std::min(speed, 0.5 * map_.limits[i].start_speed / std::fabs(tangent[i]));
    return speed;
}

Pulses4 Segmenter::pulses_at(const Work& work, double s) const {
    return s >= work.path.length ? work.to : map_.pulses(control::position_at(work.path, s));
}

/// How long before its end a move must begin to fall from `top` to `exit` (V units), with the pulses that the chip's
/// whole steps, the host's register accesses and the rounding to pulses may take.
double Segmenter::fall_length(double units, const Speeds& speeds) const {
    if (speeds.top <= speeds.exit) return 0;
    const double top = speeds.top, exit = speeds.exit;
    const double ticks_per_step = speed_carry / speeds.acceleration;
    const double phase = ticks_per_step * (top * (top + 1) - exit * (exit + 1)) / 2 + ticks_per_step * top +
                         latency_seconds_ * rules::clock_hz * top;
    return (phase / range_ + 2) / (units * pulses_per_v_);
}

// ---- moves to pieces

void Segmenter::emit(const Work& work, std::optional<double> next_units) {
    if (work.shape == Shape::pause) return emit_pause(work);
    const bool rests = !next_units || work.move.exit <= 0 || work.turns_back;
    if (rests && !chain_open_ && work.move.jerk > 0 && emit_s_curve(work)) return;
    const double units = std::min(work.units_in, work.units_out);
    Speeds speeds;
    speeds.top = speed_units(units, work.move.cruise);
    speeds.exit = rests ? speed_units(work.units_out, start_speed(work.path.tangent_out))
                        : speed_units(std::min(work.units_out, *next_units), work.move.exit);
    speeds.exit = std::min(speeds.exit, speeds.top);
    speeds.acceleration = acceleration_units(units, work.move.accel);
    if (work.move.even) make_even(work, speeds);
    speeds.fall_from = std::max(0.0, work.path.length - fall_length(units, speeds));
    switch (work.shape) {
        case Shape::chip_arc:
            if (speeds.fall_from > 0) emit_arcs(work, 0, speeds.fall_from, speeds.top, speeds.acceleration);
            emit_arcs(work, speeds.fall_from, work.path.length, speeds.exit, speeds.acceleration);
            break;
        case Shape::chords:
            emit_chords(work, speeds);
            break;
        default:
            emit_straight(work, speeds);
            break;
    }
    if (rests) {
        add_rest(work, speeds);
        close_chain();
    }
}

void Segmenter::emit_pause(const Work& work) {
    close_chain();
    if (work.move.move.seconds <= 0) return;
    Segment segment;
    segment.kind = SegmentKind::pause;
    segment.seconds = work.move.move.seconds;
    segment.block = work.block;
    segment.line = work.move.move.line;
    segment.starts_chain = segment.ends_chain = true;
    ready_.push_back(segment);
}

void Segmenter::close_chain() {
    if (chain_open_ && !ready_.empty()) ready_.back().ends_chain = true;
    chain_open_ = false;
}

void Segmenter::emit_straight(const Work& work, const Speeds& speeds) {
    if (work.companion >= 0 && !work.move.even) return emit_chords(work, speeds);
    if (speeds.fall_from > 0) {
        const Pulses4 middle = pulses_at(work, speeds.fall_from);
        Pulses4 fall = {};
        for (std::size_t c = 0; c < fall.size(); ++c) fall[c] = work.to[c] - middle[c];
        // The fall begins with the speed of the piece before it.
        emit_line(work, middle, std::min(speeds.top, most_on(fall, work.constant_vector).speed), speeds.acceleration);
    }
    emit_line(work, work.to, speeds.exit, speeds.acceleration);
}

/// One S-curve from rest to rest, if the chip's ramp fits into the move and its slowest jerk is slow enough.
bool Segmenter::emit_s_curve(const Work& work) {
    if (work.shape != Shape::line || work.companion >= 0) return false;
    const double units = work.units_in;
    const double initial = std::floor(units * start_speed(work.path.tangent_in));
    const double k = std::ceil(rules::jerk_unit / (units * work.move.jerk));
    if (k > static_cast<double>(param::K.greatest) || initial < 1) return false;
    // The top speed for which two S-ramps with the acceleration limit (or without reaching it) take at most the move's
    // length.
    const double a = units * work.move.accel, j = rules::jerk_unit / std::max(1.0, k), v0 = initial;
    auto ramp_length = [&](double v) {  // in V units * seconds
        const double dv = v - v0;
        const double time = dv * j <= a * a ? 2 * std::sqrt(dv / j) : dv / a + a / j;
        return (v + v0) / 2 * time;
    };
    const double whole = units * work.path.length;
    const double spare = (8 + 0.02 * whole * rules::clock_hz / range_) * range_ / rules::clock_hz + v0 * 1e-3;
    double low = v0 + 1, high = std::min(most_units, units * work.move.cruise);
    if (high <= low || 2 * ramp_length(low) + spare > whole) return false;
    if (2 * ramp_length(high) + spare > whole)
        for (int i = 0; i < 40; ++i)
            (2 * ramp_length((low + high) / 2) + spare > whole ? high : low) = (low + high) / 2;
    else
        low = high;
    for (std::size_t c = 0; c < at_.size(); ++c)
        if (work.to[c] - at_[c] > longest_line || at_[c] - work.to[c] > longest_line) return false;
    // The chip's S-ramps are not quite symmetric: what falling takes more than rising goes into AO, or it would end too
    // fast.
    const auto v = static_cast<std::int32_t>(low), sv = static_cast<std::int32_t>(initial);
    const auto limit = static_cast<std::int32_t>(std::clamp(std::floor(a / rules::rate_unit), 1.0, most_units));
    const auto jerk = static_cast<std::int32_t>(std::max(1.0, k));
    if (v <= sv) return false;
    const std::int64_t rise = rules::s_ramp(sv, v, limit, jerk).phase / range_;
    const std::int64_t fall = rules::s_ramp(v, sv, limit, jerk).phase / range_;
    const std::int64_t offset = std::max<std::int64_t>(0, fall - rise) + 2;
    const std::size_t first = ready_.size();
    emit_line(work, work.to, v, limit);
    if (ready_.size() == first) return true;  // less than half a pulse
    ready_.back().s_curve = true;
    ready_.back().speed = v;  // AO belongs to these two
    ready_.back().acceleration = limit;
    ready_.back().jerk = jerk;
    ready_.back().offset = static_cast<std::int32_t>(offset);
    close_chain();
    return true;
}

void Segmenter::emit_arcs(const Work& work, double from, double to, std::int32_t v, std::int32_t acceleration) {
    if (to <= from) return;
    // At most a third of a turn at once: no doubt which way round an end is.
    const double sweep = std::fabs(work.path.sweep) * (to - from) / work.path.length;
    const double count = std::max(1.0, std::ceil(sweep / 2.1));
    for (double i = 0; i < count; ++i) {
        const double a = from + (to - from) * i / count;
        const double b = i + 1 < count ? from + (to - from) * (i + 1) / count : to;
        if (!emit_fitted_arc(work, a, b, v, acceleration)) emit_line(work, pulses_at(work, b), v, acceleration);
    }
}

bool Segmenter::emit_fitted_arc(const Work& work, double from, double to, std::int32_t v, std::int32_t acceleration) {
    int a = map_.channel[work.path.first], b = map_.channel[work.path.second];
    double centre_a = work.path.centre_first, centre_b = work.path.centre_second;
    bool clockwise = work.path.sweep < 0;
    // The generator's own axis must not be AX2: its R would be taken for two axes stepping together.
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
    append(segment, work, reached);  // where it ends beside its point, the next piece starts from there
    return true;
}

void Segmenter::emit_line(const Work& work, const Pulses4& to, std::int32_t v, std::int32_t acceleration) {
    std::array<int, 4> moving{};
    int count = 0;
    std::int64_t longest = 0;
    for (int c = 0; c < channel_count; ++c) {
        const std::int64_t delta = to[static_cast<std::size_t>(c)] - at_[static_cast<std::size_t>(c)];
        if (delta == 0 || c == work.companion) continue;
        moving[static_cast<std::size_t>(count++)] = c;
        longest = std::max(longest, delta < 0 ? -delta : delta);
    }
    if (count == 0) return;  // less than half a pulse; a companion's pulses stay for the next piece
    // A pulse or two that an arc left beside its end wait for a piece with room, at the latest for the standstill.
    // Beside two axes with constant vector speed is no room: with a third axis a basic pulse would be another length of
    // path.
    if (count > (work.constant_vector ? 2 : 3)) {
        int least = 0;
        auto size = [&](int i) {
            return std::llabs(to[static_cast<std::size_t>(moving[static_cast<std::size_t>(i)])] -
                              at_[static_cast<std::size_t>(moving[static_cast<std::size_t>(i)])]);
        };
        for (int i = 1; i < count; ++i)
            if (size(i) < size(least)) least = i;
        Pulses4 without = to;
        const auto left = static_cast<std::size_t>(moving[static_cast<std::size_t>(least)]);
        without[left] = at_[left];
        return emit_line(work, without, v, acceleration);
    }
    if (longest > longest_line) {
        Pulses4 half = at_;
        for (std::size_t c = 0; c < half.size(); ++c) half[c] += (to[c] - at_[c]) / 2;
        emit_line(work, half, v, acceleration);
        return emit_line(work, to, v, acceleration);
    }
    if (count == 1) {  // the chip's line has two axes: the other one stands
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
    Pulses4 way = {};
    for (std::size_t i = 0; i < segment.axis_count; ++i) way[segment.axes[i]] = segment.finish[i];
    const Most most = most_on(way, segment.constant_vector);
    segment.speed = std::min(segment.speed, most.speed);
    segment.acceleration = std::min(segment.acceleration, most.acceleration);
    segment.even = work.move.even;
    if (work.move.even) segment.braking = most.acceleration;
    append(segment, work, to);
}

/// The most that no axis' limits are passed with on this way: in a short line rounding gives an axis more than its
/// share.
Segmenter::Most Segmenter::most_on(const Pulses4& way, bool constant_vector) const {
    double basic = 0, second = 0;
    for (const std::int64_t pulses : way) {
        const auto size = static_cast<double>(std::llabs(pulses));
        second = std::max(second, std::min(basic, size));
        basic = std::max(basic, size);
    }
    if (constant_vector) basic += both_axes_extra * second;
    Most most;
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] < 0 || way[static_cast<std::size_t>(map_.channel[i])] == 0) continue;
        const auto own = static_cast<double>(std::llabs(way[static_cast<std::size_t>(map_.channel[i])]));
        const double units = map_.limits[i].pulses_per_unit * basic / own / pulses_per_v_;
        auto at_most = [](double value) {
            return static_cast<std::int32_t>(std::clamp(std::floor(value), 1.0, most_units));
        };
        most.speed = std::min(most.speed, at_most(map_.limits[i].max_speed * units));
        most.acceleration = std::min(most.acceleration, at_most(map_.limits[i].max_accel * units / rules::rate_unit));
    }
    return most;
}

void Segmenter::append(Segment segment, const Work& work, const Pulses4& to) {
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
    if (work.companion >= 0) {
        const auto c = static_cast<std::size_t>(work.companion);
        segment.companion_channel = work.companion;
        segment.companion_pulses = static_cast<std::int32_t>(to[c] - at_[c]);
        for (std::size_t i = 0; i < map_.channel.size(); ++i)
            if (map_.channel[i] == work.companion)
                segment.companion_speed =
                    work.move.exit * std::fabs(work.path.tangent_out[i]) * map_.limits[i].pulses_per_unit;
    }
    at_ = to;
    ready_.push_back(segment);
}

std::int64_t Segmenter::companion_pulses_ahead(int channel, int direction) const {
    std::int64_t sum = 0;
    for (const Segment& segment : ready_) {
        if (segment.starts_chain || segment.companion_channel != channel || segment.companion_pulses * direction < 0)
            return sum;
        sum += segment.companion_pulses;
        if (segment.ends_chain) return sum;
    }
    if (!chain_open_ || !waiting_ || waiting_->companion != channel) return sum;
    const auto c = static_cast<std::size_t>(channel);
    const std::int64_t last = waiting_->to[c] - at_[c];
    return last * direction < 0 ? sum : sum + last;
}

void Segmenter::note_split(const Work& work, const char* why, double deviation_mm) {
    notes_.push_back({work.move.move.line, fmt::format("line {}: {}", work.move.move.line, why), deviation_mm});
}

}  // namespace motionrack::mcx314
