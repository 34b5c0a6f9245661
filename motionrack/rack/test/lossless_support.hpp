// Jobs with wishes on their way, judged by the pulses on the wires.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/order_plan.hpp>
#include <string>
#include <tests/journey.hpp>
#include <tests/pulse_referee.hpp>
#include <utility>
#include <vector>

namespace motionrack::rack {

struct Driven {
    JobOutcome outcome;
    test::PulseReferee::Verdict worst;
    bool held = false;  ///< stood on its way because of a hold
};

/// Seconds since the start, and what is wished then.
using Wishes = std::vector<std::pair<double, std::string>>;

/// `slice`: called all the time while it runs. `accel_parts`: see PulseReferee.
inline Driven drive_with(const RackConfig& config, const std::string& program, const Wishes& wishes,
                         const std::function<void(Rack&)>& slice = {}, double accel_parts = 1) {
    Rack rack(config);
    std::vector<TimedText> texts;
    for (const auto& [seconds, action] : wishes) texts.push_back({Instant{} + from_seconds(seconds), action, action});
    auto plan = OrderPlan::create(rack, texts);
    EXPECT_TRUE(plan);
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    settings.orders = plan->get();
    if (slice) settings.on_slice = [&] { slice(rack); };
    Job job(rack, settings);
    test::PulseReferee referee(rack);
    rack.start();
    (*plan)->begin();
    Driven out;
    out.outcome = job.run();
    out.worst = referee.verdict(accel_parts);
    return out;
}

/// The same motors with other drives.
inline void set_microsteps(RackConfig& config, std::int64_t microsteps) {
    for (RackAxis& axis : config.axes) {
        const double times = static_cast<double>(microsteps) / static_cast<double>(axis.microsteps);
        axis.microsteps = microsteps;
        axis.motor.start_stop_hz *= times;
        axis.motor.pull_out_hz *= times;
    }
}

/// No axis jumped, by the pulses and by the monitor, and nothing else was broken or lost.
inline void expect_lossless(const Driven& driven, double jump = 1.15) {
    EXPECT_LE(driven.worst.parts, jump) << "axis " << driven.worst.axis << ": " << driven.worst.jump.speed
                                        << " units/s at " << driven.worst.jump.seconds << " s";
    for (const Breach& breach : driven.outcome.breaches.all()) ADD_FAILURE() << sentence_of(breach);
    EXPECT_TRUE(driven.outcome.position_trusted);
    for (const AxisOutcome& axis : driven.outcome.axes)
        EXPECT_EQ(axis.pulses_net, axis.pulse_position - axis.pulse_start);
}

/// Where a program of G1 X.. Y.. ends.
inline void expect_end(const Driven& driven, double x, double y) {
    ASSERT_TRUE(driven.outcome.ended) << driven.outcome.ended.error().text();
    const auto pulse = [&](std::size_t i) { return 0.51 / driven.outcome.axes[i].limits.pulses_per_unit; };
    EXPECT_NEAR(driven.outcome.axes[0].planned_end, x, pulse(0));
    EXPECT_NEAR(driven.outcome.axes[1].planned_end, y, pulse(1));
}

}  // namespace motionrack::rack
