// A recording of a run in one file of HDF5: what was run, what came from outside, every event with its tick, where the
// machine was, and what came of it. The layout is told in docs/reference/recording.md.
//
//   RecordingWriter:  create(head) ──► event, sample, input, flush ... ──► close(outcome)       bounded memory,
//   RecordingReader:  open ──► head, columns of each signal, report data   whole or cut off     whatever the length
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

/// What entered the rack from outside: "stop", "hold", "feed=0.5", or a fault as its user wrote it, without the time.
struct RecordedInput {
    Instant at{};
    std::string text;
    friend bool operator==(const RecordedInput&, const RecordedInput&) = default;
};

enum class SignalKind : std::uint8_t {
    steps,   ///< pulses at a motor: every one of them, its value is +1 or -1
    counts,  ///< counts of an encoder: every one of them, its value is the count after it
    levels   ///< wires and counters: every change
};

/// Something that events are recorded of.
struct RecordedSignal {
    std::string name;  ///< for people: "X.steps", "X.limit_plus", "motion.lp_x"
    std::string path;  ///< its group in the file: "axes/x/steps"
    SignalKind kind = SignalKind::levels;
    std::string unit;          ///< of the values: "step", "count"; empty: a level
    std::int64_t initial = 0;  ///< value when the recording begins
    double scale = 1;          ///< a value times this is in the unit
    friend bool operator==(const RecordedSignal&, const RecordedSignal&) = default;
};

struct RecordedAxis {
    std::string name;         ///< "X"
    std::string unit = "mm";  ///< or "deg"
    bool servo = false;
    double pulses_per_unit = 1, counts_per_unit = 0;  ///< counts: 0, there is no encoder
    double origin = 0;                                ///< where both counts are 0, mm or degrees
    double min_position = 0, max_position = 0, max_velocity = 0, max_accel = 0;  ///< as ReportAxis has them
    friend bool operator==(const RecordedAxis&, const RecordedAxis&) = default;
};

/// What is known before the run begins.
struct RecordingHead {
    std::string version;  ///< of the program that records
    std::string program_name, program;
    std::string rack_name, rack_file, rack;  ///< what the rack calls itself, its file's name and text
    bool block_delete = false, stream = false;
    std::string tools;                               ///< the tool table, as text
    std::map<std::string, std::string> subprograms;  ///< texts by name, of those that are not in the program
    bool live = false;                               ///< driven so that orders can come (holds, overrides)
    std::vector<RecordedInput> inputs;               ///< planned ones; later ones are added as they come
    Duration sample_period{};
    std::vector<RecordedAxis> axes;
    std::vector<RecordedSignal> signals;
};

/// Where one axis was at a sample.
struct AxisSample {
    double position = 0;   ///< of the rotor, mm or degrees
    double commanded = 0;  ///< by the card's pulses
    double speed = 0;      ///< a second
    float accel = 0;       ///< a second squared; NaN: it jumped
    float volts = 0;       ///< of a servo
};

/// A number or a text of an outcome, by its name.
struct OutcomeField {
    std::string name;
    std::string text;  ///< as it is to be read
    friend bool operator==(const OutcomeField&, const OutcomeField&) = default;
};

/// What is known when the run is over.
struct RecordingEnd {
    Instant at{};
    std::vector<OutcomeField> outcome;
    ReportData report;                  ///< its series are left out: they are made of the samples again
    std::size_t max_samples = 200'000;  ///< of the report, see DecimatingBuffer
};

class RecordingWriter {
  public:
    /// `began`: instant of the rack at which the recording begins. Errors: io.
    static Result<RecordingWriter> create(const std::string& path, const RecordingHead& head, Instant began);
    /// Writes nothing until one that was created is moved here.
    RecordingWriter();
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;
    RecordingWriter(RecordingWriter&&) noexcept;
    RecordingWriter& operator=(RecordingWriter&&) noexcept;
    ~RecordingWriter();

    /// Event of signal number `signal` of the head; of one signal in the order of time. Of levels what does not change
    /// is left out.
    void event(std::size_t signal, Instant at, std::int64_t value);
    /// `axes` as many as the head has.
    void sample(Instant at, double deviation_mm, std::span<const AxisSample> axes);
    void input(const RecordedInput& input);
    /// Everything up to `now` is in the file and can be read from now on, whatever becomes of this program.
    void flush(Instant now);
    std::uint64_t events() const { return events_; }
    /// Errors: io, the first one met since the file was made.
    Result<void> close(const RecordingEnd& end);

  private:
    struct Signal;
    struct Samples;
    void tell_axes(const RecordingHead& head);
    void make_signals(const RecordingHead& head);
    void make_samples(const RecordingHead& head);

    hdf5::File file_;
    std::vector<Signal> signals_;
    std::unique_ptr<Samples> samples_;
    hdf5::Writer input_times_, input_texts_, flushed_;
    std::uint64_t events_ = 0;
    bool good_ = true;
};

/// Times and values of one signal or sampled quantity.
struct RecordedSeries {
    std::string name;         ///< "X.steps", "X.position"
    std::string unit;         ///< of the values
    bool number = true;       ///< the values are integers; else double
    std::string time, value;  ///< the columns' paths
};

class RecordingReader {
  public:
    /// Errors: io, invalid_input (no recording, a newer format, damaged before anything could be read).
    static Result<RecordingReader> open(const std::string& path);

    const RecordingHead& head() const { return head_; }
    /// With those that came during the run, in the order of the file.
    const std::vector<RecordedInput>& inputs() const { return inputs_; }
    /// Ended properly; else it was cut off, and all before known_to() is there.
    bool whole() const { return whole_; }
    Instant began() const { return began_; }
    Instant known_to() const { return known_to_; }
    /// A sentence about a recording that is not whole.
    std::string cut_sentence() const;
    const std::vector<OutcomeField>& outcome() const { return outcome_; }
    const std::string& path() const { return file_.path(); }

    const std::vector<RecordedSeries>& series() const { return series_; }
    /// nullptr: there is none of that name.
    const RecordedSeries* find(std::string_view name) const;
    /// How many of a series' elements can be used: both columns have them, and of a recording that was cut off those
    /// before known_to().
    struct Columns {
        hdf5::Reader time, value;
        std::uint64_t size = 0;

        /// Only what is before this instant is used. Errors: io.
        Result<void> end_before(Instant until);
    };
    /// Errors: invalid_input, io.
    Result<Columns> columns(const RecordedSeries& series) const;

    /// The data of the page, the same as the run itself had; of a recording that was cut off what is there. Errors:
    /// invalid_input, io.
    Result<ReportData> report() const;

  private:
    RecordingReader() = default;
    Result<void> read_head();
    Result<void> read_inputs();
    Result<void> read_end();
    Result<void> read_samples(ReportData& data) const;
    ReportData report_of_cut() const;

    hdf5::File file_;
    RecordingHead head_;
    std::vector<RecordedInput> inputs_;
    std::vector<RecordedSeries> series_;
    std::vector<OutcomeField> outcome_;
    std::string report_;
    std::size_t max_samples_ = 200'000;
    bool whole_ = false;
    Instant began_{}, known_to_{};
};

/// The number of the layout that is written; newer ones are refused.
inline constexpr std::int64_t recording_format = 1;

}  // namespace motionrack::trace
