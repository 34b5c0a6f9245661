// The table of G and M codes: each row is complete, and its letters are the only ones that the code takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/words.hpp>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

/// Returns the names of the codes of both tables that a program may have and that fulfil the condition.
template <class Condition>
std::vector<std::string> codes_with(Condition&& condition) {
    std::vector<std::string> names;
    for (const WordRule& rule : words_g())
        if (rule.group < g_group_count && condition(rule)) names.push_back(name_of_g(rule.code));
    for (const WordRule& rule : words_m())
        if (rule.group < m_group_count && condition(rule)) names.push_back("M" + std::to_string(rule.code));
    return names;
}

/// Checks that a line with the code and one more word is refused, for each letter that the row lacks.
void expect_no_other_letter(const std::string& name, const WordRule& rule) {
    for (const char letter : std::string_view("ABCDEHIJKLPQRXYZ")) {
        if ((rule.letters & letter_bit(letter)) != 0) continue;
        Interpreter interpreter(testing::machine());
        const std::string line = name + ' ' + letter + '1';
        EXPECT_FALSE(interpreter.line(line, 1, Language::program)) << line;
    }
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

TEST(GcodeWords, ALetterThatIsNotInTheRowOfACodeIsRefused) {
    for (const WordRule& rule : words_g())
        if (rule.group < g_group_count) expect_no_other_letter(name_of_g(rule.code), rule);
    for (const WordRule& rule : words_m())
        if (rule.group < m_group_count) expect_no_other_letter("M" + std::to_string(rule.code), rule);
}

}  // namespace motionrack::control::gcode
