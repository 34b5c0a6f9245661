// Writes the events, samples and inputs of a job to its recording.
#include <fmt/format.h>

#include <motionrack/rack/job_recorder.hpp>

namespace motionrack::rack {

namespace {

std::string lower_letter(char letter) {
    return std::string(1, static_cast<char>(letter - 'A' + 'a'));
}

/// Fills in the axes, and returns their indexes.
std::vector<int> fill_in_axes(trace::RecordingHead& head, Rack& rack) {
    std::vector<int> indexes;
    head.axes.clear();
    const control::MachineLimits limits = rack.config().limits();
    for (const RunningAxis& axis : rack.axes()) {
        const RackAxis& config = axis.config;
        const control::AxisLimits& limit = limits[static_cast<std::size_t>(config.index())];
        head.axes.push_back({std::string(1, config.letter), std::string(config.unit()), axis.servo != nullptr,
                             config.pulses_per_unit(), config.counts_per_unit(), config.initial_position,
                             limit.min_position, limit.max_position, limit.max_velocity, limit.max_accel});
        indexes.push_back(config.index());
    }
    return indexes;
}

/// Returns the recorded signal of a channel, with its group ("axes/x/steps", "cards/motion/xlp", "wires/motion/xlmtp").
/// Levels and words of wires are stored unscaled.
trace::RecordedSignal signal_of(const Channel& channel) {
    trace::RecordedSignal out{channel.name, channel.scope() + "/" + channel.short_name(), trace::SignalKind::levels, "",
                              channel.initial};
    if (channel.is_wire()) {
        out.path = "wires/" + out.path;
        return out;
    }
    out.unit = channel.unit;
    if (channel.kind == ChannelKind::counter) {
        out.path = "cards/" + out.path;
        return out;
    }
    out.path = "axes/" + lower_letter(channel.name.front()) + "/" + channel.short_name();
    out.kind = channel.kind == ChannelKind::steps ? trace::SignalKind::steps : trace::SignalKind::counts;
    return out;
}

}  // namespace

Result<void> JobRecorder::RecordingSink::close(Instant at) {
    end.at = at;
    return writer.close(end);
}

Result<std::unique_ptr<JobRecorder>> JobRecorder::create(Rack& rack, const std::string& path,
                                                         trace::RecordingHead head) {
    auto out = std::make_unique<JobRecorder>();
    out->axis_indexes_ = fill_in_axes(head, rack);
    out->sampled_.resize(head.axes.size());
    RecorderSettings settings;
    settings.events = true;
    settings.sink = [&](const Declaration& declared) -> Result<std::shared_ptr<ChangeSink>> {
        head.signals.clear();
        for (const Channel& channel : declared.channels) head.signals.push_back(signal_of(channel));
        MOTIONRACK_TRY(trace::RecordingWriter writer, trace::RecordingWriter::create(path, head, declared.start));
        out->file_ = std::make_shared<RecordingSink>(std::move(writer));
        return out->file_;
    };
    MOTIONRACK_TRY(out->recorder_, Recorder::create(rack, settings));
    return out;
}

void JobRecorder::sample(const MonitorSample& sample, double deviation_mm) {
    for (std::size_t i = 0; i < sampled_.size(); ++i) {
        const auto axis = static_cast<std::size_t>(axis_indexes_[i]);
        sampled_[i] = {sample.position[axis], sample.commanded[axis], sample.velocity[axis], sample.accel[axis],
                       sample.volts[axis]};
    }
    file_->writer.sample(sample.at, deviation_mm, sampled_);
}

namespace {

/// Formats the numbers of all axes as one text: "X 81920, Y 40960".
template <class Member>
std::string of_axes(const JobOutcome& outcome, Member member) {
    std::string out;
    for (const AxisOutcome& axis : outcome.axes)
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ",
                           control::axis_letters[static_cast<std::size_t>(axis.index)], axis.*member);
    return out;
}

std::vector<trace::OutcomeField> facts_of(const JobOutcome& outcome) {
    std::vector<trace::OutcomeField> facts;
    const auto add = [&](const char* name, const auto& value) { facts.push_back({name, fmt::format("{}", value)}); };
    add("ended", outcome.ended ? "yes" : "no");
    if (!outcome.ended) {
        add("message", outcome.ended.error().message);
        add("line", outcome.ended.error().location.line);
    }
    add("duration_s", to_seconds(outcome.time));
    add("path_mm", outcome.path_mm);
    add("moves", outcome.run.moves);
    add("lines", outcome.run.lines);
    add("chip_segments", outcome.chip_segments);
    add("trace_hash", fmt::format("{:016x}", outcome.trace_hash));
    add("position_valid", outcome.position_valid ? "yes" : "no");
    add("max_deviation_mm", outcome.max_deviation.mm);
    add("pulse_positions", of_axes(outcome, &AxisOutcome::pulse_position));
    add("encoder_counts", of_axes(outcome, &AxisOutcome::encoder_counts));
    add("actual_ends", of_axes(outcome, &AxisOutcome::actual_end));
    return facts;
}

}  // namespace

Result<void> JobRecorder::finish(const JobOutcome& outcome, trace::ReportData report) {
    file_->end.outcome = facts_of(outcome);
    file_->end.report = std::move(report);
    return recorder_->finish();
}

}  // namespace motionrack::rack
