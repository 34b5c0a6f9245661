// Records a whole job, while it runs, into one file from which it can be repeated: see trace/recording.hpp.
//
//   Recorder (pulses, encoders, wires, counters) ──► RecordingWriter ──► run.h5
//                                  samples, inputs ──────┘
#pragma once

#include <memory>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/trace/recording.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::rack {

class JobRecorder {
  public:
    /// Call before the rack starts. `head`: description of the job; axes and signals are filled in here. Errors: io.
    static Result<std::unique_ptr<JobRecorder>> create(Rack& rack, const std::string& path, trace::RecordingHead head);

    /// Call after the rack has started.
    void begin() { recorder_->begin(); }
    // ---- between runs
    void sample(const MonitorSample& sample, double deviation_mm);
    /// Records an external input that takes effect at its instant.
    void input(const trace::RecordedInput& input) { file_->writer.input(input); }
    /// Writes the buffered events.
    void drain() { recorder_->drain(); }
    /// Ends the file and stops listening, even on an error; another call returns the same error. Errors: io.
    Result<void> finish(const JobOutcome& outcome, trace::ReportData report);

    std::uint64_t events() const { return file_->writer.events(); }

  private:
    /// Writes the recorder's events to the file of the job.
    struct RecordingSink final : ChangeSink {
        explicit RecordingSink(trace::RecordingWriter file) : writer(std::move(file)) {}
        void change(std::size_t index, std::int64_t value, Instant at) override { writer.event(index, at, value); }
        void settle(Instant at) override { writer.settle(at); }
        Result<void> close(Instant at) override;
        bool can_end_again() const override { return writer.is_open(); }

        trace::RecordingWriter writer;
        trace::RecordingEnd end;  ///< set before close()
    };

    std::shared_ptr<RecordingSink> file_;
    std::unique_ptr<Recorder> recorder_;
    std::vector<int> axis_indexes_;  // axis indexes of the head, 0 .. 5
    std::vector<trace::AxisSample> sampled_;
};

}  // namespace motionrack::rack
