// Sequences of corners: time gained by the corner tolerance and by a higher jerk.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_checks.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>
#include <string>
#include <vector>

namespace motionrack::control {
namespace {

using curve_test::line_to;

constexpr std::array<double, 7> tolerances = {0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2};
constexpr std::array<double, 7> jerks = {5e3, 1e4, 2e4, 4e4, 8e4, 1.6e5, 1e6};

MachineLimits machine(double jerk) {
    MachineLimits limits = curve_test::machine();
    for (AxisLimits& axis : limits) axis.max_accel = 2000, axis.max_jerk = jerk;
    limits[0].max_accel = 1500;
    return limits;
}

struct Row {
    std::string name;
    double along, up_and_along, up;  ///< mm: X of a line; X and Y of the next one
};
void PrintTo(const Row& row, std::ostream* out) {
    *out << row.name;
}
const std::vector<Row> rows = {{"comb", 3, 0, 10},
                               {"narrow comb", 0.5, 0, 2},
                               {"zigzag", 0, 5, 5},
                               {"small zigzag", 0, 1, 1},
                               {"flat zigzag", 0, 5, 2}};

std::vector<Move> moves_of(const Row& row, double tolerance) {
    std::vector<Move> out;
    double x = 0;
    for (int i = 0; i < 24; ++i) {
        const double up = i % 2 == 0 ? row.up : 0;
        if (row.along > 0) out.push_back(line_to({x += row.along, row.up - up}, tolerance));
        out.push_back(line_to({x += row.up_and_along, up}, tolerance));
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i].line = static_cast<std::int32_t>(i + 1);
    return out;
}

class CornerSequence : public testing::TestWithParam<Row> {};

TEST_P(CornerSequence, KeepsLimitsAndToleranceAtEveryInstant) {
    for (const double jerk : jerks)
        for (const double tolerance : tolerances) {
            const trajectory_test::WildProgram program{machine(jerk), {}, moves_of(GetParam(), tolerance)};
            const trajectory_test::Fault fault = trajectory_test::fault_of(program);
            EXPECT_EQ(fault.name, "") << fault.text << ", jerk " << jerk << ", tolerance " << tolerance;
        }
}

TEST_P(CornerSequence, IsNotSlowerWithMoreTolerance) {
    for (const double jerk : jerks) {
        double before = trajectory_test::seconds_stopping(moves_of(GetParam(), 0), machine(jerk));
        for (const double tolerance : tolerances) {
            const double seconds = trajectory_test::trajectory_seconds(moves_of(GetParam(), tolerance), machine(jerk));
            EXPECT_LE(seconds, 1.01 * before) << "jerk " << jerk << ", tolerance " << tolerance;
            before = std::min(before, seconds);
        }
    }
}

TEST_P(CornerSequence, IsNotSlowerWithMoreJerk) {
    for (const double tolerance : tolerances) {
        double before = std::numeric_limits<double>::infinity();
        for (const double jerk : jerks) {
            const double seconds = trajectory_test::trajectory_seconds(moves_of(GetParam(), tolerance), machine(jerk));
            EXPECT_LE(seconds, 1.01 * before) << "jerk " << jerk << ", tolerance " << tolerance;
            before = std::min(before, seconds);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, CornerSequence, testing::ValuesIn(rows), [](const auto& row) {
    std::string name = row.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

double gain_of(const Row& row, double tolerance, double jerk) {
    return 1 - trajectory_test::trajectory_seconds(moves_of(row, tolerance), machine(jerk)) /
                   trajectory_test::seconds_stopping(moves_of(row, 0), machine(jerk));
}

TEST(Corner, IsFasterThanAStopForAlternatingAxesAndForOneContinuousAxis) {
    EXPECT_GT(gain_of(rows[0], 0.05, 1.6e5), 0.12);
    EXPECT_GT(gain_of(rows[2], 0.2, 4e4), 0.15);
    EXPECT_GT(gain_of(rows[3], 0.02, 4e4), 0.10);
}

}  // namespace
}  // namespace motionrack::control
