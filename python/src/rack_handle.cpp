// Starts a rack, advances its time, and serves requests between two runs of the kernel.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/subprogram_files.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <python/src/python_error.hpp>
#include <python/src/rack_handle.hpp>

namespace motionrack::python {

namespace {
constexpr Duration slice = milliseconds(50);
constexpr std::size_t max_problems = 20;

/// Ends a run when a wire takes a level.
class WireWait final : public sim::Kernel::WireObserver {
  public:
    WireWait(rack::Rack& rack, rack::RecorderTap& tap, sim::WireId wire, int level)
        : rack_(rack), tap_(tap), wire_(wire), level_(level), over_(rack.kernel().level(wire) == level) {
        rack_.wire_listeners().add(*this);
        tap_.follow(wire_, true);
    }
    ~WireWait() override {
        tap_.follow(wire_, false);
        rack_.wire_listeners().remove(*this);
    }
    WireWait(const WireWait&) = delete;
    WireWait& operator=(const WireWait&) = delete;

    bool is_over() const { return over_; }
    void wire_changed(sim::WireId wire, int level, Instant) override {
        if (wire != wire_ || level != level_) return;
        over_ = true;
        rack_.kernel().break_run();
    }

  private:
    rack::Rack& rack_;
    rack::RecorderTap& tap_;
    sim::WireId wire_;
    int level_;
    bool over_;
};

}  // namespace

RackHandle::RackHandle(const rack::RackConfig& config) : config_(config) {
    build();
}

void RackHandle::build() {
    context_.reset();
    rack_ = std::make_unique<rack::Rack>(config_);
    context_ = std::make_unique<rack::WireAccess>(*rack_);
}

RackHandle::~RackHandle() {
    static_cast<void>(close());
}

Result<void> RackHandle::close() {
    Result<void> ended;
    if (recorder_) ended = end_waves();
    sampler_.reset();
    samples_.reset();
    recorder_.reset();
    // The kernel keeps them until the rack is destroyed; the rack no longer calls them.
    context_.reset();
    rack_.reset();
    tap_.reset();
    job_.reset();
    plan_.reset();
    return ended;
}

rack::Rack& RackHandle::rack() {
    if (!rack_) refuse("The rack was closed; nothing was done. Open another one.");
    return *rack_;
}

rack::Rack& RackHandle::running() {
    if (!rack().started()) start();
    return *rack_;
}

// ---- starting

rack::JobSettings RackHandle::job_settings() {
    rack::JobSettings settings;
    settings.sample_period = sample_period_;
    settings.stop = &stop_;
    settings.on_slice = [this] { service_run(); };
    settings.progress = [this](const rack::JobProgress& progress) {
        if (progress_) progress_(progress);
    };
    return settings;
}

void RackHandle::start() {
    plan_ = value_of(rack::FaultSchedule::create(*rack_, fault_texts_));
    if (!rack_->axes().empty()) job_ = std::make_unique<rack::Job>(*rack_, job_settings());
    tap_ = std::make_unique<rack::RecorderTap>(rack_->kernel());
    rack_->input_log().keep_no_more();
    rack_->start();
    plan_->begin();
    listen_again();
}

void RackHandle::listen_again() {
    rack_->set_stop_flag(&stop_);
    rack_->on_slice(slice, [this] { service_run(); });
}

// ---- time

void RackHandle::service_run() {
    plan_->apply_due();
    if (sampler_) {
        sampler_->poll_due();
        sampler_->drain();
    }
    if (recorder_) {
        if (now() >= next_register_look_) {
            recorder_->poll();
            const Duration period = recorder_->period();
            next_register_look_ = (now() / period + 1) * period;
        }
        recorder_->drain_settled();
    }
    if (look_) look_();
}

Result<void> RackHandle::run_to(Instant until, const std::function<bool()>& enough) {
    do {
        Instant next = std::min(until, later(now(), slice));
        if (recorder_) next = std::min(next, std::max(next_register_look_, now()));
        rack_->kernel().run_until(next);
        service_run();
        if (stop_) return fail(ErrorKind::stopped, fmt::format("The user stopped it at {:.6f} s.", to_seconds(now())));
    } while (now() < until && !(enough && enough()));
    return {};
}

Result<void> RackHandle::advance(Duration time) {
    running();
    if (time < Duration{})
        return fail(ErrorKind::refused,
                    fmt::format("Time cannot run backwards: {:.9g} s; nothing was run. Use snapshot() and restore().",
                                to_seconds(time)));
    if (time > latest - now())
        return fail(ErrorKind::refused,
                    fmt::format("The rack's time is {:.0f} s and ends at {:.0f} s; nothing was run. Open another rack.",
                                to_seconds(now()), to_seconds(latest)));
    return run_to(now() + time);
}

Result<bool> RackHandle::wait_wire(const std::string& name, int level, Duration timeout) {
    const sim::WireId wire = running().kernel().find_wire(name);
    if (wire == sim::WireId::none) {
        MOTIONRACK_CHECK(context_->get(name));
        return fail(
            ErrorKind::invalid_input,
            fmt::format(
                "{} has no edges of its own to wait for; nothing was run. Wait for the pin of a card that it leads to.",
                name));
    }
    if (timeout < Duration{} || timeout > latest - now())
        return fail(ErrorKind::refused,
                    fmt::format("The time-out is {:.9g} s; it must be 0 to {:.0f} s. Nothing was run.",
                                to_seconds(timeout), to_seconds(latest - now())));
    const WireWait wait(*rack_, *tap_, wire, level);
    if (wait.is_over()) return true;
    MOTIONRACK_CHECK(run_to(now() + timeout, [&wait] { return wait.is_over(); }));
    return wait.is_over();
}

Result<void> RackHandle::set_wire(const std::string& name, double value) {
    running();
    return context_->force(name, value);
}

rack::HomingOutcome RackHandle::home(rack::HomingSettings settings) {
    running();
    settings.stop = &stop_;
    rack::HomingOutcome out = job_ ? job_->home(settings) : rack::home_axes(*rack_, settings);
    listen_again();
    return out;
}

// ---- a part program

control::gcode::Settings RackHandle::reading_of(const ProgramInput& program) const {
    control::gcode::Settings out = rack::reader_settings(config_, program.block_delete);
    if (job_) out.start = value_of(job_->start());
    if (!program.folder.empty()) out.subprogram = rack::subprograms_in(program.folder);
    if (!program.tools_name.empty())
        out.tools = value_of(control::gcode::read_tool_table(program.tools, program.tools_name));
    value_of(control::gcode::check_settings(out));
    return out;
}

control::gcode::Settings RackHandle::check(const ProgramInput& program) const {
    if (config_.axes.empty()) refuse("The rack has no axes, so no program can run on it. Nothing was moved.");
    control::gcode::Settings reading = reading_of(program);
    if (auto check = control::gcode::check_program(program.text, reading, max_problems, program.name);
        !check.problems.empty())
        throw PythonError{check.problems.front(), false, {check.problems.begin(), check.problems.end()}};
    return reading;
}

Result<rack::JobOutcome> RackHandle::run(const ProgramInput& program, control::gcode::Settings reading,
                                         std::function<void()> superseded) {
    running();
    MOTIONRACK_TRY(reading.start, job_->start());
    if (superseded_) superseded_();
    superseded_ = std::move(superseded);
    program_ = program;
    job_->give(program_.text, program_.name, std::move(reading));
    rack::JobOutcome out = job_->run();
    listen_again();
    return out;
}

}  // namespace motionrack::python
