// LinuxCNC's interpreter as the reference for the corpus.
#include <motionrack/control/test/gcode_rs274.hpp>

namespace motionrack::control::gcode {

using namespace testing::corpus;

TEST(GcodeReferee, Rs274GivesTheSameMovesForEveryProgramOfTheCorpus) {
    if (!is_installed()) GTEST_SKIP() << "rs274 is not installed (Debian: linuxcnc-uspace)";
    Folder at;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
        if (entry.path().extension() == ".ngc") std::filesystem::copy(entry.path(), at.path());
    write(at.file("tools.tbl"), table_in_inches());
    for (const std::string& name : names()) {
        const std::string theirs = compared(name, of_rs274(at, name, has_tools(name)));
        EXPECT_EQ(compared(name, printed(file_text(folder() + name + ".ngc"), {}, settings_of(name))), theirs) << name;
        EXPECT_EQ(compared(name, file_text(folder() + name + ".canon")), theirs)
            << name << ".canon is not what rs274 prints";
    }
}

}  // namespace motionrack::control::gcode
