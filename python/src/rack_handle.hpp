// A rack in Python: started when its time is first needed, then run in slices; Python signals are checked between
// slices.
//
//   Python ──► RackHandle ──┬─► Rack, Job (a part program), FaultSchedule
//                      ├─► WireAccess, RecorderTap, Recorder
//                      └─► service_run(), between runs: faults that are due, samples, recordings, Ctrl-C
#pragma once

#include <functional>
#include <memory>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/recorder.hpp>
#include <python/src/host.hpp>
#include <python/src/sample_table.hpp>
#include <string>
#include <vector>

namespace motionrack::python {

/// A part program and what goes with it.
struct ProgramInput {
    std::string text, name;
    std::string folder;  ///< folder of its subprograms; empty: only internal ones
    std::string tools,
        tools_name;  ///< text of a tool table (LinuxCNC's .tbl), and its name; empty name: no table
    bool block_delete = false;
};

class RackHandle final : public Host {
  public:
    explicit RackHandle(const rack::RackConfig& config);
    ~RackHandle() override;
    RackHandle(const RackHandle&) = delete;
    RackHandle& operator=(const RackHandle&) = delete;

    const rack::RackConfig& config() const { return config_; }
    /// Throws refused after close.
    rack::Rack& rack();
    /// As above, after starting the rack.
    rack::Rack& running();
    const rack::WireAccess& context() { return running(), *context_; }
    bool started() const { return rack_ && rack_->started(); }
    bool closed() const { return rack_ == nullptr; }
    Instant now() override { return rack().kernel().now(); }
    /// Errors: io if the recording of waves cannot be completed; the rack is closed in any case.
    Result<void> close();

    // ---- before the start
    /// "X.limit_plus=0@0.5s": see FaultSchedule. Errors: refused in a started rack, and those of the schedule; then no
    /// fault is scheduled.
    Result<void> plan_faults(const std::vector<std::string>& texts);
    std::vector<std::string> not_done() const { return plan_ ? plan_->not_done() : std::vector<std::string>(); }
    /// Sample period of a job, > 0. Errors: refused in a started rack.
    Result<void> set_sample_period(Duration period);

    /// "trapezoid" or "jerk_limited"; overrides the rack file. Errors: refused in a started rack.
    Result<void> set_profile(const std::string& profile);

    /// Sets a numeric setting of a card, in the unit of its key. Checks its range and the card alone, not its
    /// consistency with other cards. Errors: refused, invalid_input; then nothing is changed.
    Result<void> set_card(const std::string& card, const std::string& key, double value);

    // ---- time
    /// Errors: refused (beyond latest), stopped (Ctrl-C).
    Result<void> advance(Duration time);
    /// Returns true once the wire has the level within `timeout`; time stops at that instant. Errors: invalid_input,
    /// stopped.
    Result<bool> wait_wire(const std::string& wire, int level, Duration timeout);
    static constexpr Instant latest{never.count() / 2};

    // ---- wires
    Result<void> set_wire(const std::string& name, double value);

    // ---- part programs, in sequence, from the current axis positions
    /// Returns the settings to read a valid program; otherwise throws all problems in line order, or the reason why no
    /// program can start now. Nothing moves.
    control::gcode::Settings check(const ProgramInput& program) const;
    /// Runs a program that check() has accepted, with its settings. `superseded` is called before the samples of the
    /// next program replace those of this one.
    Result<rack::JobOutcome> run(const ProgramInput& program, control::gcode::Settings reading,
                                 std::function<void()> superseded);
    /// See home_axes; replaces `settings.stop`.
    rack::HomingOutcome home(rack::HomingSettings settings);
    const rack::Job* job() const { return job_.get(); }
    const std::string& program() const { return program_.text; }
    const std::string& program_name() const { return program_.name; }

    // ---- samples and waves
    Result<void> begin_samples(const std::vector<std::string>& names, Duration period, std::size_t max_samples);
    Result<std::shared_ptr<const SampleTable>> end_samples();
    Result<void> begin_waves(const std::string& path, const std::vector<std::string>& signals);
    Result<void> end_waves();

    // ---- the whole rack
    /// Returns an independent copy in the same state; recordings stay with this one.
    std::shared_ptr<RackHandle> copy();
    void copy_from(RackHandle& other);

    // ---- observers
    /// Called between runs, at least every 50 ms of simulated time, and at each break.
    void on_poll(std::function<void()> call) { look_ = std::move(call); }
    /// Called about every 50 ms of simulated time of a program; empty: none.
    void on_progress(std::function<void(const rack::JobProgress&)> call) { progress_ = std::move(call); }
    /// Runs between two runs of the kernel: injects due faults, takes samples, drains recordings, polls Python. While a
    /// driver or a job runs the rack, its host calls this.
    void service_run();
    /// Restores the host's slices after a job or a homing used them.
    void listen_again();

  private:
    bool is_built_like(RackHandle& other);
    void build();
    void start();
    Result<void> run_to(Instant until, const std::function<bool()>& enough = {});
    rack::JobSettings job_settings();
    control::gcode::Settings reading_of(const ProgramInput& program) const;

    rack::RackConfig config_;
    ProgramInput program_;
    std::vector<std::string> fault_texts_;
    Duration sample_period_ = milliseconds(1);
    std::function<void()> look_, superseded_;
    std::function<void(const rack::JobProgress&)> progress_;

    std::unique_ptr<rack::Rack> rack_;
    std::unique_ptr<rack::WireAccess> context_;
    std::unique_ptr<rack::FaultSchedule> plan_;
    std::unique_ptr<rack::Job> job_;
    std::unique_ptr<rack::RecorderTap> tap_;
    std::unique_ptr<rack::Recorder> recorder_;
    Instant next_register_look_ = never;
    std::unique_ptr<rack::Recorder> sampler_;
    std::shared_ptr<const SampleTable> samples_;
};

}  // namespace motionrack::python
