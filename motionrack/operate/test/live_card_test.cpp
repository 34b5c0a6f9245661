// Real cards that replace virtual ones, with files as cards.
#include <gmock/gmock.h>

#include <cstdlib>
#include <exception>
#include <motionrack/live/last_stop.hpp>
#include <new>
#include <thread>

#include "real_card.hpp"

/// Writes the counters of a build that measures coverage; there is none in other builds.
extern "C" int __llvm_profile_write_file() __attribute__((weak));  // NOLINT(bugprone-reserved-identifier)

namespace motionrack::operate {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const char* const scanner = "[card.scan]\ntype = \"rtc5\"\n";

TEST(RealCard, IsOpenedByItsFirstCallAndClosedAtTheEnd) {
    CardFile file("/dev/zero");
    Real o(file);
    o.at(0.02, [](Machine& m) { EXPECT_EQ(m.service().live(), nullptr); });
    o.call(0.05, "SetRange", {{"data", 800'000}});
    o.call(0.1, "ReadLPS", {{"axis", 1}});
    o.at(0.2, [&](Machine& m) {
        ASSERT_NE(m.service().live(), nullptr);
        EXPECT_EQ(m.service().live()->registers().view.values.size(), 16U) << "four of each axis";
        EXPECT_TRUE(m.status().real);
        EXPECT_THAT(m.status().reason,
                    HasSubstr("card bench is in service by dora; it is a real one, at " + file.place()));
        EXPECT_TRUE(m.status().axes[0].position_valid) << "it is another card's";
        const auto second = live::open_card(m.service().live()->place().spec, m.rack().card("bench")->map());
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().kind, ErrorKind::refused) << "no other program drives it meanwhile";
    });
    o.end(0.3);
    o.at(0.4, [&](Machine& m) {
        EXPECT_EQ(m.service().live(), nullptr);
        EXPECT_FALSE(m.status().real);
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_TRUE(live::open_card(m.service().live_place("bench")->spec, m.rack().card("bench")->map()));
    });
    o.run(0.5);
    EXPECT_THAT(o.said, ElementsAre("Written.", "0 pulses", "The service of card bench has ended."));
    EXPECT_TRUE(o.alarms().empty());
}

TEST(RealCard, WithBytePortsIsNotOpenedWhileItIsNotReady) {
    CardFile file("/dev/zero");  // STAT is 0
    Real o(file, "[card.bench]\ntype = \"databoard4002\"\n");
    o.call(0.05, "position", {});
    o.run(0.8);
    ASSERT_EQ(o.said.size(), 1U);
    EXPECT_THAT(o.said[0], HasSubstr("Card 13 was not Ready for P within 127 ms"));
    EXPECT_TRUE(o.alarms().empty());
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

TEST(RealCard, DoesNotAffectTheVirtualOneNorTheMachine) {
    CardFile file("/dev/zero");
    Real o(file);
    o.call(0.05, "SetRange", {{"data", 800'000}});
    o.call(0.1, "LPS", {{"axis", 1}, {"data", 77}});
    o.at(0.2, [](Machine& m) { EXPECT_EQ(*m.rack().card("bench")->inspect("x.LP"), 0); });
    o.end(0.25);
    o.at(0.3, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X12\nM2\n", "p")); });
    o.run(1);
    EXPECT_NEAR(o.x(), 12, 1e-9);
}

TEST(RealCard, StillDrivingAfterItsStopRaisesALatchedAlarm) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    Real o(file);
    o.call(0.05, "ReadLPS", {{"axis", 1}});
    o.at(0.2, [](Machine& m) { m.stop({"bert", "", "STOP"}); });
    o.at(0.6, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_FALSE(m.service().on());
        ASSERT_EQ(o.alarms().size(), 1U);
        EXPECT_EQ(o.alarms()[0].source, "card bench");
        EXPECT_THAT(o.alarms()[0].text, AllOf(HasSubstr("still moves after 100 polls"),
                                              HasSubstr("press the emergency stop that cuts the motors' power")));
        m.reset(dora);
    });
    o.at(0.8, [&](Machine&) { EXPECT_TRUE(o.alarms()[0].active) << "no reset ends its cause"; });
    o.at(0.9, [&](Machine&) {
        std::ifstream in(memory, std::ios::binary);
        EXPECT_EQ(in.get(), 0x27);
        EXPECT_EQ(in.get(), 0x0F) << "the quick stop of all axes was the last that was written";
        file.points_to("/dev/zero");
    });
    o.call(1.0, "ReadLPS", {{"axis", 1}});
    o.end(1.2);
    o.at(1.4, [&](Machine&) { EXPECT_FALSE(o.alarms()[0].active) << "its axes were seen standing"; });
    o.run(1.5);
}

TEST(RealCard, IsStoppedIfAThreadEndsTheProgramOutOfMemory) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    const auto end = [&] {
        rack::Rack rack(two_axes(beside));
        rack.start();
        const auto card = LiveCard::open(*read_live_place("bench=" + file.place()), rack);
        if (!card) std::_Exit(1);
        (*card)->write(0, 0x0120);
        live::stop_live_cards_at_terminate([] { std::_Exit(5); });
        std::thread([] { throw std::bad_alloc(); }).join();
    };
    EXPECT_EXIT(end(), testing::ExitedWithCode(5), "");
    EXPECT_EQ(text_of(memory).substr(0, 2), "\x27\x0F") << "the quick stop of all axes";
}

/// Ends a process that has live cards, without their destructors.
[[noreturn]] void end_process(int code) {
    if (__llvm_profile_write_file != nullptr) __llvm_profile_write_file();
    std::_Exit(code);
}

/// Gives the card to terminate handlers, which have no arguments.
LiveCard*& ended_card() {
    static LiveCard* card = nullptr;
    return card;
}

/// Opens a card in plain memory, then ends the program by a terminate handler that calls `then`.
void end_with_card(const CardFile& file, std::terminate_handler then, void (*last)()) {
    rack::Rack rack(two_axes(beside));
    rack.start();
    const auto card = LiveCard::open(*read_live_place("bench=" + file.place()), rack);
    if (!card) std::_Exit(1);
    ended_card() = card->get();
    live::stop_live_cards_at_terminate(then);
    last();
}

TEST(RealCard, IsNotDrivenAfterTheStopOfAProgramThatEnds) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    const auto drive_and_end = [] {
        ended_card()->write(0, 0x0120);
        ended_card()->out(0, 0x20);
        end_process(5);
    };
    EXPECT_EXIT(end_with_card(file, drive_and_end, [] { std::terminate(); }), testing::ExitedWithCode(5), "");
    EXPECT_EQ(text_of(memory).substr(0, 2), "\x27\x0F") << "the quick stop of all axes";
}

TEST(RealCard, IsStoppedWhereAnInternalCheckEndsTheProgram) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    const auto fail_check = [] { MOTIONRACK_ASSERT(ended_card() == nullptr); };
    EXPECT_EXIT(end_with_card(
                    file, [] { std::_Exit(5); }, fail_check),
                testing::ExitedWithCode(5), "internal error");
    EXPECT_EQ(text_of(memory).substr(0, 2), "\x27\x0F") << "the quick stop of all axes";
}

TEST(RealCard, ThatWasClosedIsNotStoppedAtTheEndOfTheProgram) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    rack::Rack rack(two_axes(beside));
    rack.start();
    { ASSERT_TRUE(LiveCard::open(*read_live_place("bench=" + file.place()), rack)); }
    const std::string before = text_of(memory);
    live::stop_live_cards();
    EXPECT_EQ(text_of(memory), before);
}

TEST(RealCard, ThatDoesNotStopDelaysNoFunctionAndNoAlarm) {
    CardFile file("/dev/zero");
    file.points_to(file.memory('\0'));
    Real o(file);
    o.call(0.05, "wait", {{"axis", 1}, {"milliseconds", 60'000}});
    double stopped = 0;
    o.at(0.3, [&](Machine& m) {
        EXPECT_EQ(m.service().working(), "wait") << "the rack's time goes on while it waits";
        m.stop({"bert", "", "STOP"});
        stopped = to_seconds(m.now());
    });
    o.at(1.0, [&](Machine& m) {
        EXPECT_FALSE(m.service().on());
        ASSERT_EQ(o.alarms().size(), 1U);
        EXPECT_LT(to_seconds(o.alarms()[0].at) - stopped, 0.5);
    });
    o.run(1.1);
    ASSERT_EQ(o.said.size(), 1U);
    EXPECT_THAT(o.said[0], HasSubstr("had not ended 100 ms after the stop and was aborted"));
}

TEST(RealCard, WithARejectedAccessInServiceRaisesALatchedAlarm) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    Real o(file);
    o.call(0.05, "ReadLPS", {{"axis", 1}});
    o.at(0.2, [&](Machine&) { fs::resize_file(memory, 0); });
    o.call(0.25, "ReadLPS", {{"axis", 1}});
    o.at(0.5, [&](Machine& m) {
        EXPECT_FALSE(m.service().on());
        EXPECT_EQ(m.state(), MachineState::standstill);
    });
    o.run(0.6);
    ASSERT_EQ(o.said.size(), 2U);
    EXPECT_THAT(o.said[1], HasSubstr("could not be read through"));
    ASSERT_EQ(o.alarms().size(), 1U);
    EXPECT_TRUE(o.alarms()[0].active && o.alarms()[0].stays);
    EXPECT_THAT(o.alarms()[0].text, AllOf(HasSubstr("could not be read through"), HasSubstr("was not written"),
                                          HasSubstr("press the emergency stop")));
}

/// The card's file is truncated; when the service opens the port again, another card answers there.
TEST(RealCard, StoppedThroughItsPortOpenedAgainRaisesAnAlarmThatAResetEnds) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    Real o(file);
    o.call(0.05, "ReadLPS", {{"axis", 1}});
    o.at(0.2, [&](Machine&) {
        fs::resize_file(memory, 0);
        file.points_to("/dev/zero");
    });
    o.call(0.25, "ReadLPS", {{"axis", 1}});
    o.at(0.5, [&](Machine& m) {
        EXPECT_FALSE(m.service().on());
        ASSERT_EQ(o.alarms().size(), 1U);
        EXPECT_TRUE(o.alarms()[0].active);
        EXPECT_THAT(
            o.alarms()[0].text,
            AllOf(HasSubstr("could not be read through"),
                  HasSubstr("was opened again, and the quick stop of all axes was written through it: they stand"
                            ". Check the card before its next service.")));
        m.reset();
    });
    o.run(0.6);
    EXPECT_FALSE(o.alarms()[0].active);
}

/// An exception leaves the loop of the machine, as after a failed allocation.
TEST(RealCard, IsStoppedWhereAnExceptionEndsTheMachine) {
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\0');
    file.points_to(memory);
    Real o(file);
    o.call(0.05, "ReadLPS", {{"axis", 1}});
    o.at(0.2, [](Machine&) { throw std::bad_alloc(); });
    EXPECT_THROW(o.run(0.3), std::bad_alloc);
    EXPECT_NE(text_of(memory).substr(0, 2), "\x27\x0F");
    o.watch.reset();
    o.machine.reset();
    EXPECT_EQ(text_of(memory).substr(0, 2), "\x27\x0F") << "the quick stop of all axes";
}

/// Expects the alarm of a card that is removed from its slot at 0.2 s. A file keeps written words, unlike an empty
/// slot, so it is filled again before the next service.
void expect_the_alarm_of_an_empty_slot(double call_at, const std::string& function, const CallArguments& arguments) {
    CardFile file("/dev/zero");
    file.points_to(file.memory('\0'));
    Real o(file);
    o.call(0.02, "ReadLPS", {{"axis", 1}});
    o.call(call_at, function, arguments);
    o.at(0.2, [&](Machine&) { file.memory('\xFF'); });
    o.at(1.1, [&](Machine& m) {
        EXPECT_FALSE(m.service().on());
        ASSERT_EQ(o.alarms().size(), 1U);
        EXPECT_TRUE(o.alarms()[0].active && o.alarms()[0].stays);
        EXPECT_THAT(o.alarms()[0].text,
                    AllOf(HasSubstr("no card answers"), HasSubstr("their positions are not valid"),
                          HasSubstr("was not written, or had no effect"), HasSubstr("press the emergency stop")));
        file.memory('\xFF');
    });
    o.call(1.2, "ReadLPS", {{"axis", 1}});
    o.run(1.4);
    EXPECT_THAT(o.said, ElementsAre("0 pulses", HasSubstr("no card answers"), HasSubstr("no card answers")))
        << "-1 is not its position";
}

TEST(RealCard, ReadingAllOnesAtStandstillRaisesALatchedAlarm) {
    expect_the_alarm_of_an_empty_slot(0.4, "moving", {{"axis", 1}});
}

TEST(RealCard, ReadingAllOnesWhileAFunctionWaitsRaisesALatchedAlarm) {
    expect_the_alarm_of_an_empty_slot(0.05, "wait", {{"axis", 1}, {"milliseconds", 60'000}});
}

TEST(RealCard, ThatCannotBeOpenedRejectsTheService) {
    struct Bad {
        const char* name;
        const char* says;
    };
    CardFile file("/dev/zero");
    const fs::path memory = file.memory('\xFF');
    for (const Bad& bad : {Bad{"/nowhere/card", "no card behind it"}, Bad{"/dev/full", "could not be written"},
                           Bad{memory.c_str(), "no card answers"}}) {
        const char* const says = bad.says;
        file.points_to(bad.name);
        Real o(file);
        o.at(0.05, [&](Machine& m) {
            EXPECT_TRUE(m.service().begin("bench", dora, "w1", [&](const Result<std::string>& reported) {
                o.said.push_back(reported ? *reported : reported.error().message);
            }));
        });
        o.at(0.2, [&](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::standstill);
            EXPECT_THAT(m.status().reason, AllOf(HasSubstr("was not started"), HasSubstr(says)));
        });
        o.at(0.25, [&](Machine&) { file.memory('\xFF'); });
        o.call(0.3, "ReadLPS", {{"axis", 1}});
        o.run(0.4);
        EXPECT_THAT(o.said, ElementsAre(HasSubstr(says), AllOf(HasSubstr("Not called."), HasSubstr(says))));
        EXPECT_TRUE(o.alarms().empty()) << "nothing of it was driven";
    }
}

TEST(RealCard, ReplacesACardThatMovesNoAxis) {
    const auto refused = [](const std::vector<std::string>& places, const char* more = beside) {
        MachineSettings settings;
        for (const std::string& place : places) settings.live.push_back(*read_live_place(place));
        const auto made = Machine::make(two_axes(more), std::move(settings));
        return made ? std::string() : made.error().message;
    };
    EXPECT_THAT(refused({"m=port:/dev/zero"}), HasSubstr("Card m moves X, Y of the machine"));
    EXPECT_THAT(refused({"glass=port:/dev/zero"}),
                HasSubstr("Card glass is of type ioflex02. An IOFLEX02 has no live port: "));
    EXPECT_THAT(refused({"scan=port:/dev/zero"}, scanner),
                HasSubstr("Card scan is of type rtc5. An RTC5 has no live port: "));
    EXPECT_THAT(refused({"none=port:/dev/zero"}), HasSubstr("the cards of this rack are: m, bench, glass"));
    EXPECT_THAT(refused({"bench=port:/dev/zero", "bench=port:/dev/null"}), HasSubstr("Card bench has two addresses"));
    EXPECT_EQ(refused({"bench=port:/dev/zero"}), "");
    EXPECT_EQ(refused({"bench=port:/dev/zero", "other=port:/dev/null"},
                      "[card.bench]\ntype = \"mcx314\"\n[card.other]\ntype = \"mcx314\"\n"),
              "");
}

TEST(RealCard, IsReportedWithItsAddress) {
    const Result<LivePlace> good = read_live_place("bench=port:/dev/port,offset=0x300,width=8");
    ASSERT_TRUE(good) << good.error().message;
    EXPECT_EQ(good->card, "bench");
    EXPECT_EQ(good->place, "port:/dev/port,offset=0x300,width=8");
    EXPECT_EQ(good->spec.offset, 0x300U);
    for (const char* text : {"", "bench", "=port:/dev/port", "port:/dev/port,width=8"}) {
        const Result<LivePlace> bad = read_live_place(text);
        ASSERT_FALSE(bad) << text;
        EXPECT_THAT(bad.error().message, HasSubstr("bench=port:/dev/port,offset=0x300,width=8"));
    }
    EXPECT_THAT(read_live_place("bench=uio:/dev/uio0,width=9").error().message, HasSubstr("width is 9"));
}

}  // namespace
}  // namespace motionrack::operate
