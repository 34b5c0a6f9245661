// A part program on the router, and the limits that every job must observe.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/template.hpp>
#include <string>
#include <tests/environment.hpp>

namespace motionrack::rack {

/// Returns the template with the given profile of the path velocity.
inline RackConfig router(const std::string& profile = "trapezoid") {
    RackConfig config = *read_rack_text(*rack_template("router")).config;
    config.controller.profile = profile;
    return config;
}

struct Done {
    JobOutcome outcome;
    std::uint64_t state_hash = 0;
};

/// `slice`: called repeatedly during the run.
inline Done drive(const RackConfig& config, const std::string& program, const std::atomic<bool>* stop = nullptr,
                  const std::function<void(const Rack&)>& slice = {}) {
    Rack rack(config);
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    settings.stop = stop;
    if (slice) settings.on_slice = [&] { slice(rack); };
    Job job(rack, settings);
    rack.start();
    Done done;
    done.outcome = job.run();
    done.state_hash = rack.kernel().state_hash();
    return done;
}

/// `jump`: allowed velocity step of an axis, relative to its limit. 0: not checked, for moves so short that one pulse
/// more or less changes their mean rate by that much.
inline void expect_limits(const JobOutcome& outcome, double jump = 1.15) {
    EXPECT_TRUE(outcome.position_valid);
    for (const AxisOutcome& axis : outcome.axes) {
        EXPECT_EQ(axis.pulses_net, axis.pulse_position - axis.pulse_start) << axis.index;
        EXPECT_EQ(axis.encoder_counts, axis.expected_counts) << axis.index;
        EXPECT_EQ(axis.lost_pulses, 0) << axis.index;
        EXPECT_LE(axis.top.peak_velocity, axis.limits.max_velocity * 1.001) << axis.index;
        // Resolution of four samples: one speed step of the chip.
        EXPECT_LE(axis.top.peak_accel, axis.limits.max_accel * 1.02) << axis.index;
        if (jump > 0) {
            EXPECT_LE(axis.top.peak_velocity_step, axis.limits.max_velocity_step * jump) << axis.index;
        }
    }
}

inline void expect_exact(const JobOutcome& outcome, double jump = 1.15) {
    ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
    expect_limits(outcome, jump);
}

}  // namespace motionrack::rack
