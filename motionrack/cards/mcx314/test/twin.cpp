// The twin's tick: inputs, a pulse and its consequences.
#include <algorithm>
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

namespace {
constexpr std::uint16_t flag_pulse = 1u << 0;
constexpr std::uint16_t flag_drive_end = 1u << 7;

}  // namespace

void Twin::tick() {
    ++now_;
    if (extended_) sample();
    for (int a = 0; a < axis_count; ++a) {
        Axis& axis = axes_[a];
        if (axis.gen.kind != Generator::Kind::idle) work(a);
    }
    for (Axis& axis : axes_) {
        if (!axis.waits_position) continue;
        const bool in_position = axis.level(Pin::in_position) == bit(axis.wr2, 14);
        if (!bit(axis.wr2, 15) || in_position) axis.waits_position = false;
    }
    look_at_wires();
    for (int a = 0; a < axis_count; ++a) look_at_home(a);
    act_together();
}

void Twin::work(int a) {
    Generator& gen = axes_[a].gen;
    if (gen.wait > 0) {
        --gen.wait;
        return;
    }
    if (inputs(a)) return;
    if (gen.kind == Generator::Kind::fixed && gen.n >= axes_[a].reg.pulses) return end(a);
    if (gen.kind == Generator::Kind::path && path_finished() && segment_end(a)) return;
    if (halted(a)) return;
    bool step_made = false;
    gen.acc += gen.speed;
    if (gen.acc >= gen.range_now) {
        gen.acc -= gen.range_now;
        if (pulse(a)) return;
        step_made = by_steps(a);
    }
    if (speed_step(a) || !step_made) return;
    step_under_way_ = false;
    if (gen.stopping) end(a);
}

// ---- step 1

// Returns true if generator `a` steps axis `other` in the present segment, or is its own generator.
bool Twin::moves_with(int a, int other) const {
    if (axes_[a].gen.kind != Generator::Kind::path) return a == other;
    return (path_.segment().mask() >> other & 1) != 0;
}

// Returns the active stop causes of an axis as bits of RR1, and which kind of stop they request.
std::uint16_t Twin::active_inputs(const Axis& axis, bool& decelerating, bool& immediate) const {
    unsigned causes = 0;
    for (int i = 0; i < 4; ++i) {
        if (bit(axis.wr1, 2 * i + 1) && axis.level(static_cast<Pin>(i)) == bit(axis.wr1, 2 * i))
            causes |= 1u << (8 + i);
    }
    if (causes != 0) decelerating = true;
    const bool plus = axis.direction > 0;
    const Pin limit = plus ? Pin::limit_plus : Pin::limit_minus;
    if (axis.level(limit) == bit(axis.wr2, plus ? 3 : 4)) {
        causes |= plus ? 1u << 12 : 1u << 13;
        (bit(axis.wr2, 2) ? decelerating : immediate) = true;
    }
    if (bit(axis.wr2, 13) && axis.level(Pin::alarm) == bit(axis.wr2, 12)) {
        causes |= 1u << 14;
        immediate = true;
    }
    if (!emergency_level()) {
        causes |= 1u << 15;
        immediate = true;
    }
    return static_cast<std::uint16_t>(causes);
}

bool Twin::beyond_software_limit(const Axis& axis) const {
    const std::int32_t counter = bit(axis.wr2, 5) ? axis.ep : axis.lp;
    const bool at = options_.software_limit == SoftwareLimit::at && counter == axis.comp_plus;
    if (axis.direction > 0) return bit(axis.wr2, 0) && (counter > axis.comp_plus || at);
    return bit(axis.wr2, 1) && counter < axis.comp_minus;
}

// Applies the stop inputs; returns true if the drive ended.
bool Twin::inputs(int a) {
    Generator& gen = axes_[a].gen;
    bool decelerating = gen.ask_decelerating;
    bool immediate = gen.ask_immediate;
    gen.ask_decelerating = gen.ask_immediate = false;
    for (int i = 0; i < axis_count; ++i) {
        if (!moves_with(a, i)) continue;
        axes_[i].causes |= active_inputs(axes_[i], decelerating, immediate);
        if (beyond_software_limit(axes_[i])) decelerating = true;
        if (home_stops(axes_[i])) decelerating = true;
    }
    return stop(a, decelerating, immediate);
}

// Applies a stop request; returns true if it ended the drive.
bool Twin::stop(int a, bool decelerating, bool immediate) {
    Generator& gen = axes_[a].gen;
    if (!decelerating && !immediate) return false;
    if (immediate || halted(a) || gen.speed <= used_start_speed(axes_[a].reg)) return end(a), true;
    gen.final = gen.stopping = true;
    if (gen.kind == Generator::Kind::path) queued_ = false;
    return false;
}

void Twin::end(int a) {
    const unsigned axes = axes_[a].gen.kind == Generator::Kind::path ? chain_ : 1u << a;
    for (int i = 0; i < axis_count; ++i) {
        if (!(axes >> i & 1)) continue;
        Axis& axis = axes_[i];
        if (chain_ >> i & 1 && !emergency_level()) axis.causes |= 1u << 15;
        axis.finished |= axis.causes;
        axis.causes = 0;
        axis.flags |= axis.wr1 >> 8 & flag_drive_end;
        axis.waits_position = true;
        note(i, 0x0020);
    }
    if (axes_[a].gen.kind == Generator::Kind::path) {
        chain_ = 0;
        queued_ = false;
    }
    axes_[a].gen.kind = Generator::Kind::idle;
    axes_[a].gen.ramp = 0;
    axes_[a].external = -1;
}

// ---- step 2

// Executes a pulse of the generator; returns true if the drive ended with it.
bool Twin::pulse(int a) {
    Generator& gen = axes_[a].gen;
    ++gen.n;
    for (int i = 0; i < axis_count; ++i)
        if (moves_with(a, i)) axes_[i].pulse_end = now_;
    const int stepped = step_axes(a);
    if (gen.kind == Generator::Kind::path) {
        path_stepped_ = stepped;
        gen.range_now = path_range_[stepped - 1];
    }
    show_pulse(a);
    if (gen.ramp > 0) ++gen.accel_pulses;
    if (gen.ramp < 0 && !gen.final && gen.accel_pulses > 0) --gen.accel_pulses;

    bool beyond = false;
    for (int i = 0; i < axis_count; ++i) beyond = beyond || (moves_with(a, i) && beyond_software_limit(axes_[i]));
    if (stop(a, beyond, false)) return true;
    if (gen.kind == Generator::Kind::fixed && gen.n >= axes_[a].reg.pulses) return end(a), true;
    if (gen.kind == Generator::Kind::path && path_finished()) return segment_end(a);
    check_final(a);
    avoid_triangle(axes_[a]);
    return false;
}

// Makes the pulse wires of the axes that have just moved active for half a period.
void Twin::show_pulse(int a) {
    const Generator& gen = axes_[a].gen;
    for (int i = 0; i < axis_count; ++i)
        if (moves_with(a, i) && axes_[i].pulse_end > now_)
            axes_[i].pulse_end = now_ + std::max<std::int64_t>(1, gen.range_now / gen.speed / 2);
}

// Moves the axes of one pulse; returns the number of axes moved.
int Twin::step_axes(int a) {
    if (axes_[a].gen.kind != Generator::Kind::path) return move(a, axes_[a].direction), 1;
    if (path_.is_pattern()) return step_pattern();
    std::array<int, 3> step{};
    path_.step(step);
    int moved = 0;
    for (int i = 0; i < path_.segment().count; ++i) {
        Axis& axis = axes_[path_.segment().axis[i]];
        if (step[i] != 0) {
            move(path_.segment().axis[i], step[i]);
            ++moved;
        }
        if (path_.direction(i) != 0) axis.direction = path_.direction(i);
    }
    return moved;
}

// Executes the next step of the running word; returns the number of axes moved, at least one.
int Twin::step_pattern() {
    const Pattern::Step step = pattern_.pop();
    const Segment& segment = path_.segment();
    if (step.is_end(segment.count)) {
        pattern_.clear();
        return 1;
    }
    int moved = 0;
    for (int i = 0; i < segment.count; ++i) {
        if (step.of(i) == 0) continue;
        move(segment.axis[i], step.of(i));
        ++moved;
    }
    if (!pattern_.running()) next_word();
    look_ahead();
    return std::max(moved, 1);
}

void Twin::next_word() {
    const int before = pattern_.counter();
    if (!pattern_.take()) ++conditions_;
    if (before == 2 && pattern_.counter() == 1 && bit(wr5_, 15)) pattern_.interrupt = true;
}

void Twin::look_ahead() {
    const Segment& segment = path_.segment();
    for (int i = 0; i < segment.count; ++i)
        if (const int direction = pattern_.next_direction(i, segment.count); direction != 0)
            axes_[segment.axis[i]].direction = direction;
}

bool Twin::path_finished() const {
    return path_.is_pattern() ? !pattern_.running() : path_.finished();
}

void Twin::move(int a, int direction) {
    Axis& axis = axes_[a];
    axis.lp = next_count(axis, axis.lp, direction);
    count_[a] += direction;
    ++made_[a];
    axis.flags |= axis.wr1 >> 8 & flag_pulse;
    axis.pulse_direction = direction;
    axis.pulse_end = now_ + 1;
    if (recording_) pulses_.push_back({now_, a, direction});
    compare(a);
}

// Ends the running segment: the queued one takes over, or the drive ends (returns true).
bool Twin::segment_end(int a) {
    if (!queued_) return end(a), true;
    queued_ = false;
    begin_segment(queue_);
    axes_[a].gen.n = 0;
    axes_[a].gen.range_now = path_range_[path_stepped_ - 1];
    if (bit(wr5_, 14)) path_interrupt_ = true;
    if (path_finished()) return end(a), true;
    check_final(a);
    return false;
}

void Twin::begin_segment(const Segment& segment) {
    path_.begin(segment);
    if (path_.is_pattern()) {
        if (!pattern_.running()) next_word();
        look_ahead();
    }
    const auto range_of = [&](int i) { return used_range(axes_[segment.axis[i]].reg); };
    path_range_.fill(axes_[master_].gen.range);
    if (segment.constant_speed == 1) path_range_[1] = path_range_[2] = range_of(1);
    if (segment.constant_speed == 3) {
        path_range_[1] = range_of(1);
        path_range_[2] = segment.count == 3 ? range_of(2) : path_range_[1];
    }
    for (int i = 0; i < segment.count; ++i)
        if (path_.direction(i) != 0) axes_[segment.axis[i]].direction = path_.direction(i);
}

// ---- start of the final deceleration

void Twin::check_final(int a) {
    const Axis& axis = axes_[a];
    Generator& gen = axes_[a].gen;
    if (gen.kind == Generator::Kind::path) return check_final_of_path();
    if (gen.kind != Generator::Kind::fixed) return;
    const std::int64_t left = std::int64_t{axis.reg.pulses} - gen.n;
    if (gen.manual ? gen.n >= axis.reg.decel_point : left <= final_pulses(axis) + axis.reg.offset) gen.final = true;
}

void Twin::check_final_of_path() {
    const Axis& axis = axes_[master_];
    Generator& gen = axes_[master_].gen;
    if (!decel_enabled_ || queued_) return;
    if (gen.manual) {
        if (gen.n >= axis.reg.decel_point) gen.final = true;
    } else if (path_.is_line() && path_.left() <= final_pulses(axis) + axis.reg.offset) {
        gen.final = true;
    }
}

// ---- comparisons

void Twin::compare(int a) {
    Axis& axis = axes_[a];
    const std::int32_t counter = bit(axis.wr2, 5) ? axis.ep : axis.lp;
    unsigned now = 0;
    if (counter >= axis.comp_minus) now |= 1u << 1;
    if (counter < axis.comp_minus) now |= 1u << 2;
    if (counter < axis.comp_plus) now |= 1u << 3;
    if (counter >= axis.comp_plus) now |= 1u << 4;
    const unsigned risen = now & ~axis.compared;
    axis.compared = now;
    axis.flags |= static_cast<std::uint16_t>(axis.wr1 >> 8 & risen);
    if (risen & 1u << 4) note(a, 0x0001);
    if (risen & 1u << 3) note(a, 0x0002);
    if (risen & 1u << 2) note(a, 0x0004);
    if (risen & 1u << 1) note(a, 0x0008);
}

bool Twin::interrupt() const {
    return path_interrupt_ || pattern_.interrupt ||
           std::any_of(axes_.begin(), axes_.end(), [](const Axis& axis) { return axis.flags != 0; });
}

bool Twin::any_driving() const {
    for (int a = 0; a < axis_count; ++a)
        if (driving(a)) return true;
    return false;
}

}  // namespace motionrack::mcx314::twin
