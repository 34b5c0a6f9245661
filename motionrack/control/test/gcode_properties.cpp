// Properties: the same program written in other ways has the same meaning; rapidcheck prints the seed of a failure.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using testing::machine;
using testing::read;

struct Word {
    char letter;
    std::string number;
};
using Line = std::vector<Word>;

/// Generates the text of a number from -99.999 to 99.999 with up to three decimals.
rc::Gen<std::string> coordinate() {
    return rc::gen::map(rc::gen::inRange(-99'999, 100'000), [](int thousandths) {
        char text[32];
        std::snprintf(text, sizeof text, "%s%d.%03d", thousandths < 0 ? "-" : "", std::abs(thousandths) / 1000,
                      std::abs(thousandths) % 1000);
        return std::string(text);
    });
}

Line straight_line() {
    Line line = {{'G', *rc::gen::element<std::string>("0", "1", "01", "1.0")}};
    for (const char axis : axis_letters) {
        if (*rc::gen::inRange(0, 3) == 0) line.push_back({axis, *coordinate()});
    }
    line.push_back({'F', std::to_string(*rc::gen::inRange(1, 5000))});
    return line;
}

std::vector<Line> straight_program() {
    std::vector<Line> program;
    const int count = *rc::gen::inRange(1, 12);
    for (int i = 0; i < count; ++i) program.push_back(straight_line());
    return program;
}

std::string plain(const std::vector<Line>& program) {
    std::string text;
    for (const Line& line : program) {
        for (const Word& word : line) text += word.letter + word.number + ' ';
        text += '\n';
    }
    return text;
}

/// Returns the same words with blanks anywhere, letters of any case, comments, N words, and one of the three line ends.
std::string disguised(const std::vector<Line>& program) {
    const std::string line_end = *rc::gen::element<std::string>("\n", "\r\n", "\r");
    std::string text = *rc::gen::element<std::string>("", "\xEF\xBB\xBF");
    const auto blanks = [] {
        return std::string(static_cast<std::size_t>(*rc::gen::inRange(0, 3)), *rc::gen::element(' ', '\t'));
    };
    int number = 0;
    for (const Line& line : program) {
        if (*rc::gen::arbitrary<bool>()) text += blanks() + 'n' + std::to_string(++number);
        for (const Word& word : line) {
            text += blanks();
            text += *rc::gen::arbitrary<bool>() ? word.letter : static_cast<char>(word.letter | 0x20);
            for (const char c : word.number) text += blanks() + c;
            if (*rc::gen::inRange(0, 4) == 0) text += "(X1 G5)";
        }
        if (*rc::gen::arbitrary<bool>()) text += "; to the end ( $";
        text += line_end;
    }
    if (*rc::gen::arbitrary<bool>()) text.resize(text.size() - line_end.size());
    return text;
}

/// Returns a point of the circle about the origin, exact except for rounding, from the parametrisation without angles.
Point on_circle(double radius, double t, bool left) {
    const double x = radius * (1 - t * t) / (1 + t * t);
    return {left ? -x : x, radius * 2 * t / (1 + t * t), 0, 0, 0, 0};
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12f", value);
    return text;
}

}  // namespace

RC_GTEST_PROP(GcodeProperties, DisguisedProgramsReadTheSame, ()) {
    const auto program = straight_program();
    const auto first = read(plain(program));
    const auto second = read(disguised(program));
    RC_ASSERT(first.problems.empty());
    RC_ASSERT(second.problems.empty());
    const auto a = first.moves();
    const auto b = second.moves();
    RC_ASSERT(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        RC_ASSERT(testing::describe(a[i]) == testing::describe(b[i]));
        RC_ASSERT(a[i].line == b[i].line);
    }
}

RC_GTEST_PROP(GcodeProperties, IncrementalProgramsGoWhereAbsoluteOnesGo, ()) {
    std::string incremental = "G91 F100 G1\n";
    std::string absolute = "G90 F100 G1\n";
    std::array<int, 3> at = {};
    const int count = *rc::gen::inRange(1, 30);
    for (int i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const int step = *rc::gen::inRange(-5000, 5000);
            at[axis] += step;
            incremental += axis_letters[axis] + number(step / 1000.0) + ' ';
            absolute += axis_letters[axis] + number(at[axis] / 1000.0) + ' ';
        }
        incremental += '\n';
        absolute += '\n';
    }
    const auto a = read(absolute).moves();
    const auto b = read(incremental).moves();
    RC_ASSERT(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) RC_ASSERT(std::fabs(a[i].end[axis] - b[i].end[axis]) < 1e-9);
    }
}

RC_GTEST_PROP(GcodeProperties, InchesAreMillimetres, ()) {
    const double x = *rc::gen::inRange(-15'000, 15'000) / 1000.0;
    const double r = *rc::gen::inRange(100, 2'300) / 1000.0;  // the whole circle is within the limits
    const std::string inch = "G20 G0 X" + number(x) + " F10\nG2 I" + number(r) + " Z.5\nG1 Y1";
    const std::string mm = "G21 G0 X" + number(x * 25.4) + " F254\nG2 I" + number(r * 25.4) + " Z12.7\nG1 Y25.4";
    const auto a = read(inch).moves();
    const auto b = read(mm).moves();
    RC_ASSERT(a.size() == 3u);
    RC_ASSERT(b.size() == 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        RC_ASSERT(std::fabs(a[i].feed - b[i].feed) < 1e-9);
        RC_ASSERT(std::fabs(a[i].centre_first - b[i].centre_first) < 1e-9);
        for (int axis = 0; axis < 3; ++axis) RC_ASSERT(std::fabs(a[i].end[axis] - b[i].end[axis]) < 1e-9);
    }
}

RC_GTEST_PROP(GcodeProperties, ArcsWithRadiusHaveTheCentreOfArcsWithOffsets, ()) {
    const double radius = *rc::gen::inRange(1'000, 90'000) / 1000.0;
    const Point from = on_circle(radius, *rc::gen::inRange(-99, 100) / 100.0, *rc::gen::arbitrary<bool>());
    const Point to = on_circle(radius, *rc::gen::inRange(-99, 100) / 100.0, *rc::gen::arbitrary<bool>());
    const double chord = std::hypot(from[0] - to[0], from[1] - to[1]);
    RC_PRE(chord > radius * 0.01 && chord < radius * 1.99);
    const bool counter_clockwise = *rc::gen::arbitrary<bool>();
    const bool end_is_left = from[0] * to[1] - from[1] * to[0] > 0;
    const double signed_radius = counter_clockwise == end_is_left ? radius : -radius;
    const std::string start = "G0 X" + number(from[0]) + " Y" + number(from[1]) + " F99\n";
    const std::string arc = std::string(counter_clockwise ? "G3" : "G2") + " X" + number(to[0]) + " Y" + number(to[1]);
    const auto a = read(start + arc + " I" + number(-from[0]) + " J" + number(-from[1])).moves();
    const auto b = read(start + arc + " R" + number(signed_radius)).moves();
    RC_ASSERT(a.size() == 2u);
    RC_ASSERT(b.size() == 2u);
    RC_ASSERT(a[1].turns == b[1].turns);
    RC_ASSERT(a[1].end == b[1].end);
    RC_ASSERT(std::fabs(a[1].centre_first - b[1].centre_first) < 1e-6);
    RC_ASSERT(std::fabs(a[1].centre_second - b[1].centre_second) < 1e-6);
}

RC_GTEST_PROP(GcodeProperties, AnyBytesAreReadOrRefusedWithALocationInTheText, ()) {
    const std::string text = *rc::gen::container<std::string>(
        rc::gen::oneOf(rc::gen::element('G', 'X', 'Y', 'I', 'R', 'F', '0', '1', '2', '3', '8', '.', '-', ' ', '\n', '(',
                                        ')', '/', '%'),
                       rc::gen::arbitrary<char>()));
    const auto program = read(text);
    for (const Problem& problem : program.problems) {
        RC_ASSERT(problem.location.line >= 1);
        RC_ASSERT(problem.location.column >= 1);
        RC_ASSERT(!problem.message.empty());
        RC_ASSERT(problem.status != GrblStatus::none);
    }
    for (const Move& move : program.moves()) {
        for (const double value : move.end) RC_ASSERT(std::fabs(value) <= 500 + limit_slack);
    }
}

}  // namespace motionrack::control::gcode
