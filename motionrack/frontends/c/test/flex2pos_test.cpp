// The function library of the IOFLEX02 over the C interface beside the call-backs of its rack.
#include <gmock/gmock.h>
#include <motionrack/flex2pos.h>

#include <filesystem>
#include <motionrack/frontends/c/test/world.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;

/// A card without an image, and a motor that cannot start at 40,000 pulses per second: it loses steps.
constexpr const char* board_and_weak_axis = R"(
[card.p1]
type = "ioflex02"
preloaded = false
[card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
max_jerk_mm_s3 = 0
)";

struct Board {
    Board() { EXPECT_EQ(flex2pos_open(world, &flex), MR_OK) << mr_last_error(); }
    ~Board() { flex2pos_close(flex); }
    Board(const Board&) = delete;
    Board& operator=(const Board&) = delete;

    World world{board_and_weak_axis};
    flex2pos* flex = nullptr;
};

/// Results of calls inside a call-back, with their sentences.
struct CalledInside {
    Board& board;
    std::vector<std::pair<int, std::string>> answers = {};

    void note(int code) { answers.emplace_back(code, mr_last_error()); }
    static void call(void* user, std::uint64_t, std::int64_t, const char*, int, const char*) {
        CalledInside& own = *static_cast<CalledInside*>(user);
        own.note(flex2pos_Init(own.board.flex, 0x2400));
        own.note(flex2pos_Configure(own.board.flex, nullptr, 0));
        own.note(flex2pos_set_base_address(own.board.flex, 0x2400));
    }
};

TEST(CFlex2Pos, ClaimsNoSuccessInACallBackThatCannotConfigure) {
    Board board;
    ASSERT_EQ(flex2pos_Init(board.flex, 0x2300), Flex_Ok) << flex2pos_why(board.flex);
    CalledInside inside{board};
    ASSERT_EQ(mr_on_condition(board.world, &CalledInside::call, &inside), MR_OK) << mr_last_error();
    ASSERT_EQ(mr_fault(board.world, "motor.lose_steps=64", "X"), MR_OK) << mr_last_error();
    ASSERT_GE(inside.answers.size(), 3u);
    EXPECT_EQ(inside.answers[0].first, Flex_ErrDevice);
    EXPECT_EQ(inside.answers[1].first, Flex_ErrDevice);
    EXPECT_EQ(inside.answers[2].first, MR_REFUSED);
    for (const auto& [code, sentence] : inside.answers) EXPECT_THAT(sentence, HasSubstr("A call-back of this rack"));
    EXPECT_EQ(flex2pos_Result(board.flex), Flex_Ok) << "that of the last call that was made";
    EXPECT_EQ(flex2pos_GetIdent(board.flex), 0x25) << "of the card that Init selected";
}

/// Drives X continuously, at full velocity from the start.
void drive_weak_axis(World& world) {
    world.set_up(1, 4000);
    world.command(1, 0x04, 4000);
    world.write(0x00, 0x0122);
}

TEST(CFlex2Pos, ARecordingIsSampledWhileInitLoadsTheArray) {
    const std::string csv = temporary("flex.csv");
    Board board;
    drive_weak_axis(board.world);
    ASSERT_EQ(mr_trace_start(board.world, csv.c_str(), "c1.xlp"), MR_OK) << mr_last_error();
    ASSERT_EQ(flex2pos_Init(board.flex, 0x2300), Flex_Ok) << flex2pos_why(board.flex);
    const auto passed_ms = static_cast<int>(mr_now_ns(board.world) / 1'000'000);
    ASSERT_EQ(mr_trace_stop(board.world), MR_OK) << mr_last_error();
    EXPECT_GE(passed_ms, 2'000);
    EXPECT_GE(count_of(text_of_file(csv), ",c1.xlp,"), passed_ms - 1) << "each ms";
    std::filesystem::remove(csv);
}

/// The first report of a condition, and the results of calls inside it.
struct FirstReport {
    Board& board;
    std::int64_t at_ns = -1;
    std::uint64_t now_ns = 0;
    int configured = Flex_Ok;

    static void call(void* user, std::uint64_t, std::int64_t at, const char*, int, const char*) {
        FirstReport& own = *static_cast<FirstReport*>(user);
        if (own.at_ns >= 0) return;
        own.at_ns = at / 10;
        own.now_ns = mr_now_ns(own.board.world);
        own.configured = flex2pos_Configure(own.board.flex, nullptr, 0);
        flex2pos_close(own.board.flex);
        EXPECT_THAT(mr_last_error(), HasSubstr("It was not closed"));
    }
};

TEST(CFlex2Pos, AConditionIsReportedAtItsInstantWhileInitLoadsTheArray) {
    Board board;
    FirstReport first{board};
    ASSERT_EQ(mr_on_condition(board.world, &FirstReport::call, &first), MR_OK) << mr_last_error();
    drive_weak_axis(board.world);
    ASSERT_EQ(first.at_ns, -1) << "the motor loses its steps later";
    ASSERT_EQ(flex2pos_Init(board.flex, 0x2300), Flex_Ok) << flex2pos_why(board.flex);
    ASSERT_GE(first.at_ns, 0);
    EXPECT_LT(first.now_ns, static_cast<std::uint64_t>(first.at_ns) + 1'000) << "within an access to the bus";
    EXPECT_EQ(first.configured, Flex_ErrDevice);
    EXPECT_EQ(flex2pos_GetIdent(board.flex), 0x25);
}

}  // namespace
}  // namespace motionrack::c_test
