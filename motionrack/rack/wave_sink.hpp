// Destinations of a recording: a VCD file (*.vcd), a table of changes (*.csv) or an HDF5 recording (*.h5).
//
// Levels are wires of a VCD file. Numbers (a counter, a voltage in V, a word of a bus) are reals, which every reader
// accepts; sigrok rejects vectors.
//
//   time_s,signal,value        CSV: the state of every signal at the start, then one line per change, in order of time
//   0,X.step,0
//   0.0012345,X.step,1
//
//   wires/X/step/time, value   HDF5: format of docs/reference/recording.md, with wires only
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
    bool is_number = false;    ///< false: a level, 0 or 1
    double unit = 1;           ///< value of one count (numbers); volts for a voltage
    std::int64_t initial = 0;  ///< value at the start of the recording, in counts

    /// Value shown in the recording; whole numbers stay exact.
    double shown(std::int64_t value) const { return static_cast<double>(value) * unit; }
};

class WaveSink {
  public:
    virtual ~WaveSink() = default;
    /// Records a new value of declared signal `index`. `at` must not be earlier than the previous one.
    virtual void change(std::size_t index, std::int64_t value, Instant at) = 0;
    /// Ends the file at `end`. Errors: io, the first error.
    virtual Result<void> close(Instant end) = 0;
    /// Returns true if close() may be retried after an error, with further changes before it.
    virtual bool can_end_again() const { return true; }
};

enum class WaveFormat : std::uint8_t { vcd, csv, hdf5 };

/// Returns the format for the ending of a file's name. Errors: refused (none of .vcd, .csv, .h5).
Result<WaveFormat> wave_format(const std::string& path);

struct WaveSinkSettings {
    std::string path;
    WaveFormat format = WaveFormat::vcd;
    Duration vcd_unit{1000};         ///< see trace::VcdSettings
    Instant start{};                 ///< start of the recording
    std::string rack_name, version;  ///< HDF5: name of the rack, version of the recording program
};

/// Errors: refused (the time unit), io. On error nothing is written.
Result<std::unique_ptr<WaveSink>> make_wave_sink(const WaveSinkSettings& settings,
                                                 const std::vector<WaveSignal>& signals);

}  // namespace motionrack::rack
