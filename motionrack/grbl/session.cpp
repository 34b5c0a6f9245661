// Lines of a sender, one at a time, each with its one answer.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/grbl/session.hpp>

namespace motionrack::grbl {

using control::gcode::Block;
using control::gcode::GrblStatus;
using control::gcode::Problem;
using operate::MachineState;

namespace {

/// G codes that act once, and for which Grbl lets all motion before them come to its end.
bool stands_first(int tenths) {
    constexpr std::array<int, 8> codes = {40, 100, 281, 301, 920, 921, 922, 923};
    return std::find(codes.begin(), codes.end(), tenths) != codes.end();
}

control::gcode::Spindle spindle_of(int code) {
    using control::gcode::Spindle;
    return code == 3 ? Spindle::clockwise : code == 4 ? Spindle::counter_clockwise : Spindle::off;
}

/// Those that the machine has for reasons of its own are a lock.
int decimal_of(const Problem& problem) {
    return problem.status == GrblStatus::none ? int{error_locked} : static_cast<int>(problem.status);
}

}  // namespace

Session::Session(operate::Machine& machine, SessionSettings settings)
    : machine_(machine), settings_(std::move(settings)) {
    settings_.axes = std::clamp(settings_.axes, 3, 4);
    if (machine_.state() == MachineState::disabled) (void)machine_.enable(true);
    watch_machine();
    out_.clear();
}

// ---- bytes

void Session::receive(std::string_view bytes) {
    for (const char c : bytes) {
        const auto byte = static_cast<std::uint8_t>(c);
        if (const std::optional<Realtime> what = realtime_of(byte)) {
            act(*what);
            continue;
        }
        if (intake_.room() == 0) work();  // a long line without an end so far
        intake_.put(byte);
        if (c == '\n' || c == '\r') work();
    }
    if (status_wanted_) report();
}

void Session::observe(std::string_view bytes) {
    for (const char c : bytes) {
        const std::optional<Realtime> what = realtime_of(static_cast<std::uint8_t>(c));
        if (what == Realtime::status || what == Realtime::reset || what == Realtime::feed_hold ||
            what == Realtime::door || what == Realtime::jog_cancel)
            act(*what);
    }
    if (status_wanted_) report();
}

void Session::tick() {
    watch_machine();
    work();
    if (status_wanted_) report();
}

void Session::greet() {
    intake_.clear();
    line_.reset();
    if (doing_) doing_->silent = true;
    begin_again(false);
    work();
}

// ---- lines

/// Takes lines for as long as nothing makes them wait.
void Session::work() {
    while (true) {
        if (doing_ && !finish()) return;
        if (!settled()) return;
        if (boot_ != Boot::done) finish_boot();
        if (critical_ || asleep_) return;
        if (!line_) line_ = intake_.next();
        if (!line_ || must_wait(*line_)) return;
        if (status_wanted_) report();
        const Line line = *std::exchange(line_, std::nullopt);
        if (line.too_long)
            answer(error_line_length);
        else
            carry_out(line.text);
    }
}

/// The machine is in nobody's hands but the lines'.
bool Session::settled() const {
    const MachineState state = machine_.state();
    return !machine_.has_orders() && state != MachineState::stopping && state != MachineState::homing;
}

bool Session::has_room() const {
    return machine_.has_room() && machine_.stream().moves() < planner_blocks;
}

bool Session::must_wait(const Line& line) {
    const std::string& text = line.text;
    if (line.too_long || text.empty()) return false;
    const State now = state();
    if (text[0] == '$') return now == State::jog && text.compare(0, 3, "$J=") == 0 && !has_room();
    if (now == State::hold || now == State::door) return true;
    if (now != State::run || machine_.status().program_runs) return false;
    if (!has_room()) return true;
    Block block;
    Problem problem;
    return control::gcode::scan_line(text, {}, block, problem) && must_stand_first(block);
}

/// What Grbl does only when all motion before it is done.
bool Session::must_stand_first(const Block& block) const {
    using namespace control::gcode;
    const Modes& modes = interpreter().modes();
    if (block.has_m(m_stop)) return true;
    if (block.has_g(g_nonmodal) && stands_first(block.g[g_nonmodal])) return true;
    if (block.has_g(g_system) && block.g[g_system] != 540 + 10 * modes.system) return true;
    if (block.has_g(g_tool_length) && (block.g[g_tool_length] == 431 || interpreter().frame().tool[2] != 0))
        return true;
    if (block.has_m(m_spindle) && spindle_of(block.m[m_spindle]) != modes.spindle) return own_.laser == 0;
    if (block.has('S') && block['S'] != modes.speed_rpm) return own_.laser == 0;
    return (block.has_m(m_mist) && !modes.mist) || (block.has_m(m_flood) && !modes.flood) ||
           (block.has_m(m_coolant_off) && (modes.mist || modes.flood));
}

void Session::carry_out(const std::string& text) {
    int error = error_none;
    if (!text.empty() && text[0] == '$')
        error = command(text);
    else if (!text.empty())
        error = gcode(text);
    if (error != answer_later) answer(error);
}

/// Grbl's words are fewer than those of the machine's reader.
bool Session::grbl_has(const Block& block) const {
    using namespace control::gcode;
    const std::uint32_t others = settings_.axes > 3 ? letter_bit('B') | letter_bit('C') : rotary_words;
    const bool cutter = block.has_g(g_cutter) && block.g[g_cutter] != 400;
    return (block.words & others) == 0 && !block.has_m(m_tool) && !cutter;
}

int Session::gcode(const std::string& text) {
    using namespace control::gcode;
    const State now = state();
    if (now == State::alarm || now == State::jog) return error_locked;
    if (text.find('%') != std::string::npos) return error_letter;
    Block block;
    Problem problem;
    const bool good = scan_line(text, {}, block, problem);
    if (good && !grbl_has(block)) return error_unsupported;
    const Outcome<void> read =
        check_ ? check_->line(text, 0) : give(text, good && block.has('N') ? static_cast<std::int32_t>(block['N']) : 0);
    if (!read) return refused(read.error());
    if (block.has_g(g_motion)) was_g80_ = block.g[g_motion] == 800;
    const bool ends = block.has_m(m_stop) && block.m[m_stop] >= 2;
    if (check_) {
        if (ends) say("Pgm End");
        return error_none;
    }
    const bool probes = machine_.stream().probe_waits();
    if (!probes && !block.has_m(m_stop) && !(block.has_g(g_nonmodal) && block.g[g_nonmodal] == 40)) return error_none;
    doing_ = Doing{Doing::What::moving};
    doing_->program_ends = ends;
    return answer_later;
}

/// A line for the machine, which begins in G0 as a Grbl does.
control::gcode::Outcome<void> Session::give(const std::string& text, std::int32_t n_word) {
    if (!control()) {
        Problem problem;
        problem.trouble = Trouble::refused;
        return tl::unexpected<Problem>(std::move(problem));
    }
    if (interpreter().modes().motion == control::gcode::no_motion && !was_g80_) (void)machine_.line("G0", line_number_);
    const auto read = machine_.line(text, line_number_ + 1);
    if (!read) return read;
    ++line_number_;
    if (n_word > 0) n_words_.push_back({line_number_, n_word});
    return {};
}

int Session::refused(const Problem& problem) {
    if (problem.status == GrblStatus::travel_exceeded) {
        if (!check_ && machine_.state() == MachineState::moving) machine_.cancel();
        doing_ = Doing{Doing::What::leaving_travel};
        return answer_later;
    }
    if (problem.status == GrblStatus::none && !problem.message.empty()) say(problem.message);
    return decimal_of(problem);
}

bool Session::control() {
    if (!settings_.take_control) return true;
    const Result<void> taken = settings_.take_control();
    if (!taken) say(taken.error().message);
    return taken.has_value();
}

// ---- answers that had to wait

/// Whether the line before is done with.
bool Session::finish() {
    const MachineState state = machine_.state();
    if (critical_ || (state == MachineState::error_stop && doing_->what != Doing::What::homing)) return false;
    const bool stands = settled() && state != MachineState::moving && state != MachineState::hold;
    if (!stands) return false;
    switch (doing_->what) {
        case Doing::What::moving:
            if (doing_->program_ends) end_program();
            break;
        case Doing::What::leaving_travel:
            alarm(alarm_soft_limit, true);
            return false;
        case Doing::What::homing:
            return finish_homing();
        case Doing::What::unlocking:
            if (!doing_->silent) say("Caution: Unlocked");
            break;
    }
    finish_answer(error_none);
    return true;
}

void Session::finish_answer(int error) {
    if (!std::exchange(doing_, std::nullopt)->silent) answer(error);
}

void Session::end_program() {
    spindle_override_ = 100;
    machine_.set_overrides(1, 1);
    if (!doing_->silent) say("Pgm End");
}

void Session::finish_boot() {
    const bool after_reset = std::exchange(boot_, Boot::done) == Boot::reset;
    if (machine_.state() == MachineState::error_stop) {
        critical_ = true;
        say(machine_.status().why);
    }
    if (locked())
        say("'$H'|'$X' to unlock");
    else if (after_reset)
        startup();
}

void Session::startup() {
    for (const std::string& text : startup_lines_) {
        if (text.empty()) continue;
        const auto read = give(text, 0);
        put(fmt::format(">{}:", text));
        answer(read ? int{error_none} : decimal_of(read.error()));
    }
}

// ---- answers

void Session::answer(int error) {
    if (error == error_none)
        put("ok\r\n");
    else
        put(fmt::format("error:{}\r\n", error));
}

/// In ASCII, and without what ends a message.
void Session::say(std::string_view text) {
    put("[MSG:");
    for (const char c : text) out_ += c >= ' ' && c <= '~' && c != '[' && c != ']' ? c : '?';
    put("]\r\n");
}

void Session::alarm(int number, bool needs_reset) {
    alarm_ = true;
    put(fmt::format("ALARM:{}\r\n", number));
    if (!needs_reset) return;
    critical_ = true;
    say("Reset to continue");
}

}  // namespace motionrack::grbl
