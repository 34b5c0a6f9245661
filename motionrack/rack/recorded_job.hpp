// A job with its observers and all its inputs: the content of a recording that allows it to be repeated.
//
//   JobRequest ──► RecordedJob ──► rack, job, faults, commands      files, options ──► JobRequest
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
#include <motionrack/rack/recorder.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::rack {

struct JobRequest {
    RackConfig config;
    std::string rack_file, rack_text;  ///< source of the config; only recordings need it
    std::string program, program_name;
    bool block_delete = false, stream = false;
    control::gcode::ToolTable tools;
    std::map<std::string, std::string> subprograms;  ///< texts of called subprograms outside the program
    std::vector<ScheduledText> faults, commands;
    std::string version;  ///< version of the running program
};

/// Parses "COMMAND@TIME" texts. Errors: invalid_input.
Result<std::vector<ScheduledText>> read_commands(const std::vector<std::string>& texts);

/// Returns the reader settings of the request's program.
control::gcode::Settings reading_of(const JobRequest& request);

/// Restores the request of a recording. Errors: invalid_input if its rack can no longer be read.
Result<JobRequest> request_of(const trace::RecordingReader& recording);

struct JobObservers {
    std::string recording = {};  ///< path; empty: no recording
    std::optional<RecorderSettings> waves = std::nullopt;
};

class RecordedJob {
  public:
    /// Builds everything without any motion. `request` must outlive the object. Errors: as FaultSchedule,
    /// CommandSchedule, the recorders.
    static Result<std::unique_ptr<RecordedJob>> create(const JobRequest& request, const JobObservers& watchers);
    ~RecordedJob();

    /// Runs the job. Call once. `stop_asked` may be nullptr, `progress` empty.
    const JobOutcome& run(const std::atomic<bool>* stop_asked, std::function<void(const JobProgress&)> progress);
    /// Ends the files. Errors: io; the first one is returned.
    Result<void> finish();

    Rack& rack() { return rack_; }
    const Job& job() const { return *job_; }
    /// Data of the report page, also stored in the recording.
    const trace::ReportData& report() const { return report_; }
    /// Sentences about planned faults and commands that were not executed.
    std::vector<std::string> not_done() const;
    /// Number of events in the recording; 0: no recording.
    std::uint64_t events() const { return recorder_ ? recorder_->events() : 0; }

  private:
    explicit RecordedJob(const JobRequest& request) : request_(request), rack_(request.config) {}
    void between_runs(const std::atomic<bool>* stop_asked);

    const JobRequest& request_;
    Rack rack_;
    std::unique_ptr<Recorder> waves_;
    std::unique_ptr<JobRecorder> recorder_;
    std::unique_ptr<FaultSchedule> faults_;
    std::unique_ptr<CommandSchedule> commands_;
    std::unique_ptr<Job> job_;
    JobOutcome outcome_;
    trace::ReportData report_;
};

}  // namespace motionrack::rack
