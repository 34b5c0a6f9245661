// Processes lines of a sender one at a time, with one answer each.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/grbl/grbl_session.hpp>
#include <motionrack/grbl/line_rules.hpp>
#include <motionrack/grbl/machine_view.hpp>

namespace motionrack::grbl {

using control::gcode::Block;
using control::gcode::GrblStatus;
using control::gcode::Problem;
using operate::MachineState;

namespace {

/// Returns N of "error:N" for a problem; problems that Grbl does not know map to error 9 (locked).
int decimal_of(const Problem& problem) {
    return problem.status == GrblStatus::none ? int{error_locked} : static_cast<int>(problem.status);
}

constexpr std::string_view banner = "\r\nGrbl 1.1h ['$' for help]\r\n";

}  // namespace

GrblSession::GrblSession(operate::Machine& machine, SessionSettings settings)
    : machine_(machine),
      settings_(std::move(settings)),
      gcode_(machine),
      sender_settings_(machine, settings_, gcode_, answers_),
      state_(machine, gcode_),
      overrides_(machine),
      reports_({machine, settings_, sender_settings_.values(), reader_, gcode_, state_, overrides_}, answers_),
      realtime_({machine, settings_, state_, overrides_, reports_, answers_}),
      commands_({machine, settings_, sender_settings_, gcode_, state_, reports_, answers_, pending_}) {
    settings_.axes = std::clamp(settings_.axes, 3, 4);
    watch_machine();
    (void)answers_.take();
}

// ---- bytes

void GrblSession::receive(std::string_view bytes) {
    for (const char c : bytes) {
        const auto byte = static_cast<std::uint8_t>(c);
        if (const std::optional<Realtime> what = realtime_of(byte)) {
            act(*what);
            continue;
        }
        if (reader_.free_bytes() == 0) work();  // a long line without an end so far
        reader_.put(byte);
        if (c == '\n' || c == '\r') work();
    }
    reports_.answer_request();
}

void GrblSession::observe(std::string_view bytes) {
    for (const char c : bytes) {
        const std::optional<Realtime> what = realtime_of(static_cast<std::uint8_t>(c));
        if (what == Realtime::reset && !settings_.onlookers_reset)
            answers_.push("The reset of an observer was not executed. ! holds the machine");
        else if (what == Realtime::status || what == Realtime::reset || what == Realtime::feed_hold ||
                 what == Realtime::door || what == Realtime::jog_cancel)
            act(*what);
    }
    reports_.answer_request();
}

void GrblSession::act(Realtime what) {
    if (const std::optional<ResetCause> cause = realtime_.act(what)) reset(*cause);
}

void GrblSession::tick() {
    watch_machine();
    work();
    reports_.answer_request();
}

void GrblSession::greet() {
    reader_.clear();
    pending_.silence();
    relies_on_modes_ = false;
    begin_again(false);
    work();
}

// ---- lines

/// Processes lines until one has to wait.
void GrblSession::work() {
    while (true) {
        if (pending_.exists() && !finish()) return;
        if (!is_settled(machine_)) return;
        if (boot_ != Boot::done) finish_boot();
        if (state_.needs_reset() || state_.is_asleep()) return;
        const Line* next = reader_.next();
        if (next == nullptr || must_wait(*next)) return;
        reports_.answer_request();
        const Line line = reader_.take();
        if (line.too_long)
            answers_.answer(error_line_length);
        else
            carry_out(line.text);
    }
}

bool GrblSession::must_wait(const Line& line) {
    const std::string& text = line.text;
    if (line.too_long || text.empty()) return false;
    const State now = state();
    if (text[0] == '$') return now == State::jog && text.compare(0, 3, "$J=") == 0 && !gcode_.has_room();
    if (now == State::hold || now == State::door) return true;
    if (now != State::run || machine_.status().program_runs) return false;
    if (!gcode_.has_room()) return true;
    Block block;
    Problem problem;
    return control::gcode::scan_line(text, {}, block, problem) &&
           must_stand_first(block, gcode_.interpreter(), sender_settings_.values().laser != 0);
}

void GrblSession::carry_out(const std::string& text) {
    int error = error_none;
    if (!text.empty() && text[0] == '$')
        error = command(text);
    else if (!text.empty())
        error = gcode(text);
    if (error != answer_later) answers_.answer(error);
}

int GrblSession::command(const std::string& text) {
    const int error = commands_.execute(text);
    if (error == error_none && text.compare(0, 2, "$J") == 0) watch_machine();
    if (error != reset_now) return error;
    reset(ResetCause::implicit);
    return answer_later;
}

int GrblSession::gcode(const std::string& text) {
    using namespace control::gcode;
    const State now = state();
    if (now == State::alarm || now == State::jog) return error_locked;
    if (text.find('%') != std::string::npos) return error_letter;
    Block block;
    Problem problem;
    const bool good = scan_line(text, {}, block, problem);
    if (good && !grbl_has(block, settings_.axes)) return error_unsupported;
    const Outcome<void> read = gcode_.is_checking()
                                   ? gcode_.check(text)
                                   : give(text, good && block.has('N') ? static_cast<std::int32_t>(block['N']) : 0);
    if (!read) return refused(read.error());
    gcode_.note_motion_mode(block);
    const bool ends = block.has_m(m_stop) && block.m[m_stop] >= 2;
    if (gcode_.is_checking()) {
        if (ends) answers_.push("Pgm End");
        return error_none;
    }
    const bool probes = machine_.stream().probe_pending();
    if (!probes && !block.has_m(m_stop) && !(block.has_g(g_nonmodal) && block.g[g_nonmodal] == 40)) return error_none;
    pending_.begin(PendingAction::moving, ends);
    return answer_later;
}

control::gcode::Outcome<void> GrblSession::give(const std::string& text, std::int32_t n_word) {
    if (!take_control(settings_, answers_)) {
        Problem problem;
        problem.kind = ErrorKind::refused;
        return tl::unexpected<Problem>(std::move(problem));
    }
    state_.enable_new_machine();
    auto read = gcode_.execute(text, n_word);
    relies_on_modes_ = relies_on_modes_ || read;
    return read;
}

int GrblSession::refused(const Problem& problem) {
    if (problem.status == GrblStatus::travel_exceeded) {
        if (!gcode_.is_checking() && machine_.state() == MachineState::moving) machine_.cancel();
        pending_.begin(PendingAction::leaving_travel);
        return answer_later;
    }
    if (problem.status == GrblStatus::none && !problem.message.empty()) answers_.push(problem.message);
    return decimal_of(problem);
}

// ---- changes of the machine

void GrblSession::watch_machine() {
    state_.watch_machine();
    gcode_.drop_executed_n_words();
    const control::ProbeReport& probe = machine_.stream().last_probe();
    const bool probed = reports_.report_probe();
    if (state_.enters_error_stop() && !(state_.is_stopped() && is_plain_stop(machine_)) &&
        !pending_.waits_for(PendingAction::homing)) {
        state_.end_hold();
        alarm(probed && probe.failed() ? (probe.begun ? alarm_probe_contact : alarm_probe_initial)
                                       : alarm_of_stop(machine_),
              true);
        answers_.push(machine_.status().reason);
    }
}

// ---- actions of other clients

/// Handles a stop or reset by another client. A reset at standstill ends the lock of a stop, but not while lines from
/// before it wait, or if it comes before the stop was carried out: the lines would be executed after it. It also locks
/// a sender that has lines waiting or has set modes, since it has cleared the modes that its next lines rely on.
void GrblSession::stopped(const operate::StopReport& report) {
    if (state_.is_resetting_machine()) return;
    const bool waits = state_.is_held() || reader_.has_input() || pending_.exists();
    if (report.releases && !waits && !is_stop_pending(machine_)) {
        // Senders begin with ^X: at standstill without an error stop it must not release another one.
        const bool ends_lock = report.source.kind != "^X" || machine_.state() == MachineState::error_stop;
        if (ends_lock && state_.release()) answers_.push(report.text + " The sender may continue");
        if (!relies_on_modes_) return;
    }
    state_.lock_disabled_machine();
    lock(report.text);
}

void GrblSession::lose_control(const std::string& to) {
    if (operate::idle(machine_.state()) && !reader_.has_line() && !pending_.exists()) return;
    lock(fmt::format("{} has taken control", to.empty() ? "Another user" : to));
}

/// Locks the session. Keeps waiting lines, which are answered with an error: dropping part of a line would make another
/// line of it. A homing raises its own alarm when it has ended, and so does a line past the travel, unless a stop is in
/// force: then the machine enters its error stop instead of standstill.
void GrblSession::lock(std::string_view why) {
    const bool locked_before = state_.lock();
    relies_on_modes_ = false;
    gcode_.drop_n_words();
    const bool alarms_later =
        pending_.waits_for(PendingAction::homing) ||
        (pending_.waits_for(PendingAction::leaving_travel) && !machine_.rack().stop_latch().latched());
    if (!locked_before && !alarms_later) answers_.alarm(alarm_reset);
    answers_.push(why);
    if (pending_.exists() && !alarms_later) pending_.finish(error_locked);
}

// ---- reset

/// Resets the session. Motion of another client continues, and its stop stays in force, unless the settings permit
/// otherwise. A stop in force ends only with a reset that the sender requests, not with an implicit reset of the Grbl.
void GrblSession::reset(ResetCause cause) {
    const MachineState state = machine_.state();
    const bool is_stationary = operate::idle(state), latched = machine_.rack().stop_latch().latched();
    const bool releases = cause == ResetCause::requested && (latched || state == MachineState::error_stop);
    const bool holds = state == MachineState::homing && cause != ResetCause::requested;  // ! and the door end a homing
    const bool must_ask = settings_.may_stop && !holds && (!is_stationary || releases);
    const Result<void> may = must_ask ? settings_.may_stop() : Result<void>();
    const Alarm homing_alarm = cause == ResetCause::door ? alarm_homing_door : alarm_homing_reset;
    const Alarm number = state == MachineState::homing ? homing_alarm : is_moving(machine_) ? alarm_reset : alarm_none;
    if (may && number != alarm_none) alarm(number, false);
    if (pending_.exists()) pending_.finish(error_none);
    reader_.clear();
    gcode_.reset();
    relies_on_modes_ = false;
    state_.reset();
    overrides_.reset_spindle();
    if (may && (cause == ResetCause::requested || !latched)) {
        machine_.programs().set_overrides(1, 1);
        state_.reset_machine(settings_.source("^X"));
    }
    if (!may && is_stop_ordered(machine_)) (void)state_.lock();
    begin_again(true);
    if (!may) answers_.push(may.error().message);
}

void GrblSession::begin_again(bool after_reset) {
    reports_.repeat_all();
    answers_.put(banner);
    if (boot_ != Boot::reset) boot_ = after_reset ? Boot::reset : Boot::greeting;
}

// ---- deferred answers

/// Sends the pending answer if its line has been executed. Returns true if it was sent.
bool GrblSession::finish() {
    const MachineState state = machine_.state();
    if (state_.needs_reset()) return false;
    if (state == MachineState::error_stop && pending_.action() != PendingAction::homing) return finish_refused_reset();
    const bool is_stationary = is_settled(machine_) && state != MachineState::moving && state != MachineState::hold;
    if (!is_stationary) return false;
    switch (pending_.action()) {
        case PendingAction::moving:
            if (pending_.program_ends()) {
                overrides_.end_program();
                pending_.push("Pgm End");
            }
            break;
        case PendingAction::leaving_travel:
            alarm(alarm_soft_limit, true);
            return false;
        case PendingAction::homing:
            return finish_homing();
        case PendingAction::unlocking:
            if (pending_.begins_validation()) {
                (void)machine_.enable(true);
                state_.validate_positions();
                return false;
            }
            pending_.push("Caution: Unlocked");
            break;
    }
    pending_.finish(error_none);
    return true;
}

/// Answers an unlocking whose reset was refused, as while the emergency stop is pressed. Returns true if there was one.
bool GrblSession::finish_refused_reset() {
    if (pending_.action() != PendingAction::unlocking || !is_settled(machine_)) return false;
    (void)state_.lock();
    pending_.push(machine_.status().reason);
    pending_.finish(error_locked);
    return true;
}

/// Ends a homing: answers it or raises its alarm. Axes without a switch keep their displayed positions, as after
/// power-up of a Grbl.
bool GrblSession::finish_homing() {
    const Result<void>& ended = machine_.manual().last_homing()->ended;
    if (ended) {
        state_.end_alarm();
        if (state_.is_locked() && pending_.begins_validation()) {
            state_.validate_positions();
            return false;
        }
        if (!state_.is_stopped()) startup();
        pending_.finish(state_.is_stopped() ? error_locked : error_none);
        return true;
    }
    if (ended.error().kind == ErrorKind::refused) {
        answers_.push(ended.error().message);
        pending_.finish(error_no_homing);
        return true;
    }
    alarm(alarm_of_homing(machine_), false);
    answers_.push(ended.error().message);
    reset(ResetCause::implicit);
    return false;
}

void GrblSession::finish_boot() {
    const bool after_reset = std::exchange(boot_, Boot::done) == Boot::reset;
    if (machine_.state() == MachineState::error_stop &&
        !(after_reset && (state_.needs_unlock() || state_.is_stopped()) && is_stop_ordered(machine_))) {
        state_.require_reset();
        answers_.push(machine_.status().reason);
    }
    if (state_.is_locked())
        answers_.push("'$H'|'$X' to unlock");
    else if (after_reset)
        startup();
}

void GrblSession::startup() {
    for (const std::string& text : sender_settings_.startup_lines()) {
        if (text.empty()) continue;
        const auto read = give(text, 0);
        answers_.put(fmt::format(">{}:", text));
        answers_.answer(read ? int{error_none} : decimal_of(read.error()));
    }
}

void GrblSession::alarm(int number, bool needs_reset) {
    state_.begin_alarm();
    answers_.alarm(number);
    if (!needs_reset) return;
    state_.require_reset();
    answers_.push("Reset to continue");
}

}  // namespace motionrack::grbl
