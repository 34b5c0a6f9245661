// A sweep file (TOML): which program on which rack, and what is varied.
//
//   [sweep]                                         [vary]
//   program = "part.ngc"                            "axis.X.max_accel_mm_s2" = { from = 500, to = 4000, steps = 8 }
//   rack = "router.toml"                            "fault" = ["", "X.limit_plus=0@1.5s"]
//   order = "grid"                                  "text.TOLERANCE" = [0.01, 0.05]
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

enum class Order : std::uint8_t { grid, random };

struct SweepSettings {
    std::string program;
    std::optional<std::string> rack, tools;
    bool block_delete = false;
    Order order = Order::grid;
    std::optional<std::int64_t> points;
    std::int64_t seed = 1;
};

enum class ParameterKind : std::uint8_t {
    rack,   ///< a key of the rack file
    fault,  ///< faults of the run
    text    ///< a word in braces of the program
};

/// Numbers between two others.
struct NumberRange {
    double from = 0, to = 0;
    bool whole = false;
};

/// Something that is varied.
struct Parameter {
    ParameterKind kind = ParameterKind::rack;
    std::string name;                    ///< as tables call it: axis.X.max_limit_mm, fault, text.TOLERANCE
    std::vector<std::string> path;       ///< of the rack file
    std::vector<rack::TomlNode> values;  ///< with their places in the sweep file; empty: `range` is
    std::optional<NumberRange> range;    ///< any number of it; of random sweeps only
    Place place;                         ///< of its key

    /// All its values are numbers.
    bool numeric() const;
};

/// The file by itself; the files that it names are not read yet.
struct SweepFile {
    SweepSettings settings;
    std::vector<Parameter> parameters;  ///< in the order of the file
    rack::TomlNode root;
    /// How many points it makes.
    std::int64_t points() const;
};

struct SweepFileReading {
    std::optional<SweepFile> file;  ///< if there are no errors
    std::vector<Error> errors;
};

/// Never throws; any text gives a file or errors, sorted by place. `name` stands in them.
SweepFileReading read_sweep_file(std::string_view text, const std::string& name);

/// The reference of the keys (Markdown).
std::string sweep_file_reference();

/// A value as tables and programs have it: 0.05, X.limit_plus=0@1.5s, true.
std::string value_text(const rack::TomlNode& value);

/// The faults of a value, which stand with blanks between.
std::vector<std::string> words_of(const std::string& text);

/// The number of `range` nearest to `value` that has few digits: it is off by at most 1/20,000 of the range.
double tidied(double value, const NumberRange& range);

}  // namespace motionrack::sweep
