// Sampling in virtual time, and what is made of the samples between runs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/rack/monitor.hpp>

namespace motionrack::rack {

namespace {
constexpr std::size_t most_blocks = 20'000;
// Pulses: a piece begins and ends at whole pulses of its own axis and of the one that leads it.
constexpr double most_rounding = 2;
// The acceleration of an axis is kept but for a speed step of the card more or less within the time that it is taken
// over.
constexpr double accel_reserve = 1.03;
}  // namespace

void Monitor::Ear::rate_changed(double before, double rate, Instant now) {
    speed.changed(before, rate, now);
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
    if (pending && ramp) {  // a ramp goes on after the jump
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
        rounding = std::max(pending ? rounding : 0, most_rounding / piece);
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

void Monitor::Ear::settle() {
    if (!pending) return;
    jump = std::max(jump, std::min(std::fabs(present - good), std::fabs(present - follower)) - rounding);
    good = present;
    pending = false;
    ++jumps;
}

Monitor::Monitor(sim::Kernel& kernel, std::vector<WatchedAxis> axes, Duration period, std::size_t most_samples)
    : kernel_(kernel),
      id_(kernel.add(*this, sim::Phase::observers, "monitor")),
      axes_(std::move(axes)),
      period_(period),
      kept_(most_samples) {
    ears_.reserve(axes_.size());  // they are listened with
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        ears_.emplace_back(axes_[i].jump_hz, period);
        ears_[i].full_step = axes_[i].full_step;
        ears_[i].accel_hz = axes_[i].accel_hz;
        axes_[i].commanded->listen(ears_[i]);
        // A servo follows a voltage in steps; a card that has none of these limits is not held to them.
        const bool watched = axes_[i].servo == nullptr && axes_[i].start_hz > 0;
        jump_watches_.emplace_back(axes_[i].start_hz, axes_[i].accel_hz, watched ? period : never);
    }
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
    if (block_open_) close_block(kernel_.now());
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        ears_[i].settle();
        AxisStatistics& out = statistics_[static_cast<std::size_t>(axes_[i].index)];
        ears_[i].speed.finish();
        out.top_speed = ears_[i].speed.hz() / axes_[i].pulses_per_unit;
        out.top_jump = ears_[i].jump / axes_[i].pulses_per_unit;
    }
}

void Monitor::act(Instant now) {
    take(now);
    for (std::size_t i = 0; i < axes_.size(); ++i)
        ears_[i].speed.look(axes_[i].commanded->count(now), axes_[i].commanded->rate(now), now);
    if (running_) kernel_.schedule(id_, now + period_);
}

void Monitor::take(Instant now) {
    if (ring_end_ - ring_begin_ >= ring_size) {
        ++ring_lost_;
        return;
    }
    RawSample& raw = ring_[ring_end_++ % ring_size];
    raw.at = now;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        raw.count[i] = axes_[i].real->count(now);
        raw.commanded[i] = axes_[i].commanded->count(now);
        raw.rate[i] = axes_[i].commanded->rate(now);
        if (axes_[i].servo != nullptr) raw.volts[i] = static_cast<float>(axes_[i].servo->volts());
        raw.jumps[i] = ears_[i].jumps;
    }
}

// ---- between runs

void Monitor::planned(std::int64_t block, const control::PlannedMove& move) {
    planned_.push_back({block, move});
}

void Monitor::started(const std::vector<control::BlockStart>& starts) {
    starts_.insert(starts_.end(), starts.begin(), starts.end());
}

void Monitor::drain() {
    while (ring_begin_ < ring_end_) work_off(ring_[ring_begin_++ % ring_size]);
    ring_begin_ = ring_end_ = 0;
}

void Monitor::close_block(Instant end) {
    open_block_.end = end;
    if (blocks_.size() < most_blocks)
        blocks_.push_back(open_block_);
    else
        ++blocks_left_out_;
    block_open_ = false;
}

void Monitor::work_off(const RawSample& raw) {
    while (!starts_.empty() && starts_.front().at <= raw.at) {
        const control::BlockStart start = starts_.front();
        starts_.pop_front();
        if (block_open_) close_block(start.at);
        if (start.block < 0) continue;
        current_ = start.block;
        while (planned_.size() > 1 && planned_[1].block < current_) planned_.pop_front();
        for (const Planned& planned : planned_) {
            if (planned.block != current_) continue;
            open_block_ = {current_,
                           planned.move.move.line,
                           planned.move.move.kind,
                           planned.move.length,
                           planned.move.entry,
                           planned.move.cruise,
                           planned.move.exit,
                           start.at,
                           start.at,
                           0};
            block_open_ = true;
            begin_programmed(planned.move);
        }
    }
    find_programmed();
    Sample sample;
    sample.at = raw.at;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const auto axis = static_cast<std::size_t>(axes_[i].index);
        sample.position[axis] = axes_[i].origin + static_cast<double>(raw.count[i]) / axes_[i].pulses_per_unit;
        sample.commanded[axis] = axes_[i].origin + static_cast<double>(raw.commanded[i]) / axes_[i].pulses_per_unit;
        sample.volts[axis] = raw.volts[i];
        sample.speed[axis] = raw.rate[i] / axes_[i].pulses_per_unit;
    }
    accelerations(raw, sample);
    look_for_jumps(raw, sample);
    const ProgramDistance distance = deviation_at(sample.position);
    look_at_deviation(sample, distance);
    const double off = distance.mm;
    if (off > worst_.mm)
        worst_ = {off, sample.at, open_block_.line, {sample.position[0], sample.position[1], sample.position[2]}};
    if (block_open_) open_block_.deviation_mm = std::max(open_block_.deviation_mm, off);
    ++taken_;
    kept_.add(sample, off);
    if (on_sample_) on_sample_(sample, off);
}

void Monitor::accelerations(const RawSample& raw, Sample& sample) {
    std::move_backward(last_.begin(), last_.end() - 1, last_.end());
    last_[0] = raw;
    if (++last_count_ < 5) return;
    const double seconds = to_seconds(raw.at - last_[4].at);
    if (seconds <= 0) return;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const auto axis = static_cast<std::size_t>(axes_[i].index);
        const double accel = (raw.rate[i] - last_[4].rate[i]) / axes_[i].pulses_per_unit / seconds;
        const bool jumped = raw.jumps[i] != last_[4].jumps[i];
        sample.accel[axis] = jumped ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(accel);
        if (jumped) continue;
        statistics_[axis].top_accel = std::max(statistics_[axis].top_accel, std::fabs(accel));
        const double limit = axes_[i].accel_hz / axes_[i].pulses_per_unit;
        if (axes_[i].start_hz <= 0 || std::fabs(accel) <= accel_reserve * limit) continue;
        Breach breach = breach_here(sample);
        breach.kind = BreachKind::accel;
        breach.axis = axes_[i].index;
        breach.value = std::fabs(accel);
        breach.limit = limit;
        breaches_.add(breach);
    }
}

Breach Monitor::breach_here(const Sample& sample) const {
    Breach out;
    out.at = sample.at;
    out.line = open_block_.line;
    out.place = {sample.position[0], sample.position[1], sample.position[2]};
    return out;
}

void Monitor::look_for_jumps(const RawSample& raw, const Sample& sample) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const JumpWatch::Jump jump = jump_watches_[i].look(raw.commanded[i]);
        if (jump.hz <= 0) continue;
        Breach breach = breach_here(sample);
        breach.kind = BreachKind::jump;
        breach.axis = axes_[i].index;
        breach.at = sample.at - jump_watches_[i].middle();
        breach.value = jump.hz / axes_[i].pulses_per_unit;
        breach.limit = axes_[i].start_hz / axes_[i].pulses_per_unit;
        breach.times = jump.first;
        breaches_.add(breach);
    }
}

/// A motor that does not follow is another matter: it is the pulses that must not leave the path.
void Monitor::look_at_deviation(const Sample& sample, const ProgramDistance& off) {
    const bool was_beside = beside_;
    beside_ = false;
    if (allowed_mm_ <= 0 || off.judged_mm <= off.tolerance_mm + allowed_mm_) return;
    const ProgramDistance led = deviation_at(sample.commanded);
    if (led.judged_mm <= led.tolerance_mm + allowed_mm_) return;
    beside_ = true;
    Breach breach = breach_here(sample);
    breach.kind = BreachKind::deviation;
    breach.value = led.judged_mm;
    breach.limit = led.tolerance_mm + allowed_mm_;
    breach.times = !was_beside;
    breaches_.add(breach);
}

std::array<double, 3> Monitor::place_at(Instant at) const {
    const std::vector<Sample>& kept = samples();
    if (kept.empty()) return {};
    const auto after =
        std::lower_bound(kept.begin(), kept.end(), at, [](const Sample& one, Instant t) { return one.at < t; });
    const Sample& near = after == kept.end() ? kept.back() : *after;
    return {near.position[0], near.position[1], near.position[2]};
}

/// Several blocks may follow on one move, or on several that have become one.
void Monitor::begin_programmed(const control::PlannedMove& block) {
    const std::int64_t index = block.move.index;
    if (part_.first < 0 || index != current_programmed_) {
        part_.first = current_programmed_ < 0 ? index : std::min(index, current_programmed_);
        before_mm_ = current_mm_;
        current_mm_ = 0;
        current_programmed_ = index;
        program_.drop_before(part_.first);
    }
    current_mm_ += block.length;
}

/// The host hears of a joint a little after it happened, so the moves of the block before and of the one after count
/// too. A block may stand for several moves, and a move for several blocks.
void Monitor::find_programmed() {
    constexpr double longer = 2, more_mm = 1;  // a program's path than that of what it is driven as
    part_.last = std::numeric_limits<std::int64_t>::max();
    part_.reach_mm = more_mm + longer * (before_mm_ + current_mm_);
    std::int64_t next = -1;
    for (const Planned& planned : planned_) {
        const std::int64_t index = planned.move.move.index;
        if (planned.block <= current_ + 1) {
            if (planned.block > current_) part_.reach_mm += longer * planned.move.length;
            next = index;
        } else if (index > next) {
            part_.last = index;
            return;
        }
    }
}

ProgramDistance Monitor::deviation_at(const std::array<double, control::axis_count>& position) const {
    if (current_ < 0) return {};
    return program_.distance(part_, position[0], position[1], position[2]);
}

}  // namespace motionrack::rack
