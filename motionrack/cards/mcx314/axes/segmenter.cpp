// Division of planned moves into chip segments, and the speeds of the segments.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>
#include <motionrack/cards/mcx314/ramp.hpp>

namespace motionrack::mcx314 {

namespace {

// The planner reserves a little of each axis' acceleration (ChipAxisGroup::accel_reserve). This factor returns part of
// it to the chip, so its whole-number steps are never slower than the plan.
constexpr double acceleration_reserve = 1.015;
// Register accesses between the interrupt at a junction and the write of the new speed.
constexpr double accesses_to_write_speed = 8;
// Accesses until the next segment is queued, and their safety factors for whole pulses and accesses by other functions.
// The factor is smaller if the pulses are counted.
constexpr double accesses_of_piece = 28, piece_reserve = 1.5, counted_reserve = 1.2;

}  // namespace

std::int32_t Segmenter::best_range(const AxisMap& map) {
    double max_pulse_hz = 1;
    for (std::size_t i = 0; i < map.channel.size(); ++i)
        if (map.channel[i] >= 0)
            max_pulse_hz = std::max(max_pulse_hz, map.limits[i].max_velocity * map.limits[i].pulses_per_unit);
    const double range = rules::clock_hz * max_units / (max_pulse_hz * 1.4143);
    return static_cast<std::int32_t>(
        std::clamp(std::floor(range), static_cast<double>(param::R.min), static_cast<double>(param::R.max)));
}

double Segmenter::min_seconds(const HostTimes& host) {
    return piece_reserve * (accesses_of_piece * to_seconds(host.access) + to_seconds(host.latency));
}

double Segmenter::min_counted_seconds(const HostTimes& host) {
    return counted_reserve / piece_reserve * min_seconds(host);
}

Segmenter::Segmenter(const AxisMap& map, std::int32_t range, const Pulses4& start, const HostTimes& host)
    : map_(map),
      range_(range),
      pulses_per_v_(rules::clock_hz / range),
      host_seconds_(to_seconds(host.latency)),
      latency_seconds_(accesses_to_write_speed * to_seconds(host.access) + host_seconds_),
      min_seconds_(min_seconds(host)),
      min_counted_seconds_(min_counted_seconds(host)),
      at_(start) {}

void Segmenter::add(const control::PlannedMove& move) {
    PendingMove work = classify(move);
    if (waiting_ && work.move.constant_accel) look_at_next(*waiting_, work);
    if (waiting_) emit(*waiting_, work.shape == Shape::pause ? std::nullopt : std::optional(work.units_in));
    // A move starts at the true end of the previous one, which only emit knows.
    waiting_ = work;
}

void Segmenter::finish() {
    if (waiting_) emit(*waiting_, std::nullopt);
    waiting_.reset();
}

// ---- classification of moves

Segmenter::PendingMove Segmenter::classify(const control::PlannedMove& move) {
    PendingMove work;
    work.move = move;
    work.block = next_block_++;
    work.path = control::geometry_of(move.move, move.start);
    work.to = map_.pulses(move.move.end);
    if (work.path.shape == control::PathShape::nothing) {
        work.shape = Shape::pause;
        return work;
    }
    const DriveMotion drawing = drawing_of(map_, work.path, move.axes);
    work.auxiliary = drawing.auxiliary;
    work.channels = drawing.channels;
    // From segment to segment of a trajectory the basic pulse must stay the same: the pulses of the longest axis.
    work.constant_vector = drawing.constant_vector && !move.constant_accel;
    if (work.path.shape == control::PathShape::arc)
        work.shape = drawing.constant_vector ? Shape::chip_arc : Shape::chords;
    work.units_in = units_along(work, work.path.tangent_in);
    work.units_out = units_along(work, work.path.tangent_out);
    if (work.shape == Shape::chip_arc)  // with constant vector speed the path is never faster than this
        work.units_in = work.units_out = map_.limits[work.path.first].pulses_per_unit / pulses_per_v_;
    return work;
}

double Segmenter::units_along(const PendingMove& work, const control::Point& tangent) const {
    return basic_pulses_along(map_, {work.constant_vector, work.auxiliary}, tangent) / pulses_per_v_;
}

std::int32_t Segmenter::speed_units(double units, double speed) const {
    return static_cast<std::int32_t>(std::clamp(std::floor(units * speed), 1.0, max_units));
}

std::int32_t Segmenter::acceleration_units(double units, double acceleration) const {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(units * acceleration * acceleration_reserve / rules::rate_unit), 1.0, max_units));
}

/// The speed for starts and stops: half of each axis' velocity step, because a stop and a start in the opposite
/// direction may follow each other.
double Segmenter::start_speed(const control::Point& tangent) const {
    double speed = 1e9;
    for (std::size_t i = 0; i < tangent.size(); ++i)
        if (map_.channel[i] >= 0 && std::fabs(tangent[i]) > 1e-12)
            speed = std::min(speed, 0.5 * map_.limits[i].max_velocity_step / std::fabs(tangent[i]));
    return speed;
}

Pulses4 Segmenter::pulses_at(const PendingMove& work, double s) const {
    return s >= work.path.length ? work.to : map_.pulses(control::position_at(work.path, s));
}

/// Length at the end of a move for the deceleration from `top` to `exit` (V units). It includes the pulses for the
/// chip's whole steps, the host's register accesses and the rounding to pulses.
double Segmenter::fall_length(double units, const MoveSpeeds& speeds) const {
    if (speeds.top <= speeds.exit) return 0;
    const double top = speeds.top, exit = speeds.exit;
    const double ticks_per_step = speed_carry / speeds.acceleration;
    const double phase = ticks_per_step * (top * (top + 1) - exit * (exit + 1)) / 2 + ticks_per_step * top +
                         latency_seconds_ * rules::clock_hz * top;
    return (phase / range_ + 2) / (units * pulses_per_v_);
}

/// Position at which a move is divided so that its second segment decelerates to the exit speed. Both segments take the
/// host's minimum time; otherwise the move is not divided and has the exit speed from its start.
double Segmenter::fall_from(const PendingMove& work, double units, const MoveSpeeds& speeds) const {
    const double fall = fall_length(units, speeds);
    if (fall <= 0) return work.path.length;
    const double min_length = min_seconds_ * speeds.top / units, pulse = 1 / (units * pulses_per_v_);
    double from = work.path.length - std::max(fall, min_length);
    if (!leaves_time(work, from, work.path.length, speeds.top)) from -= 2 * pulse;
    const bool fits = from >= min_length && leaves_time(work, 0, from, speeds.top) &&
                      leaves_time(work, from, work.path.length, speeds.top);
    return fits ? from : 0;
}

/// Returns true if the host can serve a segment between two positions, by its whole pulses: of a few pulses, rounding
/// may remove one.
bool Segmenter::leaves_time(const PendingMove& work, double from, double to, std::int32_t v) const {
    const Pulses4 begin = from > 0 ? pulses_at(work, from) : at_;
    const auto pulses = static_cast<double>(basic_pulses(delta_between(work, begin, pulses_at(work, to))));
    return pulses >= min_counted_seconds_ * v * pulses_per_v_;
}

// ---- moves to segments

void Segmenter::emit(const PendingMove& work, std::optional<double> next_units) {
    if (work.shape == Shape::pause) return emit_pause(work);
    const bool rests = !next_units || work.move.exit_velocity <= 0 || work.turns_back;
    if (rests && !chain_open_ && work.move.jerk > 0 && emit_s_curve(work)) return;
    const double units = std::min(work.units_in, work.units_out);
    MoveSpeeds speeds;
    speeds.top = speed_units(units, work.move.cruise_velocity);
    speeds.exit = rests ? speed_units(work.units_out, start_speed(work.path.tangent_out))
                        : speed_units(std::min(work.units_out, *next_units), work.move.exit_velocity);
    speeds.exit = std::min(speeds.exit, speeds.top);
    speeds.acceleration = acceleration_units(units, work.move.accel);
    if (work.move.constant_accel) make_even(work, speeds);
    speeds.fall_from = fall_from(work, units, speeds);
    if (work.shape == Shape::chip_arc && left_at_ > speeds.top) {
        MoveSpeeds first = speeds;  // the arc begins with the higher rate of the move before
        first.top = static_cast<std::int32_t>(std::min(left_at_, max_units));
        first.exit = speeds.top;
        if (fall_length(units, first) > speeds.fall_from) speeds.fall_from = 0;
    }
    left_at_ = rests ? 0 : work.units_out * work.move.exit_velocity;
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

void Segmenter::emit_pause(const PendingMove& work) {
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

void Segmenter::emit_straight(const PendingMove& work, const MoveSpeeds& speeds) {
    if (work.auxiliary >= 0 && !work.move.constant_accel) return emit_chords(work, speeds);
    if (speeds.fall_from > 0) {
        const Pulses4 middle = pulses_at(work, speeds.fall_from);
        Pulses4 fall = {};
        for (std::size_t c = 0; c < fall.size(); ++c) fall[c] = work.to[c] - middle[c];
        // The deceleration begins with the speed of the previous segment.
        emit_line(work, middle, std::min(speeds.top, max_on(fall, work.constant_vector).speed), speeds.acceleration);
    }
    // A pulse that waits for a free axis is not a segment of its own.
    if (speeds.fall_from >= work.path.length) return;
    emit_line(work, work.to, speeds.exit, speeds.acceleration);
}

/// Draws one S-curve from standstill to standstill, if the chip's ramp fits into the move and its lowest jerk is low
/// enough. The S-curve is the whole chain, so no pulse may be left over: a third axis with less than one pulse from
/// earlier moves is drawn in the same line.
bool Segmenter::emit_s_curve(const PendingMove& planned) {
    if (planned.shape != Shape::line || planned.auxiliary >= 0) return false;
    const Pulses4 delta = delta_between(planned, at_, planned.to);
    const auto moving = delta.size() - static_cast<std::size_t>(std::count(delta.begin(), delta.end(), 0));
    if (moving > 3) return false;
    PendingMove work = planned;
    if (moving > 2 && work.constant_vector) {
        work.constant_vector = false;
        work.units_in = work.units_out = units_along(work, work.path.tangent_in);
    }
    const double units = work.units_in;
    const double initial = std::floor(units * start_speed(work.path.tangent_in));
    const double k = std::ceil(rules::jerk_unit / (units * work.move.jerk));
    if (k > static_cast<double>(param::K.max) || initial < 1) return false;
    // The top speed for which two S-ramps, with or without the acceleration limit, fit into the length of the move.
    const double a = units * work.move.accel, j = rules::jerk_unit / std::max(1.0, k), v0 = initial;
    auto ramp_length = [&](double v) {  // V units * seconds
        const double dv = v - v0;
        const double time = dv * j <= a * a ? 2 * std::sqrt(dv / j) : dv / a + a / j;
        return (v + v0) / 2 * time;
    };
    const double whole = units * work.path.length;
    const double spare = (8 + 0.02 * whole * rules::clock_hz / range_) * range_ / rules::clock_hz + v0 * 1e-3;
    double low = v0 + 1, high = std::min(max_units, units * work.move.cruise_velocity);
    if (high <= low || 2 * ramp_length(low) + spare > whole) return false;
    if (2 * ramp_length(high) + spare > whole)
        for (int i = 0; i < 40; ++i)
            (2 * ramp_length((low + high) / 2) + spare > whole ? high : low) = (low + high) / 2;
    else
        low = high;
    for (std::size_t c = 0; c < at_.size(); ++c)
        if (work.to[c] - at_[c] > max_line_pulses || at_[c] - work.to[c] > max_line_pulses) return false;
    // The chip's S-ramps are slightly asymmetric: AO covers the extra pulses of the deceleration, which would otherwise
    // end too fast.
    const auto v = static_cast<std::int32_t>(low), sv = static_cast<std::int32_t>(initial);
    const auto limit = static_cast<std::int32_t>(std::clamp(std::floor(a / rules::rate_unit), 1.0, max_units));
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

}  // namespace motionrack::mcx314
