// Tools that words name.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

/// Refuses a tool that the tool table does not have; without a tool table every number is valid.
bool WordReader::require_tool(char letter, std::int32_t number) {
    if (number == 0 || settings().tools.empty() || tools().find(number)) return true;
    return fail_word(
        letter, GrblStatus::unsupported,
        fmt::format("{}: the tool table has no tool {}; write it into the table", word_text(letter), number));
}

/// Returns a tool of the table; reports a missing one and returns null. The error points to the word that names it or,
/// for the tool in the spindle, to the code.
const Tool* WordReader::tool_of_table(std::int32_t number, char letter, GroupG code) {
    const Tool* tool = tools().find(number);
    const bool named = block().has(letter);
    if (!tool) {
        fail_at(named ? block().column[letter_index(letter)] : block().g_column[code], GrblStatus::unsupported,
                fmt::format("{}: the tool table has no tool {}; write it into the table",
                            named ? word_text(letter) : name_of_g(block().g[code]), number));
    }
    return tool;
}

}  // namespace motionrack::control::gcode
