// The function library by its declaration: each function on a card whose motor follows its pulses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/databoard4002/library/library.hpp>
#include <motionrack/cards/databoard4002/test/host.hpp>
#include <string>
#include <vector>

namespace motionrack::databoard4002 {
namespace {

using ::testing::HasSubstr;

/// Requests a stop at an instant.
class StoppingHost final : public Interrupt {
  public:
    explicit StoppingHost(Interrupt& inner) : inner_(inner) {}
    bool wait(Duration timeout) override { return inner_.wait(timeout); }
    void pass(Duration duration) override { inner_.pass(duration); }
    Instant now() const override { return inner_.now(); }
    bool stop_requested() const override { return now() >= stop_at; }
    Instant stop_at = never;

  private:
    Interrupt& inner_;
};

class Databoard4002Library : public testing::Test {
  protected:
    Databoard4002Library() : time(host.port), library(host.port, time, select) {
        host.start();
        EXPECT_TRUE(library.begin());
    }
    Result<CallAnswer> call(std::string_view name, const std::vector<std::int64_t>& values = {}) {
        const std::span<const FunctionInfo> functions = library.functions();
        for (std::size_t i = 0; i < functions.size(); ++i)
            if (functions[i].name == name) return library.call(i, values);
        return fail(ErrorKind::invalid_input, "no such function");
    }
    std::string text(std::string_view name, const std::vector<std::int64_t>& values = {}) {
        const Result<CallAnswer> answer = call(name, values);
        return answer ? answer->text : answer.error().message;
    }

    Host host;
    StoppingHost time;
    CommandLibrary library;
};

constexpr std::int64_t thousand_hz = 16'384 - 400;

TEST_F(Databoard4002Library, HasEachCommandOfTheCard) {
    std::string meanings;
    for (const FunctionInfo& function : library.functions()) meanings += std::string(function.meaning) + '\n';
    for (const CommandInfo& command : map::commands) {
        if (command.name == "S") continue;  // written by design_slope
        EXPECT_THAT(meanings, HasSubstr(std::string(command.meaning)));
    }
}

TEST_F(Databoard4002Library, MovesAndReportsItsPosition) {
    EXPECT_EQ(text("set_rate", {thousand_hz}), "Written.");
    EXPECT_EQ(text("move_to", {250, 1000}), "The card is at 250 counts.");
    EXPECT_EQ(text("move_by", {-290, 1000}), "The card is at -40 counts.");
    EXPECT_EQ(text("position"), "-40 counts");
    EXPECT_EQ(text("set_number", {50}), "Written.");
    EXPECT_EQ(text("go"), "Given.");
    EXPECT_TRUE(library.moving());
    EXPECT_EQ(call("rate")->value, thousand_hz);
    library.stop_now();
    time.pass(milliseconds(1));
    EXPECT_FALSE(library.moving());
}

TEST_F(Databoard4002Library, MovesByASlopeTableThatItDesigned) {
    EXPECT_THAT(text("design_slope", {10'000, 100'000, 1000, 0}), HasSubstr("48 intervals up to 10000 counts/s"));
    EXPECT_EQ(text("on_regulation"), "Given.");
    EXPECT_EQ(text("move_to", {5000, 2000}), "The card is at 5000 counts.");
    EXPECT_THAT(text("design_slope", {400'001, 100'000, 1000, 0}), HasSubstr("No table was created"));
}

TEST_F(Databoard4002Library, ReadsStatusAndEvents) {
    time.pass(milliseconds(1));  // the card works on the last access
    EXPECT_THAT(text("status"), HasSubstr("READY: the card takes an access"));
    EXPECT_EQ(text("enable_events", {event::POSITION}), "EVENT 00h. No event had happened.");
    EXPECT_EQ(text("set_rate", {thousand_hz}), "Written.");
    EXPECT_EQ(text("set_number", {5}), "Written.");
    EXPECT_EQ(text("go"), "Given.");
    time.pass(milliseconds(20));
    EXPECT_EQ(text("disable_events"), "EVENT 01h. POSITION: the position was reached or passed.");
}

TEST_F(Databoard4002Library, EndsItsMoveAndWritesNothingElseOnceAStopIsRequested) {
    EXPECT_EQ(text("set_rate", {thousand_hz}), "Written.");
    time.stop_at = time.now() + milliseconds(50);
    EXPECT_THAT(text("move_to", {100'000, 10'000}), HasSubstr("Stopped on request"));
    EXPECT_FALSE(library.moving());
    const std::int64_t here = host.card.position();
    EXPECT_NEAR(static_cast<double>(here), 50, 5);
    static_cast<void>(call("go"));
    time.pass(milliseconds(20));
    EXPECT_EQ(host.card.position(), here);
}

TEST_F(Databoard4002Library, ReportsThatNoCardAnswers) {
    CommandLibrary absent(host.port, time, select + 1);
    const Result<void> begun = absent.begin();
    ASSERT_FALSE(begun);
    EXPECT_THAT(begun.error().message, HasSubstr("No card answers under the number 14"));
}

}  // namespace
}  // namespace motionrack::databoard4002
