// A job with all that may watch it, and everything that it is made of: what a recording keeps, so that it can be run
// again.
//
//   JobRequest ──► RecordedJob ──► rack, job, faults, orders        files, options ──► JobRequest
//                       │                                           recording ───────► JobRequest
//                       └──► waves (VCD), recording (HDF5)
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/job_recorder.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::rack {

struct JobRequest {
    RackConfig config;
    std::string rack_file, rack_text;  ///< what the config was read from; only recordings need them
    std::string program, program_name;
    bool block_delete = false, stream = false;
    control::gcode::ToolTable tools;
    std::map<std::string, std::string> subprograms;  ///< texts of those that the program calls and does not have itself
    std::vector<ScheduledText> faults, orders;
    std::string version;  ///< of the program that runs it
};

/// Takes "ORDER@TIME" as users write it. Errors: invalid_input.
Result<std::vector<ScheduledText>> read_orders(const std::vector<std::string>& texts);

/// How its program is read.
control::gcode::Settings reading_of(const JobRequest& request);

/// The request that a recording was made by. Errors: invalid_input, its rack cannot be read any more.
Result<JobRequest> request_of(const trace::RecordingReader& recording);

struct JobObservers {
    std::string recording = {};  ///< its path; empty: none
    std::optional<WaveSettings> waves = std::nullopt;
};

class RecordedJob {
  public:
    /// Builds all; nothing has moved. `request` must outlive it. Errors: as FaultSchedule, CommandSchedule, the
    /// recorders.
    static Result<std::unique_ptr<RecordedJob>> create(const JobRequest& request, const JobObservers& watchers);
    ~RecordedJob();

    /// Once. `stop_asked` may be nullptr, `progress` empty.
    const JobOutcome& run(const std::atomic<bool>* stop_asked, std::function<void(const JobProgress&)> progress);
    /// Ends the files. Errors: io, the first one.
    Result<void> finish();

    Rack& rack() { return rack_; }
    const Job& job() const { return *job_; }
    /// What the page shows; also what stands in the recording.
    const trace::ReportData& report() const { return report_; }
    /// Sentences about planned faults and orders that were not done.
    std::vector<std::string> not_done() const;
    /// Events that the recording has; 0: there is none.
    std::uint64_t events() const { return recorder_ ? recorder_->events() : 0; }

  private:
    explicit RecordedJob(const JobRequest& request) : request_(request), rack_(request.config) {}
    void between_runs(const std::atomic<bool>* stop_asked);

    const JobRequest& request_;
    Rack rack_;
    std::unique_ptr<WaveRecorder> waves_;
    std::unique_ptr<JobRecorder> recorder_;
    std::unique_ptr<FaultSchedule> faults_;
    std::unique_ptr<CommandSchedule> orders_;
    std::unique_ptr<Job> job_;
    JobOutcome outcome_;
    trace::ReportData report_;
};

}  // namespace motionrack::rack
