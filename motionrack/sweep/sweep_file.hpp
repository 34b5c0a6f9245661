// Sweep file (TOML): the program, the rack, and the varied parameters.
//
//   [sweep]                                         [vary]
//   program = "part.ngc"                            "axis.X.max_accel_mm_s2" = { from = 500, to = 4000, steps = 8 }
//   rack = "router.toml"                            "fault" = ["", "X.limit_plus=0@1.5s"]
//   sampling = "grid"                               "text.TOLERANCE" = [0.01, 0.05]
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/rack/toml_edit.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::sweep {

inline constexpr std::int64_t max_points = 100'000;
inline constexpr std::size_t max_parameters = 16;
inline constexpr std::int64_t max_steps = 10'000;

enum class Sampling : std::uint8_t { grid, random };

struct SweepSettings {
    std::string program;
    std::optional<std::string> rack, tools;
    bool block_delete = false;
    Sampling sampling = Sampling::grid;
    std::optional<std::int64_t> points;
    std::int64_t seed = 1;
};

enum class ParameterKind : std::uint8_t {
    rack,   ///< a key of the rack file
    fault,  ///< faults of the run
    text    ///< a word in braces in the program
};

/// Range of numbers.
struct NumberRange {
    double from = 0, to = 0;
    bool integer = false;
};

/// A varied parameter.
struct VariedParameter {
    ParameterKind kind = ParameterKind::rack;
    std::string name;                    ///< name in tables: axis.X.max_limit_mm, fault, text.TOLERANCE
    std::vector<std::string> path;       ///< in the rack file
    std::vector<rack::TomlNode> values;  ///< with positions in the sweep file; empty: uses `range`
    std::optional<NumberRange> range;    ///< any number in it; random sweeps only
    TextPosition location;               ///< position of its key

    /// Returns true if all values are numbers.
    bool numeric() const;
};

/// The sweep file alone; the files it names are not yet read.
struct SweepFile {
    SweepSettings settings;
    std::vector<VariedParameter> parameters;  ///< in file order
    rack::TomlNode root;
    /// Number of points.
    std::int64_t points() const;
};

struct SweepFileReading {
    std::optional<SweepFile> file;  ///< if there are no errors
    std::vector<Error> errors;
};

/// Reads a sweep file. Never throws; any text gives a file or errors, sorted by position. `name` is used in the
/// messages.
SweepFileReading read_sweep_file(std::string_view text, const std::string& name);

/// Reference of the keys (Markdown).
std::string sweep_file_reference();

/// Text of a value in tables and programs: 0.05, X.limit_plus=0@1.5s, true.
std::string value_text(const rack::TomlNode& value);

/// Splits the faults of a value at blanks.
std::vector<std::string> words_of(const std::string& text);

/// Rounds `value` to few digits within `range`; the error is at most 1/20,000 of the range.
double tidied(double value, const NumberRange& range);

}  // namespace motionrack::sweep
