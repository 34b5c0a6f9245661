// Captures of logic analysers: which lines there are, and their levels block by block, so that any size fits into
// memory.
//
//   VCD   every instant at which a chosen line changes is a sample, with its time (sigrok, PulseView, GTKWave,
//         Motionrack)
//   CSV   every row is a sample; with a time column, or at the sample rate (sigrok-cli, Saleae)
//   raw   1 to 8 bytes a sample, the lowest first, a line a bit, at the sample rate
//
// A line that is X or Z keeps its last level, and that is counted. Time that goes backwards and rows that do not fit
// are refused with their line; a file that is cut off is decoded to its last whole sample, and `cut` says where it
// ends.
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
    Format format = Format::automatic;  ///< automatic: by the name's ending, then by what the file begins with
    double sample_rate_hz = 0;          ///< for raw and for CSV without times; 0: not known
    int sample_bytes = 1;               ///< raw: 1 .. 8
};

/// Samples of the chosen lines. Planes (one for each chosen line, bit i of word w is sample 64 w + i) or, from a raw
/// file of one byte a sample, `bytes`.
struct Block {
    std::size_t samples = 0;
    std::vector<const std::uint64_t*> planes;
    const std::uint8_t* bytes = nullptr;
    const std::int64_t* times = nullptr;  ///< in ticks; null: a tick a sample
};

/// What is known of a chosen line.
struct LineFacts {
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    std::uint64_t known_from = never;  ///< the first sample that has a level
    std::uint64_t unknown = 0;         ///< how often the line went to X or Z
    std::string first_unknown;         ///< where it first did: "line 12"
};

class Capture {
  public:
    virtual ~Capture() = default;

    /// All lines of the file; names as "scope.name", of vectors "scope.name[3]"; of raw files bit numbers.
    const std::vector<std::string>& signals() const { return signals_; }
    Format format() const { return format_; }
    /// Seconds of a tick: the unit of the file's times, or a sample's.
    double tick_s() const { return tick_s_; }
    bool timed() const { return timed_; }

    /// Which signals are decoded; before the first block.
    virtual void choose(const std::vector<std::size_t>& signals) {
        chosen_ = signals;
        facts_.assign(signals.size(), {});
    }
    const std::vector<std::size_t>& chosen() const { return chosen_; }
    const LineFacts& facts(std::size_t line) const { return facts_[line]; }

    /// False at the end; the block is valid until the next call. Errors: invalid_input with its place, io.
    virtual Result<bool> next(Block& block) = 0;
    /// After the end: where the file is cut off, if it is.
    const std::optional<Error>& cut() const { return cut_; }

    virtual std::uint64_t bytes_read() const = 0;
    std::uint64_t bytes_total() const { return source_->total(); }

  protected:
    Capture(std::unique_ptr<Source> source, std::string name) : source_(std::move(source)), name_(std::move(name)) {}
    tl::unexpected<Error> refuse(std::string message, Place place) const {
        return fail(ErrorKind::invalid_input, std::move(message), place, name_);
    }
    /// What a reader of bytes says, who does not know the file's name.
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

/// Reads the head of a capture. `name`: for messages and to guess the format. Errors: invalid_input with its place, io.
Result<std::unique_ptr<Capture>> open_capture(std::unique_ptr<Source> source, const std::string& name,
                                              const CaptureSettings& settings);

/// A sample rate as people write it: "24000000", "24M", "24 MHz", "500k", "1e6". Errors: invalid_input.
Result<double> read_rate(std::string_view text);

// ---- one reader each

Result<std::unique_ptr<Capture>> open_vcd(std::unique_ptr<Source> source, const std::string& name);
Result<std::unique_ptr<Capture>> open_csv(std::unique_ptr<Source> source, const std::string& name,
                                          const CaptureSettings& settings);
Result<std::unique_ptr<Capture>> open_raw(std::unique_ptr<Source> source, const std::string& name,
                                          const CaptureSettings& settings);

}  // namespace motionrack::decode
