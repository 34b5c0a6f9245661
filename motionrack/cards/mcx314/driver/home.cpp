// Execution of the homing tables.
#include <algorithm>
#include <motionrack/cards/mcx314/driver/home.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr Field drive_end = field("WR1", "DEND");
constexpr Field comparison_limits = {
    static_cast<std::uint16_t>(field("WR2", "SLMTP").mask | field("WR2", "SLMTM").mask)};
constexpr Field curve_bits = {
    static_cast<std::uint16_t>(field("WR3", "MANLD").mask | field("WR3", "DSNDE").mask | field("WR3", "SACC").mask)};
constexpr Field plus_limit_stopped = field("RR1", "LMTP"), minus_limit_stopped = field("RR1", "LMTM");
constexpr Field plus_limit = field("RR2", "HLMTP"), minus_limit = field("RR2", "HLMTM");
constexpr Field alarm_stopped = field("RR1", "ALARM"), alarm = field("RR2", "ALARM");
constexpr Field emergency_stopped = field("RR1", "EMG"), emergency = field("RR2", "EMG");

}  // namespace

// ---- polling

Home::PollData Home::poll() {
    PollData out;
    out.driving = driver_.status().driving(mask());
    out.status = driver_.axis_status(axis_);
    const InputLevels levels = driver_.inputs(axis_);
    out.switch_on = levels.in[static_cast<std::size_t>(settings_.input)] == settings_.active_high;
    out.index_on = levels.in[static_cast<std::size_t>(settings_.index_input)] == settings_.index_high;
    out.lp = driver_.ReadLPS(axis_);
    out.cv = out.driving ? driver_.ReadCV(axis_) : 0;
    return out;
}

bool Home::limit_ahead(const PollData& poll, SearchDirection search_direction) const {
    return (settings_.negative == (search_direction == SearchDirection::towards) ? minus_limit : plus_limit)
        .test(poll.status.rr2);
}

/// The first change of the awaited home input is its edge; every later change is bounce.
void Home::note_switch(const PollData& poll, Instant now) {
    if (poll.switch_on == switch_on_) return;
    switch_on_ = poll.switch_on;
    steady_since_ = now;
    const bool waited_for = state_->does == HomingAction::wait_end &&
                            (state_->until == HomingStopInput::on || state_->until == HomingStopInput::off) &&
                            switch_on_ == (state_->until == HomingStopInput::on);
    if (waited_for && !edge_in_state_)
        edge_in_state_ = true;
    else
        ++report_.bounces;
}

/// The chip decelerates at the first contact, independent of bounce at the instant of a poll: the deceleration locates
/// the edge.
void Home::note_braking(const PollData& poll, Instant now) {
    if (braking_ || state_->until != HomingStopInput::on || !(poll.switch_on || poll.status.decelerating())) return;
    braking_ = edge_here(poll, now);
}

ChipHomingEdge Home::edge_here(const PollData& poll, Instant now) {
    // At constant speed the chip stops at the edge itself; otherwise the edge was after the last poll, or within its
    // accesses.
    const bool exact = state_->pace != HomingSpeed::fast;
    const bool index = state_->until == HomingStopInput::index;
    return {state_->name,
            index ? settings_.index_input : settings_.input,
            index || state_->until == HomingStopInput::on,
            poll.lp,
            driver_.ReadEPS(axis_),
            exact ? 0 : rules::magnitude(pulse_delta(last_lp_, poll.lp)) + 1,
            hertz(exact ? speed() : std::max(poll.cv, last_cv_)),
            now};
}

// ---- start

Result<void> Home::start(const HomeSettings& settings, Instant now) {
    const HomeSettings before = std::exchange(settings_, settings);
    if (Result<void> ready = check_ready(); !ready) {
        settings_ = before;
        return ready;
    }
    if (settings_.back_v == 0) settings_.back_v = settings_.sv;
    if (settings_.slow_v == 0) settings_.slow_v = (settings_.sv + 1) / 2;
    settings_.v = std::max(settings_.v, settings_.sv);
    if (settings_.range != 0) MOTIONRACK_CHECK(driver_.SetRange(mask(), settings_.range));
    mode_before_[0] = driver_.mode1(axis_);
    mode_before_[1] = driver_.mode2(axis_);
    mode_before_[2] = driver_.mode3(axis_);
    driver_.WriteMode2(mask(), static_cast<std::uint16_t>(mode_before_[1] & ~comparison_limits.mask));
    driver_.WriteMode3(mask(), static_cast<std::uint16_t>(mode_before_[2] & ~curve_bits.mask));
    table_ = &home_table(settings_.type);
    report_ = HomeReport{};
    report_.type = settings_.type;
    report_.axis = axis_;
    report_.negative = settings_.negative;
    report_.input = settings_.input;
    report_.home_position = settings_.home_position;
    conflict_.reset();
    edges_.begin(settings_.hysteresis < 0 ? std::nullopt : std::optional(static_cast<double>(settings_.hysteresis)),
                 static_cast<double>(settings_.repeats));
    report_.from = now;
    running_ = true;
    stop_asked_ = turned_ = again_ = false;
    failed_in_ = {};
    const PollData first = poll();
    switch_on_ = first.switch_on;
    last_lp_ = first.lp;
    state_ = nullptr;
    enter(table_->states[0].name, first, now);
    return {};
}

// ---- state machine

void Home::step(Instant now) {
    if (!running_) return;
    const PollData seen = poll();
    note_switch(seen, now);
    // RR1 describes the last drive; it is valid only after a drive of this homing.
    const unsigned ended_by = state_->does == HomingAction::wait_end ? seen.status.rr1 : 0u;
    if (state_->does == HomingAction::wait_stop) {
        run(seen, now);
    } else if (emergency.test(seen.status.rr2) || emergency_stopped.test(ended_by)) {
        fail(HomeFault::emergency, seen, now);
    } else if (alarm.test(seen.status.rr2) || alarm_stopped.test(ended_by)) {
        fail(HomeFault::alarm, seen, now);
    } else if (stop_asked_) {
        fail(HomeFault::stopped, seen, now);
    } else {
        run(seen, now);
        // START states continue at once, at most to a wait.
        while (running_ && state_->does != HomingAction::wait_end && state_->does != HomingAction::wait_steady &&
               state_->does != HomingAction::wait_stop)
            run(seen, now);
    }
    last_lp_ = seen.lp;
    last_cv_ = seen.cv;
}

void Home::enter(std::string_view name, const PollData& poll, Instant now) {
    if (state_ != nullptr && !report_.stays.empty()) {
        report_.stays.back().took = now - report_.stays.back().from;
        report_.stays.back().to_lp = poll.lp;
    }
    state_ = &table_->state(name);
    report_.stays.push_back({state_->name, now, {}, poll.lp, poll.lp});
    edge_in_state_ = false;
    if (state_->does == HomingAction::end) finish(poll, now);
}

bool Home::leave_by(HomingTransition cause, const PollData& poll, Instant now) {
    for (const HomeExit& exit : state_->exits) {
        if (exit.to.empty() || exit.cause != cause) continue;
        enter(exit.to, poll, now);
        return true;
    }
    return false;
}

void Home::run(const PollData& poll, Instant now) {
    switch (state_->does) {
        case HomingAction::poll:
            if (poll.switch_on)
                leave_by(HomingTransition::on, poll, now);
            else if (limit_ahead(poll, SearchDirection::towards) && !settings_.turn_at_limit)
                fail(HomeFault::not_found, poll, now);
            else if (limit_ahead(poll, SearchDirection::towards))
                turned_ = true, leave_by(HomingTransition::limit, poll, now);
            else
                leave_by(HomingTransition::off, poll, now);
            return;
        case HomingAction::drive:
            return drive(poll, now);
        case HomingAction::wait_end:
            return wait_end(poll, now);
        case HomingAction::settle:
            steady_since_ = now;
            deadline_ = now + settings_.timeout;
            leave_by(HomingTransition::done, poll, now);
            return;
        case HomingAction::wait_steady:
            if (now - steady_since_ < settings_.settle) {
                if (now >= deadline_) fail(HomeFault::time, poll, now);
            } else if (poll.switch_on) {
                leave_by(HomingTransition::on, poll, now);
            } else if (report_.index_lp || !leave_by(HomingTransition::unseen, poll, now)) {
                leave_by(HomingTransition::off, poll, now);
            }
            return;
        case HomingAction::zero:
            return zero(poll, now);
        case HomingAction::wait_stop:
            if (poll.driving && now >= deadline_) driver_.QuickStop(mask());
            if (!poll.driving || now >= deadline_) leave_by(HomingTransition::done, poll, now);
            return;
        case HomingAction::end:
            return;
    }
}

/// WR1 for the present state: the stop input with the level that ends the drive, and an interrupt at its end.
std::uint16_t Home::stop_inputs() const {
    const unsigned others = mode_before_[0] & ~0xFFu;
    const bool index = state_->until == HomingStopInput::index;
    const int input = index ? settings_.index_input : settings_.input;
    const bool high = index ? settings_.index_high : settings_.active_high == (state_->until == HomingStopInput::on);
    const unsigned stop = state_->until == HomingStopInput::distance ? 0u : (high ? 3u : 2u) << 2 * input;
    return static_cast<std::uint16_t>(others | drive_end.mask | stop);
}

std::int64_t Home::speed() const {
    return state_->pace == HomingSpeed::fast   ? settings_.v
           : state_->pace == HomingSpeed::back ? settings_.back_v
                                               : settings_.slow_v;
}

void Home::drive(const PollData& poll, Instant now) {
    if (state_->until == HomingStopInput::index && poll.index_on && settings_.type != 5)
        return fail(HomeFault::index_at_switch, poll, now);
    if (state_->until == HomingStopInput::distance) {
        planned_ = settings_.backoff;
        if (settings_.type == 1 || settings_.type == 3) planned_ = std::max(planned_, run_up());
        planned_ = std::min(planned_, settings_.travel);
    } else {
        planned_ = state_->until == HomingStopInput::index && settings_.turn > 0 ? settings_.turn : settings_.travel;
    }
    driver_.WriteMode1(mask(), stop_inputs());
    const Result<void> written = [&]() -> Result<void> {
        MOTIONRACK_CHECK(driver_.SetSV(mask(), settings_.sv));
        MOTIONRACK_CHECK(driver_.SetV(mask(), speed()));
        MOTIONRACK_CHECK(driver_.SetA(mask(), settings_.a));
        return driver_.Pulse(mask(), planned_);
    }();
    MOTIONRACK_ASSERT(written.has_value());  // check_ready() has checked the ranges
    driver_.Drive(mask(), settings_.negative == (state_->search_direction == SearchDirection::towards));
    at_speed_ = false;
    braking_.reset();
    deadline_ = now + std::min(settings_.timeout, drive_time(planned_, speed()));
    leave_by(HomingTransition::done, poll, now);
}

/// Ends a WAIT state at the end of the drive, by its cause.
void Home::wait_end(const PollData& poll, Instant now) {
    if (poll.driving) {
        at_speed_ = at_speed_ || (poll.cv >= settings_.v && !poll.switch_on);
        note_braking(poll, now);
        if (now >= deadline_) fail(HomeFault::time, poll, now);
        return;
    }
    const bool limit = plus_limit_stopped.test(poll.status.rr1) || minus_limit_stopped.test(poll.status.rr1);
    const int input = state_->until == HomingStopInput::index ? settings_.index_input : settings_.input;
    const bool reached = state_->until != HomingStopInput::distance && poll.status.stopped_by_input(input);
    // At constant speed the drive ends at the input's position, even if a limit switch acts at the same position.
    if (reached && (!limit || state_->pace != HomingSpeed::fast)) return drive_reached(poll, now);
    if (limit) {
        const bool again = turned_;
        if (state_->until == HomingStopInput::on && state_->search_direction == SearchDirection::towards)
            turned_ = true;
        if ((settings_.turn_at_limit && !again) || state_->until == HomingStopInput::distance)
            if (leave_by(HomingTransition::limit, poll, now)) return;
    } else if (state_->until == HomingStopInput::distance) {
        if (distance(poll) == planned_) return static_cast<void>(leave_by(HomingTransition::done, poll, now));
        return fail(HomeFault::foreign_stop, poll, now);
    } else {
        if (distance(poll) != planned_) return fail(HomeFault::foreign_stop, poll, now);
    }
    if (state_->until == HomingStopInput::index) return fail(HomeFault::no_index, poll, now);
    fail(reached                                 ? HomeFault::near_limit
         : state_->until == HomingStopInput::off ? HomeFault::not_released
                                                 : HomeFault::not_found,
         poll, now);
}

/// The awaited input has ended the drive. Its present level may be bounce; the chip's stop flag is decisive.
void Home::drive_reached(const PollData& poll, Instant now) {
    const ChipHomingEdge edge = braking_ && state_->pace == HomingSpeed::fast ? *braking_ : edge_here(poll, now);
    report_.edges.push_back(edge);
    if (state_->until == HomingStopInput::index) {
        report_.index_lp = edge.lp;
        const std::int64_t off = report_.switch_to_index().value_or(0) - settings_.index_after;
        if (settings_.index_after >= 0 && rules::magnitude(off) > std::max<std::int64_t>(1, settings_.turn / 4))
            return fail(HomeFault::wrong_index, poll, now);
    } else {
        if (!edge_in_state_) switch_on_ = edge.active;
        edge_in_state_ = true;
    }
    if (!is_edge_of_switch(edge)) return fail(HomeFault::edges_differ, poll, now);
    if (state_->until == HomingStopInput::on) {
        report_.switch_lp = edge.lp;
        report_.switch_within = edge.within;
        report_.switch_speed_hz = edge.speed_hz;
    }
    if (stopped_early() && leave_by(HomingTransition::early, poll, now)) {
        again_ = true;
        return;
    }
    if (state_->pace == HomingSpeed::fast && !at_speed_ && settings_.v > settings_.sv &&
        (settings_.type == 1 || settings_.type == 3))
        report_.notes.push_back(
            "the switch came before V was reached, without room for a longer run-up: a start from farther away may "
            "find another edge");
    leave_by(HomingTransition::done, poll, now);
}

/// Compares the edges of the approach with those of the previous approach.
bool Home::is_edge_of_switch(const ChipHomingEdge& edge) {
    const auto up = static_cast<double>(pulse_delta(report_.stays.front().from_lp, edge.lp));
    const double travel = settings_.negative ? -up : up, within = static_cast<double>(edge.within);
    if (state_->until == HomingStopInput::off) edges_.released(travel, within);
    if (state_->until == HomingStopInput::on && state_->search_direction == SearchDirection::towards)
        conflict_ = edges_.acted(travel, within);
    return !conflict_;
}

/// The end of types 1 and 3 depends on the speed at the switch, which must be V.
bool Home::stopped_early() const {
    return state_->pace == HomingSpeed::fast && !at_speed_ && !again_ && settings_.v > settings_.sv;
}

void Home::zero(const PollData& poll, Instant now) {
    report_.zero_lp = poll.lp;
    report_.zero_ep = driver_.ReadEPS(axis_);
    static_cast<void>(driver_.LPS(mask(), settings_.home_position));  // check_ready() has checked the ranges
    static_cast<void>(driver_.EPS(mask(), settings_.home_counts));
    leave_by(HomingTransition::done, poll, now);
}

// ---- end

void Home::stop() {
    if (!running_ || stop_asked_) return;
    stop_asked_ = true;
    driver_.SlowStop(mask());
}

void Home::fail(HomeFault fault, const PollData& poll, Instant now) {
    report_.fault = fault;
    failed_in_ = state_->name;
    failed_after_ = distance(poll);
    if (poll.driving) driver_.SlowStop(mask());
    deadline_ = now + std::min(settings_.timeout, drive_time(run_up(), settings_.v));
    enter("STOPPING_WAIT", poll, now);
    if (!poll.driving) leave_by(HomingTransition::done, poll, now);
}

void Home::finish(const PollData& poll, Instant now) {
    running_ = false;
    report_.homed = report_.fault == HomeFault::none;
    report_.took = now - report_.from;
    driver_.WriteMode1(mask(), mode_before_[0]);
    driver_.WriteMode3(mask(), mode_before_[2]);
    if (report_.homed) driver_.WriteMode2(mask(), mode_before_[1]);
    report_.sentence = why_failed(poll);
}

// ---- arithmetic

/// Pulses made by the present drive.
std::int64_t Home::distance(const PollData& poll) const {
    return rules::magnitude(pulse_delta(report_.stays.back().from_lp, poll.lp));
}

/// Pulses from SV to V plus a hundredth of a second at V, so that a poll falls into it.
std::int64_t Home::run_up() const {
    const auto v = static_cast<double>(settings_.v), sv = static_cast<double>(settings_.sv);
    const double m = hertz(1) > 0 ? hertz(1) : 500;  // if R was never written: the longest run-up
    const double ramp = m * (v * (v + 1) - sv * (sv + 1)) / (250.0 * static_cast<double>(settings_.a));
    return std::min(param::pulses.max, static_cast<std::int64_t>(ramp * 1.05 + v * m * 0.01) + 2);
}

/// Maximum duration of a drive: the distance at its speed, two ramps, a second.
Duration Home::drive_time(std::int64_t pulses, std::int64_t v) const {
    if (hertz(1) <= 0) return settings_.timeout;
    const double ramps = 2 * static_cast<double>(settings_.v) / (rules::rate_unit * static_cast<double>(settings_.a));
    const double seconds = 1.1 * static_cast<double>(pulses) / hertz(v) + 1.1 * ramps + 1;
    return seconds > to_seconds(settings_.timeout) ? settings_.timeout : from_seconds(seconds);
}

double Home::hertz(std::int64_t v) const {
    return static_cast<double>(v) * driver_.multiple(axis_);
}

}  // namespace motionrack::mcx314
