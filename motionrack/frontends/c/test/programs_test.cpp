// Programs in sequence on one rack: each starts at the current axis positions.
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/frontends/c/test/world.hpp>
#include <string>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t pulses_of_mm = 640;
constexpr const char* to_15_10 = "G21 G90\nG1 X15 F1200\nG1 Y10\nM2\n";
constexpr const char* to_20_0 = "G21 G90\nG1 X20 F1200\nG1 Y0\nM2\n";

void stands_at(World& world, double x, double y) {
    EXPECT_EQ(world.peek("x.LP"), std::llround(x * pulses_of_mm));
    EXPECT_EQ(world.peek("y.LP"), std::llround(y * pulses_of_mm));
    EXPECT_NEAR(world.part("X.position_mm"), x, 0.01);
    EXPECT_NEAR(world.part("Y.position_mm"), y, 0.01);
}

TEST(CPrograms, AProgramStartsAtThePositionsAfterHoming) {
    World world(homing_rack);
    ASSERT_EQ(mr_home(world, nullptr), MR_OK) << mr_last_error();
    const double homed = static_cast<double>(world.peek("x.LP")) / pulses_of_mm;
    EXPECT_NEAR(homed, 1, 0.01);
    const mr_run_result result = run(world, to_15_10);
    EXPECT_EQ(result.ok, 1);
    EXPECT_NEAR(result.path_mm, 15 - homed + 10, 1e-9);
    EXPECT_LT(result.deviation_mm, 0.02);
    stands_at(world, 15, 10);
}

TEST(CPrograms, TheSecondStartsAtTheEndOfTheFirstWithItsOwnResults) {
    World world(homing_rack), alone(homing_rack);
    const mr_run_result first = run(world, to_15_10);
    EXPECT_NEAR(first.path_mm, 20, 1e-9);
    const std::uint64_t between = mr_now_ns(world);
    const mr_run_result second = run(world, to_20_0);
    EXPECT_EQ(second.ok, 1);
    EXPECT_NEAR(second.path_mm, 15, 1e-9);
    EXPECT_NEAR(second.seconds, static_cast<double>(mr_now_ns(world) - between) * 1e-9, 2e-3);
    EXPECT_LT(second.deviation_mm, 0.02);
    EXPECT_THAT(mr_report(world), HasSubstr("path        15.000 mm"));
    EXPECT_THAT(mr_report(world), HasSubstr(std::to_string(5 * pulses_of_mm))) << "pulses of X";
    EXPECT_THAT(mr_report(world), HasSubstr(std::to_string(10 * pulses_of_mm))) << "and of Y";
    stands_at(world, 20, 0);
    run(world, "G21 G91\nG1 X-1 F600\nM2\n");
    EXPECT_NEAR(run(world, "G21\nG1 X20 F600\nM2\n").path_mm, 1, 1e-9) << "modes begin anew: G90";
    stands_at(world, 20, 0);
}

TEST(CPrograms, TimeBeforeAProgramDoesNotChangeItsResults) {
    World early(homing_rack), late(homing_rack);
    late.pass(1'250'000'000);
    const mr_run_result one = run(early, to_15_10), other = run(late, to_15_10);
    EXPECT_EQ(other.seconds, one.seconds);
    EXPECT_EQ(other.path_mm, one.path_mm);
    EXPECT_EQ(other.deviation_mm, one.deviation_mm);
    stands_at(late, 15, 10);
}

TEST(CPrograms, TheDivisionOfTheTimeBetweenTwoDoesNotMatter) {
    World whole(homing_rack), cut(homing_rack);
    run(whole, to_15_10);
    run(cut, to_15_10);
    whole.pass(1'000'000'000);
    for (const std::uint64_t ns : {1u, 299'999'999u, 0u, 650'000'000u, 50'000'000u}) cut.pass(ns);
    run(whole, to_20_0);
    run(cut, to_20_0);
    EXPECT_EQ(cut.hash(), whole.hash());
}

TEST(CPrograms, MotionByRegistersIsIncludedInTheStartPosition) {
    World world(homing_rack);
    world.set_up(1, 4000);
    world.command(1, 0x06, 640);
    world.write(0x00, 0x0120);
    world.pass(50'000'000);
    run(world, to_15_10, MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("Axis X moves at"));
    world.pass(1'000'000'000);
    world.command(1, 0x09, 12'345);  // the host may write to the card's counter
    const mr_run_result result = run(world, to_15_10);
    EXPECT_NEAR(result.path_mm, 9 + 10, 1e-9) << "from 5 mm + 640 pulses";
    EXPECT_LT(result.deviation_mm, 0.02);
    EXPECT_THAT(mr_report(world), HasSubstr(std::to_string(9 * pulses_of_mm)));
    stands_at(world, 15, 10);
}

TEST(CPrograms, TheNextStartsAtThePositionOfAStop) {
    World world(homing_rack);
    const mr_run_options options{
        nullptr, 0, [](void*, double seconds, std::int64_t, std::int64_t) { return static_cast<int>(seconds >= 0.2); },
        nullptr};
    run(world, to_15_10, MR_STOPPED, &options);
    const double stopped_at = world.part("X.position_mm");
    EXPECT_LT(stopped_at, 14);
    const mr_run_result result = run(world, to_15_10);
    EXPECT_EQ(result.ok, 1);
    EXPECT_NEAR(result.path_mm, 15 - stopped_at + 10, 0.01);
    EXPECT_LT(result.deviation_mm, 0.02);
    stands_at(world, 15, 10);
}

TEST(CPrograms, AnErrorInTheSecondMovesNothing) {
    World world(homing_rack);
    run(world, to_15_10);
    const std::uint64_t hash = world.hash();
    const mr_run_result wrong = run(world, "G21 G90\nG1 X7 F600\nG1 Xq\n", MR_BAD_INPUT);
    EXPECT_EQ(wrong.line, 3);
    EXPECT_EQ(wrong.seconds, 0);
    EXPECT_EQ(world.hash(), hash);
    stands_at(world, 15, 10);
    run(world, to_20_0);
    stands_at(world, 20, 0);
}

TEST(CPrograms, ACopyRunsTheSecondAsTheOriginalRackDoes) {
    World world(homing_rack);
    ASSERT_EQ(mr_home(world, nullptr), MR_OK) << mr_last_error();
    run(world, to_15_10);
    World copy(world.rack);
    const mr_run_result one = run(world, to_20_0), other = run(copy, to_20_0);
    EXPECT_EQ(other.seconds, one.seconds);
    EXPECT_EQ(other.path_mm, one.path_mm);
    EXPECT_EQ(other.deviation_mm, one.deviation_mm);
    EXPECT_EQ(copy.hash(), world.hash());
    stands_at(copy, 20, 0);
}

TEST(CPrograms, ARecordingStartedBeforeHasAllOfThem) {
    World world(homing_rack);
    const std::string csv = temporary("programs.csv");
    ASSERT_EQ(mr_trace_start(world, csv.c_str(), "X.step Y.step"), MR_OK) << mr_last_error();
    run(world, to_15_10);
    world.pass(100'000'000);
    run(world, to_20_0);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    const std::string table = text_of_file(csv);
    EXPECT_EQ(count_of(table, ",X.step,1\r\n"), 15 * pulses_of_mm);
    EXPECT_EQ(count_of(table, ",Y.step,1\r\n"), 20 * pulses_of_mm);
    std::filesystem::remove(csv);
}

TEST(CPrograms, ALostPositionPreventsTheNextUntilTheAxisIsHomed) {
    World world(homing_rack);
    struct Pusher {
        mr_rack* rack;
        bool pushed = false;
        static int call(void* user, double seconds, std::int64_t, std::int64_t) {
            auto& own = *static_cast<Pusher*>(user);
            if (seconds > 0.3 && !own.pushed) own.pushed = mr_fault(own.rack, "motor.lose_steps=64", "X") == MR_OK;
            return 0;
        }
    } pusher{world.rack};
    const mr_run_options options{nullptr, 0, &Pusher::call, &pusher};
    run(world, to_15_10, MR_MACHINE, &options);
    EXPECT_THAT(mr_last_error(), HasSubstr("64 pulses"));
    const std::uint64_t hash = world.hash();
    run(world, to_20_0, MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("The position of axis X is not valid since"));
    EXPECT_THAT(mr_last_error(), HasSubstr("home it"));
    EXPECT_EQ(world.hash(), hash);
    {
        World copy(world.rack);
        run(copy, to_20_0, MR_REFUSED);
    }
    ASSERT_EQ(mr_home(world, "X"), MR_OK) << mr_last_error();
    const mr_run_result result = run(world, to_20_0);
    EXPECT_EQ(result.ok, 1);
    EXPECT_LT(result.deviation_mm, 0.02);
    EXPECT_THAT(result.sentence, Not(HasSubstr("lost")));
    stands_at(world, 20, 0);
}

TEST(CPrograms, AFailedHomingPreventsPrograms) {
    World world(homing_rack);
    EXPECT_EQ(mr_fault(world, "home.stuck_open", "X"), MR_OK);
    EXPECT_EQ(mr_home(world, "X"), MR_MACHINE);
    run(world, to_15_10, MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("its homing did not end at home"));
    EXPECT_EQ(mr_fault(world, "home.stuck_open=0", "X"), MR_OK);
    ASSERT_EQ(mr_home(world, "X"), MR_OK) << mr_last_error();
    run(world, to_15_10);
    stands_at(world, 15, 10);
}

TEST(CPrograms, AfterAnEmergencyStopAxesAreHomedAndProgramsRunAgain) {
    World world(homing_rack);
    const mr_run_options options{nullptr, 0,
                                 [](void* user, double seconds, std::int64_t, std::int64_t) {
                                     if (seconds > 0.2) mr_wire_set(static_cast<mr_rack*>(user), "estop", 0);
                                     return 0;
                                 },
                                 world.rack};
    run(world, to_15_10, MR_MACHINE, &options);
    run(world, to_15_10, MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("The position of axis X is not valid"));
    world.set("estop", 1);
    ASSERT_EQ(mr_home(world, "X"), MR_OK) << mr_last_error();
    EXPECT_EQ(run(world, to_15_10).ok, 1);
    stands_at(world, 15, 10);
}

// ---- a servo axis of a databoard4002

constexpr const char* carriage = R"(
[card.board]
type = "databoard4002"
[axis.X]
card = "board"
lead_mm = 10
encoder_counts_per_rev = 1000
max_velocity_mm_s = 500
initial_position_mm = 100
min_limit_mm = -200
max_limit_mm = 2900
[axis.X.servo]
[axis.X.switches]
limit_minus_mm = -300
limit_plus_mm = 3000
cam_from_mm = 126
cam_to_mm = 132
)";

TEST(CPrograms, AServoContinuesFromItsActualPosition) {
    World world(carriage);
    world.pass(10'000'000);
    EXPECT_EQ(run(world, "G21 G90\nG1 X150 F6000\nM2\n").ok, 1);
    EXPECT_NEAR(world.part("X.position_mm"), 150, 0.2);
    const mr_run_result second = run(world, "G21 G91\nG1 X-30 F6000\nM2\n");
    EXPECT_EQ(second.ok, 1) << second.sentence;
    EXPECT_NEAR(second.path_mm, 30, 0.2);
    EXPECT_NEAR(world.part("X.position_mm"), 120, 0.4);
    World copy(world.rack);
    EXPECT_EQ(run(copy, "G21 G90\nG1 X200 F6000\nM2\n").ok, 1) << mr_last_error();
    EXPECT_NEAR(copy.part("X.position_mm"), 200, 0.3);
    ASSERT_EQ(mr_home(world, nullptr), MR_OK) << mr_last_error();
    EXPECT_EQ(run(world, "G21 G90\nG1 X200 F6000\nM2\n").ok, 1) << mr_last_error();
    EXPECT_NEAR(world.part("X.position_mm"), 200, 0.3);
    constexpr std::uint32_t select = 1, command = 3;
    EXPECT_EQ(mr_write8(world, "board", select, 13), MR_OK);
    world.pass(10'000'000);
    EXPECT_EQ(mr_write8(world, "board", command, 'A'), MR_OK) << "here is 0, says the host";
    world.pass(10'000'000);
    run(world, "G21 G90\nG1 X210 F6000\nM2\n", MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("another program wrote to the card's counter"));
    EXPECT_STREQ(mr_report(world), "") << "nothing was moved";
    ASSERT_EQ(mr_home(world, nullptr), MR_OK) << mr_last_error();
    EXPECT_EQ(run(world, "G21 G90\nG1 X210 F6000\nM2\n").ok, 1) << mr_last_error();
    EXPECT_NEAR(world.part("X.position_mm"), 210, 0.3);
}

}  // namespace
}  // namespace motionrack::c_test
