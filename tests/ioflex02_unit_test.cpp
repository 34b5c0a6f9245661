// The Pascal units uIOFlex2, uFlex2Pos and uFlx2Pos in the four modes of the compiler, and the command image.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <tests/ran.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

const std::filesystem::path examples = source_root / "examples";

Ran run(const std::filesystem::path& folder, const std::string& command) {
    return run_in(folder, command, "/dev/null");
}

/// Returns the path of a Pascal program, compiled in that mode.
std::string pascal(const std::string& mode, const std::string& name) {
    return "LD_LIBRARY_PATH='" MOTIONRACK_C_LIBRARY_FOLDER "' '" MOTIONRACK_PASCAL_EXAMPLES "/" + mode + "/" + name +
           "/" + name + "'";
}

class PascalMode : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Pascal, PascalMode, testing::Values("fpc", "tp", "delphi", "objfpc"));

TEST_P(PascalMode, ThePrintedExampleReportsEachOutcomeOfInit) {
    const std::string init = pascal(GetParam(), "init");
    const Ran good = run(examples, init);
    EXPECT_EQ(good.code, 0);
    EXPECT_EQ(good.out, "") << "Flex_Ok";
    const auto file = std::filesystem::temp_directory_path() / (std::string("motionrack_irc_") + GetParam() + ".bin");
    const auto with_image = [&](const std::string& options) {
        EXPECT_EQ(
            run(examples, std::string(MOTIONRACK_PROGRAM) + " image make -o '" + file.string() + "' " + options).code,
            0);
        return run(examples, "MOTIONRACK_IRC='" + file.string() + "' " + init).out;
    };
    EXPECT_EQ(with_image(""), "");
    EXPECT_EQ(with_image("--ident 0x24"), "Chyba inicializace desky: 3");
    EXPECT_EQ(with_image("--project stepper"), "Chyba inicializace desky: 3");
    std::filesystem::resize_file(file, 20);
    EXPECT_EQ(run(examples, "MOTIONRACK_IRC='" + file.string() + "' " + init).out, "Chyba inicializace desky: 1");
    std::filesystem::remove(file);
    EXPECT_EQ(run(examples, "MOTIONRACK_IRC='" + file.string() + "' " + init).out, "Chyba inicializace desky: 1");
    for (const char* rack : {"racks/single.toml", "no_such.toml", "port:/dev/port,offset=0x2300"})
        EXPECT_EQ(run(examples, "MOTIONRACK_RACK=" + std::string(rack) + " " + init).out, "Chyba inicializace desky: 2")
            << rack << " has no such card";
}

TEST_P(PascalMode, AProgramCalibratesFourAxes) {
    EXPECT_EQ(run(examples, pascal(GetParam(), "calibrate")).out, text_of(examples / "12_pascal" / "expected.txt"));
}

TEST_P(PascalMode, EveryFunctionOfTheUnitsDoesWhatItStates) {
    const Ran ran = run(examples, pascal(GetParam(), "functions"));
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, "0 wrong\n");
}

TEST(Examples, ThePascalExampleIsThePrintedOne) {
    EXPECT_EQ(text_of(examples / "12_pascal" / "init.pas"),
              "Uses\n"
              "  uIOFlex2,\n"
              "  uFlx2Pos;\n"
              "Var\n"
              "  MyIOFlexObj : tIOFlexPos;\n"
              "Begin\n"
              "  MyIOFlexObj.Init($2300{IOFlex02 base addr});\n"
              "  If MyIOFlexObj.Result<>Flex_Ok then\n"
              "    Write('Chyba inicializace desky: ', MyIOFlexObj.Result);\n"
              "End.\n");
}

// ---- motionrack image

class ImageCommand : public InFolder {
  protected:
    Ran image(const std::string& words) { return run_in(folder, std::string(MOTIONRACK_PROGRAM) + " image " + words); }
};

TEST_F(ImageCommand, MakesShowsAndChecksAnImage) {
    const Ran made = image("make -o irc.bin --axis 0=reversed,filter=3 --axis 3=x2,index_low");
    EXPECT_EQ(made.code, 0) << made.out;
    EXPECT_NE(made.out.find("project \"position\", version 25h"), std::string::npos) << made.out;
    const std::string shown = image("show irc.bin").out;
    EXPECT_NE(shown.find("axis 0    x4,reversed,filter=3\n"), std::string::npos) << shown;
    EXPECT_NE(shown.find("axis 1    x4\n"), std::string::npos) << shown;
    EXPECT_NE(shown.find("axis 3    x2,index_low\n"), std::string::npos) << shown;
    const auto json = nlohmann::json::parse(image("show irc.bin --json").out);
    EXPECT_EQ(json["ident"], 37);
    EXPECT_EQ(json["payload_bytes"], 8);
    EXPECT_EQ(json["axes"][3], "x2,index_low");
    const Ran checked = image("check irc.bin");
    EXPECT_EQ(checked.code, 0);
    EXPECT_EQ(checked.out, "Flex_Ok: version 25h of the project \"position\"\n");
    EXPECT_EQ(image("make -o - | cmp - irc.bin").code, 1) << "other modes, other bytes";
}

TEST_F(ImageCommand, ThePageAboutImagesShowsTheOutputOfItsCommands) {
    const auto codes = run_page("docs/howto/ioflex02/image.md");
    EXPECT_EQ(codes.size(), 5u);
    EXPECT_EQ(codes.at("image check irc.bin"), 0);
    EXPECT_EQ(codes.at("image check old.bin"), 2);
}

TEST_F(ImageCommand, ReportsTheResultThatInitWouldHave) {
    EXPECT_EQ(image("make -o old.bin --ident 0x24").code, 0);
    EXPECT_EQ(image("check old.bin").code, 2);
    EXPECT_NE(image("check old.bin").out.find("Flex_ErrProject"), std::string::npos);
    EXPECT_EQ(image("make -o other.bin --project stepper").code, 0);
    EXPECT_NE(image("check other.bin").out.find("\"stepper\" (ident 25h)"), std::string::npos);
    EXPECT_EQ(image("show other.bin").out.find("axis"), std::string::npos);
    EXPECT_EQ(run_in(folder, "head -c 20 other.bin > cut.bin").code, 0);
    const Ran cut = image("check cut.bin");
    EXPECT_EQ(cut.code, 2);
    EXPECT_NE(cut.out.find("cut short, damaged, or not a zlib stream"), std::string::npos) << cut.out;
    EXPECT_EQ(image("check no_such.bin").code, 5);
}

TEST_F(ImageCommand, RejectsInvalidArgumentsAndCreatesNoImage) {
    for (const char* axis : {"4=x2", "0", "1=", "1=x3", "1=filter=16", "1=filter=", "1=reversed,,x2", "x=x2"}) {
        const Ran ran = image("make -o irc.bin --axis " + std::string(axis));
        EXPECT_EQ(ran.code, 2) << axis << ran.out;
        EXPECT_NE(ran.out.find("No image was created."), std::string::npos) << axis << ran.out;
    }
    EXPECT_EQ(image("make -o irc.bin --project 'a name that is too long'").code, 3);
    EXPECT_EQ(image("make -o irc.bin --ident 256").code, 1);
    EXPECT_EQ(run_in(folder, "head -c 200000 /dev/zero > big.rbf").code, 0);
    EXPECT_NE(image("make big.rbf -o irc.bin").code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "irc.bin"));
}

TEST_F(ImageCommand, AcceptsUserBitsAndWritesConstantsForCAndPascal) {
    EXPECT_EQ(run_in(folder, "printf 'bits' > IRC.RBF").code, 0);
    EXPECT_EQ(image("make IRC.RBF -o irc.bin").code, 0);
    EXPECT_NE(image("show irc.bin").out.find("payload   12 bytes"), std::string::npos);
    EXPECT_EQ(image("make IRC.RBF -o my-irc.h").code, 0);
    EXPECT_EQ(image("make IRC.RBF -o irc.inc").code, 0);
    const std::string c = text_of(folder / "my-irc.h"), pascal = text_of(folder / "irc.inc");
    EXPECT_NE(c.find("static const unsigned char my_irc["), std::string::npos) << c;
    EXPECT_NE(c.find("    0x78, "), std::string::npos) << c;
    EXPECT_NE(pascal.find("  irc: array[0.."), std::string::npos) << pascal;
    EXPECT_NE(pascal.find("    $78, "), std::string::npos) << pascal;
}

TEST_F(ImageCommand, ItsDigitsAreTheImageOfARackFile) {
    const auto says = [&](const std::string& options) {
        EXPECT_EQ(image("make -o irc.bin " + options).code, 0);
        const std::string rack = "printf '[card.p1]\\ntype = \"ioflex02\"\\nimage = \"%s\"\\n' $(" MOTIONRACK_PROGRAM
                                 " image show irc.bin --hex) > rack.toml; " MOTIONRACK_PROGRAM " check rack.toml";
        return run_in(folder, rack);
    };
    EXPECT_EQ(says("--axis 0=reversed").code, 0);
    EXPECT_EQ(run_in(folder, "sed -i 's/\"78/\"79/' rack.toml; " MOTIONRACK_PROGRAM " check rack.toml").code, 2);
}

}  // namespace
}  // namespace motionrack
