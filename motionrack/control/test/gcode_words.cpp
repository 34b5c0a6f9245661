// The table of G and M codes: each row is complete, and its letters are the only ones that the code takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/words.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

/// A valid line for each of `codes`, which replaces the '@'. The lines of a code together have all words of its row. A
/// code without a line here needs no words.
struct CodeLine {
    std::string_view codes;
    std::string_view line;
};

constexpr CodeLine code_lines[] = {
    {"G0 G28 G30 G43.1 G43.2 G92", "@ X1 Y1 Z1 A1 B1 C1"},
    {"G1", "F100 @ X1 Y1 Z1 A1 B1 C1"},
    {"G2 G3", "F100 @ X2 Z1 A1 B1 C1 I1 J0 P2"},
    {"G2 G3", "F100 G18 @ X2 Y1 I1 K0"},
    {"G2 G3", "F100 @ X2 R1"},
    {"G5", "F100 @ X20 Y0 I5 J10 P-5 Q10"},
    {"G5.1", "F100 @ X20 Y0 I10 J10"},
    {"G73 G83", "F100 @ X1 Y1 Z-5 R2 Q1 L2"},
    {"G74", "M4 F100 @ X1 Y1 Z-5 R2 P1 L2"},
    {"G82 G84 G86 G89", "M3 F100 @ X1 Y1 Z-5 R2 P1 L2"},
    {"G81 G85", "F100 @ X1 Y1 Z-5 R2 L2"},
    {"G70", "G18 F100 @ Q100 X30 Z2 D1 E1 P2"},
    {"G71 G71.1 G71.2 G72 G72.1 G72.2", "G18 F100 @ Q100 X30 Z2 D1 I1 R1"},
    {"G38.2 G38.3 G38.4 G38.5", "F100 @ X1 Y1 Z1 A0 B0 C0"},
    {"G4 G64 M50 M51 M53 M62 M63 M64 M65", "@ P1"},
    {"G10", "@ L2 P1 X1 Y1 Z1 A1 B1 C1 R10"},
    {"G10", "@ L1 P1 X1 R1 I1 J1 Q2"},
    {"G53", "@ G0 X1 Y1 Z1 A1 B1 C1"},
    {"G41 G42", "@ D1"},
    {"G41.1 G42.1", "@ D6"},
    {"G43 G43.2", "@ H1"},
    {"M6", "T1 @"},
    {"M52", "@ P0"},
    {"M61", "@ Q1"},
    {"M66", "@ P1 L3 Q5"},
    {"M66", "@ E1 L0"},
    {"M67 M68", "@ E1 Q1"},
    {"M98", "@ P100 L3"},
};

std::vector<std::string> lines_with(const std::string& name) {
    std::vector<std::string> lines;
    for (const CodeLine& one : code_lines) {
        if ((' ' + std::string(one.codes) + ' ').find(' ' + name + ' ') == std::string::npos) continue;
        std::string line(one.line);
        line.replace(line.find('@'), 1, name);
        lines.push_back(line);
    }
    return lines.empty() ? std::vector<std::string>{name} : lines;
}

/// Returns an interpreter of a machine with tool 1 and with saved modes, which M72 needs.
Interpreter interpreter_with_tool() {
    Settings settings = testing::machine();
    Tool tool;
    tool.number = 1;
    tool.diameter_mm = 6;
    settings.tools.put(tool);
    Interpreter interpreter(settings);
    EXPECT_TRUE(interpreter.line("M70", 1, Language::program));
    return interpreter;
}

/// Runs the action with the name and the row of each code that a program may have.
template <class Action>
void for_each_code(Action&& action) {
    for (const WordRule& rule : words_g())
        if (rule.group < g_group_count) action(name_of_g(rule.code), rule);
    for (const WordRule& rule : words_m())
        if (rule.group < m_group_count) action("M" + std::to_string(rule.code), rule);
}

/// Returns the names of the codes that a program may have and that fulfil the condition.
template <class Condition>
std::vector<std::string> codes_with(Condition&& condition) {
    std::vector<std::string> names;
    for_each_code([&](const std::string& name, const WordRule& rule) {
        if (condition(rule)) names.push_back(name);
    });
    return names;
}

}  // namespace

TEST(GcodeWords, EveryCodeHasAPhaseAndAnEffect) {
    EXPECT_THAT(codes_with([](const WordRule& rule) { return rule.phase == WordPhase::none || rule.help.empty(); }),
                ::testing::IsEmpty());
}

TEST(GcodeWords, EveryCodeHasAHandlerExceptThoseThatOtherWordsLookFor) {
    EXPECT_THAT(codes_with([](const WordRule& rule) { return rule.handler == nullptr; }),
                ::testing::ElementsAre("G80", "G53", "G97"));
}

TEST(GcodeWords, EveryRefusedCodeHasItsReason) {
    for (const WordRule& rule : words_g())
        EXPECT_TRUE(rule.group < g_group_count || !rule.refusal.empty()) << name_of_g(rule.code);
    for (const WordRule& rule : words_m())
        EXPECT_TRUE(rule.group < m_group_count || !rule.refusal.empty()) << "M" << rule.code;
}

TEST(GcodeWords, AllEarlierMotionEndsBeforeTheCodesOfGrblThatSynchronize) {
    EXPECT_THAT(codes_with([](const WordRule& rule) { return rule.stands_first; }),
                ::testing::ElementsAre("G4", "G10", "G28.1", "G30.1", "G92", "G92.1", "G92.2", "G92.3", "G43.1", "M0",
                                       "M1", "M2", "M30", "M60"));
}

TEST(GcodeWords, EveryLetterInTheRowOfACodeHasAUse) {
    for_each_code([](const std::string& name, const WordRule& rule) {
        std::uint32_t taken = 0;
        for (const std::string& line : lines_with(name)) {
            Interpreter interpreter = interpreter_with_tool();
            EXPECT_TRUE(interpreter.line(line, 1, Language::program)) << line;
            taken |= interpreter.block().words;
        }
        EXPECT_EQ(rule.letters & ~taken, 0u) << name;
    });
}

TEST(GcodeWords, ALetterThatIsNotInTheRowOfACodeIsRefused) {
    for_each_code([](const std::string& name, const WordRule& rule) {
        for (const std::string& line : lines_with(name))
            for (const char letter : std::string_view("ABCDEHIJKLPQRXYZ")) {
                if ((rule.letters & letter_bit(letter)) != 0) continue;
                Interpreter interpreter = interpreter_with_tool();
                const std::string longer = line + ' ' + letter + '1';
                EXPECT_FALSE(interpreter.line(longer, 1, Language::program)) << longer;
            }
    });
}

}  // namespace motionrack::control::gcode
