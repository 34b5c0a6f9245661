// The function library of the IOFLEX02 over the C interface beside the call-backs of its rack.
#include <gmock/gmock.h>
#include <motionrack/flex2pos.h>

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

}  // namespace
}  // namespace motionrack::c_test
