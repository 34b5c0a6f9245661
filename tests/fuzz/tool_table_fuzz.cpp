// libFuzzer: any bytes as a tool table. It is rejected with a position in the text or accepted; an accepted table is
// the same after writing and reading it again.
#include <cmath>
#include <cstdint>
#include <motionrack/control/gcode/program_lines.hpp>
#include <motionrack/control/gcode/tools.hpp>
#include <tests/fuzz/require.hpp>

namespace {

using namespace motionrack::control;
using namespace motionrack::control::gcode;
using motionrack::fuzz::require;

void check_error(const motionrack::Error& error, std::string_view text) {
    require(!error.message.empty() && error.file == "fuzz.tbl", "an error has a sentence and the file", error.text());
    require(error.location.line >= 1 && error.location.column >= 1, "an error has a place", error.text());
    ProgramLines lines(text);
    std::string_view line;
    while (lines.number() < error.location.line)
        require(lines.next(line), "the line of an error is in the text", error.text());
    require(static_cast<std::size_t>(error.location.column) <= line.size() + 1, "the column is in the line",
            error.text());
}

void check_tool(const ToolTable& table, const Tool& tool) {
    require(tool.number >= 1 && tool.number <= largest_tool, "a tool has a number", to_text(tool));
    require(tool.pocket >= 0 && tool.pocket <= largest_tool, "a pocket is in its range", to_text(tool));
    require(tool.orientation >= 0 && tool.orientation <= 9, "an orientation is 0 to 9", to_text(tool));
    require(table.find(tool.number) == &tool, "a tool is found by its number", to_text(tool));
    for (const double value : tool.offset) require(std::isfinite(value), "an offset is a number", to_text(tool));
    for (const double value : {tool.diameter_mm, tool.front_angle, tool.back_angle})
        require(std::isfinite(value), "diameter and angles are numbers", to_text(tool));
}

bool is_same(const Tool& a, const Tool& b) {
    return a.number == b.number && a.pocket == b.pocket && a.offset == b.offset && a.diameter_mm == b.diameter_mm &&
           a.front_angle == b.front_angle && a.back_angle == b.back_angle && a.orientation == b.orientation;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto table = read_tool_table(text, "fuzz.tbl");
    if (!table) {
        check_error(table.error(), text);
        return 0;
    }
    require(table->tools().size() <= max_tools, "a table has at most so many tools");
    std::string written;
    for (const Tool& tool : table->tools()) {
        check_tool(*table, tool);
        written += to_text(tool) + '\n';
    }
    const auto again = read_tool_table(written, "written.tbl");
    require(again.has_value(), "what was written is read", again ? "" : again.error().text());
    require(again->tools().size() == table->tools().size(), "no tool is lost", written);
    for (std::size_t i = 0; i < again->tools().size(); ++i)
        require(is_same(again->tools()[i], table->tools()[i]), "a tool is the same again", to_text(table->tools()[i]));
    return 0;
}
