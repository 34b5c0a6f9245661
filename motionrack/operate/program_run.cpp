// Start, feed and end of programs; single lines.
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/operate/program_run.hpp>
#include <utility>

namespace motionrack::operate {

void ProgramRun::start(control::AxisGroup& axes, Interrupt& host, const control::StreamExecutorSettings& settings) {
    stream_ = std::make_unique<control::StreamExecutor>(axes, host, settings);
}

// ---- a whole program

Result<void> ProgramRun::begin(std::string text, std::string name) {
    stream_->reset_modal_state();
    const control::gcode::ProgramCheck check = control::gcode::check_program(text, stream_->fresh_settings(), 1, name);
    if (!check.problems.empty()) return tl::unexpected<Error>(check.problems.front());
    text_ = std::move(text);
    name_ = std::move(name);
    feed_.emplace(*stream_, text_, stream_->fresh_settings(), name_);
    line_count_ = static_cast<std::int32_t>(check.lines);
    runs_ = true;
    return {};
}

control::gcode::Outcome<void> ProgramRun::feed() {
    if (!feed_) return {};
    if (auto fed = feed_->feed(); !fed) return fed;
    if (!feed_->more()) feed_.reset();
    return {};
}

void ProgramRun::end() {
    if (runs_) stream_->reset_after_program();
    runs_ = false;
}

void ProgramRun::drop() {
    feed_.reset();
    runs_ = false;
}

// ---- single lines

control::gcode::Outcome<void> ProgramRun::line(std::string_view text, std::int32_t number, Instant now) {
    if (auto read = stream_->line(text, number); !read) return read;
    last_line_ = now;
    return {};
}

void ProgramRun::move(const control::Move& move, Instant now) {
    stream_->move(move);
    last_line_ = now;
}

bool ProgramRun::more_may_come(Instant now, Duration quiet) const {
    return feed_ || (!runs_ && now - last_line_ < quiet);
}

// ---- settings and status

Result<void> ProgramRun::clear_offsets() {
    if (stream_->has_work())
        return fail(ErrorKind::refused,
                    "The work offsets were not changed: the machine moves. Stop it, or wait for standstill.");
    stream_->clear_offsets();
    return {};
}

void ProgramRun::report(Status& status) const {
    status.program = name_;
    status.line = stream_->current_line();
    status.lines = line_count_;
    status.program_runs = runs_;
    status.single_block = single_block_;
    status.feed_override = feed_override_;
    status.rapid_override = rapid_override_;
}

}  // namespace motionrack::operate
