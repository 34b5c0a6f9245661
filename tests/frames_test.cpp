// The page about frames: every command on it prints what the page says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
const fs::path root = MOTIONRACK_SOURCE_DIR;

struct Ran {
    int code = -1;
    std::string out;
};

/// Runs `motionrack ARGUMENTS` in `folder`; what it says to the terminal, warnings too.
Ran motionrack(const fs::path& folder, const std::string& arguments) {
    Ran ran;
    std::FILE* pipe = ::popen(("cd '" + folder.string() + "' && " MOTIONRACK_PROGRAM " " + arguments + " 2>&1").c_str(), "r");
    if (!pipe) return ran;
    std::array<char, 4096> buffer{};
    for (std::size_t got; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) ran.out.append(buffer.data(), got);
    const int status = ::pclose(pipe);
    if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
    return ran;
}

/// A folder that has the project's examples, for commands that write files.
class FramesPage : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
        fs::create_directory_symlink(root / "examples", folder / "examples");
    }
    void TearDown() override { fs::remove_all(folder); }
    const fs::path folder = fs::temp_directory_path() / ("motionrack_frames_" + std::to_string(::getpid()));
};

TEST_F(FramesPage, ShowsWhatItsCommandsPrint) {
    const std::string page = text_of(root / "docs/howto/grating_bus/frames.md"), begin = "```\n$ motionrack ";
    std::map<std::string, int> codes;
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
        const std::size_t command = at + begin.size(), end_of_line = page.find('\n', command), end = page.find("```", end_of_line);
        const std::string arguments = page.substr(command, end_of_line - command);
        const Ran ran = motionrack(folder, arguments);
        EXPECT_EQ(ran.out, page.substr(end_of_line + 1, end - end_of_line - 1)) << arguments;
        codes[arguments] = ran.code;
    }
    ASSERT_GE(codes.size(), 4u);
    EXPECT_EQ(codes["frames examples/grating_bus/crate.toml --for 0.05 --picture frame.svg"], 0);
    EXPECT_EQ(text_of(folder / "frame.svg"), text_of(root / "docs/pictures/grating_frame.svg"))
        << "make it anew: motionrack frames examples/grating_bus/crate.toml --for 0.05 --picture docs/pictures/grating_frame.svg";
    EXPECT_EQ(text_of(folder / "three.svg"), text_of(root / "docs/pictures/grating_three_hosts.svg"))
        << "make it anew: motionrack frames examples/grating_bus/three_hosts.toml --for 0.05 --picture docs/pictures/grating_three_hosts.svg";
}

TEST_F(FramesPage, HostAndSlavesAgreeAndThreeHostsDoNot) {
    const Ran crate = motionrack(folder, "frames examples/grating_bus/crate.toml --for 0.05 --json");
    EXPECT_EQ(crate.code, 0);
    EXPECT_THAT(crate.out, HasSubstr("\"conflicts\":0,\"agree\":true"));
    const Ran three = motionrack(folder, "frames examples/grating_bus/three_hosts.toml --for 0.05 --json");
    EXPECT_EQ(three.code, 4);
    EXPECT_THAT(three.out, HasSubstr("\"agree\":false"));
}

TEST_F(FramesPage, WavesHaveStatesAndLinesOfEveryBit) {
    ASSERT_EQ(motionrack(folder, "frames examples/grating_bus/crate.toml --for 0.001 -q --vcd f.vcd").code, 0);
    const std::string vcd = text_of(folder / "f.vcd");
    for (const char* signal : {"wire 1 ", "bus_clk", "bus_hold", "bus_read_n", "bus_addr0", "bus_data31", "wire 4 ", "c1_state", "wire 32 ", "bus_data", "b1100 "})
        EXPECT_THAT(vcd, HasSubstr(signal));
}

TEST_F(FramesPage, WrongOptionsAndRacksAreRefused) {
    EXPECT_THAT(motionrack(folder, "frames examples/racks/carriage.toml").out, HasSubstr("grating_bus"));
    const Ran negative = motionrack(folder, "frames examples/grating_bus/crate.toml --for -1");
    EXPECT_NE(negative.code, 0);
    EXPECT_THAT(negative.out, HasSubstr("--for is -1 s"));
    EXPECT_THAT(motionrack(folder, "frames examples/grating_bus/crate.toml --fault bus.nix=1@0.1s").out, HasSubstr("bus.nix"));
    const Ran refused = motionrack(folder, "frames examples/grating_bus/crate.toml --for 0.02 --fault c2.late=-5@0.01s");
    EXPECT_EQ(refused.code, 0) << "the run goes on without it";
    EXPECT_THAT(refused.out, HasSubstr("the fault c2.late=-5@0.01s was refused: c2 cannot have the fault late with the value -5"));
}

}  // namespace
}  // namespace motionrack
