// Files of waves: a VCD file (*.vcd), a table of changes (*.csv) or an HDF5 recording (*.h5).
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

#include <motionrack/rack/change_sink.hpp>

namespace motionrack::rack {

enum class WaveFormat : std::uint8_t { vcd, csv, hdf5 };

/// Returns the format for the ending of a file's name. Errors: refused (none of .vcd, .csv, .h5).
Result<WaveFormat> wave_format(const std::string& path);

struct WaveFile {
    std::string path = {};
    WaveFormat format = WaveFormat::vcd;
    /// Time unit of a VCD file. 0: Declaration::edge_unit, which is 100 ns, or less where lines of a bus (10 ns at
    /// most) or of a scale with a high count rate are recorded. Wires forced from outside at shorter intervals need a
    /// finer unit.
    Duration unit{0};
    std::string version = {};  ///< version of the recording program, stored in HDF5 files
};

/// Returns the maker of a sink that writes `file`. Errors of the maker: refused (the time unit), io. On error nothing
/// is written.
SinkMaker wave_sink(WaveFile file);

}  // namespace motionrack::rack
