// Tests of recorded signals, single values, words sent over McBSP, the disabled laser, and the opening of lists.
#include <gtest/gtest.h>

#include <motionrack/cards/rtc5/test/rig.hpp>

namespace motionrack::rtc5 {
namespace {

std::vector<std::int32_t> recorded(const Engine& card, std::int64_t channel) {
    std::vector<std::int32_t> out;
    for (std::int64_t i = 0; i < card.parts().recorder.recording().count; ++i)
        out.push_back(card.parts().recorder.recorded(channel, i));
    return out;
}

void micro_vectors(Rig& rig, int n) {
    for (int i = 0; i < n; ++i) rig.put(Op::micro_vector_rel, {10, -1, -1, -1});
}

TEST(Rtc5Recording, SetTrigger4TakesASampleAtOnceAndThenOnePerPeriod) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(3));
    rig.put(Op::set_fly_x, {0.5});
    rig.put(Op::set_trigger4, {3, 7, 20, 43, 8});
    micro_vectors(rig, 10);
    rig.go();
    // set_fly_x takes the tick before that of set_trigger4: 10 counts per tick, which are 5 bits.
    EXPECT_EQ(recorded(rig.card, 0), (std::vector<std::int32_t>{5, 30 + 20, 60 + 35, 90 + 50}));
    EXPECT_EQ(recorded(rig.card, 1), recorded(rig.card, 0));
    EXPECT_EQ(recorded(rig.card, 2), (std::vector<std::int32_t>{10, 40, 70, 100}));
    EXPECT_EQ(recorded(rig.card, 3), (std::vector<std::int32_t>{0, -3, -6, -9}));
}

TEST(Rtc5Recording, SetTriggerStartsInItsTickAndAPolylineContinuesThroughIt) {
    Rig rig;
    rig.put(Op::set_mark_speed, {1000});
    rig.put(Op::set_scanner_delays, {0, 7, 2});
    rig.put(Op::mark_abs, {50, 0});
    rig.put(Op::set_trigger, {1, 7, 0});
    rig.put(Op::mark_abs, {50, 30});
    const std::int64_t ticks = rig.go();
    EXPECT_EQ(ticks, 5 + 2 + 3 + 7 + 1);
    EXPECT_EQ(std::count(rig.laser.begin(), rig.laser.end(), 20), 10) << "the laser stays on through the corner";
    EXPECT_EQ(rig.card.parts().recorder.recording().count, 3 + 7);
    EXPECT_EQ(recorded(rig.card, 1), (std::vector<std::int32_t>{1, 1, 1, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Rtc5Recording, StagesOfTheHeadAreRecordedSeparately) {
    Rig rig;
    CorrectionFile shifted = one_to_one();
    for (std::int32_t& x : shifted.x) x = std::min(x + 1000, 1'048'575);
    ASSERT_TRUE(rig.card.parts().heads.load_table(table_of(shifted), 1));
    ASSERT_TRUE(rig.card.parts().heads.select_tables(1, 0));
    ASSERT_TRUE(rig.card.parts().heads.set_offset(1, {30, 0}, 1));
    ASSERT_TRUE(rig.card.parts().heads.set_hi(1, {2, 1}, {5, 0}));
    rig.put(Op::micro_vector_abs, {100, 7, 0, -1});
    rig.go();
    const std::pair<std::uint32_t, std::int32_t> expected[] = {
        {7, 100}, {8, 7},  {25, 130}, {10, 1130}, {20, 2 * 1130 + 5}, {1, 2265}, {16, 2265}, {21, 7}, {11, 7},
        {0, 1},   {22, 0}, {13, 0},   {28, 0},    {45, 1000}};
    for (const auto& [signal, value] : expected)
        EXPECT_EQ(rig.card.parts().recorder.value(signal).value(), value) << signal;
    rig.put(Op::laser_signal_off_list);
    rig.put(Op::list_nop);
    EXPECT_FALSE(rig.card.parts().recorder.value(3));
    EXPECT_FALSE(rig.card.parts().recorder.value(4711));
    rig.card.stop_execution();
    rig.run(1);
    EXPECT_EQ(rig.card.parts().recorder.value(16).value(), -524288) << "the laser is off";
}

TEST(Rtc5Recording, ContinuesInTheNextListAndKeepsItsSamplesWhenItEnds) {
    Rig rig;
    rig.put(Op::set_trigger, {1, 7, 8});
    micro_vectors(rig, 3);
    rig.go();
    EXPECT_EQ(rig.card.parts().recorder.recording().count, 3);
    rig.run(10);
    EXPECT_EQ(rig.card.parts().recorder.recording().count, 3) << "no list runs";
    rig.begin();
    micro_vectors(rig, 2);
    rig.put(Op::set_trigger, {0, 7, 8});
    micro_vectors(rig, 2);
    rig.go();
    EXPECT_EQ(recorded(rig.card, 0), (std::vector<std::int32_t>{10, 20, 30, 40, 50}));
    EXPECT_EQ(rig.card.parts().recorder.recording().period, 0);
    rig.begin();
    rig.put(Op::set_trigger, {1, 8, 8});
    micro_vectors(rig, 50);
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(4);
    rig.card.stop_execution();
    rig.run(4);
    EXPECT_EQ(recorded(rig.card, 1), (std::vector<std::int32_t>{-8, -9, -10, -11}));
    EXPECT_EQ(rig.card.parts().recorder.recording().period, 0);
}

TEST(Rtc5Recording, EndsWhenItsMemoryIsFull) {
    Rig rig;
    rig.put(Op::set_trigger4, {1, 7, 8, 43, 44});
    rig.put(Op::long_delay, {600'000});
    rig.go();
    EXPECT_EQ(rig.card.parts().recorder.recording().count, 1 << 19);
    EXPECT_EQ(rig.card.parts().recorder.recording().period, 0);
}

TEST(Rtc5Recording, IsTheSameWithAndWithoutObservers) {
    Engine cards[2] = {Engine(Settings{4096, 1000, 1000}), Engine(Settings{4096, 1000, 1000})};
    Rig looking;
    for (Engine& card : cards) {
        ASSERT_TRUE(card.parts().encoders.simulate(1));
        for (const Command& c : {*list_command(Op::set_fly_x, {0.25}), *list_command(Op::set_trigger, {7, 7, 43}),
                                 *list_command(Op::mark_abs, {9000, 50}), *list_command(Op::jump_abs, {-700, 800}),
                                 *list_command(Op::set_end_of_list, {})})
            ASSERT_TRUE(card.put(c));
        ASSERT_TRUE(card.execute_list(1));
        card.run_until(3000, &card == &cards[0] ? &looking : nullptr);
    }
    EXPECT_GT(cards[0].parts().recorder.recording().count, 100);
    EXPECT_EQ(recorded(cards[0], 0), recorded(cards[1], 0));
    EXPECT_EQ(recorded(cards[0], 1), recorded(cards[1], 1));
}

TEST(Rtc5Recording, ZIsThatOfTheLastTickWithAndWithoutObservers) {
    for (const bool looks : {false, true}) {
        Rig rig;
        ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
        rig.put(Op::set_fly_z, {0.5, 0});
        rig.put(Op::long_delay, {300});
        rig.put(Op::set_end_of_list);
        ASSERT_TRUE(rig.card.execute_list(1));
        rig.card.run_until(201, looks ? &rig : nullptr);
        EXPECT_EQ(rig.card.output().z, 0.5 * 2000);
        EXPECT_EQ(rig.card.parts().recorder.value(9).value(), 1000);
    }
}

TEST(Rtc5Mcbsp, SendsItsSignalsInTurn) {
    Rig rig;
    rig.put(Op::long_delay, {100});
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    EXPECT_EQ(rig.card.parts().recorder.sent(), 0);
    ASSERT_TRUE(rig.card.parts().recorder.send(std::array<std::uint32_t, 3>{43, 45, 7}));
    EXPECT_EQ(rig.card.parts().recorder.sent(), 0) << "from the next tick on";
    std::vector<std::int32_t> sent;
    for (int i = 0; i < 5; ++i) rig.run(1), sent.push_back(rig.card.parts().recorder.sent());
    EXPECT_EQ(sent, (std::vector<std::int32_t>{10, 1000, 0, 40, 1000}));
    EXPECT_FALSE(rig.card.parts().recorder.send(std::array<std::uint32_t, 2>{43, 6}));
    EXPECT_FALSE(rig.card.parts().recorder.send(std::array<std::uint32_t, 9>{}));
    rig.run(2);
    EXPECT_EQ(rig.card.parts().recorder.sent(), 70) << "what was refused changed nothing";
    ASSERT_TRUE(rig.card.parts().recorder.send({}));
    rig.run(1);
    EXPECT_EQ(rig.card.parts().recorder.sent(), 0);
}

TEST(Rtc5Mcbsp, TheCurrentWordIsReadAndStoredAtLocation0) {
    Rig rig;
    rig.card.parts().mcbsp.receive(0xFFFE0003);
    EXPECT_FALSE(rig.card.parts().mcbsp.store_now()) << "it is not taken yet";
    rig.run(1);
    EXPECT_FALSE(rig.card.parts().mcbsp.read(0));
    EXPECT_EQ(rig.card.parts().mcbsp.store_now(), static_cast<std::int32_t>(0xFFFE0003));
    EXPECT_EQ(rig.card.parts().mcbsp.read(0), static_cast<std::int32_t>(0xFFFE0003));
    rig.card.parts().mcbsp.receive(12345);
    rig.put(Op::list_nop);
    rig.put(Op::get_mcbsp_list);
    rig.go();
    EXPECT_EQ(rig.card.parts().mcbsp.read(0), 12345);
}

TEST(Rtc5Mcbsp, OnlinePositioningInListsKeepsTheOtherAxes) {
    Rig rig;
    rig.put(Op::set_mcbsp_x_list, {2});
    rig.put(Op::set_mcbsp_y_list, {3});
    rig.put(Op::long_delay, {5});
    rig.put(Op::apply_mcbsp_list, {1, 1});
    rig.put(Op::list_nop);
    rig.card.parts().mcbsp.receive(0x0005FFF9);
    rig.go();
    EXPECT_EQ(rig.last_x(), -7 * 2);
    EXPECT_EQ(rig.last_y(), 5 * 3);
}

TEST(Rtc5Laser, StaysOffWhileDisabled) {
    Rig rig;
    rig.put(Op::set_mark_speed, {1000});
    rig.put(Op::mark_abs, {200, 0});
    rig.put(Op::mark_abs, {0, 0});
    rig.put(Op::list_nop);
    rig.put(Op::mark_abs, {100, 0});
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(5);
    rig.card.parts().laser.disable();
    rig.run(10);
    EXPECT_EQ(std::count(rig.laser.begin(), rig.laser.end(), 20), 5);
    EXPECT_EQ(rig.card.get_startstop_info() & startstop_bit("LASER_ENABLED"), 0u);
    rig.card.parts().laser.enable();
    rig.run(26);
    EXPECT_EQ(std::count(rig.laser.begin(), rig.laser.end(), 20), 5) << "on again with the next polyline";
    rig.run(30);
    EXPECT_EQ(std::count(rig.laser.begin(), rig.laser.end(), 20), 5 + 10);
}

TEST(Rtc5List, StatusReportsWhichListIsLoadedReadyBusyAndUsed) {
    Rig rig;
    const auto bits = [&] { return rig.card.parts().lists.status(); };
    constexpr std::uint32_t load1 = list_status_bit("LOAD1"), load2 = list_status_bit("LOAD2"),
                            ready1 = list_status_bit("READY1"), busy1 = list_status_bit("BUSY1"),
                            busy2 = list_status_bit("BUSY2"), used1 = list_status_bit("USED1"),
                            used2 = list_status_bit("USED2"), ready2 = list_status_bit("READY2");
    EXPECT_EQ(bits(), used1 | used2);
    EXPECT_EQ(rig.card.parts().lists.load_list(3, 0).value(), 2u) << "what an automatic change would run";
    EXPECT_EQ(rig.card.parts().lists.load_list(1, 0).value(), 1u);
    EXPECT_EQ(bits(), load1);
    rig.put(Op::long_delay, {10});
    rig.put(Op::set_end_of_list);
    EXPECT_EQ(bits(), ready1);
    ASSERT_TRUE(rig.card.execute_list(3));  // odd numbers select list 1
    rig.run(1);
    EXPECT_EQ(bits(), ready1 | busy1);
    EXPECT_EQ(rig.card.parts().lists.load_list(1, 0).value(), 0u);
    EXPECT_FALSE(rig.card.put(*list_command(Op::list_nop, {}))) << "no list is open";
    EXPECT_EQ(rig.card.parts().lists.load_list(3, 0).value(), 0u) << "list 2 is free, but did not run";
    EXPECT_EQ(rig.card.parts().lists.load_list(0, 0).value(), 2u);
    EXPECT_EQ(bits(), ready1 | busy1 | load2);
    rig.put(Op::list_nop);
    rig.put(Op::set_end_of_list);
    rig.card.parts().execution.auto_change();
    rig.run(10);
    EXPECT_EQ(bits(), ready1 | ready2 | used1 | busy2);
    EXPECT_EQ(rig.card.parts().lists.load_list(3, 4).value(), 1u);
    EXPECT_EQ(rig.card.input_pointer(), 4);
    EXPECT_EQ(bits(), load1 | ready2 | busy2);
}

TEST(Rtc5List, PositionsCountFromTheBeginningOfTheListAndAreZeroBehindItsEnd) {
    Rig rig;
    ASSERT_TRUE(rig.card.set_start_list(2, 5));
    EXPECT_EQ(rig.card.input_pointer(), 1005);
    ASSERT_TRUE(rig.card.set_start_list(4, 1000));
    EXPECT_EQ(rig.card.input_pointer(), 1000);
    rig.put(Op::jump_abs, {1, 1});
    rig.put(Op::jump_abs, {2, 2});
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.execute_list(2, 1));
    ASSERT_TRUE(rig.card.run_to_rest(100));
    EXPECT_EQ(rig.last_x(), 2);
    EXPECT_EQ(rig.card.parts().execution.position(), 1002);
    ASSERT_TRUE(rig.card.parts().lists.configure(100, -1));
    ASSERT_TRUE(rig.card.set_start_list(2, 3000));
    EXPECT_EQ(rig.card.input_pointer(), 3100);
    ASSERT_TRUE(rig.card.parts().lists.configure(100, 0));
    ASSERT_TRUE(rig.card.set_start_list(2, 50));
    EXPECT_EQ(rig.card.input_pointer(), 50) << "a list 2 without memory is list 1";
}

}  // namespace
}  // namespace motionrack::rtc5
