// Where a recording goes: a VCD file (*.vcd) or a table of changes (*.csv).
//
//   time_s,signal,value        CSV: the state of every signal at the start, then one line a change, in order of time
//   0,X.step,0
//   0.0012345,X.step,1
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// A signal of a recording: "X.step" is scope X, name step.
struct WaveSignal {
    std::string scope;
    std::string name;
    int bits = 1;               ///< 1 .. 64
    bool is_signed = false;     ///< a counter below 0 is told as a negative number where the format has such
    std::uint64_t initial = 0;  ///< value when the recording begins
};

class WaveSink {
  public:
    virtual ~WaveSink() = default;
    /// Signal `index` of those declared has a new value; `at` not before an earlier one.
    virtual void change(std::size_t index, std::uint64_t value, Instant at) = 0;
    /// Ends the file at `end`. Errors: io, the first error met.
    virtual Result<void> close(Instant end) = 0;
};

enum class WaveFormat : std::uint8_t { vcd, csv };

/// The format that the ending of a file's name stands for. Errors: refused (neither .vcd nor .csv).
Result<WaveFormat> wave_format(const std::string& path);

struct WaveSinkSettings {
    std::string path;
    WaveFormat format = WaveFormat::vcd;
    Duration vcd_timescale{1000};  ///< see trace::VcdSettings
    Instant start{};               ///< when the recording begins
};

/// Errors: refused (the timescale), io. Nothing is written then.
Result<std::unique_ptr<WaveSink>> make_wave_sink(const WaveSinkSettings& settings,
                                                 const std::vector<WaveSignal>& signals);

}  // namespace motionrack::rack
