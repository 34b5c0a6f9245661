// Generates the reference page of the G and M codes from their table.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/words.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control::gcode {

namespace {

/// Returns the letters of a code, axes first, as "axes P" or "X Z D".
std::string letters_of(const WordRule& rule) {
    std::string out;
    const auto add = [&out](std::string_view text) { out.append(out.empty() ? "" : " ").append(text); };
    const bool has_all = (rule.letters & axis_words) == axis_words;
    if (has_all) add("axes");
    for (const char& axis : axis_letters)
        if (!has_all && (rule.letters & letter_bit(axis)) != 0) add({&axis, 1});
    for (char letter = 'A'; letter <= 'Z'; ++letter)
        if ((rule.letters & ~axis_words & letter_bit(letter)) != 0) add({&letter, 1});
    return out;
}

std::string row_of(const std::string& name, const WordRule& rule) {
    return fmt::format("| {} | {} | {}{} |\n", name, letters_of(rule), rule.help,
                       rule.refusal.empty() ? "" : "; not in lines from a sender");
}

}  // namespace

std::string gcode_reference() {
    std::string out =
        "# G and M codes\nThe codes of the [G-code that is understood](../explanations/gcode.md). With each of them "
        "a line may have the words F, N, S and T, and those of the table.\n";
    std::string refused;
    const std::string head = "| code | words | effect |\n|---|---|---|\n";
    out += "\n## G codes\n" + head;
    for (const WordRule& rule : words_g()) {
        if (rule.group < g_group_count)
            out += row_of(name_of_g(rule.code), rule);
        else
            refused += fmt::format("- {}\n", why_not_g(rule.code));
    }
    out += fmt::format("\n## M codes\nA line from a sender may have M0 to M{}.\n\n", max_m_of_senders) + head;
    for (const WordRule& rule : words_m()) {
        if (rule.group < m_group_count)
            out += row_of(fmt::format("M{}", rule.code), rule);
        else
            refused += fmt::format("- {}\n", why_not_m(rule.code));
    }
    return out + "\n## Refused codes\n" + refused;
}

}  // namespace motionrack::control::gcode
