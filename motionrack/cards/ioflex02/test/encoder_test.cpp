// Encoders with faults at the card's lines: findings of the diagnostics, with line and position; and a resolver as the
// source of the lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/cards/ioflex02/driver/encoder_check.hpp>
#include <motionrack/cards/ioflex02/driver/speed.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>
#include <motionrack/sim/parts/line_encoder.hpp>
#include <motionrack/sim/parts/resolver.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>
#include <motionrack/sim/wire_connections.hpp>

namespace motionrack::ioflex02 {
namespace {

using testing::HasSubstr;

/// A disc of 400 counts at axis 2, turned by a rotor of 4000 steps.
template <class Part, class PartSettings>
struct Machine {
    explicit Machine(const PartSettings& settings, const EncoderCheckSettings& checks = {.counts_per_index = 400})
        : place(rig.kernel, {}),
          part(rig.kernel, "enc", place, settings),
          junctions(rig.kernel),
          card(rig.port, rig.port),
          check(checks) {
        junctions.join(part.a(), rig.kernel.find_wire("c1.a2"));
        junctions.join(part.b(), rig.kernel.find_wire("c1.b2"));
        junctions.join(part.z(), rig.kernel.find_wire("c1.z2"));
        rig.start();
        card.Init(0x2300);
        rig.run(microseconds(1));
        check.update(detail());
    }
    AxisDetail detail() { return card.read_details()[2]; }
    bool fault(const char* name, double value) {
        const bool done = part.fault(name, value, rig.kernel.now());
        rig.kernel.settle();
        return done;
    }
    /// Moves `steps` of the rotor, one each `step`, and polls each ms.
    void go(std::int64_t steps, Duration step = microseconds(2)) {
        const Instant until = rig.kernel.now() + step * (steps < 0 ? -steps : steps);
        place.drive(step, steps < 0 ? -1 : 1);
        while (rig.kernel.now() < until) {
            rig.run(std::min(milliseconds(1), until - rig.kernel.now()));
            update();
        }
        place.drive(step, 0);
        rig.run(microseconds(200));
        update();
    }
    void update() {
        for (const Finding& f : check.update(detail())) found.push_back(f);
    }
    std::string sentence(const Finding& f) { return describe(f, detail(), "2"); }

    Rig rig{Settings{}};
    sim::FakePulses place;
    Part part;
    sim::WireConnections junctions;
    Flex2Pos card;
    EncoderCheck check;
    std::vector<Finding> found;
};

parts::LineEncoderSettings disc() {
    return {.counts_per_turn = 400, .position_per_turn = 4000, .dirt_at = 120};
}
struct Disc : Machine<parts::LineEncoder, parts::LineEncoderSettings> {
    explicit Disc(const EncoderCheckSettings& checks = {.counts_per_index = 400}) : Machine(disc(), checks) {}
};
struct Winding : Machine<parts::Resolver, parts::ResolverSettings> {
    Winding() : Machine({.counts_per_turn = 400, .position_per_turn = 4000}) {}
};

TEST(EncoderCheck, ReportsNothingForASoundEncoderThatMovesBackAndForth) {
    Disc m;
    for (const std::int64_t steps : {3'000, -9'000, 30'000, -100, 100, -40'000}) m.go(steps);
    EXPECT_TRUE(m.found.empty()) << m.sentence(m.found[0]);
    EXPECT_EQ(m.card.ReadPosition2(), m.part.count());
}

RC_GTEST_PROP(EncoderCheck, NeverBlamesAHealthyEncoderOrResolver, ()) {
    const bool eccentric = *rc::gen::arbitrary<bool>();
    const int moves = *rc::gen::inRange(1, 8);
    Disc disc;
    Winding winding;
    if (eccentric) disc.fault("eccentricity", 6);
    disc.fault("jitter", 2e-6);
    for (int i = 0; i < moves; ++i) {
        const std::int64_t steps = *rc::gen::inRange(-9'000, 9'001);
        const AxisDetail before = disc.detail();
        disc.go(steps);
        winding.go(steps, microseconds(4));
        if (std::llabs(steps) > 500) RC_ASSERT(disc.check.check_move(before, disc.detail(), steps / 10).empty());
    }
    RC_ASSERT(disc.found.empty());
    RC_ASSERT(winding.found.empty());
}

TEST(EncoderCheck, ReportsTheBrokenLineByName) {
    for (const bool a : {true, false}) {
        Disc m;
        m.go(2'500);
        m.fault(a ? "broken_a" : "broken_b", 1);
        const AxisDetail before = m.detail();
        m.go(10'000);
        ASSERT_FALSE(m.found.empty());
        EXPECT_EQ(m.found[0].fault, a ? EncoderFault::line_a_missing : EncoderFault::line_b_missing);
        EXPECT_NEAR(static_cast<double>(m.found[0].from), 250, 2);
        EXPECT_NEAR(static_cast<double>(m.found[0].to), 250, 2);
        EXPECT_THAT(m.sentence(m.found[0]), HasSubstr(a ? "A is broken" : "B is broken"));
        const auto moved = m.check.check_move(before, m.detail(), 1'000);
        ASSERT_EQ(moved.size(), 1u);
        EXPECT_EQ(moved[0].fault, m.found[0].fault);
        // Reported once while it persists, and again when it recurs.
        const auto lines = [&] {
            return std::count_if(m.found.begin(), m.found.end(), [](const Finding& f) {
                return f.fault == EncoderFault::line_a_missing || f.fault == EncoderFault::line_b_missing;
            });
        };
        EXPECT_EQ(lines(), 1);
        m.fault(a ? "broken_a" : "broken_b", 0);
        m.go(3'000);
        m.fault(a ? "broken_a" : "broken_b", 2);
        m.go(10'000);
        EXPECT_EQ(lines(), 2);
    }
}

TEST(EncoderCheck, ReportsMissingIndexPulsesWithTheirPositions) {
    Disc m;
    m.go(6'000);  // the index at 400 is known
    m.fault("missing_index", 2);
    m.go(12'000);
    ASSERT_FALSE(m.found.empty());
    std::int64_t missing = 0;
    for (const Finding& f : m.found) {
        EXPECT_EQ(f.fault, EncoderFault::index_missing) << m.sentence(f);
        missing += f.number;
    }
    EXPECT_EQ(missing, 2);
    EXPECT_EQ(m.found[0].from, 400);
    EXPECT_EQ(m.found[0].to, 800);
    EXPECT_THAT(m.sentence(m.found[0]), HasSubstr("1 index pulse did not come between 400 and 800"));
}

TEST(EncoderCheck, ReportsABrokenIndexInEachTurn) {
    Disc m;
    m.go(-5'000);
    m.fault("broken_z", 1);
    m.go(-20'000);
    std::int64_t missing = 0;
    for (const Finding& f : m.found) {
        EXPECT_EQ(f.fault, EncoderFault::index_missing);
        missing += f.number;
    }
    EXPECT_EQ(missing, 5);  // at -800 .. -2400
}

TEST(EncoderCheck, ReportsASecondIndexAndItsPosition) {
    Disc m;
    m.go(5'000);
    m.fault("double_index", 50);
    m.go(16'000);
    m.fault("double_index", 0);
    m.go(8'000);
    ASSERT_FALSE(m.found.empty());
    for (const Finding& f : m.found) EXPECT_EQ(f.fault, EncoderFault::index_extra) << m.sentence(f);
    EXPECT_EQ(m.found[0].to, 850);
    EXPECT_EQ(m.found.size(), 4u);
}

TEST(EncoderCheck, ReportsTheNumberOfLostLinesBetweenTwoIndexes) {
    Disc m;
    m.go(9'000);
    m.card.calibrate({cNop, cNop, cRes, cNop});  // positions are not affected by it
    m.fault("dirt", 3);
    m.go(8'000);
    ASSERT_FALSE(m.found.empty());
    EXPECT_EQ(m.found[0].fault, EncoderFault::counts_lost);
    EXPECT_EQ(m.found[0].number, 12);
    EXPECT_EQ(m.found[0].from, 800);
    EXPECT_EQ(m.found[0].to, 1'200 - 12);
    EXPECT_THAT(m.sentence(m.found[0]), HasSubstr("12 counts were lost between the index pulses at -100 and 288"));
    EXPECT_TRUE(m.rig.conditions().empty());  // the card itself cannot see it
}

TEST(EncoderCheck, ReportsCountsLostByOverspeed) {
    Disc m;
    m.go(6'000);
    m.fault("overspeed", 20'000);
    m.go(2'600);  // 50,000 counts/s
    m.fault("overspeed", 0);
    m.go(16'000);
    EXPECT_GT(m.part.lost(), 0);
    std::int64_t lost = 0;
    for (const Finding& f : m.found)
        if (f.fault == EncoderFault::counts_lost) lost += f.number;
    EXPECT_EQ(lost, m.part.lost());
}

TEST(EncoderCheck, ReportsSwappedAndInvertedLinesByTheirCountDirection) {
    for (const char* name : {"swapped", "inverted_a", "inverted_b"}) {
        Disc m;
        m.fault(name, 1);
        const AxisDetail before = m.detail();
        m.go(10'000);
        const auto moved = m.check.check_move(before, m.detail(), 1'000);
        ASSERT_EQ(moved.size(), 1u) << name;
        EXPECT_EQ(moved[0].fault, EncoderFault::backwards);
        EXPECT_THAT(m.sentence(moved[0]), HasSubstr("swapped, or one of them is inverted"));
        ASSERT_TRUE(m.card.set_mode(2, {.reversed = true}));  // as the message advises
        const AxisDetail again = m.detail();
        m.go(10'000);
        EXPECT_TRUE(m.check.check_move(again, m.detail(), 1'000).empty());
    }
}

TEST(EncoderCheck, ReportsNoiseAndIllegalTransitionsThatAFilterRemoves) {
    for (const int filter : {0, 15}) {
        Disc m;
        ASSERT_TRUE(m.card.set_mode(2, {.filter = filter}));
        m.go(1'000, microseconds(20));
        const AxisDetail before = m.detail();
        m.fault("noise", 400);
        m.go(1'000, microseconds(20));
        const auto moved = m.check.check_move(before, m.detail(), 100);
        if (filter == 0) {
            ASSERT_EQ(moved.size(), 1u);
            EXPECT_EQ(moved[0].fault, EncoderFault::too_many_edges);
            EXPECT_GT(moved[0].number, 500);
        } else {
            EXPECT_TRUE(moved.empty()) << m.sentence(moved[0]);
            EXPECT_EQ(m.card.ReadPosition2(), m.part.count());
        }
    }
}

TEST(EncoderCheck, ReportsIllegalTransitionsAndTheirPosition) {
    Disc m;
    m.go(700);
    m.rig.kernel.force(m.rig.kernel.find_wire("c1.a2"), 1 - m.rig.level("a2"));
    m.rig.kernel.force(m.rig.kernel.find_wire("c1.b2"), 1 - m.rig.level("b2"));
    m.rig.run(milliseconds(1));
    m.update();
    ASSERT_EQ(m.found.size(), 1u);
    EXPECT_EQ(m.found[0].fault, EncoderFault::illegal);
    EXPECT_EQ(m.found[0].number, 1);
    EXPECT_EQ(m.found[0].to, 70);
    EXPECT_THAT(m.sentence(m.found[0]), HasSubstr("changed at once 1 times, the last time at 70"));
    m.update();
    EXPECT_EQ(m.found.size(), 1u);
}

TEST(EncoderCheck, DescribesEachFindingByADifferentSentence) {
    std::vector<std::string> seen;
    for (int fault = 0; fault <= static_cast<int>(EncoderFault::too_many_edges); ++fault) {
        const std::string sentence = describe({static_cast<EncoderFault>(fault), 3, 10, 20}, AxisDetail{}, "spindle");
        EXPECT_THAT(sentence, HasSubstr("axis spindle: "));
        for (const std::string& other : seen) EXPECT_NE(sentence, other);
        seen.push_back(sentence);
    }
}

// ---- machines

TEST(Ioflex02Machine, AResolverIsCalibratedAtItsMarkerAndItsSpeedMeasured) {
    Winding m;
    m.go(700);
    m.card.calibrate({cNop, cNop, cResNm, cNop});
    m.go(5'000);
    EXPECT_TRUE(m.card.wait_calibrated(2, Duration{0}));
    EXPECT_EQ(m.card.ReadPosition2(), 170);
    m.place.drive(microseconds(5), 1);  // 20,000 counts/s
    SpeedMeter meter;
    Speed speed;
    for (int i = 0; i < 4; ++i) {
        m.rig.run(milliseconds(5));
        const Reading r = m.card.read();
        speed = meter.update(r.axes[2], r.ticks);
    }
    EXPECT_NEAR(speed.best().counts_s, 20'000, speed.best().error);
    EXPECT_LT(speed.best().error, 10);
}

TEST(Ioflex02Machine, TheErrorOfAnEccentricDiscIsWithinTheStatedOneWhenItIsReported) {
    Disc m;
    m.fault("eccentricity", 4);
    m.place.drive(microseconds(10), 1);  // 10,000 counts/s, mean
    SpeedMeter meter(4);
    for (int i = 0; i < 200; ++i) {
        m.rig.run(microseconds(731));
        const Reading r = m.card.read();
        const Speed s = meter.update(r.axes[2], r.ticks);
        for (const SpeedEstimate* e : {&s.difference, &s.edges})
            if (e->known) {
                EXPECT_NEAR(e->counts_s, 10'000, e->error + 1e-6);
            }
    }
}

}  // namespace
}  // namespace motionrack::ioflex02
