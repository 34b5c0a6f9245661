// Tests of profiles against their own derivatives and limits, and of loops closed through the frames of a scale on a
// stage, with frames in time and late.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <deque>
#include <motionrack/cards/grating_bus/processor/profile.hpp>
#include <motionrack/cards/grating_bus/processor/servo_loop.hpp>
#include <motionrack/sim/parts/linear_scale.hpp>
#include <motionrack/sim/parts/linear_stage.hpp>

namespace motionrack::grating_bus {
namespace {

const MotionLimits limits{8e7, 5e9, 1e12};  // 80 mm/s, 5 m/s2, 1000 m/s3

/// Checks that velocity, acceleration and jerk of a profile stay within the limits, and that each is the derivative of
/// the previous one.
template <class Profile>
void check(const Profile& profile, double until, const MotionLimits& max_motion) {
    const double h = 1e-6;
    Setpoint before = profile.at(0);
    for (double t = h; t < until; t += h) {
        const Setpoint here = profile.at(t);
        ASSERT_NEAR((here.position_nm - before.position_nm) / h, (here.speed_nm_s + before.speed_nm_s) / 2, 2.0) << t;
        ASSERT_NEAR((here.speed_nm_s - before.speed_nm_s) / h, (here.accel_nm_s2 + before.accel_nm_s2) / 2,
                    max_motion.jerk_nm_s3 * h)
            << t;
        ASSERT_LE(std::fabs(here.speed_nm_s), max_motion.speed_nm_s * (1 + 1e-9)) << t;
        ASSERT_LE(std::fabs(here.accel_nm_s2), max_motion.accel_nm_s2 * (1 + 1e-9)) << t;
        ASSERT_LE(std::fabs(here.accel_nm_s2 - before.accel_nm_s2), max_motion.jerk_nm_s3 * h * (1 + 1e-6)) << t;
        before = here;
    }
}

TEST(ScanProfile, MovesBackAndForthWithinItsLimitsAndAtConstantVelocityBetween) {
    const ScanProfile scan(-1e6, 3e6, limits);
    check(scan, scan.lead_s() + 2 * scan.period_s(), limits);
    EXPECT_EQ(scan.at(-1).position_nm, scan.start_nm());
    EXPECT_EQ(scan.at(-1).speed_nm_s, 0);
    EXPECT_NEAR(scan.at(scan.lead_s()).position_nm, -1e6, 1e-3);
    EXPECT_NEAR(scan.at(scan.lead_s() + scan.period_s()).position_nm, -1e6, 1e-3);
    int scanning = 0, total = 0;
    for (double t = scan.lead_s(); t < scan.lead_s() + scan.period_s(); t += 1e-5, ++total) {
        const Setpoint s = scan.at(t);
        const bool between = s.position_nm > -1e6 + 1 && s.position_nm < 3e6 - 1;
        if (between) {
            EXPECT_TRUE(scan.scanning(t));
        }
        if (!scan.scanning(t)) continue;
        ++scanning;
        EXPECT_EQ(std::fabs(s.speed_nm_s), 8e7);
    }
    EXPECT_NEAR(scanning * 1e-5, 2 * 4e6 / 8e7, 3e-5);
    EXPECT_LT(scanning, total);
}

TEST(ScanProfile, SmallVelocityChangesNeverReachTheMaximumAcceleration) {
    const MotionLimits slow{1e6, 5e9, 1e12};
    check(ScanProfile(0, 1e4, slow), 0.1, slow);
}

TEST(StepProfile, StepsUpAndDownAndStops) {
    const StepProfile steps(1e6, -2e5, 3, 0.04, limits);
    check(steps, 0.5, limits);
    const double at[] = {1e6, 8e5, 6e5, 4e5, 6e5, 8e5, 1e6, 8e5};
    for (int i = 0; i < 7; ++i) {
        EXPECT_NEAR(steps.at(i * 0.04 + 1e-9).position_nm, at[i], 1e-3) << i;
        EXPECT_NEAR(steps.at(i * 0.04 + 0.039).position_nm, at[i + 1], 1e-3) << i;
        EXPECT_EQ(steps.at(i * 0.04 + 0.039).speed_nm_s, 0);
        EXPECT_GT(steps.settled_s(i * 0.04 + 0.039), 0);
        EXPECT_LT(steps.settled_s(i * 0.04 + 0.001), 0);
    }
    const StepProfile far(0, 5e7, 1, 1.0, limits);
    check(far, 0.99, limits);
    EXPECT_NEAR(far.move_s(), 5e7 / 8e7 + 8e7 / 5e9 + 5e9 / 1e12, 1e-9);
}

RC_GTEST_PROP(StepProfile, EndsWhereItShould, ()) {
    MotionLimits any{1e5 * *rc::gen::inRange(1, 1'000), 1e8 * *rc::gen::inRange(1, 100),
                     1e11 * *rc::gen::inRange(1, 100)};
    const double step_nm = 10.0 * *rc::gen::inRange(1, 100'000);
    const StepProfile steps(0, step_nm, 2, 100, any);
    RC_ASSERT(std::fabs(steps.at(steps.move_s()).position_nm - step_nm) < 1e-6 * step_nm + 1e-3);
    RC_ASSERT(steps.at(steps.move_s() / 2).speed_nm_s <= any.speed_nm_s * (1 + 1e-9));
    RC_ASSERT(std::fabs(steps.at(steps.move_s() / 2).position_nm - step_nm / 2) < 1e-6 * step_nm + 1e-3);
}

// ---- loops

constexpr Duration servo_period = microseconds(200);

/// One axis: a stage with its scale, and a loop whose frames may arrive late or hold counts of another instant.
struct Axis {
    explicit Axis(double bandwidth_hz = 250, const parts::LinearStageSettings& stage_settings = {})
        : stage(kernel, "x", stage_settings), scale(kernel, "s", stage), loop(settings(bandwidth_hz, stage_settings)) {
        kernel.start();
        loop.close();
    }
    ServoSettings settings(double bandwidth_hz, const parts::LinearStageSettings& s) const {
        ServoSettings out;
        out.scale = 7;
        out.nm_per_count = scale.nm_per_count();
        out.gains = tuned(bandwidth_hz, s.accel_per_volt, s.viscous_friction);
        return out;
    }
    Frame latch(Instant time) {
        Frame frame;
        frame.time = time.count();
        frame.sequence = sequence++;
        frame.words = 3;
        const std::size_t word = frame.sequence % 3;  // the word position of the scale varies
        for (std::size_t k = 0; k < 3; ++k) frame.addresses[k] = k == word ? 7 : static_cast<std::uint8_t>(k);
        frame.counts[word] = static_cast<std::uint32_t>(scale.count(kernel.now()));
        frame.crc = crc_of(frame);
        return frame;
    }
    /// Runs `seconds` with frames that are used `late` periods after their instant and whose counts were latched `skew`
    /// after it. Returns the maximum true distance from the profile at the frames' instants.
    template <class Profile>
    double run(const Profile& profile, double seconds, std::size_t late = 0, Duration skew = Duration{0}) {
        double max_error = 0;
        for (const Instant until = kernel.now() + from_seconds(seconds); next < until; next += servo_period) {
            kernel.run_until(next);
            max_error =
                std::max(max_error, std::fabs(profile.at(to_seconds(next)).position_nm - stage.position_nm(next)));
            kernel.run_until(next + skew);
            under_way.push_back(latch(next));
            kernel.run_until(next + microseconds(20));
            if (under_way.size() <= late) continue;
            const Frame frame = under_way.front();
            under_way.pop_front();
            drive(loop.on_frame(frame, wanted_at(profile, to_seconds(frame.instant()), to_seconds(servo_period))));
        }
        return max_error;
    }
    void drive(double volts) {
        kernel.set_wire(stage.drive_wire(), static_cast<int>(std::lround(volts * 1e6)));
        kernel.settle();
    }

    sim::Kernel kernel;
    parts::LinearStage stage;
    parts::LinearScale scale;
    ServoLoop loop;
    Instant next{};
    std::uint32_t sequence = 0;
    std::deque<Frame> under_way;
};

TEST(ServoLoop, FollowsAScanWithinAFewTensOfNanometres) {
    Axis axis;
    const ScanProfile scan(2e6, 12e6, limits);
    const double to_start = scan.start_nm();
    axis.stage.fault("motor.push", to_start, axis.kernel.now());
    axis.loop.close(axis.scale.count(axis.kernel.now()));
    axis.run(scan, 0.1);
    axis.loop.reset_error();
    const double max_error = axis.run(scan, 1.0);
    EXPECT_LT(axis.loop.error().peak_nm, 60);
    EXPECT_LT(axis.loop.error().rms_nm(), 20);
    EXPECT_GT(axis.loop.error().rms_nm(), 0.5) << "a scale of 4.9 nm cannot be followed better";
    EXPECT_LT(max_error, 60);
    EXPECT_EQ(axis.loop.error().frames, 5'000u);
    EXPECT_EQ(axis.loop.unused(), 0u);
    EXPECT_TRUE(axis.scale.counts_valid());
}

TEST(ServoLoop, SettlesAfterAStepAndHoldsAgainstFriction) {
    parts::LinearStageSettings s;
    s.viscous_friction = 2;
    s.coulomb_friction = 0.02;
    Axis axis(250, s);
    const StepProfile steps(0, 1e6, 2, 0.2, limits);
    for (int i = 0; i < 5; ++i) {
        axis.run(steps, 0.1);  // the move takes 33 ms
        axis.loop.reset_error();
        axis.run(steps, 0.1);
        EXPECT_LT(axis.loop.error().peak_nm, 50) << i;
        EXPECT_TRUE(axis.loop.closed());
    }
}

TEST(ServoLoop, LosesStabilityWithLateFrames) {
    const StepProfile steps(0, 1e5, 1, 1, limits);
    double max_error[4] = {};
    for (std::size_t late = 0; late < 4; ++late) {
        Axis axis;
        axis.run(steps, 0.6, late);
        axis.loop.reset_error();
        axis.run(steps, 0.2, late);
        max_error[late] = axis.loop.error().peak_nm;
    }
    EXPECT_LT(max_error[0], 10) << "at rest: two counts";
    EXPECT_LT(max_error[1], 20);
    EXPECT_GT(max_error[3], 1e4) << "a loop of 250 Hz has no margin left with three periods";
    EXPECT_LE(max_error[0], max_error[1]);
    EXPECT_LT(max_error[1], max_error[3]);
    // During a move, a delay of one period already matters.
    double moving[3] = {};
    for (std::size_t late = 0; late < 3; ++late) {
        Axis axis;
        moving[late] = axis.run(StepProfile(0, 1e6, 1, 1, limits), 0.05, late);
    }
    EXPECT_GT(moving[1], 3 * moving[0]);
    EXPECT_GT(moving[2], 1.5 * moving[1]);
}

TEST(ServoLoop, CountsOfAnotherInstantAreAPositionErrorThatTheLoopCannotDetect) {
    const ScanProfile scan(2e6, 20e6, limits);
    for (const std::int64_t us : {1, 5, 20}) {
        Axis axis;
        axis.stage.fault("motor.push", scan.start_nm(), axis.kernel.now());
        axis.loop.close(axis.scale.count(axis.kernel.now()));
        axis.run(scan, 0.12, 0, microseconds(us));
        axis.loop.reset_error();
        const double max_error = axis.run(scan, 0.1, 0, microseconds(us));
        EXPECT_LT(axis.loop.error().peak_nm, 20);
        EXPECT_NEAR(max_error, static_cast<double>(us) * 80, 20) << "80 mm/s are 80 nm in a microsecond";
    }
}

TEST(ServoLoop, StaleDataOpenTheLoopUntilItIsClosedAgain) {
    Axis axis;
    const StepProfile steps(0, 1e6, 1, 1, limits);
    axis.run(steps, 0.01);
    EXPECT_NE(axis.loop.volts(), 0);
    EXPECT_EQ(axis.loop.on_stale(), 0);
    EXPECT_FALSE(axis.loop.closed());
    axis.run(steps, 0.01);
    EXPECT_EQ(axis.loop.volts(), 0) << "frames that come later do not close it";
    EXPECT_EQ(axis.loop.on_stale(), 0);
    EXPECT_EQ(axis.loop.state(), LoopState::stale);
    // Without voltage the stage coasts. The test stops it and closes the loop at its position.
    axis.stage.fault("motor.stall", 1, axis.kernel.now());
    axis.stage.fault("motor.stall", 0, axis.kernel.now());
    axis.loop.close(axis.scale.count(axis.kernel.now()));
    const StepProfile here(axis.stage.position_nm(axis.kernel.now()), 10, 1, 1, limits);
    axis.run(here, 0.2);
    axis.loop.reset_error();
    axis.run(here, 0.1);
    EXPECT_LT(axis.loop.error().peak_nm, 20);
    EXPECT_TRUE(axis.loop.closed());
}

TEST(ServoLoop, OpensOnExcessiveFollowingError) {
    Axis axis;
    ServoSettings s = axis.loop.settings();
    s.max_following_error_nm = 2'000;
    axis.loop = ServoLoop(s);
    EXPECT_EQ(axis.loop.state(), LoopState::not_begun);
    axis.loop.close();
    const StepProfile steps(0, 1e6, 1, 1, limits);
    axis.run(steps, 0.02);
    EXPECT_TRUE(axis.loop.closed());
    axis.scale.fault("scale.lose", 1'000, axis.kernel.now());
    axis.run(steps, 0.001);
    EXPECT_EQ(axis.loop.state(), LoopState::too_far);
    EXPECT_EQ(axis.loop.volts(), 0);
    EXPECT_EQ(axis.loop.on_stale(), 0);
    EXPECT_EQ(axis.loop.state(), LoopState::too_far) << "what opened it first stays";
}

TEST(ServoLoop, OpensWhenTwoConsecutiveFramesLackItsScale) {
    Axis axis;
    axis.kernel.run_until(servo_period);
    const double volts = axis.loop.on_frame(axis.latch(servo_period), {1'000, 0, 0});
    EXPECT_GT(volts, 0);
    const auto without = [&axis](int period) {
        Frame frame = axis.latch(period * servo_period);
        for (std::uint8_t& address : frame.addresses) address = address == 7 ? 8 : address;
        frame.crc = crc_of(frame);
        return frame;
    };
    EXPECT_EQ(axis.loop.on_frame(without(2), {1'000, 0, 0}), volts);
    EXPECT_TRUE(axis.loop.closed());
    EXPECT_NE(axis.loop.on_frame(axis.latch(3 * servo_period), {1'000, 0, 0}), 0);
    EXPECT_NE(axis.loop.on_frame(without(4), {1'000, 0, 0}), 0);
    EXPECT_EQ(axis.loop.on_frame(without(5), {1'000, 0, 0}), 0) << "the host reads other scales";
    EXPECT_EQ(axis.loop.state(), LoopState::stale);
    EXPECT_EQ(axis.loop.unused(), 3u);
}

TEST(ServoLoop, InvalidAndRepeatedFramesAreCountedAndNotUsed) {
    Axis axis;
    axis.kernel.run_until(servo_period);
    Frame frame = axis.latch(servo_period);
    const Setpoint wanted{1'000, 0, 0};
    const double volts = axis.loop.on_frame(frame, wanted);
    EXPECT_GT(volts, 0);
    EXPECT_EQ(axis.loop.on_frame(frame, {5'000, 0, 0}), volts) << "the same once more";
    Frame later = axis.latch(2 * servo_period);
    later.counts[1] += 1'000;
    EXPECT_EQ(axis.loop.on_frame(later, wanted), volts) << "damaged";
    later.words = 1;
    later.crc = crc_of(later);
    EXPECT_EQ(axis.loop.on_frame(later, wanted), volts) << "without this scale";
    EXPECT_EQ(axis.loop.unused(), 3u);
    EXPECT_EQ(axis.loop.error().frames, 1u);
    ServoSettings limited = axis.loop.settings();
    limited.limit_v = 0.01;
    ServoLoop weak(limited);
    weak.close();
    EXPECT_EQ(weak.on_frame(frame, {1e9, 0, 0}), 0.01);
    // The count of a scale wraps at 32 bits: the loop takes the count nearest to the last one.
    ServoLoop far(axis.loop.settings());
    far.close(5'000'000'000);
    frame.counts[0] = static_cast<std::uint32_t>(5'000'000'123);
    frame.crc = crc_of(frame);
    far.on_frame(frame, {});
    EXPECT_EQ(far.count(), 5'000'000'123);
}

}  // namespace
}  // namespace motionrack::grating_bus
