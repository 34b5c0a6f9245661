// A job recorded whole, while it runs, into one file from which it can be run again: see trace/recording.hpp.
//
//   pulses ──┐
//   encoders ┼──► events in a buffer ──drain(), between runs──► RecordingWriter ──► run.h5
//   wires ───┤                              samples, inputs ──────┘
//   counters ┘ looked at every ms
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
    /// Before the rack is started. `head`: what was run; axes and signals are filled in here. Errors: io.
    static Result<std::unique_ptr<JobRecorder>> create(Rack& rack, const std::string& path, trace::RecordingHead head);
    ~JobRecorder() override;

    /// After the rack was started.
    void begin();
    // ---- between runs
    void sample(const Sample& sample, double deviation_mm);
    /// Something from outside takes effect at its instant.
    void input(const trace::RecordedInput& input) { writer_.input(input); }
    /// Writes what has come together.
    void drain();
    /// Ends the file and listens no more. Errors: io.
    Result<void> finish(const JobOutcome& outcome, trace::ReportData report);

    std::uint64_t events() const { return writer_.events(); }
    void on_scheduled(Instant now) override;
    void wire_changed(sim::WireId wire, int level, Instant now) override;

  private:
    struct Event {
        Instant at{};
        std::int64_t value = 0;
        std::uint32_t signal = 0;
    };
    /// Hears pulses, or counts, of one axis.
    class Observer;
    /// LP (or EP) of a channel.
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
    std::vector<std::pair<EdgeFanout*, std::unique_ptr<Observer>>> ears_;
    std::vector<std::int64_t> wire_signals_;  // signal of each kernel wire, -1: not recorded
    std::vector<Counter> counters_;
    std::vector<Event> buffer_;
    std::vector<int> axis_indexes_;  // of the head's axes, 0 .. 5
    std::vector<trace::AxisSample> sampled_;
    bool listening_ = false;
    std::uint64_t lost_ = 0, flushed_events_ = 0;
    Instant began_{}, next_flush_{};
};

}  // namespace motionrack::rack
