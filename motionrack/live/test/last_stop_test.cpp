// The stop of listed cards by a terminate handler, with a card that ends the program itself.
#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <motionrack/live/last_stop.hpp>

namespace motionrack::live {
namespace {

/// A function library whose stop ends the program, as a failed internal check does.
class EndingLibrary final : public FunctionLibrary {
  public:
    std::span<const FunctionInfo> functions() const override { return {}; }
    Result<void> begin() override { return {}; }
    Result<CallAnswer> call(std::size_t, std::span<const std::int64_t>) override { return CallAnswer{}; }
    bool moving() override { return true; }
    void stop_now() override { std::terminate(); }
};

TEST(LastStop, EndsTheProgramIfAStopItselfAborts) {
    const auto end = [] {
        EndingLibrary library;
        const LastStop listed(library);
        stop_live_cards_at_terminate([] { std::_Exit(5); });
        std::terminate();
    };
    EXPECT_EXIT(end(), testing::ExitedWithCode(5), "");
}

TEST(LastStop, ReportsThatTheProgramEnds) {
    EXPECT_FALSE(is_program_ending());
    const auto end = [] {
        stop_live_cards_at_terminate([] { std::_Exit(is_program_ending() ? 5 : 1); });
        std::terminate();
    };
    EXPECT_EXIT(end(), testing::ExitedWithCode(5), "");
}

}  // namespace
}  // namespace motionrack::live
