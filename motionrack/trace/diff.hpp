// What two recordings of the same kind differ in, and where first: HDF5, VCD, CSV (samples, events, changes).
//
//   A ─┐                 ┌─ each signal: its first difference
//      ├─ diff_files ────┼─ signals that only one has
//   B ─┘                 └─ what they are made of: program, rack, inputs, outcome
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

/// Where one signal differs first.
struct Difference {
    std::string signal;
    std::optional<Instant> at;  ///< the earlier of the two; nothing: the file has no times
    std::string a, b;           ///< what is there on each side, to be read: "+1", "0", "nothing more"
    std::string unit;
};

struct Diff {
    const char* kind = "";                ///< "recordings", "VCD files", "tables of samples"
    std::uint64_t signals = 0;            ///< that both have
    std::uint64_t compared = 0;           ///< events, changes or fields of the first one
    std::vector<Difference> differences;  ///< one a signal that differs, the earliest first
    std::vector<std::string> only_a, only_b;
    std::vector<std::string> made_of;  ///< sentences: the programs differ in line 3
    std::vector<std::string> notes;    ///< sentences that are no difference: another version wrote it
    std::optional<Instant> until;      ///< only so far, for one was cut off
    bool stopped = false;

    bool same() const { return differences.empty() && only_a.empty() && only_b.empty() && made_of.empty(); }
};

struct DiffSettings {
    std::function<void(double part)> progress = {};
    std::function<bool()> stop = {};  ///< true ends it early
};

/// Errors: io, invalid_input (a file of no such kind, two kinds, damage).
Result<Diff> diff_files(const std::string& a, const std::string& b, const DiffSettings& settings = {});
Result<Diff> diff_recordings(const RecordingReader& a, const RecordingReader& b, const DiffSettings& settings = {});

/// For people.
std::string diff_text(const Diff& diff, const std::string& a, const std::string& b);
/// For programs.
std::string diff_json(const Diff& diff, const std::string& a, const std::string& b);

/// What a file is by what it begins with.
enum class FileKind : std::uint8_t { hdf5, vcd, csv };
/// Errors: io, invalid_input (none of these).
Result<FileKind> kind_of_file(const std::string& path);

}  // namespace motionrack::trace
