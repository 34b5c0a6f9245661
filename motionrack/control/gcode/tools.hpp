// The tool table in the format of LinuxCNC's .tbl files: one tool per line.
//
//     T1 P1 Z42.5 D3.175   ;end mill
//     T2 P2 X0.1 Z38 D6 I90 J30 Q2
//
// T number, P pocket, X Y Z A B C offsets (mm, degrees), D diameter (mm), I J angles of a lathe tool (degrees), Q its
// orientation.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/control/move.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode {

inline constexpr std::size_t max_tools = 1000;
inline constexpr std::int32_t largest_tool = 99'999;

struct Tool {
    std::int32_t number = 0;  ///< T number, 1 .. largest_tool
    std::int32_t pocket = 0;  ///< P number, 0 .. largest_tool
    Point offset = {};        ///< X Y Z (mm) and A B C (degrees)
    double diameter_mm = 0;
    double front_angle = 0;  ///< I word of a lathe tool, degrees
    double back_angle = 0;
    std::int32_t orientation = 0;  ///< Q word of a lathe tool, 0 .. 9
};

class ToolTable {
  public:
    /// Returns the tool with this number; null if the table has none.
    const Tool* find(std::int32_t number) const;
    /// Returns the tools in file order.
    const std::vector<Tool>& tools() const { return tools_; }
    bool empty() const { return tools_.empty(); }
    /// Replaces the tool with this number, or appends it. Returns false at max_tools.
    bool put(const Tool& tool);

  private:
    std::vector<Tool> tools_;
};

/// Reads a tool table. Errors: a line that does not describe a tool, with its position in `file`.
Result<ToolTable> read_tool_table(std::string_view text, const std::string& file = {});

/// Returns a line of the table without its end: "T1 P1 Z42.5 D3.175". Each number has the fewest digits that
/// read back as the same number, and no exponent, which the format does not have. Requires finite numbers.
std::string to_text(const Tool& tool);

}  // namespace motionrack::control::gcode
