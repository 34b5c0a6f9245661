// The controller itself causes no step loss, for any request during a program and for moves of any length. The pulse
// rate on the wires never changes by more than the motors can follow.
#include <algorithm>
#include <motionrack/rack/mcx314_card.hpp>

#include "lossless_support.hpp"

namespace motionrack::rack {
namespace {

Wishes holds(double first, double every, int count) {
    Wishes out;
    for (int i = 0; i < count; ++i) {
        out.emplace_back(first + i * every, "hold");
        out.emplace_back(first + (i + 0.5) * every, "resume");
    }
    return out;
}

struct Path {
    std::string text;
    double x = 0, y = 0;  ///< end of the program, mm
};

/// Returns a spiral about the middle of the table, in chords of this length.
Path spiral(double chord, double length) {
    Path out{"G21 G90 G64 P0.01\nG0 X170 Y100\nG1 F6000\n"};
    double angle = 0;
    for (double s = 0; s < length; s += chord) {
        const double radius = 20 + s / 100;
        angle += chord / radius;
        out.x = 150 + radius * std::cos(angle);
        out.y = 100 + radius * std::sin(angle);
        out.text += fmt::format("X{:.4f} Y{:.4f}\n", out.x, out.y);
    }
    out.text += "M2\n";
    return out;
}

Path collinear(double line, double length) {
    Path out{"G21 G90 G64 P0.01\nG0 X10 Y10\nG1 F6000\n"};
    for (double s = line; s < length; s += line) {
        out.x = 10 + s * 0.8;
        out.y = 10 + s * 0.6;
        out.text += fmt::format("X{:.4f} Y{:.4f}\n", out.x, out.y);
    }
    out.text += "M2\n";
    return out;
}

/// Returns a cross-section of a relief, along X.
Path relief(double chord, double length, double feed) {
    Path out{fmt::format("G21 G90 G64 P0.005\nG0 X10 Y10 Z75\nG1 F{}\n", feed)};
    out.y = 10;
    for (double s = chord; s < length; s += chord) {
        out.x = 10 + s;
        out.text += fmt::format("X{:.4f} Z{:.4f}\n", out.x,
                                75 - 0.4 * (1 - std::cos(0.7 * s)) - 0.25 * (1 - std::cos(2.3 * s)));
    }
    out.text += "M2\n";
    return out;
}

class Lossless : public testing::TestWithParam<const char*> {};
std::string profile_of(const testing::TestParamInfo<const char*>& param) {
    return param.param;
}
INSTANTIATE_TEST_SUITE_P(With, Lossless, testing::Values("trapezoid", "jerk_limited"), profile_of);

void expect_held_without_loss(const char* profile, const Path& path, double first) {
    const Driven undisturbed = drive_with(router(profile), path.text, {}),
                 held = drive_with(router(profile), path.text, holds(first, 0.413, 4));
    expect_lossless(held);
    expect_end(held, path.x, path.y);
    EXPECT_GT(to_seconds(held.outcome.time), to_seconds(undisturbed.outcome.time) + 4 * 0.1) << "it stood";
}

TEST_P(Lossless, AFeedHoldDeceleratesAlongASpiralOfChords) {
    for (const double chord : {0.2, 0.7}) {
        SCOPED_TRACE(chord);
        expect_held_without_loss(GetParam(), spiral(chord, 260), 2.1);
    }
}

TEST_P(Lossless, AFeedHoldDeceleratesAlongCollinearLines) {
    for (const double line : {0.5, 1.0, 10.0}) {
        SCOPED_TRACE(line);
        expect_held_without_loss(GetParam(), collinear(line, 230), 0.8);
    }
}

void expect_undisturbed(const RackConfig& config, const Path& path, double seconds) {
    const Driven driven = drive_with(config, path.text, {});
    expect_lossless(driven);
    expect_end(driven, path.x, path.y);
    EXPECT_LT(to_seconds(driven.outcome.time), seconds);
}

TEST_P(Lossless, AReliefInFineStepsLosesNoPulse) {
    RackConfig config = router(GetParam());
    set_microsteps(config, 64);
    expect_undisturbed(config, relief(0.05, 60, 20'000), 5.5);
}

TEST_P(Lossless, ASpiralOnASlowBusLosesNoPulse) {
    RackConfig config = router(GetParam());
    config.cards[0].settings.edit<Mcx314Settings>().bus_access_ns = 1'000;
    expect_undisturbed(config, spiral(0.2, 200), 5.2);
}

TEST_P(Lossless, DrivesChordsOfMicrometresAsFastAsTheirCurve) {
    const double seconds = to_seconds(drive_with(router(GetParam()), spiral(0.2, 30).text, {}).outcome.time);
    for (const double chord : {0.002, 0.01, 0.05}) {
        SCOPED_TRACE(chord);
        expect_undisturbed(router(GetParam()), spiral(chord, 30), 1.05 * seconds + 0.05);
    }
}

TEST_P(Lossless, AHostWithoutLatencyAndASlowOneLoseNoPulse) {
    for (const std::int64_t latency : {0, 400}) {
        SCOPED_TRACE(latency);
        RackConfig config = router(GetParam());
        config.cards[0].settings.edit<Mcx314Settings>().host_latency_us = latency;
        expect_undisturbed(config, spiral(0.1, 60), 4.5);
    }
}

/// Short chords; the last one decelerates for a corner after which Z moves too, and a short line before the next corner
/// follows. There, a pulse of the chip is a longer distance of the path than before the corner.
TEST_P(Lossless, ShortLinesDecelerateInTimeForACornerAtWhichZContinues) {
    RackConfig config = router(GetParam());
    set_microsteps(config, 64);
    Path path{"G21 G90 G64 P0.01\nG0 X150 Y100 Z75\nG1 F1247\n", 150, 100};
    double z = 75;
    const auto go = [&](double x, double y, double up) {
        path.x += x;
        path.y += y;
        z += up;
        path.text += fmt::format("X{:.4f} Y{:.4f} Z{:.4f}\n", path.x, path.y, z);
    };
    for (int i = 0; i < 12; ++i) go(0.029, 0.038, 0);
    path.text += "F4000\n";
    go(0.0219, 0.0292, -0.0087);
    go(0.0365, 0, 0.0102);
    for (int i = 0; i < 12; ++i) go(0.0365, 0, 0.002);
    expect_undisturbed(config, path, 2);
}

/// On a diagonal line, the pulse generator has a higher rate than on an arc of the same velocity.
TEST_P(Lossless, AnArcDeceleratesInTimeFromTheRateOfADiagonalLine) {
    std::string text = "G21 G90 G17 G64 P0.002\nG0 X152.3125 Y101.0757 Z75\nG1 F2750\n";
    for (int i = 1; i <= 23; ++i)
        text += fmt::format("X{:.4f} Y{:.4f}\n", 152.3125 - 0.0476 * i, 101.0757 + 0.0189 * i);
    text +=
        "G3 X148.5167 Y101.7604 I-1.7775 J-4.4876\nG2 X148.5066 Y101.7587 I-0.0404 J0.2072\n"
        "G2 X147.7299 Y99.3469 I-1.6146 J-0.8110\nM2\n";
    RackConfig config = router(GetParam());
    set_microsteps(config, 64);
    config.cards[0].settings.edit<Mcx314Settings>().host_latency_us = 200;
    expect_lossless(drive_with(config, text, {}));
}

/// The program has moves from standstill to standstill, in each of which X has less than half a pulse.
TEST_P(Lossless, AnAxisWithLessThanAPulsePerMoveEndsAtItsTarget) {
    RackConfig config = router(GetParam());
    set_microsteps(config, 16);
    Path path{"G21 G90 G61\nG0 X150 Y100 Z75\nG1 F1200\n", 150, 100};
    for (int i = 1; i <= 8; ++i) {
        path.x += 0.0007;
        path.y += i % 2 != 0 ? 9 : -8;
        path.text += fmt::format("X{:.4f} Y{:.4f} Z{}\n", path.x, path.y, i % 2 != 0 ? 72 : 75);
    }
    const Driven driven = drive_with(config, path.text + "M2\n", {});
    expect_lossless(driven);
    expect_end(driven, path.x, path.y);
}

/// The program is a ramp in chords or quarter circles, in each of which Z has less than half a pulse.
TEST_P(Lossless, AnAxisWithLessThanAPulsePerChordStaysOnThePath) {
    const auto ramp = [](double angle, double rise, bool arcs) {
        Path out{"G21 G90 G64 P0.01\nG0 X170 Y100 Z40\nG1 F1200\n"};
        for (int i = 1; i <= static_cast<int>(21 / angle); ++i) {
            out.x = 150 + 20 * std::cos(i * angle);
            out.y = 100 + 20 * std::sin(i * angle);
            out.text += fmt::format("{} X{:.4f} Y{:.4f} Z{:.4f}{}\n", arcs ? "G3" : "G1", out.x, out.y, 40 - i * rise,
                                    arcs ? " R20" : "");
        }
        out.text += "M2\n";
        return out;
    };
    for (const Path& path : {ramp(0.01, 0.0005, false), ramp(0.01, 0.0001, false), ramp(1.5, 0.0007, true)}) {
        const Driven driven = drive_with(router(GetParam()), path.text, {});
        expect_lossless(driven);
        expect_end(driven, path.x, path.y);
    }
}

/// The end of a short drive of the fourth axis may coincide with the instant at which the queue has room.
TEST_P(Lossless, AFourthAxisThatOftenStopsDelaysNothing) {
    Path path{"G21 G90 G64 P0.01 F1051\nG0 X170 Y100 Z40\n", 0, 0};
    for (int i = 1; i < 153; ++i) {
        path.x = 150 + 20 * std::cos(i * 0.005);
        path.y = 100 + 20 * std::sin(i * 0.005);
        path.text +=
            fmt::format("G1 X{:.4f} Y{:.4f} Z{:.4f} A{:.4f}\n", path.x, path.y, 40 - 0.0005 * i, 0.0083226 * i);
    }
    const Driven driven = drive_with(router(GetParam()), path.text + "M2\n", {});
    expect_lossless(driven);
    expect_end(driven, path.x, path.y);
}

TEST_P(Lossless, AFeedHoldDuringAReversalSkipsNothing) {
    const Path path{"G21 G90 G61\nG0 X10 Y10\nG1 F3000\nX20.3 Y14.7\nX8.1 Y9.133\nX21 Y15.02\nX11 Y10.457\nM2\n", 11,
                    10.457};
    const RackConfig config = router(GetParam());
    const Driven undisturbed = drive_with(config, path.text, {});
    for (double at = 0.45; at < 1; at += 0.044) {
        SCOPED_TRACE(at);
        const Driven held = drive_with(config, path.text, {{at, "hold"}, {at + 0.2, "resume"}});
        expect_lossless(held);
        expect_end(held, path.x, path.y);
        for (std::size_t i = 0; i < 2; ++i) {
            const std::int64_t sent = held.outcome.axes[i].pulses_sent;
            EXPECT_LE(std::llabs(sent - undisturbed.outcome.axes[i].pulses_sent), 4) << "axis " << i << ": " << sent;
        }
    }
}

TEST(Host, ADelayedHostIsReportedWithPositionAndDelay) {
    bool late = false;
    const Path path = spiral(0.2, 200);
    RackConfig config = router();
    for (RackAxis& axis : config.axes) axis.following_error_alarm = 0;  // the motors lose steps
    const auto be_late = [&](Rack& rack) {
        if (late || rack.kernel().now() < milliseconds(2500)) return;
        late = true;
        rack.cards().front()->host().pass(milliseconds(20));
    };
    const test::LimitFactors known = test::known_breaches("late_host");
    const Driven driven = drive_with(config, path.text, {}, be_late, known);
    ASSERT_TRUE(driven.outcome.ended);
    EXPECT_FALSE(driven.outcome.good());
    bool reported = false;
    for (const Breach& breach : driven.outcome.breaches.all()) {
        if (breach.kind != BreachKind::late) continue;
        reported = true;
        EXPECT_NEAR(breach.value, 0.017, 0.003) << "of the two milliseconds that each chord takes";
        EXPECT_NEAR(to_seconds(breach.at), 2.503, 0.003);
        EXPECT_GT(breach.line, 3);
        EXPECT_NE(sentence_of(breach).find("host_latency_us"), std::string::npos);
    }
    EXPECT_TRUE(reported);
    EXPECT_GT(driven.worst.parts, 5) << "the referee sees that the pulses stopped at once";
    EXPECT_LE(driven.worst.parts, known.max_velocity_step);
    EXPECT_EQ(driven.outcome.breaches.all().back().kind, BreachKind::jump) << "and so does the monitor";
    expect_end(driven, path.x, path.y);
}

/// In the second program, X starts the chain of segments but does not move in the lines before which the host is late:
/// Y must take its place in the following segments.
TEST_P(Lossless, ALateHostContinuesAtTheProgrammedFeed) {
    RackConfig config = router(GetParam());
    for (RackAxis& axis : config.axes) axis.following_error_alarm = 0;  // the motors lose steps
    for (const char along : {'X', 'Y'}) {
        std::string text = "G21 G90 G64 P0.01\nG0 X100 Y100 Z40\nG1 F3000\nX102\n";
        for (int i = 1; i <= 200; ++i) text += fmt::format("{}{:.4f} Z{:.4f}\n", along, 102 + 0.2 * i, 40 + 0.1 * i);
        const Driven undisturbed = drive_with(config, text + "M2\n", {});
        const double seconds = to_seconds(undisturbed.outcome.time);
        for (double left = 0.2; left < 0.75; left += 0.15) {
            SCOPED_TRACE(testing::Message() << along << ", late " << left << " s before the end");
            bool late = false;
            const auto be_late = [&](Rack& rack) {
                if (late || to_seconds(rack.kernel().now()) < seconds - left) return;
                late = true;
                rack.cards().front()->host().pass(milliseconds(20));
            };
            const Driven driven = drive_with(config, text + "M2\n", {}, be_late, test::known_breaches("late_host"));
            ASSERT_TRUE(driven.outcome.ended);
            EXPECT_FALSE(driven.outcome.good());
            EXPECT_LT(to_seconds(driven.outcome.time), seconds + 0.4);
            expect_end(driven, along == 'X' ? 142 : 102, along == 'X' ? 100 : 142);
        }
    }
}

TEST(Host, PollsAxesEveryFewMicrosecondsOnlyDuringDeceleration) {
    RackConfig config = router();
    config.cards[0].settings.edit<Mcx314Settings>().bus_access_ns = 60;
    constexpr double asked = 0.5;
    double seconds = 0, reads = 0;
    const Driven driven = drive_with(config, "G1 X200 F6000\nM2\n", {{asked, "flag"}}, [&](Rack& rack) {
        seconds = to_seconds(rack.kernel().now()) - asked;
        const auto& inputs = rack.input_log().inputs();
        reads = static_cast<double>(std::count_if(inputs.begin(), inputs.end(), [&](const sim::LoggedInput& input) {
            return input.kind == sim::InputKind::register_read && to_seconds(input.at) >= asked;
        }));
    });
    ASSERT_FALSE(driven.outcome.ended);
    ASSERT_GT(seconds, 0.02) << "it braked";
    EXPECT_LT(reads / seconds, 1.2e6) << "reads a second, of 16 million that the bus can do";
    expect_lossless(driven);
}

}  // namespace
}  // namespace motionrack::rack
