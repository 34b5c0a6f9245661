// Cards, commands, events, moves, stops and errors over the C library; exported names.
#include <databoard4002lib.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <motionrack/cards/databoard4002/library/library.hpp>
#include <regex>
#include <set>
#include <string>
#include <tests/source_root.hpp>
#include <thread>

namespace motionrack::databoard4002lib_test {
namespace {

using testing::HasSubstr;

constexpr const char* one_card = "card.c1 = \"databoard4002\"";
constexpr const char* two_cards =
    "[card.c1]\ntype = \"databoard4002\"\n[card.c2]\ntype = \"databoard4002\"\ncard_number = 7\nversion = 3\n";
constexpr int rate_of_1_khz = 16'384 - 400;

/// An open card; its motor follows its pulses.
class Open {
  public:
    explicit Open(const char* place = one_card, int number = 13) : handle(databoard4002_open(place, number)) {
        EXPECT_GT(handle, 0) << databoard4002_last_error();
        EXPECT_EQ(databoard4002_set_rate(handle, rate_of_1_khz), 0) << databoard4002_last_error();
        databoard4002_clear_error();
    }
    ~Open() { databoard4002_close(handle); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

    int handle;
};

/// The answer of a function that stores one.
int answer_of(int (*function)(int, int*), const Open& card) {
    int answer = -1;
    EXPECT_EQ(function(card.handle, &answer), 0) << databoard4002_last_error();
    return answer;
}

std::int64_t peek(const Open& card, const char* name) {
    std::int64_t value = -1;
    EXPECT_EQ(databoard4002_peek(card.handle, name, &value), 0) << databoard4002_last_error();
    return value;
}

std::set<std::string> declared_functions() {
    std::ifstream file(source_dir() + "/motionrack/frontends/databoard4002lib/databoard4002lib.h");
    std::set<std::string> declared;
    const std::regex function(R"(^DATABOARD4002_API [^(]*\b(\w+)\()");
    std::smatch match;
    for (std::string line; std::getline(file, line);)
        if (std::regex_search(line, match, function)) declared.insert(match[1]);
    return declared;
}

// ---- cards

TEST(Databoard4002libCards, WithoutAnAddressTheMessageNamesTheVariableToSet) {
    ::unsetenv("MOTIONRACK_RACK");
    EXPECT_EQ(databoard4002_open(nullptr, 13), -1);
    EXPECT_THAT(databoard4002_last_error(), HasSubstr("databoard4002_open: No card is open, and the environment "
                                                      "variable MOTIONRACK_RACK is not set"));
    ::setenv("MOTIONRACK_RACK", one_card, 1);
    const Open card(nullptr);
    EXPECT_EQ(answer_of(databoard4002_position, card), 0);
    ::unsetenv("MOTIONRACK_RACK");
}

TEST(Databoard4002libCards, TwoCardsOfARackShareItsBusAndItsClock) {
    const Open first(two_cards), second(nullptr, 7);
    EXPECT_EQ(databoard4002_open(nullptr, 7), -1);
    EXPECT_THAT(databoard4002_last_error(), HasSubstr("Card 7 of this bus is open already"));
    EXPECT_EQ(answer_of(databoard4002_version, second), 3);
    EXPECT_EQ(databoard4002_move_to(second.handle, 100, 10'000), 0) << databoard4002_last_error();
    EXPECT_EQ(answer_of(databoard4002_position, second), 100);
    EXPECT_EQ(answer_of(databoard4002_position, first), 0);
    EXPECT_EQ(databoard4002_now_us(first.handle), databoard4002_now_us(second.handle));
}

TEST(Databoard4002libCards, NamesACardThatCannotBeOpened) {
    const auto refused = [](const char* place, int number) {
        EXPECT_EQ(databoard4002_open(place, number), -1);
        return std::string(databoard4002_last_error());
    };
    EXPECT_THAT(refused(one_card, 256), HasSubstr("The card's number is 256; it must be 0 to 255"));
    EXPECT_THAT(refused(one_card, 14), HasSubstr("no databoard4002 with the number 14; the numbers of those it has: "
                                                 "13"));
    EXPECT_THAT(refused("card.c1 = \"mcx314\"", 13), HasSubstr("the numbers of those it has: none"));
    EXPECT_THAT(refused("/no/such/rack.toml", 13), HasSubstr("/no/such/rack.toml"));
    EXPECT_THAT(refused("port:/no/such/port", 13), HasSubstr("/no/such/port"));
    EXPECT_THAT(refused("port:/dev/port,wrong=1", 13), HasSubstr("unknown key 'wrong'"));
    int counts = 0;
    EXPECT_EQ(databoard4002_position(-1, &counts), -1);
    EXPECT_THAT(databoard4002_last_error(), HasSubstr("databoard4002_position: Unknown card handle -1; the handles of "
                                                      "the open cards are: none"));
}

// ---- commands

TEST(Databoard4002libCommands, ClosingAndOpeningNeitherStopsNorResetsTheCard) {
    const Open other(two_cards, 7);
    {
        const Open card(nullptr, 13);
        EXPECT_EQ(databoard4002_set_number(card.handle, 1000), 0) << databoard4002_last_error();
        EXPECT_EQ(databoard4002_go(card.handle), 0) << databoard4002_last_error();
        databoard4002_advance_ms(card.handle, 100);
    }
    const int again = databoard4002_open(nullptr, 13);
    int rate = 0, counts = 0;
    EXPECT_EQ(databoard4002_rate(again, &rate), 0) << databoard4002_last_error();
    EXPECT_EQ(rate, rate_of_1_khz);
    databoard4002_advance_ms(again, 2000);
    EXPECT_EQ(databoard4002_position(again, &counts), 0) << databoard4002_last_error();
    EXPECT_EQ(counts, 1000);
    EXPECT_EQ(databoard4002_close(again), 0);
}

TEST(Databoard4002libCommands, EachCommandMovesOrReportsAsDocumented) {
    const Open card;
    EXPECT_EQ(databoard4002_set_target(card.handle, 250), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_go(card.handle), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 100);
    EXPECT_EQ(answer_of(databoard4002_rate, card), rate_of_1_khz);
    EXPECT_EQ(databoard4002_quit(card.handle), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 1);
    EXPECT_EQ(answer_of(databoard4002_rate, card), 0);
    EXPECT_NEAR(answer_of(databoard4002_position, card), 100, 5);
    EXPECT_EQ(databoard4002_athome(card.handle), 0) << databoard4002_last_error();
    EXPECT_EQ(answer_of(databoard4002_position, card), 0);
    EXPECT_EQ(databoard4002_move_by(card.handle, -40, 1000), 0) << databoard4002_last_error();
    EXPECT_EQ(answer_of(databoard4002_position, card), -40);
    EXPECT_EQ(databoard4002_set_deviation(card.handle, 10), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_lock(card.handle), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 1);
    EXPECT_EQ(peek(card, "LOCKED"), 1);
    EXPECT_EQ(answer_of(databoard4002_deviation, card), 0);
    EXPECT_EQ(databoard4002_manual(card.handle), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 1);
    EXPECT_EQ(peek(card, "LOCKED"), 0);
}

TEST(Databoard4002libCommands, AResetClearsPositionAndRate) {
    const Open card;
    EXPECT_EQ(databoard4002_move_to(card.handle, 250, 1000), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_reset(card.handle), 0) << databoard4002_last_error();
    EXPECT_EQ(answer_of(databoard4002_position, card), 0);
    EXPECT_EQ(databoard4002_set_rate(card.handle, rate_of_1_khz), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_move_to(card.handle, 10, 1000), 0) << "its reset mark is cleared";
}

TEST(Databoard4002libCommands, AnEventReportsThatAPositionWasReached) {
    const Open card;
    int word = -1;
    EXPECT_EQ(databoard4002_enable_events(card.handle, DATABOARD4002_POSITION, &word), 0);
    EXPECT_EQ(word, 0);
    EXPECT_EQ(databoard4002_set_number(card.handle, 5), 0);
    EXPECT_EQ(databoard4002_go(card.handle), 0);
    int looks = 0;
    while ((answer_of(databoard4002_status, card) & DATABOARD4002_STAT_EVENT) == 0 && looks < 1'000'000) ++looks;
    EXPECT_GT(looks, 10);
    EXPECT_EQ(answer_of(databoard4002_disable_events, card), DATABOARD4002_POSITION);
}

TEST(Databoard4002libCommands, AMoveFollowsASlopeThatTheLibraryDesigns) {
    const Open card;
    EXPECT_EQ(databoard4002_design_slope(card.handle, 10'000, 100'000, 1000, 0), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_on_regulation(card.handle), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_move_to(card.handle, 5000, 2000), 0) << databoard4002_last_error();
    EXPECT_EQ(answer_of(databoard4002_position, card), 5000);
}

TEST(Databoard4002libCommands, AMoveAgainstAnActiveEndStopNamesIt) {
    const Open card;
    EXPECT_EQ(databoard4002_set_wire(card.handle, "c1.esr", 1), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 1);
    EXPECT_EQ(databoard4002_move_to(card.handle, 250, 1000), -1);
    EXPECT_THAT(databoard4002_last_error(), HasSubstr("the right end stop is active"));
    EXPECT_EQ(databoard4002_set_wire(card.handle, "c1.esr", std::nan("")), 0);
    databoard4002_advance_ms(card.handle, 10);
    EXPECT_EQ(databoard4002_move_to(card.handle, 250, 1000), 0) << databoard4002_last_error();
}

// ---- refusals

struct Refusal {
    const char* name;
    int (*call)(int card);
    const char* sentence;
};

const Refusal refusals[] = {
    {"set_deviation", [](int card) { return databoard4002_set_deviation(card, -1); }, "0 to 8388607"},
    {"set_number", [](int card) { return databoard4002_set_number(card, 8'388'608); }, "-8388608 to 8388607"},
    {"set_target", [](int card) { return databoard4002_set_target(card, -8'388'609); }, "-8388608 to 8388607"},
    {"set_rate", [](int card) { return databoard4002_set_rate(card, 16'384); },
     "rate is 16384, but must be 0 to 16383"},
    {"position", [](int card) { return databoard4002_position(card, nullptr); }, "null pointer"},
    {"enable_events",
     [](int card) {
         int word = 0;
         return databoard4002_enable_events(card, DATABOARD4002_WATCH_OUT, &word);
     },
     "or a sum of these"},
    {"move_to", [](int card) { return databoard4002_move_to(card, 8'388'608, 1000); }, "-8388608 to 8388607"},
    {"move_by", [](int card) { return databoard4002_move_by(card, 1, 0); }, "1 to 600000 ms"},
    {"find_zero", [](int card) { return databoard4002_find_zero(card, 1, 1000, 1, 1000); }, "marks is 1"},
    {"design_slope", [](int card) { return databoard4002_design_slope(card, 0, 1, 1, 0); }, "1 to 400000 counts/s"},
    {"advance_ms", [](int card) { return databoard4002_advance_ms(card, -1); }, "0 to 600000 ms"},
    {"peek", [](int card) { return databoard4002_peek(card, "POSITION", nullptr); }, "null pointer"},
    {"set_wire", [](int card) { return databoard4002_set_wire(card, "c1.none", 1); }, "c1.none"},
};

TEST(Databoard4002libErrors, AnInvalidValueIsNamedAndWritesNothing) {
    const Open card;
    for (const Refusal& each : refusals) {
        databoard4002_clear_error();
        EXPECT_EQ(each.call(card.handle), -1) << each.name;
        EXPECT_THAT(databoard4002_last_error(), HasSubstr(std::string("databoard4002_") + each.name + ": "));
        EXPECT_THAT(databoard4002_last_error(), HasSubstr(each.sentence));
        EXPECT_EQ(peek(card, "POSITION"), 0) << each.name;
        EXPECT_EQ(peek(card, "MOVING"), 0) << each.name;
    }
}

TEST(Databoard4002libErrors, EachThreadHasItsOwnMessage) {
    const Open card;
    databoard4002_set_rate(card.handle, -1);
    const std::string here = databoard4002_last_error();
    std::string there = "?";
    std::thread([&there] { there = databoard4002_last_error(); }).join();
    EXPECT_EQ(there, "");
    EXPECT_EQ(databoard4002_last_error(), here);
    EXPECT_NE(here, "");
}

// ---- stops

TEST(Databoard4002libStops, AStopHoldsUntilItIsReset) {
    const Open card;
    EXPECT_EQ(databoard4002_set_number(card.handle, 1000), 0);
    EXPECT_EQ(databoard4002_go(card.handle), 0);
    databoard4002_advance_ms(card.handle, 100);
    EXPECT_EQ(databoard4002_stop(card.handle), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 1);
    EXPECT_EQ(answer_of(databoard4002_rate, card), 0);
    const int here = answer_of(databoard4002_position, card);
    for (const auto refused : {databoard4002_go, databoard4002_reset, databoard4002_lock}) {
        EXPECT_EQ(refused(card.handle), -1);
        EXPECT_THAT(databoard4002_last_error(),
                    HasSubstr("Card 13 was stopped, and the stop holds. Nothing was done."));
    }
    EXPECT_EQ(databoard4002_quit(card.handle), 0) << databoard4002_last_error();
    databoard4002_advance_ms(card.handle, 100);
    EXPECT_EQ(answer_of(databoard4002_position, card), here);
    EXPECT_EQ(databoard4002_reset_stop(card.handle), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_move_to(card.handle, 10, 1000), 0) << databoard4002_last_error();
}

/// Ten minutes of simulated time, which take seconds; it is stopped before it moves or while it does.
TEST(Databoard4002libStops, AnotherThreadStopsALongMove) {
    const Open card;
    EXPECT_EQ(databoard4002_set_rate(card.handle, 1), 0);
    int stopped = -1;
    std::thread stopper([&] { stopped = databoard4002_stop(card.handle); });
    EXPECT_EQ(databoard4002_move_to(card.handle, 8'000'000, 600'000), -1);
    const std::string sentence = databoard4002_last_error();
    stopper.join();
    EXPECT_EQ(stopped, 0);
    EXPECT_THAT(sentence,
                testing::AnyOf(HasSubstr("Stopped on request"), HasSubstr("was stopped, and the stop holds")));
    databoard4002_advance_ms(card.handle, 1);
    EXPECT_EQ(peek(card, "MOVING"), 0);
}

TEST(Databoard4002libStops, AWaitForOneCardDoesNotDelayTheStopOfAnother) {
    const Open waiting(two_cards, 7), other(nullptr, 13);
    EXPECT_EQ(databoard4002_set_rate(waiting.handle, 1), 0);
    std::string sentence;
    std::thread mover([&] {
        databoard4002_move_to(waiting.handle, 8'000'000, 600'000);
        sentence = databoard4002_last_error();
    });
    EXPECT_EQ(databoard4002_stop(other.handle), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_stop(waiting.handle), 0) << databoard4002_last_error();
    mover.join();
    EXPECT_THAT(sentence,
                testing::AnyOf(HasSubstr("Stopped on request"), HasSubstr("was stopped, and the stop holds")));
    EXPECT_EQ(databoard4002_reset_stop(other.handle), 0) << databoard4002_last_error();
    EXPECT_EQ(databoard4002_move_to(other.handle, 10, 1000), 0) << databoard4002_last_error();
}

// ---- the library's names

TEST(Databoard4002lib, HasEachFunctionOfTheDeclaration) {
    const std::set<std::string> declared = declared_functions();
    for (const FunctionInfo& function : databoard4002::library_functions())
        EXPECT_EQ(declared.count("databoard4002_" + std::string(function.name)), 1u) << function.name;
}

TEST(Databoard4002lib, ExportsTheFunctionsOfItsHeaderOnly) {
    const std::set<std::string> declared = declared_functions();
    std::FILE* pipe = ::popen("nm -D --defined-only --format=just-symbols '" DATABOARD4002LIB_LIBRARY "'", "r");
    ASSERT_NE(pipe, nullptr);
    std::set<std::string> shown;
    std::array<char, 512> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
        const std::string name = line.data();
        shown.insert(name.substr(0, name.find_last_not_of('\n') + 1));
    }
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_EQ(shown, declared);
    EXPECT_EQ(declared.size(), 34u);
}

}  // namespace
}  // namespace motionrack::databoard4002lib_test
