// Compares the logic in hdl/ with its page: pins, parameters, and the resources that yosys counts.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <tests/environment.hpp>
#include <tests/source_root.hpp>
#include <vector>

namespace motionrack::grating_bus {
namespace {

namespace fs = std::filesystem;

const std::string hdl = source_dir() + "/hdl/";

std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Returns the first cell of each row, without quotes, of the table whose first heading is `heading`.
std::vector<std::string> first_cells(const std::string& heading) {
    std::vector<std::string> out;
    std::istringstream page(contents(hdl + "README.md"));
    bool inside = false;
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("| " + heading + " |", 0) == 0) inside = true;
        if (line.empty()) inside = false;
        std::smatch cell;
        if (inside && std::regex_search(line, cell, std::regex(R"(^\| `(\w+)` \|)"))) out.push_back(cell[1]);
    }
    return out;
}

/// Returns the names in the header of a module: those of its parameters, or of its ports.
std::vector<std::string> names_declared(const std::string& module, bool parameters) {
    const std::string text = contents(hdl + "grating_bus/" + module + ".sv");
    const std::size_t begin = text.find("module " + module), end = text.find("\n);", begin);
    const std::string head = text.substr(begin, end - begin);
    const std::regex name(parameters ? R"(\n    parameter (?:\[[^\]]*\] )?(\w+))"
                                     : R"(\n    (?:input|output|inout) +(?:logic|wire) *(?:\[[^\]]*\])? *(\w+))");
    std::vector<std::string> out;
    for (std::sregex_iterator at(head.begin(), head.end(), name), none; at != none; ++at) out.push_back((*at)[1]);
    return out;
}

TEST(GratingHdl, ThePageHasEveryPinAndParameterInTheirOrder) {
    EXPECT_EQ(first_cells("pin of `grating_motion_card`"), names_declared("grating_motion_card", false));
    EXPECT_EQ(first_cells("pin of `grating_decoder_card`"), names_declared("grating_decoder_card", false));
    EXPECT_EQ(first_cells("parameter"), names_declared("grating_motion_card", true));
    EXPECT_GE(names_declared("grating_motion_card", false).size(), 20u);
}

TEST(GratingHdl, ThePageNamesEveryFile) {
    const std::string page = contents(hdl + "README.md");
    for (const auto& file : fs::directory_iterator(hdl + "grating_bus"))
        EXPECT_NE(page.find("(grating_bus/" + file.path().filename().string() + ")"), std::string::npos)
            << file.path().filename();
}

/// Returns a row of the table of resources, with the numbers that yosys counts.
std::string row_of(const std::string& label, const std::string& top, const std::string& parameters) {
    const std::string out =
        (fs::temp_directory_path() / ("motionrack_yosys_" + std::to_string(::getpid()) + ".txt")).string();
    std::string command = "cd " + hdl + "grating_bus && yosys -q -p \"read_verilog -sv";
    for (const char* file : {"card", "decoder", "shifter", "motion_card", "decoder_card"})
        command += std::string(" grating_") + file + ".sv";
    command += "; chparam " + parameters + " " + top + "; synth_ice40 -top " + top + "; tee -o " + out +
               " stat\" >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::istringstream lines(contents(out));
    fs::remove(out);
    std::map<std::string, int> cells;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        int count = 0;
        if (words >> name >> count && name.rfind("SB_", 0) == 0)
            cells[name.rfind("SB_DFF", 0) == 0 ? "SB_DFF" : name] += count;
    }
    std::string row = "| " + label + " |";
    for (const char* cell : {"SB_LUT4", "SB_DFF", "SB_CARRY", "SB_RAM40_4K"})
        row += " " + std::to_string(cells[cell]) + " |";
    return row + "\n";
}

TEST(GratingHdl, UsesTheResourcesStatedOnThePage) {
    if (!thorough()) GTEST_SKIP() << "half a minute of synthesis is for MOTIONRACK_THOROUGH=1 (./test --all seeds)";
    if (std::system("yosys -V 2>/dev/null | grep -q '^Yosys 0.23 '") != 0)
        GTEST_SKIP() << "yosys 0.23 is not installed (Debian package yosys); nothing was synthesized";
    const std::string page = contents(hdl + "README.md"), card = "grating_motion_card",
                      decoder = "grating_decoder_card";
    for (const std::string& row : {row_of("`" + card + "`, host, N = 8", card, "-set N 8 -set HOST 1"),
                                   row_of("`" + card + "`, slave, N = 8", card, "-set N 8"),
                                   row_of("`" + decoder + "`, N = 8", decoder, "-set N 8")})
        EXPECT_NE(page.find("\n" + row), std::string::npos) << "the page has another row than:\n" << row;
}

}  // namespace
}  // namespace motionrack::grating_bus
