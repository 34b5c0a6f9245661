// Programs driven while they still come, held, slowed and let go on at any instant: what holds at every instant of
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/curve/test/curve_support.hpp>
#include <motionrack/control/ride/rider.hpp>
#include <motionrack/control/ride/test/ride_support.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

using curve_test::arc_from;
using curve_test::line_to;
using curve_test::machine;

constexpr double slack = 1 + 1e-6;

/// Lines, some of them many and short, some with Z, arcs, and dwells.
std::vector<Move> program(std::mt19937& random) {
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const auto one_of = [&](unsigned n) { return random() % n == 0; };
    std::vector<Move> out;
    const bool chords = one_of(3), exact = one_of(4), arcs = !chords && one_of(2);
    const double tolerance = std::exp(between(std::log(0.003), std::log(0.3)));
    double angle = 0;
    Point place = {};
    for (auto n = 5 + random() % 60; n > 0; --n) {
        const Point from = place;
        const double length = chords ? 0.3 : std::exp(between(std::log(0.05), std::log(30.0)));
        angle += chords ? between(-0.3, 0.3) : between(-2.5, 2.5);
        place[0] += length * std::cos(angle);
        place[1] += length * std::sin(angle);
        if (one_of(5)) place[2] += between(-1, 1);
        Move move = line_to(place, tolerance);
        if (arcs && one_of(2)) {
            const double sweep = between(-3, 3);
            move = arc_from(from, angle, between(0.2, 12), sweep, tolerance);
            place = move.end;
            angle += sweep;
        }
        if (exact) move.path = PathControl::exact_path;
        move.feed = between(5, 120);
        if (one_of(8)) move.kind = MoveKind::traverse;
        move.line = static_cast<int>(out.size()) + 1;
        out.push_back(move);
        if (!one_of(25)) continue;
        move.kind = MoveKind::dwell;
        move.seconds = 0.05;
        out.push_back(move);
    }
    return out;
}

/// Pushes the moves that have come while there is room, and passes the time; looks at all axes all the time.
class Driven {
  public:
    Driven(std::vector<Move> moves, RiderSettings settings)
        : moves_(std::move(moves)), rider(machine(), {}, settings) {}

    /// False when all is driven.
    bool step(double seconds, bool early) {
        while (next_ < std::min(come, moves_.size()) && rider.has_room()) rider.push({moves_[next_++]});
        if (next_ == moves_.size() && !flushed_ && rider.has_room()) flushed_ = (rider.flush(), true);
        const RideNext next = rider.next(early);
        if (next == RideNext::nothing) return next_ < moves_.size() || !flushed_;
        if (next == RideNext::dwell) {
            const double wait = std::min(seconds, rider.dwell_seconds());
            rider.pass_dwell(wait);
            now += wait;
            return true;
        }
        const double pass = std::min(seconds, rider.left());
        for (const double part : {0.005, 0.505}) look(part * pass);
        rider.pass(pass);
        now += pass;
        return true;
    }
    void pass_time(double seconds) { now += seconds; }

    std::size_t come = static_cast<std::size_t>(-1);  ///< so many moves, at most
    double now = 0, speed = 0, accel = 0, jerk = 0,
           jump = 0;  ///< greatest parts of the limits; of what the limits let change
    RideState last;

  private:
    void look(double seconds) {
        const MachineLimits limits = machine();
        const RideState state = rider.at(seconds);
        const double gap = now + seconds - at_;
        for (std::size_t i = 0; i < limits.size(); ++i) {
            const AxisLimits& most = limits[i];
            speed = std::max(speed, std::fabs(state.speed[i]) / most.max_speed);
            accel = std::max(accel, std::fabs(state.accel[i]) / most.max_accel);
            jerk = std::max(jerk, std::fabs(state.jerk[i]) / most.max_jerk);
            jump = std::max({jump, std::fabs(state.place[i] - last.place[i]) / (slack * most.max_speed * gap + 1e-5),
                             std::fabs(state.speed[i] - last.speed[i]) / (slack * most.max_accel * gap + 1e-4),
                             std::fabs(state.accel[i] - last.accel[i]) / (slack * most.max_jerk * gap + 1e-2)});
        }
        last = state;
        at_ = now + seconds;
    }

    std::vector<Move> moves_;
    std::size_t next_ = 0;
    bool flushed_ = false;
    double at_ = 0;

  public:
    Rider rider;
};

void expect_limits(const Driven& driven) {
    EXPECT_LE(driven.speed, slack);
    EXPECT_LE(driven.accel, slack);
    EXPECT_LE(driven.jerk, slack);
    EXPECT_LE(driven.jump, 1);
}

void expect_end(const Driven& driven, const Point& end) {
    for (std::size_t i = 0; i < end.size(); ++i) EXPECT_NEAR(driven.last.place[i], end[i], 1e-4);
}

TEST(ARiderLeftAlone, IsAsQuickAsIfAllWereKnownAndHardlySlowerIfItKnowsLittle) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        const bool knows_all = seed % 2 == 0;
        Driven driven(moves, {knows_all ? std::size_t{16'384} : 60});
        while (driven.step(0.0015, false)) {
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
        EXPECT_NEAR(driven.now, ride_test::seconds_of_ride(moves, machine()), (knows_all ? 1e-3 : 0.1) * driven.now);
    }
}

TEST(ARiderDisturbedAtRandom, KeepsAllLimitsAndEndsWhereTheProgramEnds) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        Driven driven(moves, {64});
        const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
        double wish = between(0.05, 0.5), resume = 1e9;
        for (int steps = 0; driven.step(between(0.0005, 0.0025), true) || resume < 1e9; ++steps) {
            ASSERT_LT(steps, 1'000'000);
            if (driven.rider.stands()) driven.pass_time(0.001);
            if (driven.now > wish && resume == 1e9) {
                if (random() % 3 == 0) {
                    driven.rider.hold();
                    resume = driven.now + between(0, 0.6);
                } else {
                    driven.rider.set_overrides(between(0.05, 2), between(0.05, 1));
                }
                wish = driven.now + between(0.1, 0.6);
            }
            if (driven.now < resume) continue;
            driven.rider.resume();
            resume = 1e9;
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
    }
}

/// Whatever comes on its way to where it stands: corners, bends, the end of what is known. Where a leg has begun before
/// the one before it has ended, both are driven as planned until that one ends.
TEST(ARiderDisturbedAtRandom, NeverSpeedsUpAgainOnceItSlowsDownForAHold) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        const double whole = ride_test::seconds_of_ride(moves, machine());
        for (int holds = 0; holds < 10; ++holds) {
            const double when = whole * std::uniform_real_distribution<>(0, 1)(random);
            SCOPED_TRACE(::testing::Message() << "seed " << seed << ", held at " << when << " s");
            Driven driven(moves, {64});
            while (driven.now < when && driven.step(0.001, true)) {
            }
            driven.rider.hold();
            double greatest = 0, lowest = 1e9, rise = 0;  // the last two since it slows down
            while (driven.rider.next(true) == RideNext::motion) {
                const RideState before = driven.last;
                const double at = driven.now;
                driven.step(0.001, true);
                const double way = driven.last.u - before.u;
                if (driven.now - at < 0.0005) continue;  // too short to tell a speed
                if (at - when < 0.02 || way < 0) {       // not heard yet, or on the next leg
                    greatest = 0, lowest = 1e9;
                    continue;
                }
                const double speed = way / (driven.now - at);
                greatest = std::max(greatest, speed);
                if (speed < 0.98 * greatest) lowest = std::min(lowest, speed);
                rise = std::max(rise, speed - 1.05 * lowest);
            }
            EXPECT_LT(rise, 0.1);
            EXPECT_LT(driven.now - when, 1);
            expect_limits(driven);
        }
    }
}

/// So that a stretch may grow while the next one's beginning is planned already.
TEST(ARider, KeepsAllLimitsWheneverMovesCome) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
        Driven driven(moves, {});
        driven.come = 2;
        double more = 0;
        for (int steps = 0; driven.step(0.001, true); ++steps) {
            ASSERT_LT(steps, 1'000'000);
            if (driven.rider.stands()) driven.pass_time(0.001);
            if (driven.now < more) continue;
            driven.come += 1 + random() % 10;
            more = driven.now + between(0.01, 0.4);
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
    }
}

/// The stretch behind a corner grows when its beginning is planned already.
TEST(ARider, GoesOnPastACornerToWhatCameBeforeIt) {
    std::vector<Move> moves = {line_to({20}, 0.05)};
    for (int i = 1; i <= 80; ++i) moves.push_back(line_to({20 - 0.002 * i * i, 0.4 * i}, 0.01));
    int late = 0;
    for (double left = 0.3; left > 0.01; left -= 0.005) {
        SCOPED_TRACE(left);
        Driven driven(moves, {});
        driven.come = 60;
        while (driven.step(0.001, true)) {
            ASSERT_LT(driven.now, 60);
            if (driven.rider.stands()) driven.pass_time(0.001);
            if (driven.come != 60 || driven.rider.left() > left || driven.now < 0.1) continue;
            late += driven.last.place[1] == 0;
            driven.come = moves.size();
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
    }
    EXPECT_GT(late, 10);
}

Move long_line(double feed) {
    Move move = line_to({100});
    move.feed = feed;
    return move;
}

TEST(ARider, StandsSoonAfterAHoldAndGoesOnFromThere) {
    Driven driven({long_line(50)}, {});
    while (driven.now < 0.5) driven.step(0.001, true);
    driven.rider.hold();
    const double asked = driven.now;
    while (driven.rider.next(true) == RideNext::motion) driven.step(0.001, true);
    // twice sqrt(speed / jerk): its acceleration is not reached
    EXPECT_NEAR(driven.now - asked, 2 * std::sqrt(50 / machine()[0].max_jerk), 0.005);
    EXPECT_TRUE(driven.rider.stands());
    EXPECT_EQ(driven.rider.next(true), RideNext::nothing);
    driven.rider.resume();
    while (driven.step(0.001, true)) {
    }
    EXPECT_NEAR(driven.last.place[0], 100, 1e-6);
    expect_limits(driven);
}

/// A line, the same in short ones, a circle, the same in chords.
std::vector<std::vector<Move>> ways_at(double feed) {
    std::vector<std::vector<Move>> out = {{long_line(feed)}, {}, {arc_from({}, 0, 30, 6)}, {}};
    for (int i = 1; i <= 200; ++i) out[1].push_back(line_to({0.5 * i}));
    for (int i = 1; i <= 600; ++i)
        out[3].push_back(line_to({30 * std::sin(0.01 * i), 30 - 30 * std::cos(0.01 * i)}, 0.02));
    for (std::vector<Move>& way : out)
        for (Move& move : way) move.feed = feed;
    return out;
}

TEST(ARider, StandsAsSoonWhileItSlowsDownForOverrides) {
    for (const std::vector<Move>& way : ways_at(50)) {
        const auto held_after = [&](double feed, double after) {
            Driven driven(way, {});
            while (driven.now < 0.5) driven.step(0.001, true);
            driven.rider.set_overrides(feed, 1);
            while (driven.now < 0.5 + after) driven.step(0.001, true);
            driven.rider.hold();
            const double asked = driven.now;
            while (driven.rider.next(true) == RideNext::motion) driven.step(0.001, true);
            expect_limits(driven);
            return driven.now - asked;
        };
        const double alone = held_after(1, 0);
        for (const double feed : {0.8, 0.4, 0.1, 0.02})
            for (double after = 0.001; after < 1.2 * alone; after += 0.006)
                EXPECT_LT(held_after(feed, after), alone + 0.03)
                    << way.size() << " moves, feed " << feed << ", held " << after << " s after";
    }
}

/// The bend alone takes nearly all of the acceleration of X and Y by turns, and most of their jerk; slowing down takes
/// from the same.
TEST(ARider, StandsSoonOnACircleThatIsDrivenAsFastAsItCanBe) {
    Move circle = arc_from({}, 0, 10, 50);
    circle.feed = 1000;
    for (const double when : {0.8, 0.9, 1.0, 1.1, 1.2}) {
        Driven driven({circle}, {});
        while (driven.now < when) driven.step(0.001, true);
        const double speed = std::hypot(driven.last.speed[0], driven.last.speed[1]),
                     all = std::sqrt(machine()[0].max_accel * 10);
        EXPECT_GT(speed, 0.9 * all);
        driven.rider.hold();
        const double asked = driven.now,
                     alone = speed / machine()[0].max_accel + machine()[0].max_accel / machine()[0].max_jerk;
        while (driven.rider.next(true) == RideNext::motion) driven.step(0.001, true);
        EXPECT_LT(driven.now - asked, 4 * alone) << when;
        expect_limits(driven);
    }
}

/// While it still speeds up, and at its full speed, where hardly any jerk is left to slow down with.
TEST(ARider, StandsAndSlowsDownSoonOnBendsThatTakeNearlyAllOfTheJerk) {
    const auto speed_of = [](const Driven& driven) { return std::hypot(driven.last.speed[0], driven.last.speed[1]); };
    for (const double radius : {2, 10})
        for (double when = 0.05; when < 0.6; when += 0.05) {
            SCOPED_TRACE(::testing::Message() << "radius " << radius << ", at " << when << " s");
            Move circle = arc_from({}, 0, radius, 50);
            circle.feed = 1000;
            Driven held({circle}, {}), slowed({circle}, {});
            while (held.now < when) held.step(0.001, true);
            while (slowed.now < when) slowed.step(0.001, true);
            const double speed = speed_of(held);
            held.rider.hold();
            while (held.rider.next(true) == RideNext::motion) held.step(0.001, true);
            EXPECT_LT(held.now - when, 0.5);
            slowed.rider.set_overrides(0.5 * speed / circle.feed, 1);
            while (speed_of(slowed) > 0.51 * speed && slowed.now < when + 1) slowed.step(0.001, true);
            EXPECT_LT(slowed.now - when, 0.8);
            expect_limits(held);
            expect_limits(slowed);
        }
}

/// Where the next line would begin before this one has ended.
TEST(ARider, StandsAtTheCornerBeforeWhichItIsHeld) {
    Driven driven({line_to({10, 0}, 0.2), line_to({10, 10}, 0.2)}, {});
    driven.step(0, true);
    const double whole = driven.rider.until_rest();
    while (driven.rider.left() > 0.005) ASSERT_TRUE(driven.step(0.0005, true));
    ASSERT_LT(driven.now, 0.8 * whole);
    driven.rider.hold();
    while (!driven.rider.stands()) driven.step(0.0005, true);
    EXPECT_NEAR(driven.last.place[0], 10, 1e-3);
    EXPECT_NEAR(driven.last.place[1], 0, 1e-3);
    driven.rider.resume();
    while (driven.step(0.0005, true)) {
    }
    expect_limits(driven);
    expect_end(driven, {10, 10});
}

TEST(ARider, TakesOtherFeedsAsSoonAsTheLimitsAllow) {
    Driven driven({long_line(20)}, {});
    const auto speed_after = [&](double seconds) {
        for (const double until = driven.now + seconds; driven.now < until;) driven.step(0.001, true);
        return driven.rider.at(0).speed[0];
    };
    EXPECT_NEAR(speed_after(0.5), 20, 1e-6);
    driven.rider.set_overrides(0.5, 1);
    EXPECT_NEAR(speed_after(0.15), 10, 1e-6);
    driven.rider.set_overrides(2, 1);
    EXPECT_NEAR(speed_after(0.2), 40, 1e-6);
    driven.rider.set_overrides(0.01, 1);
    EXPECT_NEAR(speed_after(0.3), 0.2, 1e-6);
    expect_limits(driven);
}

TEST(ARider, AlwaysEndsAtRestInWhatItKnows) {
    std::mt19937 random(3);
    const std::vector<Move> moves = program(random);
    Driven driven(moves, {40});
    int looks = 0;
    while (driven.step(0.003, false)) {
        if (driven.rider.stands() || driven.rider.left() < driven.rider.until_rest())
            continue;  // the next stretch begins before its end
        const RideState end = driven.rider.at(driven.rider.until_rest());
        for (const double speed : end.speed) EXPECT_EQ(speed, 0);
        ++looks;
    }
    EXPECT_GT(looks, 100);
}

TEST(ARider, TellsWhichMoveItIsOnAndKeepsNoOther) {
    std::vector<Move> moves;
    for (int i = 1; i <= 3000; ++i) moves.push_back(line_to({0.3 * i, i % 2 * 0.2}, 0.001));
    Driven driven(moves, {500});
    std::int64_t last = 0;
    while (driven.step(0.02, false)) {
        if (driven.rider.next(false) != RideNext::motion) continue;
        const std::int64_t number = driven.rider.move_of(driven.rider.at(0));
        EXPECT_GE(number, last);
        EXPECT_EQ(driven.rider.move(number).move.end, moves[static_cast<std::size_t>(number)].end);
        EXPECT_NEAR(driven.rider.at(0).place[0], 0.3 * static_cast<double>(number), 0.7);
        last = number;
    }
    EXPECT_GT(last, 2990);
    EXPECT_EQ(driven.rider.first_left(), 3000);
}

}  // namespace
}  // namespace motionrack::control
