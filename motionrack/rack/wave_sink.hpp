// Where a recording goes: a VCD file (*.vcd), a table of changes (*.csv) or a recording of HDF5 (*.h5).
//
// Levels are wires of a VCD file; what carries a number (a counter, a voltage in V, a word of a bus) is a real, as
// every reader takes it: sigrok stops at vectors.
//
//   time_s,signal,value        CSV: the state of every signal at the start, then one line a change, in order of time
//   0,X.step,0
//   0.0012345,X.step,1
//
//   wires/X/step/time, value   HDF5: as docs/reference/recording.md has it, with wires alone
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
    bool is_number = false;    ///< else a level, 0 or 1
    double unit = 1;           ///< of a number: what one count is; volts for a voltage
    std::int64_t initial = 0;  ///< value when the recording begins, in counts

    /// What the recording shows of a value: whole numbers stay exact.
    double shown(std::int64_t value) const { return static_cast<double>(value) * unit; }
};

class WaveSink {
  public:
    virtual ~WaveSink() = default;
    /// Signal `index` of those declared has a new value; `at` not before an earlier one.
    virtual void change(std::size_t index, std::int64_t value, Instant at) = 0;
    /// Ends the file at `end`. Errors: io, the first error met.
    virtual Result<void> close(Instant end) = 0;
    /// Whether close() may be tried again after an error, with changes in between.
    virtual bool can_end_again() const { return true; }
};

enum class WaveFormat : std::uint8_t { vcd, csv, hdf5 };

/// The format that the ending of a file's name stands for. Errors: refused (none of .vcd, .csv, .h5).
Result<WaveFormat> wave_format(const std::string& path);

struct WaveSinkSettings {
    std::string path;
    WaveFormat format = WaveFormat::vcd;
    Duration vcd_unit{1000};         ///< see trace::VcdSettings
    Instant start{};                 ///< when the recording begins
    std::string rack_name, version;  ///< of a recording of HDF5: the rack's, and of the program that records
};

/// Errors: refused (the unit of time), io. Nothing is written then.
Result<std::unique_ptr<WaveSink>> make_wave_sink(const WaveSinkSettings& settings,
                                                 const std::vector<WaveSignal>& signals);

}  // namespace motionrack::rack
