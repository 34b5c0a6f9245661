// Recording of a run in one HDF5 file: program and rack, external inputs, every event with its tick, axis positions,
// and the outcome. docs/reference/recording.md describes the layout.
//
//  RecordingWriter:  create(head) ──► event, sample, input, flush ... ──► close(outcome)       memory is bounded
//  RecordingReader:  open ──► head, columns of each signal, report data   also if truncated    for any length
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/trace/hdf5.hpp>
#include <motionrack/trace/report.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::trace {

/// External input of the rack: "stop", "hold", "feed=0.5", or a fault as the user wrote it, without the time.
struct RecordedInput {
    Instant at{};
    std::string text;
    friend bool operator==(const RecordedInput&, const RecordedInput&) = default;
};

enum class SignalKind : std::uint8_t {
    steps,   ///< motor pulses: each event is one pulse, value +1 or -1
    counts,  ///< encoder counts: each event is one count, value is the new count
    levels   ///< wires and counters: each event is a change
};

/// A signal with recorded events.
struct RecordedSignal {
    std::string name;  ///< display name: "X.steps", "X.limit_plus", "motion.lp_x"
    std::string path;  ///< group in the file: "axes/x/steps"
    SignalKind kind = SignalKind::levels;
    std::string unit;          ///< unit of the values: "step", "count"; empty: a level
    std::int64_t initial = 0;  ///< value at the start of the recording
    double scale = 1;          ///< value in `unit` = stored value times this
    friend bool operator==(const RecordedSignal&, const RecordedSignal&) = default;
};

struct RecordedAxis {
    std::string name;         ///< "X"
    std::string unit = "mm";  ///< or "deg"
    bool servo = false;
    double pulses_per_unit = 1, counts_per_unit = 0;  ///< counts: 0 without encoder
    double origin = 0;                                ///< position at which both counts are 0, mm or degrees
    double min_position = 0, max_position = 0, max_velocity = 0, max_accel = 0;  ///< as in ReportAxis
    friend bool operator==(const RecordedAxis&, const RecordedAxis&) = default;
};

/// Data known before the run.
struct RecordingHead {
    std::string version;  ///< version of the recording program
    std::string program_name, program;
    std::string rack_name, rack_file, rack;  ///< name of the rack, file name and text
    bool block_delete = false, stream = false;
    std::string tools;                               ///< tool table as text
    std::map<std::string, std::string> subprograms;  ///< texts by name, for subprograms outside the program
    bool live = false;                               ///< interactive run: commands (feed hold, overrides) are possible
    std::vector<RecordedInput> inputs;               ///< planned inputs; others are added when they occur
    Duration sample_period{};
    std::vector<RecordedAxis> axes;
    std::vector<RecordedSignal> signals;
};

/// State of one axis at a sample.
struct AxisSample {
    double position = 0;   ///< rotor position, mm or degrees
    double commanded = 0;  ///< by the card's pulses
    double velocity = 0;   ///< mm/s or deg/s
    float accel = 0;       ///< mm/s2 or deg/s2; NaN: velocity step
    float volts = 0;       ///< servo command, V
};

/// Named number or text of an outcome.
struct OutcomeField {
    std::string name;
    std::string text;  ///< display text
    friend bool operator==(const OutcomeField&, const OutcomeField&) = default;
};

/// Data known after the run.
struct RecordingEnd {
    Instant at{};
    std::vector<OutcomeField> outcome;
    ReportData report;                  ///< without its series, which are rebuilt from the samples
    std::size_t max_samples = 200'000;  ///< limit of the report, see DecimatingBuffer
};

class RecordingWriter {
  public:
    /// `began`: simulated time at which the recording starts. Errors: io.
    static Result<RecordingWriter> create(const std::string& path, const RecordingHead& head, Instant began);
    /// Ignores all data until a created writer is moved here.
    RecordingWriter();
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;
    RecordingWriter(RecordingWriter&&) noexcept;
    RecordingWriter& operator=(RecordingWriter&&) noexcept;
    ~RecordingWriter();

    /// Adds an event of signal number `signal` of the head; events of one signal must be in time order. Skips unchanged
    /// levels.
    void event(std::size_t signal, Instant at, std::int64_t value);
    /// Adds a sample; requires as many `axes` as in the head.
    void sample(Instant at, double deviation_mm, std::span<const AxisSample> axes);
    void input(const RecordedInput& input);
    /// Makes all data up to `now` readable, even if the program is killed afterwards.
    void flush(Instant now);
    /// Notifies the writer that all events before `now` were added: flushes after a second, later after each tenth of
    /// the recorded time, at the latest after a million events.
    void settle(Instant now);
    std::uint64_t events() const { return events_; }
    /// Ends the file for good, even on an error: later data is ignored, and another call returns the result of the
    /// first. Errors: io, the first error since the file was created.
    Result<void> close(const RecordingEnd& end);
    /// Returns true from create() to close().
    bool is_open() const { return samples_ != nullptr; }

  private:
    struct Signal;
    struct Samples;
    Result<void> complete(const RecordingEnd& end);
    void write_axes(const RecordingHead& head);
    void make_signals(const RecordingHead& head);
    void make_samples(const RecordingHead& head);

    hdf5::Hdf5File file_;
    std::vector<Signal> signals_;
    std::unique_ptr<Samples> samples_;  ///< nullptr: not open
    hdf5::Writer input_times_, input_texts_, flushed_;
    Instant began_{}, next_flush_{};
    std::uint64_t events_ = 0, flushed_events_ = 0;
    bool good_ = true;
    Result<void> ended_;  ///< result of close()
};

/// Times and values of one signal or sampled quantity.
struct RecordedSeries {
    std::string name;         ///< "X.steps", "X.position"
    std::string unit;         ///< unit of the values
    bool number = true;       ///< integer values; else double
    std::string time, value;  ///< paths of the columns
};

class RecordingReader {
  public:
    /// Errors: io, invalid_input (not a recording, another format, or damaged before any readable data).
    static Result<RecordingReader> open(const std::string& path);

    const RecordingHead& head() const { return head_; }
    /// Includes inputs from during the run, in file order.
    const std::vector<RecordedInput>& inputs() const { return inputs_; }
    /// Returns true if the recording was closed; otherwise it was truncated and is complete up to known_to().
    bool whole() const { return whole_; }
    Instant began() const { return began_; }
    Instant known_to() const { return known_to_; }
    /// Sentence about a truncated recording.
    std::string cut_sentence() const;
    const std::vector<OutcomeField>& outcome() const { return outcome_; }
    const std::string& path() const { return file_.path(); }

    const std::vector<RecordedSeries>& series() const { return series_; }
    /// nullptr: unknown name.
    const RecordedSeries* find(std::string_view name) const;
    /// Number of usable elements of a series: those present in both columns and, in a truncated recording, before
    /// known_to().
    struct Columns {
        hdf5::Reader time, value;
        std::uint64_t size = 0;

        /// Uses only elements before this instant. Errors: io.
        Result<void> end_before(Instant until);
    };
    /// Errors: invalid_input, io.
    Result<Columns> columns(const RecordedSeries& series) const;

    /// Returns the report data of the run; of a truncated recording, the available part. Errors: invalid_input, io.
    Result<ReportData> report() const;

  private:
    RecordingReader() = default;
    Result<void> read_head();
    Result<void> read_inputs();
    Result<void> read_end();
    Result<void> read_samples(ReportData& data) const;
    ReportData report_of_cut() const;

    hdf5::Hdf5File file_;
    RecordingHead head_;
    std::vector<RecordedInput> inputs_;
    std::vector<RecordedSeries> series_;
    std::vector<OutcomeField> outcome_;
    std::string report_;
    std::size_t max_samples_ = 200'000;
    bool whole_ = false;
    Instant began_{}, known_to_{};
};

/// Version of the written layout; all others are rejected.
inline constexpr std::int64_t recording_format = 2;

}  // namespace motionrack::trace
