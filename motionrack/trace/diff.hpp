// Differences between two recordings of the same kind, with the first one: HDF5, VCD, CSV (samples, events, changes).
//
//   A ─┐                 ┌─ each signal: its first difference
//     ├─ diff_files ────┼─ signals present in one file only
//  B ─┘                 └─ origin: program, rack, inputs, outcome
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/trace/recording.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::trace {

/// First difference of one signal.
struct Difference {
    std::string signal;
    std::optional<Instant> at;  ///< the earlier of the two; empty: the file has no times
    std::string a, b;           ///< displayed value on each side: "+1", "0", "nothing more"
    std::string unit;
};

struct Diff {
    const char* kind = "";                ///< "recordings", "VCD files", "tables of samples"
    std::uint64_t signals = 0;            ///< number of common signals
    std::uint64_t compared = 0;           ///< events, changes or fields of the first file
    std::vector<Difference> differences;  ///< one per differing signal, earliest first
    std::vector<std::string> only_a, only_b;
    std::vector<std::string> made_of;  ///< sentences on the origin: the programs differ in line 3
    std::vector<std::string> notes;    ///< sentences that are not differences: another version wrote it
    std::optional<Instant> until;      ///< end of the comparison if a file was truncated
    bool stopped = false;

    bool same() const { return differences.empty() && only_a.empty() && only_b.empty() && made_of.empty(); }
};

struct DiffSettings {
    std::function<void(double part)> progress = {};
    std::function<bool()> stop = {};  ///< polled; true ends the comparison early
};

/// Errors: io, invalid_input (unknown kind of file, two different kinds, damage).
Result<Diff> diff_files(const std::string& a, const std::string& b, const DiffSettings& settings = {});
Result<Diff> diff_recordings(const RecordingReader& a, const RecordingReader& b, const DiffSettings& settings = {});

/// Returns the differences as text.
std::string diff_text(const Diff& diff, const std::string& a, const std::string& b);
/// Returns the differences as JSON.
std::string diff_json(const Diff& diff, const std::string& a, const std::string& b);

/// File kind, detected by its first bytes.
enum class FileKind : std::uint8_t { hdf5, vcd, csv };
/// Errors: io, invalid_input (unknown kind).
Result<FileKind> kind_of_file(const std::string& path);

}  // namespace motionrack::trace
