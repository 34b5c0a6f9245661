// The motion thread: executes one action at a time to its end, and processes the inbox in every slice.
#include <fmt/format.h>

#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <utility>

namespace motionrack::operate {

// ---- the loop

void Machine::run() {
    while (!quit_ || state() == MachineState::stopping || positions_.any()) step();
    publisher_.status().ended = true;
    publisher_.publish();  // includes the final positions
}

/// Executes one slice: pacing, inbox, stops, status. Called between two runs of the kernel, possibly in the middle of a
/// motion.
void Machine::slice() {
    bool on = false;
    while (!on) {
        on = !settings_.pace || settings_.pace(now()) || quit_;
        std::vector<std::function<void()>> work;
        {
            const std::lock_guard<std::mutex> alone(lock_);
            work.swap(inbox_);
        }
        for (const std::function<void()>& one : work) one();
        take_stop();
        if (handover_.in_progress()) continue;
        if (!is_stationary(state())) alarms_.raise(validity_.poll(now(), state()));  // a move may take long
        publisher_.publish();
    }
}

/// Handles openings of the door, alarms of the emergency stop, and a new stop of the stop latch. Called in every slice.
void Machine::take_stop() {
    rack::StopLatch& latch = rack_.stop_latch();
    latch.poll();
    for (std::string& text : latch.contacts().take_alarms()) alarms_.raise("emergency stop", std::move(text));
    const bool in_work =
        (state() == MachineState::moving && !programs_.stream().last_probe().runs) || state() == MachineState::hold;
    const bool by_writes = idle(state()) && manual_access_.moving_axis() != '\0';
    if (std::optional<std::string> opened = door_.take_opening(by_writes || !is_stationary(state()), in_work)) {
        alarms_.raise("door", std::move(*opened));
        rack::react(rack_, rack::StopSource::stop_command);
        if (state() == MachineState::moving && in_work) programs_.stream().hold();
        if (!in_work && (by_writes || !idle(state()))) cancel();
        if (in_work) door_.keep_tools(publisher_.status());
        publisher_.tools_off();
    }
    if (latch.latched()) manual_.jogs().let_go(), service_.break_off(), publisher_.tools_off();
    if (latch.latched() && by_writes) pending_stop_.request(true);  // a card stops only its own axis at a limit switch
    if (!latch.halted() || std::exchange(stop_taken_, true)) return;
    cancel();
}

namespace {

/// Returns the cause of the stop as alarm source; empty for a commanded stop, which needs no alarm.
std::string alarm_source(const rack::StopLatch& latch) {
    return latch.is_ordered() ? std::string() : std::string(rack::name_of(latch.cause()));
}

/// Returns true if the text already reports a lost position, as texts of homing and of cards do.
bool says_lost(const std::string& text) {
    const std::size_t at = text.find(" not valid");
    return at != std::string::npos && text.rfind("position", at) != std::string::npos;
}

/// Describes the cause or source of the stop, and the remedy.
std::string stop_text(const rack::StopLatch& latch, const std::string& ordered_by) {
    const bool ordered = latch.is_ordered() && !ordered_by.empty();
    return fmt::format("{} {}", ordered ? ordered_by : latch.sentence(), latch.advice());
}

}  // namespace

void Machine::step() {
    if (service_.on()) return service_.step();
    if (pending_stop_.comes_first()) {  // before anything that was commanded after it
        if (manual_access_.moving_axis() == '\0') return wait_for_standstill();
        if (Result<void> ended = manual_access_.end_motion(); !ended) failed(ended.error());
        return;
    }
    if (manual_access_.any()) return manual_access_.step();
    if (manual_.jogs().any()) return manual_.step_jogs([this](const Error& error) { failed(error); });
    alarms_.raise(validity_.poll(now(), state()));
    if (manual_.wants_homing()) {
        if (Result<void> homed = manual_.step_homing(); !homed) failed(homed.error());
        return;
    }
    if (positions_.any()) {
        if (Result<void> set = positions_.step(); !set) failed(set.error());
        return;
    }
    const bool drives =
        programs_.stream().state() == control::ExecutionState::running ||
        (state() == MachineState::moving && programs_.stream().state() == control::ExecutionState::feed_hold);
    if (programs_.has_lines() || programs_.stream().has_work() || drives) return drive();
    if (pending_stop_.wanted()) return wait_for_standstill();
    const rack::StopLatch& latch = rack_.stop_latch();
    const bool another_cause = state() == MachineState::error_stop && stop_ordered_ && !latch.is_ordered();
    if (latch.latched() && (state() != MachineState::error_stop || another_cause))
        return enter_error_stop(alarm_source(latch), stop_text(latch, ordered_by_));
    alarms_.raise(validity_.take_losses());
    host_of(rack_).pass(settings_.slice);
}

/// Enters the error stop at standstill. An empty `source` means a commanded stop, which raises an alarm only if a
/// position was lost.
void Machine::enter_error_stop(std::string source, std::string text) {
    rack::StopLatch& latch = rack_.stop_latch();
    std::string lost;
    text += service_.take_note();
    latch.settle(true);
    stop_taken_ = stop_taken_ || latch.latched();
    stop_ordered_ = latch.latched() && latch.is_ordered();
    for (const rack::RackAxis& axis : rack_.config().axes) {
        if (latch.keeps_position(axis.index())) continue;
        validity_.invalidate(axis.letter);
        lost += axis.letter;
    }
    if (!lost.empty() || (latch.latched() && !says_lost(text))) text += ' ' + latch.position_sentence();
    const std::string unknown = validity_.invalidate_unknown();
    if (!unknown.empty() && !says_lost(text))
        text += fmt::format(" The position of {} is not valid any more; home again.", fmt::join(unknown, ", "));
    if (source.empty() && !(lost + unknown).empty()) source = "position";
    if (!source.empty()) alarms_.supersede(lost + unknown);
    publisher_.tools_off();
    if (!source.empty()) alarms_.raise(std::move(source), text);
    publisher_.enter(MachineState::error_stop, std::move(text));
}

/// Waits for standstill after a stop.
void Machine::wait_for_standstill() {
    pending_stop_.end();
    manual_.end_stop();
    if (!failures_.empty()) enter_failures();
    rack::StopLatch& latch = rack_.stop_latch();
    if (latch.latched() && state() != MachineState::error_stop)  // losses stay, even with an immediate reset
        enter_error_stop(alarm_source(latch), stop_text(latch, ordered_by_));
    if (pending_stop_.wants_reset()) {
        latch.following().poll(now());
        alarms_.raise(validity_.take_losses());
    }
    const bool asked = pending_stop_.take_reset(latch.trips());
    const Result<void> reset = asked ? latch.reset() : Result<void>();
    if (!reset) publisher_.status().reason = reset.error().message;
    if (asked && reset) {
        stop_taken_ = false;
        ordered_by_.clear();
        programs_.stream().reset_modal_state();
        publisher_.tools_off();
        alarms_.reset();
        if (state() == MachineState::error_stop) publisher_.enter(MachineState::standstill);
    }
    if (state() == MachineState::stopping) publisher_.enter(MachineState::standstill, publisher_.status().reason);
    enables_.settle();
    if (!enables_.any() && state() == MachineState::standstill) publisher_.enter(MachineState::disabled);
}

// ---- lines and programs

void Machine::drive() {
    if (const auto fed = programs_.feed(); !fed) failed(fed.error());
    if (state() == MachineState::error_stop)
        programs_.stream().stop();  // discards what it has, so that no step waits for it
    const Result<control::ExecutionState> driven =
        programs_.stream().drive(programs_.more_may_come(now(), settings_.quiet));
    if (!driven) return failed(driven.error());
    if (*driven != control::ExecutionState::running) rack_.stop_latch().settle();  // a stop by a card also ends a hold
    if (*driven == control::ExecutionState::waiting) host_of(rack_).pass(milliseconds(1));
    const bool is_held = *driven == control::ExecutionState::feed_hold;
    if (is_held || *driven == control::ExecutionState::paused) {
        if (state() == MachineState::moving)
            publisher_.enter(MachineState::hold,
                             is_held ? "feed hold; continue with resume" : "the program waits; continue with resume");
        host_of(rack_).pass(settings_.slice);
    }
    if (*driven != control::ExecutionState::idle || programs_.has_lines()) return;
    programs_.end();
    door_.forget_tools();              // a hold that came with the last move has nothing to resume
    if (manual_.jogs().any()) return;  // commanded while this motion ended
    if (state() == MachineState::moving || state() == MachineState::jogging) publisher_.enter(MachineState::standstill);
}

// ---- failures

/// Ends all motion and drops all requests. Axes that still move first decelerate.
void Machine::failed(const Error& error) {
    failures_.push_back({publisher_.at_work(), error.text()});
    publisher_.tools_off();  // at once; only the axes take time
    manual_.jogs().let_go();
    if (!manual_.jogs().any() && !programs_.stream().has_work()) return enter_failures();
    programs_.stream().stop();
    pending_stop_.request();
    publisher_.enter(MachineState::stopping, error.text());
}

/// Enters the error stop of the failures. Call at standstill.
void Machine::enter_failures() {
    programs_.drop();
    const rack::StopLatch& latch = rack_.stop_latch();
    for (Failure& one : std::exchange(failures_, {})) {
        const bool known =
            latch.latched() && latch.cause() != rack::StopSource::limit_switch && !alarm_source(latch).empty();
        enter_error_stop(known ? alarm_source(latch) : std::move(one.at_work), std::move(one.text));
    }
}

}  // namespace motionrack::operate
