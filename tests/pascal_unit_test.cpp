// The Pascal unit uMotionrack: every function of the C interface, in the four modes of the compiler.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <tests/ran.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

class RackUnit : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Pascal, RackUnit, testing::Values("fpc", "tp", "delphi", "objfpc"));

TEST_P(RackUnit, EveryFunctionDoesWhatItStates) {
    const Ran ran =
        run_in(source_root / "examples",
               std::string("LD_LIBRARY_PATH='" MOTIONRACK_C_LIBRARY_FOLDER "' '" MOTIONRACK_PASCAL_EXAMPLES "/") +
                   GetParam() + "/rack/rack'",
               "/dev/null");
    EXPECT_EQ(ran.out, "0 wrong\n");
    EXPECT_EQ(ran.code, 0);
}

/// Returns all matches of the first group of the expression.
std::set<std::string> all_of(const std::string& text, const char* expression) {
    const std::regex searched(expression);
    std::set<std::string> out;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), searched); at != std::sregex_iterator(); ++at)
        out.insert((*at)[1]);
    return out;
}

TEST(RackUnitsNames, AreThoseOfTheHeader) {
    const std::string header = text_of(source_root / "motionrack/c.h"),
                      folder = (source_root / "motionrack/frontends/pascal").string(),
                      unit = text_of(folder + "/uMotionrack.pas"), program = text_of(folder + "/test/rack.pas");
    const std::set<std::string> functions = all_of(header, R"(MR_API [^(]*?\b(mr_\w+)\()");
    EXPECT_GT(functions.size(), 25u);
    EXPECT_EQ(all_of(unit, R"((?:function|procedure) (mr_\w+))"), functions);
    for (const std::string& name : functions) EXPECT_NE(program.find(name), std::string::npos) << name;
    EXPECT_EQ(all_of(unit, R"(\n  (MR_\w+ = \d+);)"), all_of(header, R"((?:\n    |enum \{ )(MR_\w+ = \d+))"));
}

}  // namespace
}  // namespace motionrack
