// Converts a request to a monitored job, and a recording to a request.
#include <fmt/format.h>

#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <string_view>
#include <utility>

namespace motionrack::rack {

namespace {

// Distinguishes faults from commands in a recording.
constexpr std::string_view fault_word = "fault ";

trace::RecordingHead head_of(const JobRequest& request, const CommandSchedule& commands) {
    trace::RecordingHead head;
    head.version = request.version;
    head.program_name = request.program_name;
    head.program = request.program;
    head.rack_name = request.config.name;
    head.rack_file = request.rack_file;
    head.rack = request.rack_text;
    head.block_delete = request.block_delete;
    head.stream = request.stream;
    for (const control::gcode::Tool& tool : request.tools.tools()) head.tools += to_text(tool) + "\n";
    head.subprograms = request.subprograms;
    head.live = commands.needs_stream();
    head.sample_period = JobSettings().sample_period;
    for (const ScheduledText& fault : request.faults)
        head.inputs.push_back({fault.at, std::string(fault_word) + fault.action});
    for (const ScheduledText& command : request.commands) head.inputs.push_back({command.at, command.action});
    return head;
}

}  // namespace

Result<std::vector<ScheduledText>> read_commands(const std::vector<std::string>& texts) {
    std::vector<ScheduledText> out;
    for (const std::string& text : texts) {
        std::optional<ScheduledText> timed = read_timed_text(text);
        if (!timed)
            return fail(ErrorKind::invalid_input,
                        fmt::format("The command {} needs its time, 0 to {:.0f} s: hold@1.5s, "
                                    "resume@2s, feed=0.5@20ms, stop@3s. Nothing was moved.",
                                    in_quotes(text), max_planned_seconds));
        out.push_back(std::move(*timed));
    }
    return out;
}

control::gcode::Settings reading_of(const JobRequest& request) {
    control::gcode::Settings out = reader_settings(request.config, request.block_delete);
    out.tools = request.tools;
    out.subprogram = [texts = request.subprograms](const std::string& name) -> Result<std::string> {
        const auto found = texts.find(name);
        if (found == texts.end())
            return fail(ErrorKind::invalid_input, fmt::format("no text of {} came with it", in_quotes(name)));
        return found->second;
    };
    return out;
}

Result<JobRequest> request_of(const trace::RecordingReader& recording) {
    const trace::RecordingHead& head = recording.head();
    RackReading reading = read_rack_text(head.rack, head.rack_file);
    if (!reading.config)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The rack of the recording cannot be read by this version: {}", reading.errors.front().text()),
            {}, recording.path());
    JobRequest out;
    out.config = std::move(*reading.config);
    out.rack_file = head.rack_file;
    out.rack_text = head.rack;
    out.program = head.program;
    out.program_name = head.program_name;
    out.block_delete = head.block_delete;
    out.stream = head.stream;
    MOTIONRACK_TRY(out.tools, control::gcode::read_tool_table(head.tools, recording.path()));
    out.subprograms = head.subprograms;
    for (const trace::RecordedInput& input : recording.inputs()) {
        const bool fault = input.text.compare(0, fault_word.size(), fault_word) == 0;
        const std::string action = fault ? input.text.substr(fault_word.size()) : input.text;
        (fault ? out.faults : out.commands)
            .push_back({input.at, action, fmt::format("{}@{}s", action, to_seconds(input.at))});
    }
    return out;
}

Result<std::unique_ptr<RecordedJob>> RecordedJob::create(const JobRequest& request, const JobObservers& watchers) {
    std::unique_ptr<RecordedJob> out(new RecordedJob(request));
    if (watchers.waves) {
        MOTIONRACK_TRY(out->waves_, Recorder::create(out->rack_, *watchers.waves));
    }
    MOTIONRACK_TRY(out->faults_, FaultSchedule::create_timed(out->rack_, request.faults));
    MOTIONRACK_TRY(out->commands_, CommandSchedule::create(out->rack_, request.commands));
    if (!watchers.recording.empty()) {
        MOTIONRACK_TRY(out->recorder_,
                       JobRecorder::create(out->rack_, watchers.recording, head_of(request, *out->commands_)));
    }
    return out;
}

RecordedJob::~RecordedJob() = default;

const JobOutcome& RecordedJob::run(const std::atomic<bool>* stop_asked,
                                   std::function<void(const JobProgress&)> progress) {
    JobSettings settings;
    settings.program = request_.program;
    settings.program_name = request_.program_name;
    settings.reading = reading_of(request_);
    settings.commands = commands_.get();
    settings.progress = std::move(progress);
    settings.on_slice = [this, stop_asked] { between_runs(stop_asked); };
    if (recorder_)
        settings.on_sample = [this](const MonitorSample& sample, double deviation) {
            recorder_->sample(sample, deviation);
        };
    job_ = std::make_unique<Job>(rack_, settings);
    rack_.start();
    if (waves_) waves_->begin();
    if (recorder_) recorder_->begin();
    faults_->begin();
    commands_->begin();
    outcome_ = job_->run();
    report_ = report_of(rack_, *job_, outcome_, request_.program, request_.program_name);
    return outcome_;
}

void RecordedJob::between_runs(const std::atomic<bool>* stop_asked) {
    faults_->apply_due();
    if (stop_asked != nullptr && stop_asked->load(std::memory_order_relaxed))
        if (const std::optional<Instant> at = commands_->ask_stop(); at && recorder_) recorder_->input({*at, "stop"});
    if (waves_) waves_->drain_settled();
    if (recorder_) recorder_->drain();
}

Result<void> RecordedJob::finish() {
    Result<void> waves = waves_ ? waves_->finish() : Result<void>();
    Result<void> recorded = recorder_ ? recorder_->finish(outcome_, report_) : Result<void>();
    return waves ? recorded : waves;
}

std::vector<std::string> RecordedJob::not_done() const {
    std::vector<std::string> out = faults_->not_done();
    for (std::string& command : commands_->not_done()) out.push_back(std::move(command));
    return out;
}

}  // namespace motionrack::rack
