// Jobs with requests during the run, evaluated by the pulses on the wires.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/command_schedule.hpp>
#include <string>
#include <tests/invariants/watch.hpp>
#include <tests/journey.hpp>
#include <tests/known_breaches.hpp>
#include <tests/pulse_referee.hpp>
#include <utility>
#include <vector>

namespace motionrack::rack {

struct Driven {
    JobOutcome outcome;
    test::PulseReferee::Verdict worst;
    double peak_accel_factor = 0;  ///< see Invariants
    bool held = false;             ///< a hold has stopped the program on its way
};

/// Seconds since the start, and the request at that instant.
using Wishes = std::vector<std::pair<double, std::string>>;

/// Sets a flag at its instant, as a signal may arrive at any time.
class FlagAt final : public sim::Device {
  public:
    FlagAt(sim::Kernel& kernel, Instant at) : kernel_(kernel) {
        kernel_.schedule(kernel_.add(*this, sim::Phase::observers, "flag"), at);
    }
    void on_scheduled(Instant) override { flag_ = true; }
    const std::atomic<bool>& flag() const { return flag_; }

  private:
    sim::Kernel& kernel_;
    std::atomic<bool> flag_{false};
};

/// Runs a program with requests at given instants. A request is a command of the job; "ctrl-c", which the job checks
/// between two runs of the kernel; or "flag" (only without other requests), as a program with its own job sets it.
/// `slice`: called throughout the run. `known`: known breaches of the run, in addition to those of its profile.
/// `accel_parts`: see PulseReferee.
inline Driven drive_with(const RackConfig& config, const std::string& program, const Wishes& wishes,
                         const std::function<void(Rack&)>& slice = {}, const test::LimitFactors& known = {},
                         double accel_parts = 1) {
    Rack rack(config);
    std::vector<ScheduledText> texts;
    Instant ctrl_c = never, flag_at = never;
    for (const auto& [seconds, action] : wishes) {
        const Instant at = Instant{} + from_seconds(seconds);
        if (action == "ctrl-c")
            ctrl_c = at;
        else if (action == "flag")
            flag_at = at;
        else
            texts.push_back({at, action, action});
    }
    auto plan = CommandSchedule::create(rack, texts);
    EXPECT_TRUE(plan);
    FlagAt flag(rack.kernel(), flag_at);
    const test::LimitFactors of_profile =
        config.jerk_limited() ? test::LimitFactors() : test::known_breaches("trapezoid");
    test::RackWatch watch(rack, test::fail_test, test::larger_of(of_profile, known));
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    if (flag_at == never)
        settings.commands = plan->get();
    else
        settings.stop = &flag.flag();
    settings.on_slice = [&] {
        if (rack.kernel().now() >= ctrl_c) (*plan)->ask_stop();
        if (slice) slice(rack);
        watch.poll();
    };
    Job job(rack, settings);
    test::PulseReferee referee(rack);
    rack.start();
    (*plan)->begin();
    Driven out;
    out.outcome = job.run();
    out.worst = referee.verdict(accel_parts);
    out.peak_accel_factor = watch.invariants().peak_accel_factor();
    if (!config.jerk_limited())
        test::ReachedFactors::of_program().add(known.max_accel > 1 ? "random_trapezoids" : "trapezoid",
                                               {out.peak_accel_factor, 1});
    return out;
}

/// Sets the microsteps of the drives; the motors keep their limits in full steps per second.
inline void set_microsteps(RackConfig& config, std::int64_t microsteps) {
    for (RackAxis& axis : config.axes) {
        const double times = static_cast<double>(microsteps) / static_cast<double>(axis.microsteps);
        axis.microsteps = microsteps;
        axis.motor.start_stop_hz *= times;
        axis.motor.pull_out_hz *= times;
    }
}

/// Expects no velocity step, by the pulses and by the monitor, and no other breach or loss.
inline void expect_lossless(const Driven& driven, double jump = 1.15) {
    EXPECT_LE(driven.worst.parts, jump) << "axis " << driven.worst.axis << ": " << driven.worst.jump.velocity
                                        << " units/s at " << driven.worst.jump.seconds << " s";
    for (const Breach& breach : driven.outcome.breaches.all()) ADD_FAILURE() << sentence_of(breach);
    EXPECT_TRUE(driven.outcome.position_valid);
    for (const AxisOutcome& axis : driven.outcome.axes)
        EXPECT_EQ(axis.pulses_net, axis.pulse_position - axis.pulse_start);
}

/// Expects that a program ends at X and Y, within half a pulse.
inline void expect_end(const Driven& driven, double x, double y) {
    ASSERT_TRUE(driven.outcome.ended) << driven.outcome.ended.error().text();
    const auto pulse = [&](std::size_t i) { return 0.51 / driven.outcome.axes[i].limits.pulses_per_unit; };
    EXPECT_NEAR(driven.outcome.axes[0].planned_end, x, pulse(0));
    EXPECT_NEAR(driven.outcome.axes[1].planned_end, y, pulse(1));
}

}  // namespace motionrack::rack
