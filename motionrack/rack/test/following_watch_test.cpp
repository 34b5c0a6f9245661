// Following errors of axes with an encoder: warnings, stops of the machine, and rejected settings in a rack file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/test/servo_helpers.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

std::string axis_with(const std::string& keys) {
    return "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n" + keys;
}

/// Moves X to 40 mm at 10 mm/s.
JobOutcome run_with(const std::string& keys, const std::vector<std::string>& faults) {
    JobRequest request;
    request.config = good(axis_with(keys));
    request.program = "G21 G90 F600\nG1 X40\nM2\n";
    request.program_name = "part.ngc";
    request.faults = *read_faults(faults);
    auto job = RecordedJob::create(request, {});
    EXPECT_TRUE(job) << job.error().message;
    return (*job)->run(nullptr, {});
}

std::string warnings_of(const JobOutcome& outcome) {
    std::string out;
    for (const JobWarning& warning : outcome.warnings) out += warning.text + "\n";
    return out;
}

TEST(FollowingError, AboveItsWarningLimitIsReportedAndChangesNothing) {
    const JobOutcome outcome = run_with("", {"X.encoder.broken_a@0.5s", "X.encoder.broken_a=0@0.57s"});
    EXPECT_TRUE(outcome.ended) << outcome.ended.error().message;
    EXPECT_TRUE(outcome.position_valid) << "the pulses are right";
    EXPECT_EQ(outcome.axes[0].actual_end, 40);
    EXPECT_THAT(warnings_of(outcome), HasSubstr("the following error of X was 0."));
    EXPECT_THAT(warnings_of(outcome), HasSubstr("above the warning limit of 0.5 mm"));
}

TEST(FollowingError, BelowItsWarningLimitIsNotReported) {
    const JobOutcome outcome =
        run_with("following_error_warning_mm = 0.9\n", {"X.encoder.broken_a@0.5s", "X.encoder.broken_a=0@0.57s"});
    EXPECT_TRUE(outcome.ended);
    EXPECT_THAT(warnings_of(outcome), testing::Not(HasSubstr("following error")));
}

TEST(FollowingError, AboveItsAlarmLimitStopsTheMachineAndInvalidatesThePosition) {
    const JobOutcome outcome = run_with("following_error_alarm_mm = 0.2\n", {"X.motor.stall@1s"});
    ASSERT_FALSE(outcome.ended);
    EXPECT_EQ(outcome.ended.error().kind, ErrorKind::machine);
    // At 10 mm/s, 0.2 mm take 20 ms; the job checks every millisecond.
    EXPECT_THAT(outcome.ended.error().message, HasSubstr("The following error of X was 0.2"));
    EXPECT_THAT(outcome.ended.error().message, HasSubstr("above its limit of 0.2 mm at 1.02"));
    EXPECT_THAT(outcome.ended.error().message, HasSubstr("The position of X is not valid any more"));
    EXPECT_FALSE(outcome.position_valid);
    EXPECT_LT(to_seconds(outcome.time), 1.2);
}

TEST(FollowingError, IsNotMonitoredIfItsLimitsAreZero) {
    const JobOutcome outcome = run_with("following_error_alarm_mm = 0\n", {"X.encoder.broken_a@0.5s"});
    EXPECT_TRUE(outcome.ended) << outcome.ended.error().message;
    EXPECT_THAT(warnings_of(outcome), testing::Not(HasSubstr("following error")));
}

TEST(FollowingError, OfAnAxisWithoutAnEncoderIsUnknown) {
    const JobOutcome outcome = run_with("encoder_counts_per_rev = 0\n", {"X.motor.stall@1s"});
    EXPECT_TRUE(outcome.ended) << outcome.ended.error().message;
    EXPECT_FALSE(outcome.position_valid);
}

/// Moves the carriage to 2000 mm and back, at 500 mm/s.
JobOutcome run_carriage(const std::string& keys, const std::vector<std::string>& faults) {
    std::string text = carriage();
    text.insert(text.find("[axis.X]\n") + 9, keys);
    JobRequest request;
    request.config = good(text);
    request.program = "G21 G90\nG0 X2000\nG1 X100 F6000\nM2\n";
    request.program_name = "part.ngc";
    request.faults = *read_faults(faults);
    auto job = RecordedJob::create(request, {});
    EXPECT_TRUE(job) << job.error().message;
    return (*job)->run(nullptr, {});
}

TEST(FollowingError, OfASoundServoIsAtMostAFewMillimetres) {
    const JobOutcome outcome = run_carriage("following_error_warning_mm = 4\n", {});
    EXPECT_TRUE(outcome.ended) << outcome.ended.error().message;
    EXPECT_THAT(warnings_of(outcome), testing::Not(HasSubstr("following error")));
}

class ServoThatDoesNotFollow : public testing::TestWithParam<const char*> {};

TEST_P(ServoThatDoesNotFollow, StopsAtItsLimit) {
    const JobOutcome outcome = run_carriage("following_error_alarm_mm = 10\n", {std::string(GetParam()) + "@1.5s"});
    ASSERT_FALSE(outcome.ended);
    EXPECT_THAT(outcome.ended.error().message, HasSubstr("The following error of X was 10."));
    EXPECT_THAT(outcome.ended.error().message, HasSubstr("above its limit of 10 mm at 1.5"));
    EXPECT_THAT(outcome.ended.error().message, HasSubstr("its motor did not follow, or its encoder does not count"));
    EXPECT_THAT(outcome.ended.error().message, testing::Not(HasSubstr("steps")));
    EXPECT_FALSE(outcome.position_valid);
}

INSTANTIATE_TEST_SUITE_P(Faults, ServoThatDoesNotFollow,
                         testing::Values("X.motor.stall", "X.encoder.broken_a", "X.encoder.swapped", "X.drive=0"));

TEST(FollowingError, HasLimitsThatFollowFromTheEncoder) {
    const RackConfig fine = good(axis_with("")), coarse = good(axis_with("encoder_counts_per_rev = 4\n")),
                     set = good(axis_with("following_error_alarm_mm = 0.5\n")),
                     none = good(axis_with("encoder_counts_per_rev = 0\n"));
    EXPECT_EQ(fine.axes[0].following_alarm(), 1);
    EXPECT_EQ(fine.axes[0].following_warning(), 0.5);
    EXPECT_EQ(coarse.axes[0].following_alarm(), 5) << "four counts, each of 1.25 mm";
    EXPECT_EQ(set.axes[0].following_warning(), 0.25);
    EXPECT_EQ(none.axes[0].following_alarm(), 0);
    const RackConfig servo = good(carriage());
    EXPECT_EQ(servo.axes[0].following_alarm(), 0.1 * servo.axes[0].max_velocity);
}

TEST(FollowingError, RejectsAnImpossibleLimit) {
    struct Bad {
        const char *keys, *words;
    };
    for (const Bad& bad : {Bad{"following_error_alarm_mm = 0.001\n", "less than two counts of its encoder, 0.0025 mm"},
                           Bad{"following_error_warning_mm = 2\n", "above its following_error_alarm_mm, which is 1"},
                           Bad{"encoder_counts_per_rev = 0\nfollowing_error_alarm_mm = 1\n", "has no encoder"},
                           Bad{"following_error_alarm_mm = -1\n", "following_error_alarm_mm"}}) {
        const RackReading reading = read_rack_text(axis_with(bad.keys));
        ASSERT_EQ(reading.errors.size(), 1u) << bad.keys << all_texts(reading.errors);
        EXPECT_THAT(reading.errors[0].message, HasSubstr(bad.words));
    }
}

}  // namespace
}  // namespace motionrack::rack
