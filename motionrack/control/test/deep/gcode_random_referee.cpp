// LinuxCNC's interpreter as the reference for random programs.
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/control/test/gcode_rs274.hpp>
#include <string>
#include <vector>

namespace motionrack::control::gcode {

using namespace testing::corpus;

namespace {

/// Returns a random value: a number, a parameter or an expression of them.
std::string value(int depth) {
    const int kind = depth == 0 ? *rc::gen::inRange(0, 2) : *rc::gen::inRange(0, 8);
    const auto sub = [&] { return value(depth - 1); };
    switch (kind) {
        case 0:
            return fmt::format("{}", *rc::gen::inRange(-400, 400) / 16.0);
        case 1:
            return fmt::format("#{}", *rc::gen::inRange(1, 5));
        case 2:
            return fmt::format("[{} + {}]", sub(), sub());
        case 3:
            return fmt::format("[{} - {} * {}]", sub(), sub(), *rc::gen::inRange(-3, 4));
        case 4:
            return fmt::format("[{} / {}]", sub(), *rc::gen::inRange(2, 9));
        case 5:
            return fmt::format("[{} MOD 7 + {}]", sub(), *rc::gen::inRange(0, 9));
        case 6:
            return fmt::format("ABS[{}]", sub());
        default:
            return fmt::format("[10 * SIN[{}]]", sub());
    }
}

/// Returns a random line, with rotated work systems (`turns`) or with G92: rs274 loses its position if a system is
/// rotated while G92 is on.
std::string line(bool turns) {
    const char* axes = "XYZ";
    const char axis = axes[*rc::gen::inRange(0, 3)];
    switch (*rc::gen::inRange(0, 6)) {
        case 0:
            return fmt::format("#{} = {}\n", *rc::gen::inRange(1, 5), value(2));
        case 1:
            return fmt::format("G0 {}{}\n", axis, value(2));
        case 2:
            return fmt::format("G1 {}{} {}\n", axis, value(1), axis == 'X' ? "Y" + value(1) : "");
        case 3:
            return fmt::format("G10 L2 P1 X{} Y{}{}\n", *rc::gen::inRange(-9, 9), *rc::gen::inRange(-9, 9),
                               turns ? fmt::format(" R{}", *rc::gen::inRange(-18, 18) * 10) : "");
        case 4:
            return *rc::gen::element<std::string>("G90\n", "G91\n", "G55\n", "G54\n", "G20\n", "G21\n",
                                                  turns ? "G54\n" : "G92 X1 Y2\n", turns ? "G55\n" : "G92.1\n");
        default: {
            const int radius = *rc::gen::inRange(1, 9);
            return fmt::format("G91 G2 X{} Y0 I{} J0 P2\nG90\n", 2 * radius, radius);
        }
    }
}

std::string body(int depth, int& label, bool turns) {
    std::string out;
    const int lines = *rc::gen::inRange(1, 5);
    for (int i = 0; i < lines; ++i) {
        const int kind = depth == 0 ? 0 : *rc::gen::inRange(0, 5);
        const int o = ++label;
        if (kind <= 2) out += line(turns);
        if (kind == 3)
            out += fmt::format("o{0} if [{1} GT 1]\n{2}o{0} else\n{3}o{0} endif\n", o, value(1),
                               body(depth - 1, label, turns), body(depth - 1, label, turns));
        if (kind == 4)
            out += fmt::format("o{0} repeat [{1}]\n{2}o{0} endrepeat\n", o, *rc::gen::inRange(1, 4),
                               body(depth - 1, label, turns));
    }
    return out;
}

/// Divides "(-12.3437,-25.0000)" into its words, at any of " (),".
std::vector<std::string> words_of(const std::string& calls) {
    std::vector<std::string> out(1);
    for (const char c : calls) {
        if (std::string(" (),\n").find(c) == std::string::npos)
            out.back() += c;
        else if (!out.back().empty())
            out.emplace_back();
    }
    return out;
}

/// Returns true for equal calls whose numbers may differ in the last digit. A value half-way between two is rounded by
/// its sixteenth digit, which the inverse rotation of a system changes.
bool are_same(const std::string& ours, const std::string& theirs) {
    constexpr double last_digit = 1.01e-4;
    const std::vector<std::string> a = words_of(ours), b = words_of(theirs);
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const std::string& x, const std::string& y) {
        if (x == y) return true;
        char *x_end = nullptr, *y_end = nullptr;
        const double of_x = std::strtod(x.c_str(), &x_end), of_y = std::strtod(y.c_str(), &y_end);
        return *x_end == 0 && *y_end == 0 && x_end != x.c_str() && std::fabs(of_x - of_y) <= last_digit;
    });
}

}  // namespace

TEST(GcodeReferee, AcceptsEqualCallsAsEqual) {
    EXPECT_TRUE(are_same("STRAIGHT_FEED(-12.3437, 0.0000)\n", "STRAIGHT_FEED(-12.3438, 0.0000)\n"));
    EXPECT_FALSE(are_same("STRAIGHT_FEED(-12.3437, 0.0000)\n", "STRAIGHT_FEED(-12.3439, 0.0000)\n"));
    EXPECT_FALSE(are_same("STRAIGHT_FEED(1.0000)\n", "STRAIGHT_TRAVERSE(1.0000)\n"));
    EXPECT_FALSE(are_same("STRAIGHT_FEED(1.0000)\n", "STRAIGHT_FEED(1.0000)\nDWELL(1.0000)\n"));
    EXPECT_FALSE(are_same("", "DWELL(1.0000)\n"));
}

TEST(GcodeReferee, Rs274GivesTheSameMovesForRandomPrograms) {
    if (!is_installed()) GTEST_SKIP() << "rs274 is not installed (Debian: linuxcnc-uspace)";
    Folder at;
    EXPECT_TRUE(rc::check([&] {
        int label = 0;
        const bool turns = *rc::gen::arbitrary<bool>();
        const std::string sub = fmt::format("o900 sub\n{}o900 endsub [#1 + 1]\n", body(1, label, turns));
        const std::string text =
            fmt::format("{}G21 G90 G17 F100\nG0 X0\n{}o900 call [1.5] [2.5]\nG0 X#<_value>\n{}M2\n", sub,
                        body(2, label, turns), body(1, label, turns));
        write(at.file("random.ngc"), text);
        const std::string theirs = motion_lines(of_rs274(at, "random", false));
        std::string ours;
        const auto done =
            print_canon(text, testing::machine("XYZABC", 1e8), {}, [&](std::string_view one) { ours += one; });
        RC_ASSERT(done.has_value());
        RC_LOG() << text;
        RC_ASSERT(are_same(motion_lines(ours), theirs));
    }));
}

}  // namespace motionrack::control::gcode
