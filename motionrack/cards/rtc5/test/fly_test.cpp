// Tests of processing on the fly through the public interface, with results of the source's formulas.
#include <cmath>
#include <motionrack/cards/rtc5/test/rig.hpp>

namespace motionrack::rtc5 {
namespace {

constexpr double fly_k = 5184;  // bits/mm

/// Inputs: encoder counts that grow at a constant rate, and McBSP words from a list.
class Belt final : public Inputs {
  public:
    double per_tick = 0;
    std::vector<std::uint32_t> words_of_ticks;
    void counts(int, std::int64_t first, std::span<std::int32_t> out) override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = static_cast<std::int32_t>(
                std::floor(per_tick * static_cast<double>(first + static_cast<std::int64_t>(i))));
    }
    bool words(std::int64_t first, std::span<std::uint32_t> out) override {
        if (words_of_ticks.empty()) return false;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = words_of_ticks[std::min(static_cast<std::size_t>(first) + i, words_of_ticks.size() - 1)];
        return true;
    }
};

TEST(Rtc5Fly, AnEncoderOf2000CountsAMillimetreMovesTheOutputByAMicrometreATick) {
    Rig rig;
    Belt belt;
    belt.per_tick = 2;
    rig.card.set_inputs(&belt);
    rig.run(5);
    rig.put(Op::set_fly_x, {fly_k / 2000});
    rig.put(Op::long_delay, {10'000});
    rig.go();
    EXPECT_EQ(rig.x[5], 0);
    EXPECT_EQ(rig.x[6], 5);  // 2 counts are 1 um, 5.184 bits
    EXPECT_EQ(rig.x[5 + 10'000], 51'840);
    EXPECT_EQ(rig.y[5 + 10'000], 0);
}

TEST(Rtc5Fly, TheSimulatedEncoderCountsAMillionASecond) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(3));
    rig.put(Op::set_fly_x, {fly_k * 100 / 1e6});
    rig.put(Op::long_delay, {9'999});
    rig.go();
    EXPECT_EQ(rig.card.encoder(0), 100'000);
    EXPECT_EQ(rig.last_x(), 51'840);
}

TEST(Rtc5Fly, SetFlyZeroesItsOwnEncoderOnlyAndScaleZeroTurnsOff) {
    Rig rig;
    rig.card.parts().encoders.set_count(0, 700);
    rig.card.parts().encoders.set_count(1, 900);
    rig.run(1);
    rig.put(Op::set_fly_x, {1});
    rig.put(Op::set_fly_x, {0});
    rig.go();
    EXPECT_EQ(rig.card.encoder(0), 0);
    EXPECT_EQ(rig.card.encoder(1), 900);
    EXPECT_FALSE(rig.card.state().fly.on());
}

TEST(Rtc5Fly, AMcBspWordIsA32BitPositionForOneAxis) {
    for (const auto& [word, x] : {std::pair{12345u, 63'996}, std::pair{0xFFFFFFFFu, -5}}) {
        Rig rig;
        rig.put(Op::set_fly_x_pos, {5.184});
        rig.put(Op::list_nop);
        rig.card.parts().mcbsp.receive(word);
        rig.go();
        EXPECT_EQ(rig.last_x(), x);
        EXPECT_EQ(rig.card.parts().mcbsp.read(0), static_cast<std::int32_t>(word));
    }
}

TEST(Rtc5Fly, AMcBspWordIsTwo16BitPositionsForTwoAxes) {
    struct Case {
        std::uint32_t word;
        double x, y;
    };
    for (const Case& c : {Case{0xFFFE0003, 155.52, -103.68}, Case{0x80007FFF, 32767 * 51.84, -32768 * 51.84},
                          Case{0x0000FFFF, -51.84, 0}, Case{0xFFFF0000, 0, -51.84}}) {
        Rig rig;
        rig.put(Op::set_fly_x_pos, {51.84});
        rig.put(Op::set_fly_y_pos, {51.84});
        rig.put(Op::list_nop);
        rig.card.parts().mcbsp.receive(c.word);
        rig.go();
        EXPECT_DOUBLE_EQ(rig.card.output().corrected.x, c.x);
        EXPECT_DOUBLE_EQ(rig.card.output().corrected.y, c.y);
    }
}

TEST(Rtc5Fly, TwoReadingsOfTheMcBspGiveTheScale) {
    Rig rig;
    rig.put(Op::set_fly_x_pos, {1});
    rig.card.parts().mcbsp.receive(1000);
    rig.go();
    const std::int32_t before = rig.card.parts().mcbsp.read(0).value();
    rig.card.parts().mcbsp.receive(51'000);
    rig.run(1);
    const double increment = (rig.card.parts().mcbsp.read(0).value() - before) / 50.0;
    EXPECT_DOUBLE_EQ(increment, 1000);
    EXPECT_DOUBLE_EQ(fly_k / increment, 5.184);
}

TEST(Rtc5Fly, LocationZeroIsWrittenAfterFlyReturnAndAfterAReset) {
    Rig rig;
    rig.card.parts().mcbsp.receive(5);
    rig.run(1);
    const auto unread = rig.card.parts().mcbsp.read(0);
    ASSERT_FALSE(unread);
    EXPECT_EQ(unread.error().message,
              "read_mcbsp: location 0 is empty; first use "
              "set_fly_x_pos, set_fly_y_pos or set_fly_rot_pos in a list (with any scale), or set_mcbsp_in, "
              "set_multi_mcbsp_in or get_mcbsp");
    rig.put(Op::set_fly_x_pos, {1});
    rig.put(Op::fly_return, {0, 0});
    rig.go();
    rig.card.parts().mcbsp.receive(77);
    rig.run(1);
    EXPECT_EQ(rig.card.parts().mcbsp.read(0), 77);
    rig.card.load_program_file();
    rig.card.parts().mcbsp.receive(78);
    rig.run(1);
    EXPECT_EQ(rig.card.parts().mcbsp.read(0), 78);
    EXPECT_FALSE(rig.card.state().fly.on());
}

TEST(Rtc5Fly, SetMcbspInUsesAllLocationsAndMultiWritesRoundRobin) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().fly.set_mcbsp_in(3, 1));
    for (int location = 0; location < 4; ++location)
        EXPECT_EQ(rig.card.parts().mcbsp.read(location).error().message,
                  "read_mcbsp: no word was received over McBSP yet; let the sender send one first");
    rig.card.parts().mcbsp.receive(0xFFFE0003);
    rig.run(1);
    EXPECT_EQ(rig.card.parts().mcbsp.read(0), static_cast<std::int32_t>(0xFFFE0003)) << "there as well";
    EXPECT_EQ(rig.card.parts().mcbsp.read(1), 3);
    EXPECT_EQ(rig.card.parts().mcbsp.read(2), -2);
    EXPECT_EQ(rig.card.parts().mcbsp.read(3), static_cast<std::int32_t>(0xFFFE0003));
    ASSERT_TRUE(rig.card.parts().fly.set_multi_mcbsp_in(0, 8192, 1));
    rig.card.parts().mcbsp.receive(1000u << 3 | 3);
    rig.card.parts().mcbsp.receive(100u << 3 | 0);
    rig.card.parts().mcbsp.receive(static_cast<std::uint32_t>(-50) << 3 | 1);
    rig.run(1);
    EXPECT_EQ(rig.last_x(), 100);
    EXPECT_EQ(rig.last_y(), -50);
    EXPECT_EQ(rig.card.parts().mcbsp.read(1), 800);
    EXPECT_EQ(rig.card.parts().mcbsp.read(2), -399);
    EXPECT_EQ(rig.card.parts().mcbsp.power(), 500);
    EXPECT_EQ(rig.card.parts().mcbsp.typed(1), -50);
}

TEST(Rtc5Fly, OnlinePositioningUsesLocations1And2AndMovesWhenApplied) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().fly.set_mcbsp_online(2, 3, 0));
    rig.card.parts().mcbsp.receive(0xFFFE0003);
    rig.run(1);
    EXPECT_EQ(rig.last_x(), 0);
    EXPECT_EQ(rig.card.parts().mcbsp.read(1), static_cast<std::int32_t>(0xFFFE0003));
    ASSERT_TRUE(rig.card.apply_mcbsp(1, 1));
    rig.run(1);
    EXPECT_EQ(rig.last_x(), 6);
    EXPECT_EQ(rig.last_y(), -6);
    for (const int location : {0, 2, 3}) EXPECT_FALSE(rig.card.parts().mcbsp.read(location)) << location;
    ASSERT_TRUE(rig.card.parts().fly.set_mcbsp_online(1, 0, 3600));
    rig.card.parts().mcbsp.receive(1000);
    rig.card.parts().mcbsp.receive(0x80000000u | 900);
    rig.run(1);
    rig.card.parts().mcbsp.receive(1000);
    rig.run(1);
    ASSERT_TRUE(rig.card.apply_mcbsp(1, 1));
    EXPECT_DOUBLE_EQ(rig.card.state().transforms.heads[0].transform.angle_deg, 90);
    EXPECT_EQ(rig.card.state().transforms.heads[0].transform.offset.x, 1000);
    rig.card.parts().fly.set_mcbsp_matrix();
    rig.card.parts().mcbsp.receive(static_cast<std::uint32_t>(-(1 << 23)) << 2 | 2);  // M21 = -0.5
    rig.run(1);
    ASSERT_TRUE(rig.card.apply_mcbsp(4, 1));
    EXPECT_EQ(rig.card.state().transforms.global.matrix[2], -0.5);
}

TEST(Rtc5Fly, TheRotaryCorrectionTurnsCounterClockwiseAboutItsCentre) {
    const double bits = 1048576.0 / 60;
    struct Case {
        std::int32_t count;
        double x_mm, y_mm;
        std::uint32_t flags;
    };
    for (const Case& c : {Case{300, -6.6987, 25, 0}, Case{900, -50, 50, 0b1001}, Case{-900, -50, -50, 0b0101}}) {
        Rig rig;
        ASSERT_TRUE(rig.card.parts().fly.set_rot_center({std::floor(-50 * bits), 0}));
        rig.put(Op::set_fly_rot, {3600});
        rig.put(Op::list_nop);
        rig.go();
        rig.card.parts().encoders.set_count(0, c.count);
        rig.run(1);
        EXPECT_NEAR(rig.card.output().corrected.x / bits, c.x_mm, 1e-4);
        EXPECT_NEAR(rig.card.output().corrected.y / bits, c.y_mm, 1e-4);
        EXPECT_EQ(rig.card.parts().flags.take_marking_info(), c.flags);
        EXPECT_EQ(rig.card.parts().flags.take_marking_info(), 0u);
    }
}

TEST(Rtc5Fly, TheTrackingErrorExtrapolatesTheCount) {
    Rig rig;
    Belt belt;
    belt.per_tick = 2;
    rig.card.set_inputs(&belt);
    rig.card.parts().encoders.set_tracking_error(15, 0);
    rig.put(Op::set_fly_x, {1});
    rig.put(Op::long_delay, {50});
    rig.go();
    EXPECT_EQ(rig.last_x(), rig.card.encoder(0) + 30);
    EXPECT_EQ(rig.x[0], 0) << "the empty cycle";
    EXPECT_EQ(rig.x[1], 32);
}

TEST(Rtc5Fly, AMissedWaitLastsTwoToThe31Counts) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.run(100);
    rig.put(Op::wait_for_encoder, {1000, 0});
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.execute_list(1));
    ASSERT_TRUE(rig.card.run_to_rest(300'000'000));
    EXPECT_NEAR(static_cast<double>(rig.card.tick()) * 1e-5 / 60, 35.79, 0.01);
}

TEST(Rtc5Fly, ASquareOnABeltIsASquareOnThePart) {
    // Marks a square of 10 mm at 500 mm/s on a belt at 100 mm/s; the corners are in part coordinates.
    const double corners_off[5][2] = {{0, 0}, {8, 0}, {6, 10}, {-6, 10}, {-8, 0}},
                 corners_on[5][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
    for (const bool fly : {false, true}) {
        Rig rig;
        ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
        rig.put(Op::set_fly_x, {fly ? fly_k * 100 / 1e6 : 0});
        rig.put(Op::set_mark_speed, {2592});
        for (const auto& [x, y] : {std::pair{10, 0}, std::pair{10, 10}, std::pair{0, 10}, std::pair{0, 0}})
            rig.put(Op::mark_abs, {x * fly_k, y * fly_k});
        EXPECT_EQ(rig.go(), 8002);
        for (int i = 0; i < 5; ++i) {
            const auto tick = static_cast<std::size_t>(i * 2000);
            const double belt = static_cast<double>(tick) * 1e-5 * 100;  // travel of the part since tick 0
            EXPECT_NEAR(rig.x[tick] / fly_k - belt, (fly ? corners_on : corners_off)[i][0], 0.0011) << i;
            EXPECT_NEAR(rig.y[tick] / fly_k, (fly ? corners_on : corners_off)[i][1], 0.0011) << i;
        }
    }
}

TEST(Rtc5Fly, ConditionalCommandsReadTheLimitFlagsAndClearThem) {
    Rig rig;
    rig.put(Op::set_fly_limits, {-1000, 1000, -1000, 1000});
    rig.put(Op::activate_fly_xy, {1, 1});
    rig.put(Op::micro_vector_abs, {2000, 0, -1, -1});
    rig.put(Op::if_fly_x_overflow, {-1});
    rig.put(Op::write_io_port_list, {1});
    rig.put(Op::if_fly_x_overflow, {1});
    rig.put(Op::write_io_port_list, {2});
    rig.put(Op::micro_vector_abs, {0, 0, -1, -1});
    rig.put(Op::if_not_fly_x_overflow, {0});
    rig.put(Op::micro_vector_abs, {5, 5, -1, -1});
    rig.go();
    EXPECT_EQ(rig.card.state().io, 2);
    EXPECT_EQ(rig.last_x(), 5);
    EXPECT_EQ(rig.card.parts().flags.take_marking_info(), 0u);
}

TEST(Rtc5Fly, PositionsOutsideTheFieldAreClippedFlaggedAndReported) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.put(Op::set_fly_x, {52.42881});
    rig.put(Op::long_delay, {3000});
    rig.go();
    EXPECT_EQ(rig.last_x(), 524'287);
    EXPECT_EQ(rig.card.state().flags.flag_tick[1], 1000);
    EXPECT_EQ(decoded(rig.card.parts().flags.take_marking_info(), map::marking_info_bits),
              std::vector<std::string>{"FLY_X_OVERFLOW: the corrected X was above 524287"});
}

TEST(Rtc5Fly, StoredEncodersAreReadAndTheirVelocityIsSmoothed) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.put(Op::set_encoder_speed, {0, 1000, 0.5});
    rig.put(Op::store_encoder, {1});
    rig.put(Op::long_delay, {200});
    rig.go();
    EXPECT_EQ(rig.card.parts().encoders.stored(1)[0], 10);
    EXPECT_EQ(rig.card.parts().encoders.stored(0)[0], 0);
    EXPECT_NEAR(rig.card.parts().encoders.speed(), 1000, 1e-6);
}

TEST(Rtc5Fly, TheExtentGivesTheMarginOfAJobWithAndWithoutObservers) {
    const auto extent = [](double scale, bool looked_at) {
        Rig rig;
        EXPECT_TRUE(rig.card.parts().encoders.simulate(1));
        EXPECT_TRUE(rig.card.parts().pipeline.extent().empty());
        rig.put(Op::set_fly_x, {scale});
        rig.put(Op::set_mark_speed, {2592});
        rig.put(Op::mark_abs, {0, -7000});
        rig.put(Op::mark_abs, {20'000, 9000});
        rig.put(Op::fly_return, {0, 0});
        rig.put(Op::set_end_of_list);
        EXPECT_TRUE(rig.card.execute_list(1));
        EXPECT_TRUE(rig.card.run_to_rest(1'000'000, looked_at ? &rig : nullptr));
        return rig.card.parts().pipeline.extent();
    };
    for (const double scale : {0.5, 100.0}) {
        const PlanExtent seen = extent(scale, true), unseen = extent(scale, false);
        EXPECT_NEAR(seen.max_x, unseen.max_x, 1e-6);
        EXPECT_NEAR(seen.min_y, unseen.min_y, 1e-6);
        EXPECT_NEAR(seen.min_y, -7000, 1e-6);
        EXPECT_EQ(seen.max_y, 9000);
        EXPECT_EQ(seen.max_x > max_field, scale == 100.0);
    }
}

TEST(Rtc5Fly, FlyReturnJumpsFromTheCorrectedPosition) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.put(Op::set_jump_speed, {10'000});
    rig.put(Op::set_fly_x, {1});
    rig.put(Op::long_delay, {100});
    rig.put(Op::fly_return, {0, 0});
    rig.go();
    EXPECT_EQ(rig.x[100], 1000);
    EXPECT_EQ(rig.x[101], 918);  // 1010 bits at 100 bits per tick take eleven ticks
    EXPECT_EQ(rig.last_x(), 0);
    EXPECT_FALSE(rig.card.state().fly.on());
}

TEST(Rtc5Fly, ParkingPausesTheCorrectionAndReturnsToThePart) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().encoders.simulate(1));
    rig.put(Op::set_fly_x, {1});
    rig.put(Op::jump_abs, {500, 0});
    rig.put(Op::park_position, {0, -3000, 0});
    rig.put(Op::long_delay, {10});
    rig.put(Op::park_return, {0, 0, 0});
    rig.go();
    EXPECT_EQ(rig.last_x(), 500 + rig.card.encoder(0));
    EXPECT_NE(std::find(rig.x.begin(), rig.x.end(), -3000), rig.x.end());
}

TEST(Rtc5Fly, ACompensationTableIsReadCheckedAndAdded) {
    const char* const text =
        "; comment\n[Fly2DTable2]\n0 0 9 9\n[Fly2DTable1]\n0 0 0 0\n100 0 10 -10 ; end\n0 100 0 0\n100 100 10 -10\n0 0 "
        "2 2\n[Fly2DTable1]\nnonsense\n";
    const auto table = FlyTable::read(text, 1, "t.txt");
    ASSERT_TRUE(table) << table.error().text();
    EXPECT_DOUBLE_EQ(table->at(0, 0).x, 2) << "the last of a point counts";
    EXPECT_DOUBLE_EQ(table->at(50, 100).x, 5);
    EXPECT_DOUBLE_EQ(table->at(1e9, 1e9).y, -10);
    EXPECT_NE(FlyTable::read(text, 7, "t.txt").error().text().find("[Fly2DTable7]"), std::string::npos);
    EXPECT_NE(FlyTable::read("[Fly2DTable1]\n0 0 0\n", 1, "t.txt").error().text().find("t.txt:2"), std::string::npos);
    EXPECT_FALSE(FlyTable::read("[Fly2DTable1]\n0 0 0 0\n1 1 0 0\n", 1, "t.txt"));
    EXPECT_FALSE(FlyTable::read("[Fly2DTable1]\n0 0 0 99999999999\n", 1, "t.txt"));
    Rig rig;
    rig.card.parts().fly.load_table(std::make_shared<const FlyTable>(*table));
    rig.put(Op::set_fly_2d, {1, 1});
    rig.go();
    rig.card.parts().encoders.set_count(0, 100);
    rig.run(1);
    EXPECT_EQ(rig.last_x(), 110);
    EXPECT_EQ(rig.last_y(), -10);
}

TEST(Rtc5Fly, Activate2DWithoutATableIsAnError) {
    Rig rig;
    rig.put(Op::activate_fly_2d, {1, 1});
    rig.go();
    EXPECT_EQ(rig.card.parts().flags.take_marking_info(), marking_bit("ACTIVATE_FLY_ERROR"));
    EXPECT_FALSE(rig.card.state().fly.on());
}

}  // namespace
}  // namespace motionrack::rtc5
