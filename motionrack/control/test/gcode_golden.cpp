// Our canonical motion lines against those that LinuxCNC's rs274 printed for the same programs (tests/golden/canon).
#include <gtest/gtest.h>

#include <fstream>
#include <motionrack/control/gcode/canon.hpp>
#include <sstream>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Only STRAIGHT_.., ARC_FEED and DWELL, without the columns before them and without the sign of zeros.
std::string motion_lines(const std::string& canon) {
    std::string out;
    std::istringstream lines(canon);
    for (std::string line; std::getline(lines, line);) {
        for (const char* start : {"STRAIGHT_", "ARC_FEED", "DWELL"}) {
            const std::size_t at = line.find(start);
            if (at == std::string::npos || line.find("COMMENT") != std::string::npos) continue;
            std::string call = line.substr(at);
            for (std::size_t zero; (zero = call.find("-0.0000")) != std::string::npos;) call.erase(zero, 1);
            out += call + '\n';
        }
    }
    return out;
}

std::string printed(const std::string& program, CanonOptions options = {}) {
    std::string out;
    const auto done =
        print_canon(program, testing::machine("XYZABC", 1e5), options, [&](std::string_view line) { out += line; });
    EXPECT_TRUE(done) << done.error().text();
    return out;
}

}  // namespace

class GcodeGolden : public ::testing::TestWithParam<const char*> {};

TEST_P(GcodeGolden, MovesAreThoseOfRs274) {
    const std::string base = std::string(MOTIONRACK_SOURCE_DIR) + "/tests/golden/canon/" + GetParam();
    const std::string expected = motion_lines(file_text(base + ".canon"));
    ASSERT_GT(expected.size(), 100u);
    EXPECT_EQ(motion_lines(printed(file_text(base + ".ngc"))), expected);
}

INSTANTIATE_TEST_SUITE_P(Programs, GcodeGolden,
                         ::testing::Values("lines", "planes", "helices", "radius", "inches", "offsets", "shifts",
                                           "references", "drilling", "drilling_planes", "drilling_series", "modes",
                                           "marks", "cutter_outside", "cutter_pocket", "cutter_slot", "cutter_arc_corners",
                                           "cutter_arc_arc", "cutter_entry_arc", "cutter_helix", "cutter_plunge", "cutter_g18",
                                           "cutter_inch", "cutter_back", "cutter_exit", "cutter_sides", "cutter_rapid",
                                           "cutter_offsets", "cutter_rotary", "cutter_radius", "probe"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(GcodeCanon, PrintsEventsAndColumnsAsRs274Does) {
    const std::string out =
        printed("N10 T2 M6\nS900 M3 M8 (MSG,go)\nN5 G20 G18\nG55\nG61\nM1\nG4 P.5\nM5 M9\nM0\nM2\n");
    const char* expected =
        "    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
        "    2 N..... SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "    3 N..... SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "    4 N..... SET_XY_ROTATION(0.0000)\n"
        "    5 N10    SELECT_TOOL(2)\n"
        "    6 N10    START_CHANGE()\n"
        "    7 N10    CHANGE_TOOL(2)\n"
        "    8 N..... MESSAGE(\"go\")\n"
        "    9 N..... SET_SPINDLE_SPEED(0, 900.0000)\n"
        "   10 N..... START_SPINDLE_CLOCKWISE(0)\n"
        "   11 N..... FLOOD_ON()\n"
        "   12 N5     SELECT_PLANE(CANON_PLANE_XZ)\n"
        "   13 N5     USE_LENGTH_UNITS(CANON_UNITS_INCHES)\n"
        "   14 N..... SET_G5X_OFFSET(2, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "   15 N..... SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "   16 N..... SET_XY_ROTATION(0.0000)\n"
        "   17 N..... SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)\n"
        "   18 N..... OPTIONAL_PROGRAM_STOP()\n"
        "   19 N..... DWELL(0.5000)\n"
        "   20 N..... STOP_SPINDLE_TURNING(0)\n"
        "   21 N..... MIST_OFF()\n"
        "   22 N..... FLOOD_OFF()\n"
        "   23 N..... PROGRAM_STOP()\n"
        "   24 N..... SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "   25 N..... SET_XY_ROTATION(0.0000)\n"
        "   26 N..... SET_FEED_MODE(0, 0)\n"
        "   27 N..... SET_FEED_RATE(0.0000)\n"
        "   28 N..... STOP_SPINDLE_TURNING(0)\n"
        "   29 N..... PROGRAM_END()\n";
    EXPECT_EQ(out, expected);
}

TEST(GcodeCanon, PrintsMachineCoordinatesWhenAsked) {
    const CanonOptions options = {Coordinates::machine, false};
    const std::string out = printed("G10 L2 P1 X10\nG20 G0 X1\n", options);
    EXPECT_NE(out.find("STRAIGHT_TRAVERSE(35.4000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"), std::string::npos)
        << out;
}

}  // namespace motionrack::control::gcode
