// Samples in virtual time and evaluates the samples between runs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/rack/monitor.hpp>

namespace motionrack::rack {

namespace {
constexpr std::size_t max_blocks = 20'000;
// Pulses: a segment begins and ends at whole pulses of its own axis and of the leading axis.
constexpr double max_rounding = 2;
// Tolerance of the acceleration limit: one velocity step of the card more or less within the averaging time.
constexpr double accel_reserve = 1.03;
}  // namespace

void Monitor::RateObserver::rate_changed(double before, double rate, Instant now) {
    velocity.changed(before, rate, now);
    const bool ramp = std::fabs(rate - before) <= jump_hz;
    if (pending) {
        const double seconds = to_seconds(now - since);
        away += (present - good) * seconds;
        explained += accel_hz * seconds;
        const double drift = before - present;  // along a curve, between the changes
        good += drift;
        follower += drift;
        present = before;
        if (std::fabs(away) > full_step) settle();
    }
    if (!pending) good = follower = before;
    if (pending && ramp) {  // a ramp continues after the step
        good += rate - before;
        follower += rate - before;
    }
    if (pending && !ramp) {
        follower += std::clamp(present - follower, -explained, explained);
        explained = 0;
    }
    if (!ramp) {
        ++jumps;
        const double piece = std::max(to_seconds(now - piece_since), 1e-9);
        rounding = std::max(pending ? rounding : 0, max_rounding / piece);
        piece_since = now;
    }
    present = rate;
    since = now;
    const double step = std::fabs(rate - good);
    if (step <= jump_hz || (pending && step <= 2 * jump_hz)) {
        good = rate;
        pending = false;
    } else if (!pending) {
        pending = true;
        away = explained = 0;
    }
}

void Monitor::RateObserver::settle() {
    if (!pending) return;
    jump = std::max(jump, std::min(std::fabs(present - good), std::fabs(present - follower)) - rounding);
    good = present;
    pending = false;
    ++jumps;
}

void Monitor::RateObserver::restart(const PeakVelocity& fresh, double rate, Instant now) {
    velocity = fresh;
    good = follower = present = rate;
    away = rounding = explained = jump = 0;
    pending = false;
    since = piece_since = now;
    jumps = 0;
}

Monitor::Seen::Seen(const std::vector<WatchedAxis>& axes, Duration period, std::size_t max_samples)
    : kept(max_samples) {
    for (const WatchedAxis& axis : axes) {
        // A servo follows a voltage in steps; a card without these limits is not checked against them.
        const bool watched = axis.servo == nullptr && axis.start_hz > 0;
        jump_watches.emplace_back(axis.start_hz, axis.accel_hz, watched ? period : never);
    }
}

Monitor::Monitor(sim::Kernel& kernel, std::vector<WatchedAxis> axes, Duration period, std::size_t max_samples)
    : kernel_(kernel),
      id_(kernel.add(*this, sim::Phase::observers, "monitor")),
      axes_(std::move(axes)),
      period_(period),
      max_samples_(max_samples),
      seen_(axes_, period, max_samples) {
    listeners_.reserve(axes_.size());  // listeners keep their addresses
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        listeners_.emplace_back(axes_[i].jump_hz, period);
        listeners_[i].full_step = axes_[i].full_step;
        listeners_[i].accel_hz = axes_[i].accel_hz;
        axes_[i].commanded->add_listener(listeners_[i]);
    }
}

void Monitor::restart(std::vector<WatchedAxis> axes) {
    axes_ = std::move(axes);
    seen_ = Seen(axes_, period_, max_samples_);
    const Instant now = kernel_.now();
    for (std::size_t i = 0; i < axes_.size(); ++i)
        listeners_[i].restart(PeakVelocity(axes_[i].jump_hz, period_), axes_[i].commanded->rate(now), now);
}

// ---- in virtual time

void Monitor::begin() {
    ring_.resize(ring_size);
    running_ = true;
    kernel_.schedule(id_, kernel_.now());
}

void Monitor::finish() {
    running_ = false;
    kernel_.schedule(id_, never);
    take(kernel_.now());
    drain();
    if (seen_.block_open) close_block(kernel_.now());
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        listeners_[i].settle();
        AxisStatistics& out = seen_.statistics[static_cast<std::size_t>(axes_[i].index)];
        listeners_[i].velocity.finish();
        out.peak_velocity = listeners_[i].velocity.hz() / axes_[i].pulses_per_unit;
        out.peak_velocity_step = listeners_[i].jump / axes_[i].pulses_per_unit;
    }
}

void Monitor::on_scheduled(Instant now) {
    take(now);
    for (std::size_t i = 0; i < axes_.size(); ++i)
        listeners_[i].velocity.sample(axes_[i].commanded->count(now), axes_[i].commanded->rate(now), now);
    if (running_) kernel_.schedule(id_, now + period_);
}

void Monitor::take(Instant now) {
    if (seen_.ring_end - seen_.ring_begin >= ring_size) {
        ++seen_.ring_lost;
        return;
    }
    RawSample& raw = ring_[seen_.ring_end++ % ring_size];
    raw.at = now;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        raw.count[i] = axes_[i].real->count(now);
        raw.commanded[i] = axes_[i].commanded->count(now);
        raw.rate[i] = axes_[i].commanded->rate(now);
        if (axes_[i].servo != nullptr) raw.volts[i] = static_cast<float>(axes_[i].servo->volts());
        raw.jumps[i] = listeners_[i].jumps;
    }
}

// ---- between runs

void Monitor::planned(std::int64_t block, const control::PlannedMove& move) {
    seen_.planned.push_back({block, move});
}

void Monitor::started(const std::vector<control::MoveStart>& starts) {
    seen_.starts.insert(seen_.starts.end(), starts.begin(), starts.end());
}

void Monitor::drain() {
    while (seen_.ring_begin < seen_.ring_end) work_off(ring_[seen_.ring_begin++ % ring_size]);
    seen_.ring_begin = seen_.ring_end = 0;
}

void Monitor::close_block(Instant end) {
    seen_.open_block.end = end;
    if (seen_.blocks.size() < max_blocks)
        seen_.blocks.push_back(seen_.open_block);
    else
        ++seen_.blocks_left_out;
    seen_.block_open = false;
}

void Monitor::work_off(const RawSample& raw) {
    while (!seen_.starts.empty() && seen_.starts.front().at <= raw.at) {
        const control::MoveStart start = seen_.starts.front();
        seen_.starts.pop_front();
        if (seen_.block_open) close_block(start.at);
        if (start.block < 0) continue;
        seen_.current = start.block;
        while (seen_.planned.size() > 1 && seen_.planned[1].block < seen_.current) seen_.planned.pop_front();
        for (const Planned& planned : seen_.planned) {
            if (planned.block != seen_.current) continue;
            seen_.open_block = {seen_.current,
                                planned.move.move.line,
                                planned.move.move.kind,
                                planned.move.length,
                                planned.move.entry_velocity,
                                planned.move.cruise_velocity,
                                planned.move.exit_velocity,
                                start.at,
                                start.at,
                                0};
            seen_.block_open = true;
            begin_programmed(planned.move);
        }
    }
    find_programmed();
    MonitorSample sample;
    sample.at = raw.at;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const auto axis = static_cast<std::size_t>(axes_[i].index);
        sample.position[axis] = axes_[i].origin + static_cast<double>(raw.count[i]) / axes_[i].pulses_per_unit;
        sample.commanded[axis] = axes_[i].origin + axes_[i].commanded_beyond +
                                 static_cast<double>(raw.commanded[i]) / axes_[i].pulses_per_unit;
        sample.volts[axis] = raw.volts[i];
        sample.velocity[axis] = raw.rate[i] / axes_[i].pulses_per_unit;
    }
    accelerations(raw, sample);
    look_for_jumps(raw, sample);
    const ProgramDistance distance = deviation_at(sample.position);
    look_at_deviation(sample, distance);
    const double off = distance.mm;
    if (off > seen_.max_deviation.mm)
        seen_.max_deviation = {
            off, sample.at, seen_.open_block.line, {sample.position[0], sample.position[1], sample.position[2]}};
    if (seen_.block_open) seen_.open_block.deviation_mm = std::max(seen_.open_block.deviation_mm, off);
    ++seen_.taken;
    seen_.kept.add(sample, off);
    if (on_sample_) on_sample_(sample, off);
}

void Monitor::accelerations(const RawSample& raw, MonitorSample& sample) {
    std::move_backward(seen_.last.begin(), seen_.last.end() - 1, seen_.last.end());
    seen_.last[0] = raw;
    if (++seen_.last_count < 5) return;
    const double seconds = to_seconds(raw.at - seen_.last[4].at);
    if (seconds <= 0) return;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const auto axis = static_cast<std::size_t>(axes_[i].index);
        const double accel = (raw.rate[i] - seen_.last[4].rate[i]) / axes_[i].pulses_per_unit / seconds;
        const bool jumped = raw.jumps[i] != seen_.last[4].jumps[i];
        sample.accel[axis] = jumped ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(accel);
        if (jumped) continue;
        seen_.statistics[axis].peak_accel = std::max(seen_.statistics[axis].peak_accel, std::fabs(accel));
        const double limit = axes_[i].accel_hz / axes_[i].pulses_per_unit;
        if (axes_[i].start_hz <= 0 || std::fabs(accel) <= accel_reserve * limit) continue;
        Breach breach = breach_here(sample);
        breach.kind = BreachKind::accel;
        breach.axis = axes_[i].index;
        breach.value = std::fabs(accel);
        breach.limit = limit;
        seen_.breaches.add(breach);
    }
}

Breach Monitor::breach_here(const MonitorSample& sample) const {
    Breach out;
    out.at = sample.at;
    out.line = seen_.open_block.line;
    out.position = {sample.position[0], sample.position[1], sample.position[2]};
    return out;
}

void Monitor::look_for_jumps(const RawSample& raw, const MonitorSample& sample) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const JumpWatch::Jump jump = seen_.jump_watches[i].sample(raw.commanded[i]);
        if (jump.hz <= 0) continue;
        Breach breach = breach_here(sample);
        breach.kind = BreachKind::jump;
        breach.axis = axes_[i].index;
        breach.at = sample.at - seen_.jump_watches[i].middle();
        breach.value = jump.hz / axes_[i].pulses_per_unit;
        breach.limit = axes_[i].start_hz / axes_[i].pulses_per_unit;
        breach.times = jump.first;
        seen_.breaches.add(breach);
    }
}

/// A motor that does not follow is reported elsewhere; here the pulses must not leave the path.
void Monitor::look_at_deviation(const MonitorSample& sample, const ProgramDistance& off) {
    const bool was_beside = seen_.beside;
    seen_.beside = false;
    if (allowed_mm_ <= 0 || off.judged_mm <= off.tolerance_mm + allowed_mm_) return;
    const ProgramDistance led = deviation_at(sample.commanded);
    if (led.judged_mm <= led.tolerance_mm + allowed_mm_) return;
    seen_.beside = true;
    Breach breach = breach_here(sample);
    breach.kind = BreachKind::deviation;
    breach.value = led.judged_mm;
    breach.limit = led.tolerance_mm + allowed_mm_;
    breach.times = !was_beside;
    seen_.breaches.add(breach);
}

std::array<double, 3> Monitor::place_at(Instant at) const {
    const std::vector<MonitorSample>& kept = samples();
    if (kept.empty()) return {};
    const auto after =
        std::lower_bound(kept.begin(), kept.end(), at, [](const MonitorSample& one, Instant t) { return one.at < t; });
    const MonitorSample& near = after == kept.end() ? kept.back() : *after;
    return {near.position[0], near.position[1], near.position[2]};
}

/// Several planned moves may follow on one programmed move, or on several merged ones. A planned move may end beyond
/// the start of the next programmed one by nearly its own length.
void Monitor::begin_programmed(const control::PlannedMove& block) {
    const std::int64_t index = block.move.index;
    if (seen_.part.first < 0 || index != seen_.current_programmed) {
        seen_.part.first = seen_.current_programmed < 0 ? index : std::min(index, seen_.current_programmed);
        seen_.part.furthest = std::max(index, seen_.current_programmed);
        seen_.before_mm = seen_.last_mm;
        seen_.current_mm = 0;
        seen_.current_programmed = index;
        seen_.program.drop_before(seen_.part.first);
    }
    seen_.last_mm = block.length;
    seen_.current_mm += block.length;
}

/// The host learns of a junction slightly late, so the programmed moves of the previous and the next planned move count
/// too. A planned move may stand for several programmed moves, and vice versa.
void Monitor::find_programmed() {
    constexpr double longer = 2, more_mm = 1;  // a programmed path may be longer than the planned one
    seen_.part.last = std::numeric_limits<std::int64_t>::max();
    seen_.part.reach_mm = more_mm + longer * (seen_.before_mm + seen_.current_mm);
    std::int64_t next = -1;
    for (const Planned& planned : seen_.planned) {
        const std::int64_t index = planned.move.move.index;
        if (planned.block <= seen_.current + 1) {
            if (planned.block > seen_.current) seen_.part.reach_mm += longer * planned.move.length;
            next = index;
        } else if (index > next) {
            seen_.part.last = index;
            return;
        }
    }
}

ProgramDistance Monitor::deviation_at(const std::array<double, control::axis_count>& position) const {
    if (seen_.current < 0) return {};
    return seen_.program.distance(seen_.part, position[0], position[1], position[2]);
}

}  // namespace motionrack::rack
