// A code that needs no new motion is a row and its handler. This program has the row of G53.1 in its table of codes, as
// docs/howto/add_gcode_word.md adds it (CMakeLists.txt); no other file of the module knows the code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <map>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/words.hpp>
#include <motionrack/control/test/gcode_support.hpp>
#include <set>
#include <sstream>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

namespace motionrack::control::gcode {

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int added = 531;

/// Returns the product's sources without comments, by file.
std::map<std::string, std::string> product_code() {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(source_root / "motionrack")) {
        const fs::path& path = entry.path();
        if (path.extension() != ".hpp" && path.extension() != ".cpp") continue;
        const std::string name = fs::relative(path, source_root).generic_string();
        if (name.find("/test/") != std::string::npos) continue;
        std::istringstream lines(motionrack::text_of(path));
        std::string& code = out[name];
        for (std::string line; std::getline(lines, line);) code += line.substr(0, line.find("//")) + '\n';
    }
    return out;
}

/// Returns true if `code` has this name of a code, as "G43", not as a part of "G43.1" or "G430".
bool has_name(const std::string& code, const std::string& name) {
    const auto is_word = [&](std::size_t at) {
        return at < code.size() && (std::isalnum(static_cast<unsigned char>(code[at])) != 0 || code[at] == '_');
    };
    for (std::size_t at = code.find(name); at != std::string::npos; at = code.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_word(at - 1)) && !is_word(end) &&
            !(end < code.size() && code[end] == '.' && is_word(end + 1)))
            return true;
    }
    return false;
}

}  // namespace

TEST(AddedWord, IsReadAsItsRowSays) {
    EXPECT_EQ(group_of_g(added), g_nonmodal);
    const auto program = testing::read("G0 X1\nG53.1\nG0 X2\nM2\n");
    EXPECT_TRUE(program.problems.empty()) << program.problems[0].message;
    EXPECT_EQ(program.moves().size(), 2u);
    const auto without_row = testing::read("G53.2\n");
    ASSERT_EQ(without_row.problems.size(), 1u);
    EXPECT_THAT(without_row.problems[0].message, HasSubstr("G53.2 is not a known command"));
}

TEST(AddedWord, ExcludesTheOthersOfItsGroup) {
    Interpreter interpreter(testing::machine());
    const auto refused = interpreter.line("G53.1 G4 P1", 1, Language::program);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("G53.1 and G4 exclude each other"));
    EXPECT_THAT(refused.error().message, HasSubstr("a line takes one of G53.1 G4 "));
}

TEST(AddedWord, IsRefusedInLinesOfSendersForTheReasonOfItsRow) {
    Interpreter interpreter(testing::machine());
    const auto refused = interpreter.line("G53.1", 1);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().status, GrblStatus::unsupported);
    EXPECT_THAT(refused.error().message, HasSubstr("G53.1: Grbl has no tilted planes; leave it out"));
}

TEST(AddedWord, IsOnThePageOfTheCodes) {
    EXPECT_THAT(gcode_reference(), HasSubstr("accepted without effect: no axis tilts the tool"));
}

TEST(GcodeWords, AreEachNamedInAtMostFourFilesOfTheProduct) {
    // Messages of other codes name these, as in "end it with G40".
    const std::set<std::string> in_messages = {"G10", "G17", "G40", "G93", "G94", "M0"};
    const std::map<std::string, std::string> product = product_code();
    std::vector<std::string> names;
    for (const WordRule& rule : words_g()) names.push_back(name_of_g(rule.code));
    for (const WordRule& rule : words_m()) names.push_back("M" + std::to_string(rule.code));
    for (const std::string& name : names) {
        std::vector<std::string> files;
        for (const auto& [file, code] : product)
            if (has_name(code, name)) files.push_back(file);
        EXPECT_EQ(files.size() > 4, in_messages.count(name) != 0)
            << name << " is named in " << ::testing::PrintToString(files)
            << "; make these at most four, or, where they are now, remove it from in_messages";
    }
}

}  // namespace motionrack::control::gcode
