// The start pages: their commands, run in the order of the page in a tree like a fresh clone, print what it shows.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tests/fenced_blocks.hpp>
#include <tests/ran.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
#define MOTIONRACK_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MOTIONRACK_SANITIZED
#endif
#endif

namespace motionrack {
namespace {

namespace fs = std::filesystem;
constexpr int max_lines = 120, min_commands = 3;

/// Commands of a block, and the text that bash -v prints: each command as it is read, without "$ ", then its output. A
/// backslash at the end of a line continues the command on the next line.
struct Transcript {
    std::string commands, printed;
    int count = 0;
};

Transcript transcript_of(const std::string& block) {
    Transcript out;
    std::istringstream in(block);
    bool goes_on = false;
    for (std::string line; std::getline(in, line);) {
        const bool begins = line.rfind("$ ", 0) == 0;
        if (begins) line.erase(0, 2), ++out.count;
        if (begins || goes_on) out.commands += line + "\n";
        goes_on = (begins || goes_on) && !line.empty() && line.back() == '\\';
        out.printed += line + "\n";
    }
    return out;
}

/// A tree like a fresh clone: links to the source files, copies of the examples (their scripts find the tree by their
/// own path), the programs of this build, and functions that install and build nothing in place of the scripts that do.
class StartPage : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        fs::remove_all(clone);
        fs::create_directories(clone / "build");
        fs::create_directories(clone / "cmake");
        std::istringstream files(run_in(source_root, "tests/rules/files . | tr '\\0' '\\n' | cut -d/ -f1 | uniq").out);
        for (std::string name; std::getline(files, name);) {
            if (name == "examples")
                fs::copy(source_root / name, clone / name, fs::copy_options::recursive);
            else if (name != "cmake" && !fs::exists(clone / name))
                fs::create_symlink(source_root / name, clone / name);
        }
        fs::create_directory_symlink(fs::path(MOTIONRACK_PROGRAM).parent_path().parent_path(), clone / "build/release");
        std::ofstream(clone / "cmake/setup.sh")
            << "need_packages() { :; }\nbuild_in() { :; }\nbuild_page() { :; }\nrun_packages=() release_options=()\n";
    }
    void TearDown() override { fs::remove_all(clone); }

    /// Expects a block with a file name after its language to be a part of that file of the tree. Writes the file if
    /// the tree has none.
    void expect_file(const FencedBlock& block, const std::string& name) const {
        if (fs::exists(source_root / name))
            EXPECT_NE(text_of(source_root / name).find(block.text), std::string::npos) << name << "\n" << block.text;
        else
            std::ofstream(clone / name, std::ios::binary) << block.text;
    }

    const fs::path clone = fs::temp_directory_path() / ("motionrack_start_" + std::to_string(::getpid()));
};

TEST_P(StartPage, PrintsTheOutputThatItShows) {
    const std::string page = text_of(source_root / "docs/start" / (std::string(GetParam()) + ".md"));
    ASSERT_FALSE(page.empty());
    EXPECT_LE(std::count(page.begin(), page.end(), '\n'), max_lines);
#ifdef MOTIONRACK_SANITIZED
    if (page.find("$ gcc ") != std::string::npos || page.find("$ fpc ") != std::string::npos)
        GTEST_SKIP() << "Programs of other compilers cannot be linked with libraries that have a sanitizer.";
#endif
    int commands = 0;
    for (const FencedBlock& block : fenced_blocks(page)) {
        const std::size_t blank = block.info.find(' ');
        if (blank != std::string::npos) expect_file(block, block.info.substr(blank + 1));
        if (!block.info.empty()) continue;
        const Transcript transcript = transcript_of(block.text);
        std::ofstream(clone / ".commands", std::ios::binary) << transcript.commands;
        EXPECT_EQ(run_in(clone, "bash -v .commands").out, transcript.printed);
        commands += transcript.count;
    }
    EXPECT_GE(commands, min_commands);
}

INSTANTIATE_TEST_SUITE_P(Pages, StartPage,
                         testing::Values("gcode", "mcx314", "databoard4002", "ioflex02", "marking", "grating_bus"),
                         [](const testing::TestParamInfo<const char*>& page) { return std::string(page.param); });

TEST(StartPages, AreAllRunAndListed) {
    const std::string chooser = text_of(source_root / "docs/start.md"),
                      own = text_of(source_root / "tests/start_pages_test.cpp");
    for (const auto& entry : fs::directory_iterator(source_root / "docs/start")) {
        const std::string name = entry.path().stem().string();
        EXPECT_NE(chooser.find("](start/" + name + ".md)"), std::string::npos) << name;
        EXPECT_NE(own.find("\"" + name + "\""), std::string::npos) << name;
    }
}

}  // namespace
}  // namespace motionrack
