// Condition callback: it reports each condition once, in order, at its instant; the calls allowed inside it.
#include <gmock/gmock.h>

#include <motionrack/frontends/c/test/world.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;

/// A motor that cannot start at 40,000 pulses per second: it loses steps, which is a condition.
constexpr const char* weak_axis = R"(
[card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
max_jerk_mm_s3 = 0
)";

struct Heard {
    std::uint64_t number;
    std::int64_t at;
    std::string card, sentence;
    int code;
    friend bool operator==(const Heard&, const Heard&) = default;
};

/// Records the reported conditions with their simulated time.
struct RecordingListener {
    mr_rack* rack = nullptr;
    std::vector<Heard> heard;
    std::vector<std::uint64_t> now_ns;
    void (*also)(RecordingListener& listener) = nullptr;
    std::vector<std::pair<int, std::string>> answers;  ///< results of calls inside the callback

    static void call(void* user, std::uint64_t number, std::int64_t at, const char* card, int code,
                     const char* sentence) {
        RecordingListener& listener = *static_cast<RecordingListener*>(user);
        listener.heard.push_back({number, at, card, sentence, code});
        listener.now_ns.push_back(mr_now_ns(listener.rack));
        if (listener.also != nullptr) listener.also(listener);
    }
    void note(int code) { answers.emplace_back(code, mr_last_error()); }
    void listen(World& world) {
        rack = world.rack;
        EXPECT_EQ(mr_on_condition(rack, &RecordingListener::call, this), MR_OK) << mr_last_error();
    }
};

std::vector<Heard> reported(World& world, std::uint64_t since = 0) {
    RecordingListener listener;
    listener.rack = world.rack;
    EXPECT_EQ(mr_conditions(world, since, &RecordingListener::call, &listener), MR_OK) << mr_last_error();
    return listener.heard;
}

/// Drives X continuously, at full velocity from the start.
void drive(World& world) {
    world.set_up(1, 4000);
    world.command(1, 0x04, 4000);
    world.write(0x00, 0x0122);
}

/// Drives X for 600 ms: injects a loss of 64 pulses at 120 ms and commands an instant stop at 240 ms.
void drive_and_stop(World& world, std::uint64_t step) {
    drive(world);
    for (std::uint64_t at = 0; at < 600'000'000; at += step) {
        if (at == 120'000'000) {
            EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK) << mr_last_error();
        }
        if (at == 240'000'000) world.write(0x00, 0x0127);
        world.pass(step);
    }
}

TEST(CConditions, AreReportedOnceInOrderAtTheirInstantHoweverTimeIsDivided) {
    World quiet(weak_axis);
    drive_and_stop(quiet, 600'000);
    const std::vector<Heard> all = reported(quiet);
    ASSERT_GE(all.size(), 2u);
    for (const std::uint64_t step : {600'000u, 40'000'000u, 120'000'000u}) {
        World world(weak_axis);
        RecordingListener listener;
        listener.listen(world);
        drive_and_stop(world, step);
        EXPECT_EQ(listener.heard, all) << step;
        for (std::size_t i = 0; i < listener.heard.size(); ++i)
            EXPECT_EQ(listener.now_ns[i], static_cast<std::uint64_t>(listener.heard[i].at) / 10)
                << listener.heard[i].sentence;
        EXPECT_EQ(world.hash(), quiet.hash()) << "who listens changes nothing";
    }
}

TEST(CConditions, AreReportedFromRegistrationToRemovalOfTheCallback) {
    World world(weak_axis);
    EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK);
    const std::size_t before = reported(world).size();
    ASSERT_GE(before, 1u);
    RecordingListener listener;
    listener.listen(world);
    world.pass(1000);
    EXPECT_TRUE(listener.heard.empty());
    EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK);
    ASSERT_EQ(listener.heard, reported(world, before)) << "told before mr_fault returns";
    EXPECT_FALSE(listener.heard.empty());
    EXPECT_EQ(mr_on_condition(world, nullptr, nullptr), MR_OK);
    const std::size_t heard = listener.heard.size();
    EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK);
    world.pass(1000);
    EXPECT_EQ(listener.heard.size(), heard);
}

TEST(CConditions, ACopyHasNoCallback) {
    World world(weak_axis);
    RecordingListener listener;
    listener.listen(world);
    World copy(world.rack);
    EXPECT_EQ(mr_fault(copy, "motor.lose_steps=64", "X"), MR_OK);
    EXPECT_FALSE(reported(copy).empty());
    EXPECT_TRUE(listener.heard.empty());
}

TEST(CConditions, ACallbackActsAtTheInstantOfItsCondition) {
    World world(weak_axis);
    RecordingListener listener;
    listener.also = [](RecordingListener& own) {
        double wire = -1, place = -1;
        std::uint64_t register_value = 0;
        own.note(mr_wire_get(own.rack, "c1.xlmtp", &wire));
        own.note(mr_part_get(own.rack, "X.position_mm", &place));
        own.note(mr_peek(own.rack, "c1", "x.LP", &register_value));
        own.note(mr_wire_set(own.rack, "c1.xlmtp", 0));
        if (own.heard.size() == 1) own.note(mr_fault(own.rack, "motor.lose_steps=64", "X"));
    };
    listener.listen(world);
    drive(world);
    world.pass(1'000'000'000);
    for (const auto& [code, sentence] : listener.answers) EXPECT_EQ(code, MR_OK) << sentence;
    EXPECT_EQ(world.peek("RR0") & 1, 0) << "the limit switch that it pressed has stopped the drive";
    EXPECT_EQ(listener.heard, reported(world)) << "what it did itself is told, too";
    EXPECT_GE(listener.heard.size(), 2u);
}

TEST(CConditions, ACallbackThatAdvancesTimeIsRejectedAndChangesNothing) {
    World world(weak_axis);
    RecordingListener listener;
    listener.also = [](RecordingListener& own) {
        std::uint16_t word = 0;
        mr_rack* copy = nullptr;
        const std::uint64_t before = mr_state_hash(own.rack);
        own.note(mr_advance_ns(own.rack, 1));
        own.note(mr_read16(own.rack, "c1", 0, &word));
        own.note(mr_write16(own.rack, "c1", 0, 0));
        own.note(mr_run_program(own.rack, "G1 X1 F100\n", nullptr, nullptr));
        own.note(mr_home(own.rack, nullptr));
        own.note(mr_snapshot(own.rack, &copy));
        mr_rack_close(own.rack);
        own.note(MR_REFUSED);
        EXPECT_EQ(copy, nullptr);
        EXPECT_EQ(mr_state_hash(own.rack), before);
    };
    listener.listen(world);
    EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK);
    ASSERT_FALSE(listener.answers.empty());
    for (const auto& [code, sentence] : listener.answers) {
        EXPECT_EQ(code, MR_REFUSED);
        EXPECT_THAT(sentence, HasSubstr("call-back"));
    }
    world.pass(1000);
}

TEST(CConditions, ACallbackMayRemoveItself) {
    World world(weak_axis);
    RecordingListener listener;
    listener.also = [](RecordingListener& own) { own.note(mr_on_condition(own.rack, nullptr, nullptr)); };
    listener.listen(world);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK);
    EXPECT_EQ(listener.heard.size(), 1u);
    EXPECT_EQ(mr_on_condition(nullptr, &RecordingListener::call, &listener), MR_BAD_CALL);
}

TEST(CConditions, ARecordingCanStartAtACondition) {
    World world(weak_axis);
    const std::string csv = temporary("condition.csv");
    struct At {
        mr_rack* rack;
        const char* path;
        int code = -1;
    } at{world.rack, csv.c_str()};
    EXPECT_EQ(mr_on_condition(
                  world,
                  [](void* user, std::uint64_t, std::int64_t, const char*, int, const char*) {
                      auto& own = *static_cast<At*>(user);
                      if (own.code != MR_OK) own.code = mr_trace_start(own.rack, own.path, "X.step c1.xlp");
                  },
                  &at),
              MR_OK);
    drive(world);
    world.pass(100'000'000);
    EXPECT_EQ(mr_fault(world, "motor.lose_steps=64", "X"), MR_OK);
    EXPECT_EQ(at.code, MR_OK);
    world.pass(50'000'000);
    EXPECT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    EXPECT_GT(count_of(text_of_file(csv), ",X.step,1\r\n"), 100);
    EXPECT_GT(count_of(text_of_file(csv), ",c1.xlp,"), 40) << "looked at every ms";
    std::filesystem::remove(csv);
}

}  // namespace
}  // namespace motionrack::c_test
