// A sweep with all files read and every point checked, so that errors show before the first run.
//
//   sweep file, rack file, program ──prepare──► Sweep ──point(i)──► PointText ──► text, key
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <motionrack/base/result.hpp>
#include <motionrack/control/gcode/settings.hpp>
#include <motionrack/sweep/point.hpp>
#include <motionrack/sweep/sweep_file.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::sweep {

class Sweep {
  public:
    std::int64_t points() const { return static_cast<std::int64_t>(keys_.size()); }
    const std::vector<VariedParameter>& parameters() const { return file_.parameters; }
    /// Returns a value per parameter for point `i`, 0 .. points() - 1. In a grid, the last parameter changes fastest.
    std::vector<rack::TomlNode> values(std::int64_t i) const;
    PointText point(std::int64_t i) const;
    const std::string& key(std::int64_t i) const { return keys_[static_cast<std::size_t>(i)]; }

    const std::string& rack_name() const { return rack_name_; }
    const std::string& program_name() const { return program_name_; }

  private:
    friend class Preparation;
    std::vector<rack::TomlLine> rack_lines(const std::vector<rack::TomlNode>& values) const;
    std::string program_text(const std::vector<rack::TomlNode>& values) const;

    SweepFile file_;
    std::string rack_name_, program_name_;
    rack::TomlNode rack_;
    std::string program_, tools_;
    std::map<std::string, std::string> subprograms_;
    std::vector<std::string> keys_;
};

struct SweepReading {
    std::optional<Sweep> sweep;  ///< if there are no errors
    std::vector<Error> errors;   ///< with positions in the sweep file, the rack file or the program
    std::vector<Error> warnings;
};

/// Files named by a sweep file, with the paths from the settings. The caller resolves them.
struct SweepFiles {
    std::string rack_name, rack;
    std::string program_name, program;
    std::string tools_name, tools;                                      ///< empty: none
    std::function<Result<std::string>(const std::string&)> subprogram;  ///< by name; may be empty
};

/// Reads the texts and checks them together: the rack of every point, each program text on the rack of its file, each
/// fault on the first rack that uses it.
SweepReading prepare(SweepFile file, const std::string& name, const SweepFiles& files);

}  // namespace motionrack::sweep
