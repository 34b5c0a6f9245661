// Tests of lists, paths, laser, starts, corrections and refusals through the public interface.
#include <cmath>
#include <cstring>
#include <limits>
#include <motionrack/cards/rtc5/test/rig.hpp>
#include <numeric>

namespace motionrack::rtc5 {
namespace {

TEST(Rtc5List, AMarkOf10MillimetresAt500Takes2000Ticks) {
    Rig rig;
    rig.put(Op::set_mark_speed, {2592});
    rig.put(Op::mark_abs, {51'840, 0});
    EXPECT_EQ(rig.go(), 2001);
    EXPECT_EQ(rig.x[0], 26);
    EXPECT_EQ(rig.x[1999], 51'840);
    EXPECT_EQ(std::accumulate(rig.laser.begin(), rig.laser.end(), 0), 40'000);
    EXPECT_EQ(rig.card.state().laser.on_time, 40'000);
}

TEST(Rtc5List, DelaysFollowJumpsCornersAndPolylines) {
    Rig rig;
    rig.put(Op::set_scanner_delays, {10, 7, 3});
    rig.put(Op::set_laser_delays, {25, 30});
    rig.put(Op::set_mark_speed, {1000});
    rig.put(Op::set_jump_speed, {1000});
    rig.put(Op::jump_abs, {100, 0});  // 10 ticks of motion, 10 of jump delay
    rig.put(Op::mark_abs, {200, 0});  // 10 ticks of motion, 3 of polygon delay
    rig.put(Op::set_mark_speed, {2000});
    rig.put(Op::mark_abs, {200, 100});  // 5 ticks of motion, 7 of mark delay
    rig.put(Op::jump_abs, {0, 0});
    rig.go();
    EXPECT_EQ(rig.laser[20], 0);
    EXPECT_EQ(rig.laser[21], 15);  // the laser is on 12.5 us after the first step
    for (std::size_t i = 22; i < 39; ++i) EXPECT_EQ(rig.laser[i], 20) << i;
    EXPECT_EQ(rig.laser[38], 20);
    EXPECT_EQ(rig.laser[39], 10);  // the laser is off 15 us after the last step's tick
    EXPECT_EQ(rig.laser[40], 0);
    EXPECT_EQ(rig.x[44], rig.x[37]) << "mark delay";
}

TEST(Rtc5List, AVariableCornerDelayGrowsWithTheAngle) {
    const auto ticks = [](double x, double y) {
        Rig rig;
        Delays d;
        d.polygon = 20;
        d.variable_polygon = 1;
        EXPECT_TRUE(rig.card.parts().path.set_delays(d));
        rig.put(Op::mark_abs, {100, 0});
        rig.put(Op::mark_rel, {x, y});
        return rig.go() - 21;
    };
    EXPECT_EQ(ticks(100, 0), 0);
    EXPECT_EQ(ticks(0, 100), 20);
    EXPECT_EQ(ticks(-100, 0), 40);
}

TEST(Rtc5List, ANegativeLaserOnDelayLengthensTheMark) {
    Rig rig;
    rig.put(Op::set_laser_delays, {-50, 0});
    rig.put(Op::mark_abs, {100, 0});
    EXPECT_EQ(rig.go(), 3 + 10 + 1);
    EXPECT_EQ(rig.laser[0], 10);
    EXPECT_EQ(rig.x[2], 0);
    EXPECT_EQ(rig.x[3], 10);
}

TEST(Rtc5List, APositiveArcIsClockwise) {
    Rig rig;
    rig.put(Op::set_mark_speed, {10'000});
    rig.put(Op::arc_abs, {1000, 0, 90});
    rig.go();
    EXPECT_EQ(rig.last_x(), 1000);
    EXPECT_EQ(rig.last_y(), 1000);
}

TEST(Rtc5List, ListsChangeOnceByAutoChangeAndRepeatedlyInALoop) {
    Rig rig;
    rig.put(Op::jump_rel, {10, 0});
    rig.put(Op::set_end_of_list);
    rig.begin(2);
    rig.put(Op::jump_rel, {0, 10});
    rig.put(Op::set_end_of_list);
    rig.card.parts().execution.auto_change();
    ASSERT_TRUE(rig.card.execute_list(1));
    ASSERT_TRUE(rig.card.run_to_rest(1000, &rig));
    EXPECT_EQ(rig.last_x(), 10);
    EXPECT_EQ(rig.last_y(), 10);
    rig.card.parts().execution.start_loop();
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(100);
    EXPECT_EQ(rig.last_x() + rig.last_y(), 20 + 1000);
    EXPECT_TRUE(rig.card.busy());
    rig.card.parts().execution.quit_loop();
    EXPECT_TRUE(rig.card.run_to_rest(1000, &rig));
}

TEST(Rtc5List, ALoopOfListsWithoutDurationDoesNotHang) {
    Rig rig;
    rig.put(Op::set_end_of_list);
    rig.begin(2);
    rig.put(Op::set_end_of_list);
    rig.card.parts().execution.start_loop();
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(3);
    EXPECT_FALSE(rig.card.busy());
}

TEST(Rtc5List, AFullListRejectsCommandsAndARunningOneIsNotRestarted) {
    Rig rig;
    for (int i = 0; i < 1000; ++i) rig.put(Op::list_nop);
    const auto full = rig.card.put(*list_command(Op::list_nop, {}));
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("full at position 1000"), std::string::npos) << full.error().message;
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(2);
    EXPECT_FALSE(rig.card.execute_list(1));
    EXPECT_FALSE(rig.card.parts().lists.configure(10, 10));
    EXPECT_FALSE(rig.card.set_start_list(1, 1 << 20));
    EXPECT_FALSE(rig.card.execute_list(1, -1));
    EXPECT_TRUE(rig.card.set_start_list(2));
    EXPECT_EQ(rig.card.status(), status_bit("BUSY"));
    rig.run(2000);
    EXPECT_FALSE(rig.card.busy());
    EXPECT_EQ(rig.card.state().lists.ended_unwritten, 1) << "list 2 was never written";
}

TEST(Rtc5List, ListsLongerThanTheMemoryAreRejected) {
    constexpr std::int64_t max_length = std::numeric_limits<std::int64_t>::max(),
                           min_length = std::numeric_limits<std::int64_t>::min();
    Rig rig;
    const auto begin = rig.card.state().lists.begin;
    for (const auto& [list1, list2] : {std::pair{max_length, std::int64_t{1}},
                                       {max_length, max_length},
                                       {std::int64_t{1}, max_length},
                                       {max_length, std::int64_t{-1}},
                                       {min_length, std::int64_t{-1}},
                                       {min_length, min_length}}) {
        const auto refused = rig.card.parts().lists.configure(list1, list2);
        ASSERT_FALSE(refused) << list1 << ", " << list2;
        EXPECT_NE(refused.error().message.find("do not fit a memory of"), std::string::npos) << refused.error().message;
        EXPECT_EQ(rig.card.state().lists.begin, begin);
    }
}

TEST(Rtc5List, NonFiniteAndOutOfRangeNumbersAreRejectedWithTheirLocation) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(list_command(Op::mark_abs, {nan, 0}));
    EXPECT_FALSE(list_command(Op::set_fly_x, {infinite}));
    EXPECT_FALSE(list_command(Op::mark_abs, {0.5, 0}));
    EXPECT_FALSE(list_command(Op::mark_abs, {0}));
    EXPECT_FALSE(list_command(Op::wait_for_encoder, {0, 2}));
    EXPECT_FALSE(list_command(Op::none, {}));
    EXPECT_FALSE(list_command(static_cast<Op>(9999), {}));
    EXPECT_FALSE(list_command(Op::set_matrix_list, {1, 0, 0, 51, 1}));
    const auto angle = list_command(Op::arc_abs, {0, 0, 4000});
    ASSERT_FALSE(angle);
    EXPECT_EQ(angle.error().message,
              "arc_abs: Angle is 4000; it must be -3600 to 3600 degrees; the command was not added to the list");
    EXPECT_EQ(list_command(Op::mark_abs, {1e12, -1e12})->p, (std::array<double, 4>{8388607, -8388608, 0, 0}))
        << "coordinates are clipped";
    EXPECT_EQ(list_command(Op::set_mark_speed, {1})->p[0], 1.6);
    Engine card;
    EXPECT_FALSE(card.parts().heads.set_matrix(1, {nan, 0, 0, 1}, 1));
    EXPECT_FALSE(card.parts().heads.set_offset(5, {0, 0}, 1));
    EXPECT_FALSE(card.parts().fly.set_rot_center({nan, 0}));
    EXPECT_FALSE(card.parts().heads.load_table(nullptr, 5));
    EXPECT_FALSE(card.parts().heads.select_tables(1, 9));
    EXPECT_FALSE(card.goto_xy(nan, 0));
    EXPECT_FALSE(check({.list_memory = 10}));
}

TEST(Rtc5List, TheMatrixIsAppliedAfterTheCorrection) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().heads.set_matrix(1, {0.5, -0.866, 0.866, 0.5}, 1));
    rig.put(Op::micro_vector_abs, {1000, 0, -1, -1});
    rig.go();
    EXPECT_EQ(rig.last_x(), 500);
    EXPECT_EQ(rig.last_y(), 866);
}

TEST(Rtc5List, ATransformForTheNextJumpWaitsForIt) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().heads.set_offset(3, {100, 0}, 2));
    rig.put(Op::list_nop);
    rig.put(Op::jump_abs, {0, 0});
    rig.go();
    EXPECT_EQ(rig.x[0], 0);
    EXPECT_EQ(rig.x[1], 100);
}

TEST(Rtc5Starts, TrackDelaysQueueEightStartsAndAStartDuringAListIsLost) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.card.set_control_mode(control_ext_start);
    ASSERT_TRUE(rig.card.set_ext_start_delay(1000, 0));
    rig.put(Op::micro_vector_rel, {1, 0, -1, -1});
    rig.put(Op::set_end_of_list);
    for (int i = 0; i < 8; ++i) {
        rig.card.parts().starts.trigger();
        rig.run(5);
    }
    constexpr std::uint32_t always = startstop_bit("NO_STOP_SIGNAL") | startstop_bit("LASER_ENABLED");
    EXPECT_EQ(rig.card.get_startstop_info(), always) << "none is due";
    rig.card.parts().starts.trigger();
    rig.run(1);
    EXPECT_EQ(rig.card.get_startstop_info(), always | startstop_bit("START_LOST"));
    rig.run(200);
    EXPECT_EQ(rig.card.get_startstop_info(), always | startstop_bit("EXTERNAL_START"));
    EXPECT_EQ(rig.last_x(), 8);
    ASSERT_TRUE(rig.card.set_ext_start_delay(0, 0));
    rig.begin();
    rig.put(Op::long_delay, {50});
    rig.put(Op::set_end_of_list);
    rig.card.parts().starts.trigger();
    rig.run(2);
    rig.card.parts().starts.trigger();
    rig.run(2);
    EXPECT_EQ(rig.card.get_startstop_info() & startstop_bit("START_LOST"), startstop_bit("START_LOST"));
    EXPECT_EQ(rig.card.parts().flags.take_marking_info(), marking_bit("TRIGGER_ERROR"));
}

TEST(Rtc5Starts, NotifiesAListenerOfEachStartAndEndInItsTick) {
    struct Told final : ListListener {
        std::vector<std::pair<std::int64_t, int>> all;  // 0 to 2: fate of a start; 3: end of a list
        void started(std::int64_t tick, StartFate fate) override { all.emplace_back(tick, static_cast<int>(fate)); }
        void ended(std::int64_t tick) override { all.emplace_back(tick, 3); }
    } reported;
    Rig rig;
    rig.card.set_listener(&reported);
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.card.set_control_mode(control_ext_start);
    ASSERT_TRUE(rig.card.set_ext_start_delay(1000, 0));
    rig.put(Op::long_delay, {20});
    rig.put(Op::set_end_of_list);
    rig.card.parts().starts.trigger();
    rig.run(10);  // the start in tick 0 at ten counts is due at 1010, which is tick 100
    rig.card.parts().starts.trigger();
    rig.run(50);
    for (int i = 0; i < 7; ++i) rig.card.parts().starts.trigger();
    rig.card.run_to_rest(1000);
    const std::vector<std::pair<std::int64_t, int>> expected = {
        {60, 2}, {100, 0}, {110, 1}, {120, 3}, {160, 0}, {160, 1}, {160, 1}, {160, 1}, {160, 1}, {160, 1}, {180, 3}};
    EXPECT_EQ(reported.all, expected);
}

TEST(Rtc5Starts, EquidistantPartsAreCountedFromThePreviousStart) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.card.set_control_mode(control_ext_start | control_equidistant);
    ASSERT_TRUE(rig.card.set_ext_start_delay(1000, 0));
    rig.put(Op::micro_vector_rel, {1, 0, -1, -1});
    rig.put(Op::set_end_of_list);
    rig.card.parts().starts.trigger();
    rig.run(110);
    rig.card.parts().starts.trigger();  // in tick 110: ten ticks late, but counted from the first start
    rig.run(200);
    std::vector<std::size_t> at;
    for (std::size_t i = 1; i < rig.x.size(); ++i)
        if (rig.x[i] != rig.x[i - 1]) at.push_back(i);
    ASSERT_EQ(at.size(), 2u);
    EXPECT_EQ(at[1] - at[0], 100u);
}

TEST(Rtc5Starts, ResetAtStartZeroesTheEncoderWithTheList) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.card.set_control_mode(control_ext_start | control_reset_at_start);
    rig.put(Op::set_fly_x, {1});
    rig.go();
    EXPECT_NE(rig.card.encoder(0), 0);
    rig.card.parts().starts.trigger();
    rig.run(1);
    EXPECT_EQ(rig.card.encoder(0), 0);
}

TEST(Rtc5Card, AStateAtAnInstantIsIndependentOfTheDivisionOfTime) {
    const auto state_after = [](std::vector<std::int64_t> steps, bool looked_at) {
        Rig rig;
        static_cast<void>(rig.card.parts().encoders.simulate(1));
        rig.put(Op::set_fly_x, {0.5});
        rig.put(Op::set_laser_delays, {13, 17});
        for (int i = 0; i < 200; ++i) {
            rig.put(Op::mark_rel, {i % 3 ? 77.0 : -400.0, i % 5 * 90.0});
            if (i % 9 == 0) rig.put(Op::jump_rel, {-100, 10});
            if (i % 20 == 0) rig.put(Op::micro_vector_abs, {5, 7, 3, 9});
            if (i % 20 == 0) rig.put(Op::micro_vector_abs, {6, 7, -1, -1});
            if (i % 20 == 0) rig.put(Op::micro_vector_abs, {7, 7, -1, -1});
        }
        static_cast<void>(rig.card.execute_list(1));
        for (std::size_t i = 0; rig.card.tick() < 4000; ++i)
            rig.card.run_until(std::min<std::int64_t>(4000, rig.card.tick() + steps[i % steps.size()]),
                               looked_at ? &rig : nullptr);
        std::vector<std::byte> out(sizeof(State));
        std::memcpy(out.data(), &rig.card.state(), sizeof(State));
        return out;
    };
    const auto whole = state_after({4000}, true);
    EXPECT_EQ(whole, state_after({1}, true));
    EXPECT_EQ(whole, state_after({1, 7, 333}, true));
    EXPECT_EQ(whole, state_after({4000}, false));
    EXPECT_EQ(whole, state_after({3, 1, 600}, false));
}

TEST(Rtc5Card, SettingsOfOneCardDoNotAffectAnother) {
    Rig a, b;
    ASSERT_TRUE(a.card.parts().encoders.simulate(3));
    a.put(Op::set_fly_x, {3});
    a.go();
    b.put(Op::jump_abs, {9, 9});
    b.go();
    EXPECT_EQ(b.card.encoder(0), 0);
    EXPECT_EQ(b.last_x(), 9);
}

TEST(Rtc5List, TheTimeToStandstillIsTheSameWithAndWithoutObservers) {
    for (const double target :
         {51'100.0, 51'200.0, 51'300.0, 102'400.0}) {  // 511, 512, 513 and 1024 ticks: ends of blocks
        Rig seen, unseen;
        for (Rig* rig : {&seen, &unseen}) {
            rig->card.parts().path.set_jump_speed(10'000);
            ASSERT_TRUE(rig->card.goto_xy(target, 0));
        }
        EXPECT_TRUE(seen.card.run_to_rest(10'000, &seen));
        EXPECT_TRUE(unseen.card.run_to_rest(10'000));
        EXPECT_EQ(seen.card.tick(), unseen.card.tick()) << target;
        EXPECT_EQ(seen.card.tick(), target / 100 + 1) << "the tick that finds it there is done";
        EXPECT_EQ(seen.x.size(), static_cast<std::size_t>(seen.card.tick()));
    }
}

}  // namespace
}  // namespace motionrack::rtc5
