// Collects the events of a job and passes them to the recording.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/job_recorder.hpp>

namespace motionrack::rack {

namespace {

// Data lost when the program is killed: the last tenth of the job's time, or this number of events.
constexpr std::uint64_t max_unflushed = 1'000'000;
constexpr Duration min_flush_period = whole_seconds(1);

std::string lower_letter(char letter) {
    return std::string(1, static_cast<char>(letter - 'A' + 'a'));
}

/// Converts "motion.xlmtp" to "wires/motion/xlmtp"; names without a dot belong to the rack.
std::string wire_path(const std::string& name) {
    const std::size_t dot = name.find('.');
    return dot == std::string::npos ? "wires/rack/" + name
                                    : "wires/" + name.substr(0, dot) + '/' + name.substr(dot + 1);
}

}  // namespace

class JobRecorder::Observer final : public sim::EdgeListener {
  public:
    /// `counts`: values are counts after the edge, else directions.
    Observer(JobRecorder& recorder, std::uint32_t signal, bool counts)
        : recorder_(recorder), signal_(signal), counts_(counts) {}

    void edges(const sim::EdgeBatch& batch) override {
        std::int64_t count = batch.first_count;
        for (std::uint32_t i = 0; i < batch.size; ++i, count += batch.step)
            recorder_.push(batch.origin + batch.at[i] * batch.tick, signal_, counts_ ? count : batch.step);
    }

  private:
    JobRecorder& recorder_;
    std::uint32_t signal_;
    bool counts_;
};

// ---- recorded signals

JobRecorder::JobRecorder(Rack& rack, trace::RecordingHead head) : rack_(rack), head_(std::move(head)) {
    buffer_.reserve(buffer_size);
}

JobRecorder::~JobRecorder() {
    stop_listening();
}

Result<std::unique_ptr<JobRecorder>> JobRecorder::create(Rack& rack, const std::string& path,
                                                         trace::RecordingHead head) {
    std::unique_ptr<JobRecorder> out(new JobRecorder(rack, std::move(head)));
    out->add_axes();
    out->add_wires();
    out->add_counters();
    out->began_ = rack.kernel().now();
    out->next_flush_ = out->began_ + min_flush_period;
    MOTIONRACK_TRY(out->writer_, trace::RecordingWriter::create(path, out->head_, out->began_));
    out->id_ = rack.kernel().add(*out, sim::Phase::observers, "recorder");
    out->listen();
    return out;
}

std::uint32_t JobRecorder::add(trace::RecordedSignal signal) {
    head_.signals.push_back(std::move(signal));
    return static_cast<std::uint32_t>(head_.signals.size() - 1);
}

void JobRecorder::add_axes() {
    head_.axes.clear();
    head_.signals.clear();
    const control::MachineLimits limits = rack_.config().limits();
    for (RunningAxis& axis : rack_.axes()) {
        const RackAxis& config = axis.config;
        const control::AxisLimits& limit = limits[static_cast<std::size_t>(config.index())];
        const std::string name(1, config.letter);
        head_.axes.push_back({name, std::string(config.unit()), axis.servo != nullptr, config.pulses_per_unit(),
                              config.counts_per_unit(), config.initial_position, limit.min_position, limit.max_position,
                              limit.max_velocity, limit.max_accel});
        axis_indexes_.push_back(config.index());
        const std::string folder = "axes/" + lower_letter(config.letter);
        if (!axis.servo) {
            const std::uint32_t steps = add({name + ".steps", folder + "/steps", trace::SignalKind::steps, "step", 0});
            listeners_.emplace_back(axis.pulse_listeners.get(), std::make_unique<Observer>(*this, steps, false));
        }
        if (axis.machine->has_encoder()) {
            const std::int64_t count = axis.machine->encoder().count(rack_.kernel().now());
            const std::uint32_t counts =
                add({name + ".encoder", folder + "/encoder", trace::SignalKind::counts, "count", count});
            listeners_.emplace_back(axis.encoder_listeners.get(), std::make_unique<Observer>(*this, counts, true));
        }
    }
    sampled_.resize(head_.axes.size());
}

void JobRecorder::add_wires() {
    const sim::Kernel& kernel = rack_.kernel();
    wire_signals_.assign(kernel.wire_count(), -1);
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        if (kernel.lazy(wire)) continue;  // pulse outputs and the like are driven only while observed
        const std::string& name = kernel.wire_name(wire);
        wire_signals_[i] = add({name, wire_path(name), trace::SignalKind::levels, "", kernel.level(wire)});
    }
}

void JobRecorder::add_counters() {
    for (const auto& card : rack_.cards())
        for (const CardCounter& counter : card->counters()) {
            const std::uint32_t signal =
                add({card->name() + "." + counter.name, "cards/" + card->name() + "/" + counter.name,
                     trace::SignalKind::levels, counter.encoder ? "count" : "step", card->counter(counter)});
            counters_.push_back({card.get(), counter, signal});
        }
}

// ---- recording

void JobRecorder::listen() {
    for (const auto& [fork, listener] : listeners_) fork->add(*listener);
    rack_.wire_listeners().add(*this);
    listening_ = true;
}

void JobRecorder::stop_listening() {
    if (!listening_) return;
    listening_ = false;
    for (const auto& [fork, listener] : listeners_) fork->remove(*listener);
    rack_.wire_listeners().remove(*this);
    if (rack_.started()) rack_.kernel().schedule(id_, never);
}

void JobRecorder::begin() {
    rack_.kernel().schedule(id_, rack_.kernel().now());
}

void JobRecorder::push(Instant at, std::uint32_t signal, std::int64_t value) {
    if (buffer_.size() == buffer_size) {
        ++lost_;
        return;
    }
    buffer_.push_back({at, value, signal});
    if (buffer_.size() > buffer_size / 2) rack_.kernel().break_run();
}

void JobRecorder::wire_changed(sim::WireId wire, int level, Instant now) {
    const std::int64_t signal = wire_signals_[sim::Kernel::index(wire)];
    if (signal >= 0) push(now, static_cast<std::uint32_t>(signal), level);
}

void JobRecorder::on_scheduled(Instant now) {
    for (const Counter& one : counters_) push(now, one.signal, one.card->counter(one.counter));
    rack_.kernel().schedule(id_, now + counter_period);
}

void JobRecorder::sample(const MonitorSample& sample, double deviation_mm) {
    for (std::size_t i = 0; i < sampled_.size(); ++i) {
        const auto axis = static_cast<std::size_t>(axis_indexes_[i]);
        sampled_[i] = {sample.position[axis], sample.commanded[axis], sample.velocity[axis], sample.accel[axis],
                       sample.volts[axis]};
    }
    writer_.sample(sample.at, deviation_mm, sampled_);
}

void JobRecorder::drain() {
    for (const JobEvent& event : buffer_) writer_.event(event.signal, event.at, event.value);
    buffer_.clear();
    const Instant now = rack_.kernel().now();
    if (now < next_flush_ && writer_.events() - flushed_events_ < max_unflushed) return;
    writer_.flush(now);
    flushed_events_ = writer_.events();
    next_flush_ = now + std::max(min_flush_period, (now - began_) / 10);
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
    stop_listening();
    const Instant now = rack_.kernel().now();
    for (const Counter& one : counters_) push(now, one.signal, one.card->counter(one.counter));
    drain();
    trace::RecordingEnd end;
    end.at = now;
    end.outcome = facts_of(outcome);
    end.report = std::move(report);
    const Result<void> closed = writer_.close(end);
    if (!closed || lost_ == 0) return closed;
    return fail(ErrorKind::io,
                fmt::format("{} events of one instant exceed the limit of a recording and were omitted.", lost_));
}

}  // namespace motionrack::rack
