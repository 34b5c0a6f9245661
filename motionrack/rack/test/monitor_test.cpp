// The monitor compares the pulses with the program as written, not with the plan.
#include <gtest/gtest.h>

#include <motionrack/rack/monitor.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>

namespace motionrack::rack {
namespace {

constexpr double pulses_of_mm = 640, allowed_mm = 0.005;
constexpr Duration each_pulse = microseconds(100);  // 15.625 mm/s

/// A monitored rack of X and Y whose pulses follow motion laws.
class Watch {
  public:
    Watch(std::vector<sim::PulseLaw> x, std::vector<sim::PulseLaw> y)
        : x_(kernel_, std::move(x), "x"),
          y_(kernel_, std::move(y), "y"),
          monitor_(kernel_, {axis(0, x_), axis(1, y_)}, milliseconds(1), 10'000) {
        monitor_.set_allowed_deviation(allowed_mm);
    }
    void line(double x, double y, std::int32_t number) {
        control::Move move;
        move.kind = control::MoveKind::feed;
        move.path = control::PathControl::continuous;
        move.tolerance_mm = 0.05;
        move.line = number;
        move.index = moves_++;
        move.end = {x, y};
        monitor_.programmed(move, at_);
        at_ = move.end;
    }
    /// Reports a planned move to (x, y) that starts at `at` and belongs to the programmed move `index`.
    void plan(double x, double y, std::int64_t index, std::int32_t line, Instant at) {
        control::PlannedMove planned;
        planned.move.index = index;
        planned.move.line = line;
        planned.move.end = {x, y};
        monitor_.planned(blocks_, planned);
        monitor_.started({{blocks_++, line, at}});
    }
    const Monitor& run(Duration time) {
        kernel_.start();
        monitor_.begin();
        kernel_.run_until(time);
        monitor_.finish();
        return monitor_;
    }

  private:
    static WatchedAxis axis(int index, sim::FakePulses& pulses) {
        WatchedAxis out;
        out.index = index;
        out.commanded = &pulses;
        out.real = &pulses;
        out.pulses_per_unit = pulses_of_mm;
        return out;
    }
    sim::Kernel kernel_;
    sim::FakePulses x_, y_;
    Monitor monitor_;
    control::Point at_ = {};
    std::int64_t moves_ = 0, blocks_ = 0;
};

/// Returns a motion of 10 mm along X, then 10 mm along Y, with both axes moving for `cut` at the corner.
Watch corner(Duration cut) {
    const Duration side = each_pulse * 6'400;
    return Watch({{Instant{}, each_pulse, 1}, {side, each_pulse, 0}},
                 {{side - cut, each_pulse, 1}, {2 * side - cut, each_pulse, 0}});
}

TEST(Monitor, ComparesTheMachineWithTheProgramAndNotWithThePlan) {
    const Duration side = each_pulse * 6'400, cut = milliseconds(32);  // 0.5 mm
    Watch watch = corner(cut);
    watch.line(10, 0, 3);
    watch.line(10, 10, 4);
    // The plan equals the motion.
    watch.plan(9.5, 0, 0, 3, Instant{});
    watch.plan(10, 0.5, 0, 3, side - cut);
    watch.plan(10, 10, 1, 4, side);
    const Monitor& monitor = watch.run(2 * side);
    EXPECT_NEAR(monitor.max_deviation().mm, 0.25, 0.02);
    ASSERT_EQ(monitor.breaches().size(), 1u);
    const Breach& breach = monitor.breaches().front();
    EXPECT_EQ(breach.kind, BreachKind::deviation);
    EXPECT_NEAR(breach.value, 0.25, 0.02);
    EXPECT_NEAR(breach.limit, 0.05 + allowed_mm, 1e-12);
    EXPECT_NEAR(to_seconds(breach.at), to_seconds(side - cut / 2), 0.002);
    EXPECT_EQ(breach.line, 3);
    EXPECT_NEAR(breach.position[0], 9.75, 0.03);
    EXPECT_NEAR(breach.position[1], 0.25, 0.03);
    EXPECT_EQ(breach.times, 1) << "once left, once told";
}

TEST(Monitor, AcceptsCornersWithinTheirTolerance) {
    Watch watch = corner(milliseconds(6));  // 0.094 mm, thus 0.047 mm from each side
    watch.line(10, 0, 3);
    watch.line(10, 10, 4);
    watch.plan(10, 10, 0, 3, Instant{});
    const Monitor& monitor = watch.run(each_pulse * 12'800);
    EXPECT_NEAR(monitor.max_deviation().mm, 0.047, 0.003);
    EXPECT_TRUE(monitor.breaches().empty());
}

TEST(Monitor, ComparesAMergedLineWithEachOfItsMoves) {
    const Duration side = each_pulse * 6'400;
    Watch watch({{Instant{}, each_pulse, 1}, {side, each_pulse, 0}}, {});
    watch.line(5, 0.2, 7);
    watch.line(10, 0, 8);
    watch.plan(10, 0, 0, 7, Instant{});
    const Monitor& monitor = watch.run(side);
    EXPECT_NEAR(monitor.max_deviation().mm, 0.2, 0.002) << "the place where the moves meet";
    ASSERT_EQ(monitor.breaches().size(), 1u);
    EXPECT_NEAR(to_seconds(monitor.breaches()[0].at), to_seconds(side / 2), 0.002);
}

}  // namespace
}  // namespace motionrack::rack
