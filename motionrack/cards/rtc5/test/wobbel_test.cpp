// Tests of the wobbel about a marked path, and of subroutines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/test/rig.hpp>

namespace motionrack::rtc5 {
namespace {

TEST(Rtc5Wobbel, MovesOnAnEllipseAroundMarksAndNotAroundJumps) {
    Rig rig;
    rig.put(Op::set_mark_speed, {1000});  // 10 bits per tick
    rig.put(Op::set_jump_speed, {1000});
    rig.put(Op::set_wobbel, {100, 40, 2500});  // 40 ticks per turn
    rig.put(Op::mark_abs, {800, 0});
    rig.put(Op::jump_abs, {1000, 0});
    rig.go();
    ASSERT_GE(rig.x.size(), 100u);
    EXPECT_EQ(rig.x[9], 100) << "a quarter of a turn: all of it is across";
    EXPECT_EQ(rig.y[9], 100) << "to the left of the motion";
    EXPECT_EQ(rig.x[19], 200 - 40);
    EXPECT_EQ(rig.y[19], 0);
    EXPECT_EQ(rig.y[29], -100);
    EXPECT_EQ(rig.x[39], 400 + 40);
    EXPECT_EQ(rig.x[80], 810) << "the jump is straight";
    EXPECT_EQ(rig.y[80], 0);
    EXPECT_EQ(rig.card.state().p.x, 1000);
}

TEST(Rtc5Wobbel, TurnsWithThePathAndContinuesInCorners) {
    Rig rig;
    rig.put(Op::set_mark_speed, {1000});
    rig.put(Op::set_scanner_delays, {0, 0, 20});
    rig.put(Op::set_wobbel, {100, 0, 2500});
    rig.put(Op::mark_abs, {0, 400});
    rig.put(Op::mark_abs, {400, 400});
    rig.go();
    EXPECT_EQ(rig.x[9], -100) << "left of a motion upwards";
    EXPECT_EQ(rig.y[9], 100);
    EXPECT_EQ(rig.x[49], -100) << "in the corner's delay, as on the mark before";
    EXPECT_EQ(rig.y[49], 400);
    EXPECT_EQ(rig.y[69], 400 - 100) << "three quarters of the second turn, left of a motion to the right";
    rig.begin();
    rig.put(Op::jump_abs, {1000, 0});
    rig.put(Op::arc_abs, {0, 0, -90});  // counter-clockwise
    rig.x.clear(), rig.y.clear();
    rig.go();
    const std::size_t begin = static_cast<std::size_t>(std::find(rig.x.begin(), rig.x.end(), 1000) - rig.x.begin());
    const double at10 = std::hypot(rig.x[begin + 10], rig.y[begin + 10]),
                 at30 = std::hypot(rig.x[begin + 30], rig.y[begin + 30]);
    EXPECT_NEAR(at10, 900, 1) << "left of a counter-clockwise motion is inside";
    EXPECT_NEAR(at30, 1100, 1);
}

TEST(Rtc5Wobbel, IsCorrectedAndOffWithoutAmplitudeOrFrequency) {
    for (const auto& [transversal, hertz] : {std::pair{0.0, 2500.0}, std::pair{100.0, 0.0}, std::pair{100.0, 2500.0}}) {
        Rig rig;
        rig.put(Op::set_rot_center_list, {0, 0});
        rig.card.parts().mcbsp.receive(900);
        rig.put(Op::set_fly_rot_pos, {3600});  // a quarter turn, counter-clockwise
        rig.put(Op::set_mark_speed, {1000});
        rig.put(Op::set_wobbel, {transversal, 0, hertz});
        rig.put(Op::mark_abs, {400, 0});
        rig.go();
        EXPECT_EQ(rig.x[10], transversal * hertz == 0 ? 0 : -100);
        EXPECT_EQ(rig.y[10], 100);
    }
    EXPECT_EQ(list_command(Op::set_wobbel, {200'000, 3, -9000})->p, (std::array<double, 4>{131'071, 3, -6000, 0}));
}

TEST(Rtc5Subroutines, ACallAndItsReturnTakeNoTime) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().lists.load_sub(5));
    rig.put(Op::micro_vector_rel, {1, 0, -1, -1});
    rig.put(Op::micro_vector_rel, {1, 0, -1, -1});
    rig.put(Op::list_return);
    EXPECT_FALSE(rig.card.put(*list_command(Op::list_nop, {}))) << "no list is open behind a subroutine";
    ASSERT_TRUE(rig.card.parts().lists.load_sub(6));
    rig.put(Op::sub_call, {5});
    rig.put(Op::micro_vector_rel, {0, 10, -1, -1});
    rig.put(Op::sub_call, {5});
    rig.put(Op::list_return);
    rig.begin(2);
    rig.put(Op::micro_vector_rel, {100, 0, -1, -1});
    rig.put(Op::list_return);
    rig.begin(1);
    rig.put(Op::sub_call, {6});
    rig.put(Op::list_call, {1000});
    rig.put(Op::micro_vector_rel, {0, 1000, -1, -1});
    EXPECT_EQ(rig.go(), 5 + 1 + 1 + 1);
    EXPECT_EQ(rig.last_x(), 104);
    EXPECT_EQ(rig.last_y(), 1010);
}

TEST(Rtc5Subroutines, AMissingOrTooDeepSubroutineIsANop) {
    Rig rig;
    ASSERT_TRUE(rig.card.parts().lists.load_sub(0));
    rig.put(Op::micro_vector_rel, {1, 0, -1, -1});
    rig.put(Op::list_return);
    ASSERT_TRUE(rig.card.parts().lists.load_sub(0));
    rig.put(Op::list_return);  // deletes the subroutine, which has no commands
    EXPECT_FALSE(rig.card.parts().lists.load_sub(1024));
    rig.begin();
    rig.put(Op::sub_call, {0});
    rig.put(Op::list_return);
    EXPECT_EQ(rig.go(), 2 + 1);
    EXPECT_EQ(rig.last_x(), 0);
    rig.begin();
    rig.x.clear();
    rig.put(Op::micro_vector_rel, {1, 0, -1, -1});
    rig.put(Op::list_call, {0});
    rig.put(Op::micro_vector_rel, {1000, 0, -1, -1});
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(100);
    EXPECT_EQ(rig.x[63], 64) << "63 calls";
    EXPECT_EQ(rig.x[64], 64) << "the 64th is a nop";
    EXPECT_EQ(rig.last_x(), 1064);
    EXPECT_FALSE(rig.card.busy()) << "the end of a list in a subroutine ends it";
}

TEST(Rtc5Subroutines, CallsThatTakeNoTimeDoNotHang) {
    Rig rig;
    for (int depth = 0; depth < 20; ++depth) {  // depth 20: 2^20 calls that take no tick
        ASSERT_TRUE(rig.card.parts().lists.load_sub(static_cast<std::uint32_t>(depth)));
        if (depth > 0) rig.put(Op::sub_call, {depth - 1.0}), rig.put(Op::sub_call, {depth - 1.0});
        rig.put(Op::set_mark_speed, {2000});
        rig.put(Op::list_return);
    }
    rig.begin();
    rig.put(Op::sub_call, {19});
    rig.put(Op::micro_vector_rel, {7, 0, -1, -1});
    rig.put(Op::set_end_of_list);
    ASSERT_TRUE(rig.card.execute_list(1));
    rig.run(100);
    EXPECT_TRUE(rig.card.busy());
    ASSERT_TRUE(rig.card.run_to_rest(100'000));
    EXPECT_EQ(rig.last_x(), 7);
    EXPECT_GT(rig.card.tick(), (1 << 20) / 64);
}

}  // namespace
}  // namespace motionrack::rtc5
