// The how-to pages of the function libraries show the results of their programs.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <tests/fenced_blocks.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

namespace fs = std::filesystem;
std::string printed_by(const std::string& command) {
    std::string out;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return out;
    std::array<char, 4096> buffer{};
    for (std::size_t got; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        out.append(buffer.data(), got);
    ::pclose(pipe);
    return out;
}

/// Returns every line of `text` that is not empty, with `indent` before it.
std::string indented(const std::string& text, const std::string& indent) {
    std::string out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out += line.empty() ? "\n" : indent + line + "\n";
    return out;
}

/// Returns the first block of code in a language on the page.
std::string code_of(const std::string& page, const std::string& language = "cpp") {
    return code_in_page(page, language).at(0);
}

class HowTo : public testing::TestWithParam<const char*> {};

TEST_P(HowTo, ShowsTheProgramItsOutputAndItsPicture) {
    const std::string name = GetParam(), page = text_of(source_root / "docs/howto/mcx314" / (name + ".md"));
    ASSERT_FALSE(page.empty());
    const fs::path picture = fs::temp_directory_path() / ("motionrack_howto_" + name + ".svg");
    const std::string printed = printed_by(MOTIONRACK_MCX314_EXAMPLE " " + name + " '" + picture.string() + "'");
    EXPECT_NE(page.find("\nIt prints\n\n" + indented(printed, "    ") + "\n"), std::string::npos) << printed;
    EXPECT_NE(text_of(source_root / "examples/mcx314" / (name + ".cpp")).find(indented(code_of(page), "    ")),
              std::string::npos)
        << "the page's program is not that of examples/mcx314/" << name << ".cpp";
    EXPECT_NE(page.find("](../../pictures/mcx314_" + name + ".svg)"), std::string::npos)
        << "the page does not show its picture";
    EXPECT_EQ(text_of(source_root / "docs/pictures" / ("mcx314_" + name + ".svg")), text_of(picture))
        << "make it anew: example_mcx314 " << name << " docs/pictures/mcx314_" << name << ".svg";
    fs::remove(picture);
}

TEST_P(HowTo, ShowsTheProgramInCAndItsOutput) {
    const std::string name = GetParam(), page = text_of(source_root / "docs/howto/mcx314" / (name + ".md"));
    ASSERT_NE(page.find("```c\n"), std::string::npos);
    const std::string printed =
        printed_by("MOTIONRACK_RACK='card.c1 = \"mcx314\"' " MOTIONRACK_MCX314LIB_HOWTO " " + name);
    EXPECT_NE(page.find("\nIn C it prints\n\n" + indented(printed, "    ") + "\n"), std::string::npos) << printed;
    EXPECT_NE(text_of(source_root / "examples/09_mcx314lib/howto.c").find(indented(code_of(page, "c"), "    ")),
              std::string::npos)
        << "the page's program is not that of examples/09_mcx314lib/howto.c";
}

INSTANTIATE_TEST_SUITE_P(Pages, HowTo,
                         testing::Values("trapezoid", "s_curve", "asymmetric", "line", "arc", "contour",
                                         "bit_pattern"));

// ---- IOFLEX02

class Ioflex02HowTo : public testing::TestWithParam<const char*> {};

TEST_P(Ioflex02HowTo, ShowsTheProgramAndItsOutput) {
    const std::string name = GetParam(), page = text_of(source_root / "docs/howto/ioflex02" / (name + ".md"));
    ASSERT_FALSE(page.empty());
    const std::string printed = printed_by(MOTIONRACK_IOFLEX02_EXAMPLE " " + name);
    EXPECT_NE(page.find("\nIt prints\n\n" + indented(printed, "    ") + "\n"), std::string::npos) << printed;
    EXPECT_NE(text_of(source_root / "examples/ioflex02" / (name + ".cpp")).find(indented(code_of(page), "    ")),
              std::string::npos)
        << "the page's program is not that of examples/ioflex02/" << name << ".cpp";
}

INSTANTIATE_TEST_SUITE_P(Pages, Ioflex02HowTo, testing::Values("calibrate", "speed", "broken_line", "lathe"));

// ---- C

TEST(CHowTo, ShowsTheWholeProgramAndItsOutput) {
    const std::string page = text_of(source_root / "docs/howto/c_program.md"),
                      program = text_of(source_root / "examples/c_program/program.c");
    ASSERT_FALSE(program.empty());
    EXPECT_NE(page.find("```c\n" + program + "```\n"), std::string::npos) << "it is that of examples/c_program";
    const fs::path recording = fs::temp_directory_path() / "motionrack_howto_c_program.h5";
    const std::string printed = printed_by(MOTIONRACK_C_PROGRAM_EXAMPLE " '" + recording.string() + "' 2>&1");
    EXPECT_NE(page.find("It prints\n\n" + indented(printed, "    ") + "\n"), std::string::npos) << printed;
    EXPECT_GT(fs::file_size(recording), 10'000u);
    fs::remove(recording);
}

// ---- DataBoard 4002

std::string databoard_page(const std::string& name) {
    return text_of(source_root / "docs/howto/databoard4002" / (name + ".md"));
}

/// Runs `program` with the path of a picture that it writes. Expects on the page that picture and the output of
/// `printer`, or of `program` if `printer` is empty.
void shows(const std::string& name, const std::string& program, const std::string& printer) {
    const std::string page = databoard_page(name);
    ASSERT_FALSE(page.empty());
    const fs::path picture = fs::temp_directory_path() / ("motionrack_howto_databoard4002_" + name + ".svg");
    const std::string drawn = printed_by(program + " '" + picture.string() + "'");
    const std::string printed = printer.empty() ? drawn : printed_by(printer);
    ASSERT_FALSE(printed.empty());
    EXPECT_NE(page.find("prints\n\n" + indented(printed, "    ") + "\n"), std::string::npos) << printed;
    EXPECT_NE(page.find("](../../pictures/databoard4002_" + name + ".svg)"), std::string::npos)
        << "the page does not show its picture";
    EXPECT_EQ(text_of(source_root / "docs/pictures" / ("databoard4002_" + name + ".svg")), text_of(picture))
        << "make it anew: " << program << " docs/pictures/databoard4002_" << name << ".svg";
    fs::remove(picture);
}

class Databoard4002HowTo : public testing::TestWithParam<const char*> {};

TEST_P(Databoard4002HowTo, ShowsTheProgramItsOutputAndItsPicture) {
    const std::string name = GetParam();
    shows(name, MOTIONRACK_DATABOARD4002_EXAMPLE " " + name, "");
    const std::string program = text_of(source_root / "examples/databoard4002" / (name + ".cpp"));
    EXPECT_NE(program.find(indented(code_of(databoard_page(name)), "    ")), std::string::npos)
        << "the page's program is not that of examples/databoard4002/" << name << ".cpp";
}

INSTANTIATE_TEST_SUITE_P(Pages, Databoard4002HowTo, testing::Values("slope", "lock"));

/// Tests a page with a program in C. Its output must be on the page, with a picture made from the run that it writes,
/// and the page shows parts of the program.
void shows_program_in_c(const std::string& name, const std::string& command, const std::string& source, int parts) {
    const fs::path csv = fs::temp_directory_path() / ("motionrack_howto_" + name + ".csv");
    const std::string printer = command + " '" + csv.string() + "'";
    ASSERT_FALSE(printed_by(printer).empty());
    shows(name, MOTIONRACK_DATABOARD4002_EXAMPLE " " + name + " '" + csv.string() + "'", printer);
    fs::remove(csv);
    const std::string page = databoard_page(name), program = text_of(source_root / source);
    const std::vector<std::string> blocks = code_in_page(page, "c");
    for (const std::string& code : blocks) EXPECT_NE(program.find(code), std::string::npos) << code;
    EXPECT_EQ(static_cast<int>(blocks.size()), parts);
}

TEST(Databoard4002HowToHost, ShowsThePartsOfTheProgramInCItsOutputAndThePictureOfItsRun) {
    shows_program_in_c("old_host", MOTIONRACK_DATABOARD_C_EXAMPLE, "examples/10_databoard_c/program.c", 3);
}

TEST(Databoard4002HowToRig, ShowsAClosedLoopThatSettlesAndTwoThatOscillate) {
    const std::string rig = (source_root / "examples/servo_rig/rig.toml").string();
    shows_program_in_c("closed_loop", MOTIONRACK_SERVO_RIG_EXAMPLE " '" + rig + "'", "examples/servo_rig/program.c", 1);
}

}  // namespace
}  // namespace motionrack
