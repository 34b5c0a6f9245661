// Encoders in recordings: `motionrack decode` counts a recording of `motionrack trace` like the job's summary and like
// sigrok-cli. The page about it shows the output of its commands.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tests/fenced_blocks.hpp>
#include <tests/ran.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

namespace fs = std::filesystem;

/// A temporary working folder for commands.
class Decode : public testing::Test {
  protected:
    Decode() : folder_(fs::temp_directory_path() / ("motionrack_decode_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Decode() override { fs::remove_all(folder_); }

    /// Returns the output of `command`, including errors and warnings.
    Ran run(const std::string& command) const { return run_in(folder_, command); }
    Ran motionrack(const std::string& arguments) const { return run(MOTIONRACK_PROGRAM " " + arguments); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    nlohmann::json json_of(const std::string& arguments) const {
        const Ran ran = motionrack(arguments);
        EXPECT_EQ(ran.code, 0) << ran.out;
        return nlohmann::json::parse(ran.out, nullptr, false);
    }
    bool has_sigrok() const { return run("sigrok-cli --version").code == 0; }

    fs::path folder_;
};

TEST_F(Decode, CountsWhatTheJobsSummaryStates) {
    write("move.ngc", "G21 G90\nG1 X2 Y1 F600\nG3 X1 Y2 I-1 J0\nG1 X0.5 Z79\nM2\n");
    const auto summary = json_of("trace move.ngc move.vcd --signals '?.enc_?' --json");
    const auto decoded = json_of("decode move.vcd --json");
    ASSERT_EQ(decoded["channels"].size(), summary["axes"].size());
    int moved = 0;  // all were at count 0 when the recording started
    for (std::size_t i = 0; i < decoded["channels"].size(); ++i) {
        const auto& channel = decoded["channels"][i];
        const auto& axis = summary["axes"][i];
        EXPECT_EQ(channel["name"], axis["axis"]);
        EXPECT_EQ(channel["counts"], axis["encoder_counts"]) << axis;
        EXPECT_EQ(channel["illegal"], 0);
        moved += channel["up"].get<int>() > 0;
    }
    EXPECT_EQ(moved, 2) << "up: X and Y; Z goes down";
    EXPECT_NEAR(decoded["last_s"].get<double>(), summary["duration_s"].get<double>(), 1e-4)
        << "it ends with the look after the job";
}

TEST_F(Decode, AgreesWithSigrokAndReadsItsFiles) {
    if (!has_sigrok()) GTEST_SKIP() << "sigrok-cli is not installed: apt-get install sigrok-cli";
    write("move.ngc", "G21 G90\nG1 X0.2 Y0.1 F600\nG1 X0.05\nM2\n");
    ASSERT_EQ(motionrack("trace move.ngc move.vcd --timescale-ns 1000 --signals 'X.enc_?' --signals 'Y.enc_?' -q").code,
              0);
    const Ran reported = run(
        "sigrok-cli -I vcd -i move.vcd -P graycode:d0=X_enc_a:d1=X_enc_b -A graycode=count 2>/dev/null | tail -n 1");
    const std::size_t colon = reported.out.find(": ");
    ASSERT_NE(colon, std::string::npos) << reported.out;
    const int counts = std::atoi(reported.out.c_str() + colon + 2);
    const auto from_vcd = json_of("decode move.vcd --json");
    // sigrok reports each position when it is left: the last one reported is one step before the end.
    EXPECT_EQ(from_vcd["channels"][0]["counts"], 40);
    EXPECT_EQ(counts - 1, 40);
    ASSERT_EQ(
        run("sigrok-cli -I vcd -i move.vcd -O csv -o move.csv && sigrok-cli -I vcd -i move.vcd -O binary -o move.bin")
            .code,
        0);
    const auto from_csv = json_of("decode move.csv --json --channel X=X_enc_a,X_enc_b --channel Y=Y_enc_a,Y_enc_b");
    const auto from_raw = json_of("decode move.bin --json --channel X=0,1 --channel Y=2,3");
    for (std::size_t i = 0; i < 2; ++i)
        for (const char* number : {"counts", "up", "down", "illegal"}) {
            EXPECT_EQ(from_csv["channels"][i][number], from_vcd["channels"][i][number]) << number;
            EXPECT_EQ(from_raw["channels"][i][number], from_vcd["channels"][i][number]) << number;
        }
}

TEST_F(Decode, EndsWithACodeAndASentence) {
    write("back.csv", "t,a,b\n0,0,0\n2,1,0\n1,1,1\n3,0,0\n");
    write("cut.csv", "t,a,b\n0,0,0\n2,1,0\n3,");
    write("raw.bin", "abc");
    const std::pair<const char*, int> commands[] = {{"back.csv", 2},
                                                    {"cut.csv", 2},
                                                    {"raw.bin", 2},
                                                    {"none.vcd", 5},
                                                    {".", 5},
                                                    {"raw.bin --sample-rate fast", 2},
                                                    {"cut.csv --window-ms 0", 1},
                                                    {"cut.csv --format xml", 1},
                                                    {"cut.csv --window-ms 1e30", 3},
                                                    {"cut.csv --channel q", 2},
                                                    {"--signals cut.csv", 0}};
    for (const auto& [arguments, code] : commands) {
        const Ran ran = motionrack(std::string("decode ") + arguments);
        EXPECT_EQ(ran.code, code) << arguments << "\n" << ran.out;
    }
    EXPECT_NE(motionrack("decode back.csv").out.find("back.csv:4:1: Time goes backwards"), std::string::npos);
    const Ran cut = motionrack("decode cut.csv");
    EXPECT_NE(cut.out.find("cut.csv:4:1: The file ends inside a row"), std::string::npos) << cut.out;
    EXPECT_NE(cut.out.find("encoder"), std::string::npos) << "what is before that is told";
}

TEST_F(Decode, PageShowsTheOutputOfItsCommands) {
    const std::string page = text_of(source_root / "docs/howto/decode.md");
    ASSERT_EQ(code_in_page(page, "gcode").size(), 1u);
    ASSERT_EQ(code_in_page(page, "csv").size(), 1u);
    write("move.ngc", code_in_page(page, "gcode")[0]);
    write("bench.csv", code_in_page(page, "csv")[0]);
    int commands = 0;
    for (const std::string& block : code_in_page(page, "console")) {
        std::istringstream lines(block);
        std::string shown, printed;
        for (std::string line; std::getline(lines, line);) {
            shown += line + "\n";
            if (line.rfind("$ motionrack ", 0) != 0) continue;
            printed += line + "\n" + motionrack(line.substr(13)).out;
            ++commands;
        }
        EXPECT_EQ(shown, printed);
    }
    EXPECT_GE(commands, 4);
}

}  // namespace
}  // namespace motionrack
