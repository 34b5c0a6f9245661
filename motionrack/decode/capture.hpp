// Captures of logic analysers: their lines, and the levels block by block, so files of any size fit into memory.
//
//   VCD   a sample at every instant at which a chosen line changes, with its time (sigrok, PulseView, GTKWave,
//         Motionrack)
//   CSV   one sample per row; with a time column, or at the sample rate (sigrok-cli, Saleae)
//   raw   1 to 8 bytes per sample, the lowest first, one line per bit, at the sample rate
//
// A line that becomes X or Z keeps its last level, and the change is counted. Decreasing times and malformed rows are
// refused with their line. A truncated file is decoded to its last complete sample, and `cut` gives the place of the
// truncation.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/decode/source.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::decode {

enum class Format { automatic, vcd, csv, raw };
const char* name_of(Format format);

struct CaptureSettings {
    Format format = Format::automatic;  ///< automatic: by the name's extension, then by the first bytes
    double sample_rate_hz = 0;          ///< for raw and for CSV without times; 0: unknown
    int sample_bytes = 1;               ///< raw: 1 .. 8
};

/// Samples of the chosen lines. Planes (one per chosen line, bit i of word w is sample 64 w + i) or, from a raw file of
/// one byte per sample, `bytes`.
struct SampleBlock {
    std::size_t samples = 0;
    std::vector<const std::uint64_t*> planes;
    const std::uint8_t* bytes = nullptr;
    const std::int64_t* times = nullptr;  ///< in ticks; null: one tick per sample
};

/// Properties of a chosen line.
struct LineFacts {
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    std::uint64_t known_from = never;  ///< the first sample with a level
    std::uint64_t unknown = 0;         ///< number of changes to X or Z
    std::string first_unknown;         ///< place of the first one: "line 12"
};

class Capture {
  public:
    virtual ~Capture() = default;

    /// All lines of the file; names as "scope.name", for vectors "scope.name[3]"; for raw files bit numbers.
    const std::vector<std::string>& signals() const { return signals_; }
    Format format() const { return format_; }
    /// Seconds per tick: the unit of the file's times, or the sample period.
    double tick_s() const { return tick_s_; }
    bool timed() const { return timed_; }

    /// Selects the signals to be decoded; before the first block.
    virtual void choose(const std::vector<std::size_t>& signals) {
        chosen_ = signals;
        facts_.assign(signals.size(), {});
    }
    const std::vector<std::size_t>& chosen() const { return chosen_; }
    const LineFacts& facts(std::size_t line) const { return facts_[line]; }

    /// Returns false at the end; the block is valid until the next call. Errors: invalid_input with its place, io.
    virtual Result<bool> next(SampleBlock& block) = 0;
    /// After the end: place at which the file is truncated, if any.
    const std::optional<Error>& cut() const { return cut_; }

    virtual std::uint64_t bytes_read() const = 0;
    std::uint64_t bytes_total() const { return source_->total(); }

  protected:
    Capture(std::unique_ptr<Source> source, std::string name) : source_(std::move(source)), name_(std::move(name)) {}
    tl::unexpected<Error> refuse(std::string message, TextPosition location) const {
        return fail(ErrorKind::invalid_input, std::move(message), location, name_);
    }
    /// Error of a byte reader, which does not know the file's name.
    Error in_file(Error error) const {
        error.file = name_;
        return error;
    }

    std::unique_ptr<Source> source_;
    std::string name_;
    std::vector<std::string> signals_;
    std::vector<std::size_t> chosen_;
    std::vector<LineFacts> facts_;
    std::optional<Error> cut_;
    Format format_ = Format::raw;
    double tick_s_ = 0;
    bool timed_ = false;
};

/// Reads the header of a capture. `name`: for messages and to guess the format. Errors: invalid_input with its place,
/// io.
Result<std::unique_ptr<Capture>> open_capture(std::unique_ptr<Source> source, const std::string& name,
                                              const CaptureSettings& settings);

/// Parses a sample rate: "24000000", "24M", "24 MHz", "500k", "1e6". Errors: invalid_input.
Result<double> read_rate(std::string_view text);

// ---- one reader per format

Result<std::unique_ptr<Capture>> open_vcd(std::unique_ptr<Source> source, const std::string& name);
Result<std::unique_ptr<Capture>> open_csv(std::unique_ptr<Source> source, const std::string& name,
                                          const CaptureSettings& settings);
Result<std::unique_ptr<Capture>> open_raw(std::unique_ptr<Source> source, const std::string& name,
                                          const CaptureSettings& settings);

}  // namespace motionrack::decode
