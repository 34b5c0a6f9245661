// One tick by the rules: inputs, pulse, and the consequences of a pulse (RULES.md, "One generator an axis").
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

void Generators::work(int a) {
    Generator& gen = state_.axis[a].gen;
    if (gen.wait > 0) {
        --gen.wait;
        return;
    }
    gen.full_tick = false;
    if (inputs(a)) return;
    if (gen.drive == Drive::fixed && gen.n >= state_.axis[a].pulses) return end(a);
    if (gen.drive == Drive::path && law_.path_finished() && segment_end(a)) return;
    if (state_.halted(a)) return;
    gen.acc += gen.speed;
    bool step_made = false;
    if (gen.acc >= gen.range_now) {
        gen.acc -= gen.range_now;
        if (pulse(a)) return;
        step_made = state_.by_steps(a);
    }
    if (!speed_step(a) && step_made) end_step(a);
}

// ---- step 1

/// Returns the stop causes of one axis as bits of RR1; sets `decelerating` or `immediate` to the stop that they
/// request.
std::uint16_t Generators::active_inputs(const Axis& axis, bool& decelerating, bool& immediate) const {
    unsigned causes = 0;
    for (int i = 0; i < 4; ++i)
        if (stop_input_enabled(axis, i) && input_active(axis, i)) causes |= unsigned{rr1::IN0.mask} << i;
    if (causes != 0) decelerating = true;
    if (limit_active(axis, axis.direction)) {
        causes |= axis.direction > 0 ? rr1::LMTP.mask : rr1::LMTM.mask;
        (wr2::LMTMD.test(axis.wr2) ? decelerating : immediate) = true;
    }
    if (alarm_active(axis)) {
        causes |= rr1::ALARM.mask;
        immediate = true;
    }
    if (!state_.emergency_high) {
        causes |= rr1::EMG.mask;
        immediate = true;
    }
    return static_cast<std::uint16_t>(causes);
}

/// Returns true if the drive ended.
bool Generators::inputs(int a) {
    Generator& gen = state_.axis[a].gen;
    bool decelerating = gen.ask_decelerating, immediate = gen.ask_immediate;
    gen.ask_decelerating = gen.ask_immediate = false;
    const std::uint32_t moved = state_.moved_by(a);
    for (int i = 0; i < axes_of_chip; ++i) {
        if (!(moved >> i & 1)) continue;
        const unsigned causes = state_.axis[i].causes | active_inputs(state_.axis[i], decelerating, immediate);
        state_.axis[i].causes = static_cast<std::uint16_t>(causes);
        if (comparators_.beyond_software_limit(i)) decelerating = true;
        if (bit(state_.homing, i) && home_found(state_, i)) decelerating = true;
    }
    return stop(a, decelerating, immediate);
}

/// Begins the requested stop; returns true if it ended the drive.
bool Generators::stop(int a, bool decelerating, bool immediate) {
    Generator& gen = state_.axis[a].gen;
    if (!decelerating && !immediate) return false;
    if (immediate || state_.halted(a) || gen.speed <= rules::used_speed(state_.axis[a].start_speed))
        return end(a), true;
    if (!gen.final) gen.special_known = false;
    gen.final = gen.stopping = true;
    if (gen.drive == Drive::path) state_.queued = false;
    return false;
}

void Generators::end(int a) {
    const bool path = state_.axis[a].gen.drive == Drive::path;
    const unsigned ended = path ? state_.chain : 1u << a;
    for (int i = 0; i < axes_of_chip; ++i) {
        if (!(ended >> i & 1)) continue;
        Axis& axis = state_.axis[i];
        if (path && !state_.emergency_high) axis.causes |= rr1::EMG.mask;
        axis.finished = static_cast<std::uint16_t>(axis.finished | axis.causes);
        axis.causes = 0;
        request_interrupt(axis, rr3::DEND.mask);
        if (extended_) conditions_.note(i, sm::DEND);
        state_.in_place |= 1u << i;
        requests_.law_changed(i);
    }
    if (path) {
        state_.chain = 0;
        state_.queued = false;
    }
    state_.axis[a].gen.drive = Drive::idle;
    state_.axis[a].external = 0;
    state_.working &= ~(1u << a);
    state_.axis[a].gen.ramp = 0;
}

// ---- step 2

/// Executes a pulse of the generator; returns true if the drive ended with it.
bool Generators::pulse(int a) {
    Generator& gen = state_.axis[a].gen;
    ++gen.n;
    moved_last_ = 0;
    const int stepped = step_axes(a);
    if (gen.drive == Drive::path) {
        state_.stepped = stepped;
        gen.range_now = state_.path.range_for[static_cast<std::size_t>(stepped - 1)];
    }
    if (gen.ramp > 0) ++gen.accel_pulses;
    if (gen.ramp < 0 && !gen.final && gen.accel_pulses > 0) --gen.accel_pulses;
    if (gen.n >= gen.next_special) gen.special_known = false;
    forward_.mark_pulse(a, moved_last_, {state_.tick, gen.acc, gen.speed});
    for_each_axis(moved_last_, [this](int i) { state_.axis[i].mark.direction = went_[i]; });
    bool beyond = false;
    const std::uint32_t moved = state_.moved_by(a);
    for (int i = 0; i < axes_of_chip; ++i)
        beyond = beyond || ((moved >> i & 1) && comparators_.beyond_software_limit(i));
    if (stop(a, beyond, false)) return true;
    if (gen.drive == Drive::fixed && gen.n >= state_.axis[a].pulses) return end(a), true;
    if (gen.drive == Drive::path && law_.path_finished()) return segment_end(a);
    check_final(a);
    if (gen.no_triangle) avoid_triangle(a);
    return false;
}

/// Moves the axes of one pulse; returns the number of axes moved.
int Generators::step_axes(int a) {
    Path& path = state_.path;
    if (state_.axis[a].gen.drive != Drive::path) return move(a, state_.axis[a].direction, state_.tick), 1;
    if (path.command.pattern()) return step_pattern();
    int moved = 0;
    if (path.command.arc()) {
        const int octant = path.arc.octant;
        const std::array<int, 2> step = path.arc.step();
        for (int i = 0; i < 2; ++i) {
            const int axis = path.command.axis[i];
            if (step[i] != 0) move(axis, step[i], state_.tick), ++moved;
            state_.axis[axis].direction = law_.path_direction(i);
        }
        if (path.arc.octant != octant) {
            state_.axis[a].gen.full_tick = true;
            state_.axis[a].gen.special_known = false;
            requests_.law_changed_of(a);
        }
        return moved;
    }
    const std::int64_t n = state_.axis[a].gen.n;
    for (int i = 0; i < path.command.count; ++i) {
        const std::int64_t p = rules::magnitude(path.command.finish[i]);
        if (rules::line_steps(n, p, path.max_pulses) == path.made[i]) continue;
        ++path.made[i];
        move(path.command.axis[i], path.command.finish[i] < 0 ? -1 : 1, state_.tick);
        ++moved;
    }
    return moved;
}

void Generators::move(int a, int direction, std::int64_t tick_now) {
    Axis& axis = state_.axis[a];
    axis.lp = stepped(axis, axis.lp, direction);
    axis.count += direction;
    ++axis.made;
    request_interrupt(axis, rr3::PULSE.mask);
    moved_last_ |= 1u << a;
    went_[a] = direction;
    if (axis.steps_compared()) comparators_.compare(a);
    if (edges_.wanted(a)) edges_.add(a, tick_now, direction, axis.count);
    for (int i = 0; i < listeners_.of_axis[a].size(); ++i)
        if (axis.watch[i].left(axis.count)) state_.crossed |= 1u << a;
}

/// Ends the running segment: the queued one takes over, or the drive ends (returns true).
bool Generators::segment_end(int a) {
    if (!state_.queued) return end(a), true;
    state_.queued = false;
    requests_.law_changed_of(a);
    Generator& gen = state_.axis[a].gen;
    gen.n = 0;
    begin_segment(state_.queue);
    gen.range_now = state_.path.range_for[static_cast<std::size_t>(state_.stepped - 1)];
    gen.special_known = false;
    gen.full_tick = true;
    requests_.law_changed_of(a);
    if (wr5::CIINT.test(state_.bus.wr5)) state_.path_interrupt = true;
    if (law_.path_finished()) return end(a), true;
    check_final(a);
    return false;
}

void Generators::begin_segment(const PathCommand& command) {
    Path& path = state_.path;
    path.command = command;
    path.max_pulses = 0;
    path.made = {};
    if (command.pattern()) {
        if (state_.pattern.place == Pattern::length) next_pattern_word();
        look_ahead_in_pattern();
    } else if (command.arc())
        path.arc.begin(command.centre[0], command.centre[1], command.finish[0], command.finish[1],
                       command.code == cmd::ARC_CW);
    else
        for (int i = 0; i < command.count; ++i)
            path.max_pulses = std::max(path.max_pulses, rules::magnitude(command.finish[i]));
    auto range_of = [&](int i) { return rules::used_range(state_.axis[command.axis[i]].range); };
    path.range_for.fill(state_.axis[state_.master].gen.range);
    if (command.vector_speed == 1) path.range_for[1] = path.range_for[2] = range_of(1);
    if (command.vector_speed == 3) {
        path.range_for[1] = range_of(1);
        path.range_for[2] = command.count == 3 ? range_of(2) : path.range_for[1];
    }
    for (int i = 0; i < command.count; ++i)
        if (const int d = law_.path_direction(i); d != 0) state_.axis[command.axis[i]].direction = d;
}

// ---- start of the final deceleration

void Generators::check_final(int a) {
    const Axis& axis = state_.axis[a];
    Generator& gen = state_.axis[a].gen;
    if (gen.final) return;
    bool now = false;
    if (gen.drive == Drive::fixed) {
        now = gen.manual ? gen.n >= axis.decel_point
                         : std::int64_t{axis.pulses} - gen.n <= final_pulses(axis) + axis.offset;
    } else if (gen.drive == Drive::path && state_.decel_enabled && !state_.queued) {
        now = gen.manual
                  ? gen.n >= axis.decel_point
                  : state_.path.command.line() && state_.path.max_pulses - gen.n <= final_pulses(axis) + axis.offset;
    }
    if (!now) return;
    gen.final = true;
    gen.special_known = false;
}

// ---- bit patterns

/// Executes a basic pulse of a bit pattern; returns the number of axes that stepped, at least one.
int Generators::step_pattern() {
    Pattern& pattern = state_.pattern;
    const PathCommand& command = state_.path.command;
    if (pattern.ends(command.count, pattern.place)) return patterns_.clear(), 1;
    int moved = 0;
    for (int i = 0; i < command.count; ++i)
        if (const int step = pattern.step(i, pattern.place); step != 0)
            move(command.axis[i], step, state_.tick), ++moved;
    if (++pattern.place == Pattern::length) next_pattern_word();
    look_ahead_in_pattern();
    return std::max(1, moved);
}

/// Continues with the next word of the bit pattern.
void Generators::next_pattern_word() {
    patterns_.next_word(state_.axis[state_.master].gen.n, wr5::BPINT.test(state_.bus.wr5));
    requests_.law_changed_of(state_.master);
}

/// Sets the directions of the axes to those of their next steps.
void Generators::look_ahead_in_pattern() {
    const Pattern& pattern = state_.pattern;
    const PathCommand& command = state_.path.command;
    for (int i = 0; i < command.count; ++i) {
        int direction = 0;
        for (int at = pattern.place; at < Pattern::length && direction == 0 && !pattern.ends(command.count, at); ++at)
            direction = pattern.step(i, at);
        Axis& axis = state_.axis[command.axis[i]];
        if (direction == 0 || direction == axis.direction) continue;
        axis.direction = direction;
        state_.axis[state_.master].gen.full_tick = true;  // the opposite limit applies
    }
}

// ---- single steps

/// Begins a single step requested by wire or by command (`by`, a bit of PathCommand::steps). Returns false if the
/// running interpolation does not accept it.
bool Generators::ask_step(std::uint32_t by) {
    if (state_.chain == 0 || state_.steps.in_progress || !(state_.path.command.steps & by)) return false;
    state_.steps.in_progress = true;
    state_.axis[state_.master].gen.special_known = false;
    requests_.law_changed_of(state_.master);
    return true;
}

void Generators::end_step(int a) {
    state_.steps.in_progress = false;
    state_.axis[a].gen.special_known = false;
    requests_.law_changed_of(a);
    if (state_.axis[a].gen.stopping) end(a);
}

// ---- speed

/// Returns true if the drive ended.
bool Generators::speed_step(int a) {
    Axis& axis = state_.axis[a];
    Generator& gen = axis.gen;
    auto at_start_speed = [&] { return gen.speed <= rules::used_speed(axis.start_speed); };
    if (gen.stopping && at_start_speed()) return end(a), true;
    const std::int64_t before = gen.speed;
    advance_speed(axis);
    gen.final_seen = gen.final;
    if (gen.speed != before) requests_.law_changed_of(a);
    if (gen.stopping && at_start_speed()) return end(a), true;
    return false;
}

/// Sets V to `v`. The drive goes to HV in a slow drive of a home search, at most to the cap, and, by option, at least
/// to SV.
void Generators::set_drive_speed(int a, std::uint16_t v) {
    Extension& ext = state_.extension[a];
    ext.v = v;
    if (ext.home.hmst != 0 && map::home_drive(ext.home.hmst).slow)
        v = ext.hv;
    else if (ext.cap != 0)
        v = std::min(v, ext.cap);
    if (options_.slow_drive == SlowDrive::at_sv) v = std::max(v, state_.axis[a].start_speed);
    state_.axis[a].speed = v;
}

/// Caps the speed of a drive with triangle prevention once its ramps use half of its pulses; called after each pulse.
void Generators::avoid_triangle(int a) {
    Generator& gen = state_.axis[a].gen;
    if (gen.final || gen.ramp <= 0) return;
    if (2 * (gen.accel_pulses + final_pulses(state_.axis[a])) < std::int64_t{state_.axis[a].pulses}) return;
    gen.no_triangle = false;
    gen.special_known = false;
    state_.extension[a].cap = static_cast<std::uint16_t>(gen.speed);
    set_drive_speed(a);
}

}  // namespace motionrack::mcx314
