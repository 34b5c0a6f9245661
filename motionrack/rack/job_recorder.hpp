// Records a whole job, while it runs, into one file from which it can be repeated: see trace/recording.hpp.
//
//   pulses ──┐
//   encoders ┼──► events in a buffer ──drain(), between runs──► RecordingWriter ──► run.h5
//   wires ───┤                              samples, inputs ──────┘
//   counters ┘ sampled every ms
#pragma once

#include <memory>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/trace/recording.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

class JobRecorder final : public sim::Device, public sim::Kernel::WireObserver {
  public:
    /// Call before the rack starts. `head`: description of the job; axes and signals are filled in here. Errors: io.
    static Result<std::unique_ptr<JobRecorder>> create(Rack& rack, const std::string& path, trace::RecordingHead head);
    ~JobRecorder() override;

    /// Call after the rack has started.
    void begin();
    // ---- between runs
    void sample(const MonitorSample& sample, double deviation_mm);
    /// Records an external input that takes effect at its instant.
    void input(const trace::RecordedInput& input) { writer_.input(input); }
    /// Writes the buffered events.
    void drain();
    /// Ends the file and stops listening. Errors: io.
    Result<void> finish(const JobOutcome& outcome, trace::ReportData report);

    std::uint64_t events() const { return writer_.events(); }
    void on_scheduled(Instant now) override;
    void wire_changed(sim::WireId wire, int level, Instant now) override;

  private:
    struct JobEvent {
        Instant at{};
        std::int64_t value = 0;
        std::uint32_t signal = 0;
    };
    /// Listens to the pulses or counts of one axis.
    class Observer;
    /// LP or EP of a channel.
    struct Counter {
        Card* card = nullptr;
        CardCounter counter;
        std::uint32_t signal = 0;
    };

    JobRecorder(Rack& rack, trace::RecordingHead head);
    std::uint32_t add(trace::RecordedSignal signal);
    void add_axes();
    void add_wires();
    void add_counters();
    void listen();
    void stop_listening();
    void push(Instant at, std::uint32_t signal, std::int64_t value);

    static constexpr std::size_t buffer_size = 1 << 20;
    static constexpr Duration counter_period = milliseconds(1);

    Rack& rack_;
    trace::RecordingHead head_;
    sim::DeviceId id_{};
    trace::RecordingWriter writer_;
    std::vector<std::pair<EdgeFanout*, std::unique_ptr<Observer>>> listeners_;
    std::vector<std::int64_t> wire_signals_;  // signal of each kernel wire, -1: not recorded
    std::vector<Counter> counters_;
    std::vector<JobEvent> buffer_;
    std::vector<int> axis_indexes_;  // axis indexes of the head, 0 .. 5
    std::vector<trace::AxisSample> sampled_;
    bool listening_ = false;
    std::uint64_t lost_ = 0, flushed_events_ = 0;
    Instant began_{}, next_flush_{};
};

}  // namespace motionrack::rack
