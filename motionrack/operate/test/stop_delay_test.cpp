// Time from a STOP or a hold to the deceleration, where a slow line is followed by a fast one.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

struct Sight {
    double at = 0, x = 0, y = 0;
};

struct Speeds {
    std::vector<double> at_s, mm_s;  ///< along the path, every 5 ms
};

/// Stops the machine at `stop_s` and returns its speeds.
Speeds stopped_at(double stop_s, const std::string& profile, Result<void> (*stop)(Machine&)) {
    Operated o(two_axes("[controller]\nprofile = \"" + profile + "\"\n"));
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 G64 P0.01\nG1 X11 F300\nG1 Y40 F6000\n", "p")); });
    o.at(stop_s, [stop](Machine& m) { EXPECT_TRUE(stop(m)); });
    Speeds out;
    Sight before;
    o.each_status([&](const Status& status) {
        const Sight now{to_seconds(status.at), status.axes[0].commanded, status.axes[1].commanded};
        if (now.at < before.at + 0.005) return;
        if (before.at > 0) {
            out.at_s.push_back(now.at);
            out.mm_s.push_back(std::hypot(now.x - before.x, now.y - before.y) / (now.at - before.at));
        }
        before = now;
    });
    o.run(stop_s + 0.5);
    return out;
}

void expect_soon(const Speeds& speeds, double stop_s) {
    SCOPED_TRACE(testing::Message() << "at " << stop_s << " s");
    constexpr double begins_within = 0.05, jerk_time = 0.05, sample_s = 0.01;
    double peak_speed = 0;  // before it decelerates
    for (std::size_t i = 0; i < speeds.at_s.size(); ++i) {
        if (speeds.at_s[i] <= stop_s + begins_within + jerk_time + sample_s)
            peak_speed = std::max(peak_speed, speeds.mm_s[i]);
        else
            EXPECT_LE(speeds.mm_s[i], peak_speed * 1.02 + 0.8) << speeds.at_s[i] << " s";  // rounding to pulses
    }
    EXPECT_EQ(speeds.mm_s.back(), 0);
}

TEST(StopDelay, DeceleratesWithinFiftyMillisecondsAlsoBeforeAFasterLine) {
    for (const char* const profile : {"trapezoid", "jerk_limited"}) {
        SCOPED_TRACE(profile);
        for (double at = 0.1; at < 0.5; at += 0.01)
            expect_soon(stopped_at(at, profile,
                                   [](Machine& m) {
                                       return m.stop({"anna", "", "STOP"}), Result<void>();
                                   }),
                        at);
    }
}

TEST(Hold, DeceleratesWithinFiftyMillisecondsAlsoBeforeAFasterLine) {
    for (double at = 0.15; at < 0.35; at += 0.01)
        expect_soon(stopped_at(at, "jerk_limited", [](Machine& m) { return m.hold(); }), at);
}

}  // namespace
}  // namespace motionrack::operate
