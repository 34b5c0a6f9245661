// Journal entries of a machine, and the state that the next run restores.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <motionrack/operate/journal_writer.hpp>
#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/template.hpp>

namespace motionrack::operate {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

rack::RackConfig table() {
    return *rack::read_rack_text(
                "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = "
                "10\n[axis.Y]\ncard = "
                "\"m\"\nchannel = \"y\"\n")
                .config;
}

/// A machine whose statuses are written to a journal.
class JournalWriterTest : public testing::Test {
  protected:
    JournalWriterTest()
        : path_((fs::path(testing::TempDir()) / ("journal_writer_" + std::to_string(::getpid()) + ".db")).string()) {
        remove();
    }
    ~JournalWriterTest() override {
        journal_.reset();
        remove();
    }
    void remove() const {
        for (const char* end : {"", "-wal", "-shm", ".lock"}) fs::remove(path_ + end);
    }
    void open() {
        journal_ = std::move(*journal::Journal::open(path_));
        book_.emplace(*journal_);
    }
    /// Runs a machine; calls `order` once, when `when` is true for a status.
    void run(MachineSettings settings, std::function<bool(const Status&)> when, std::function<void(Machine&)> order,
             std::function<void(Machine&)> begin) {
        Machine* machine = nullptr;
        bool done = false;
        settings.on_status = [&](const Status& status) {
            book_->see(status);
            if (machine != nullptr && quit_on_ && status.state == *quit_on_) machine->quit();
            if (machine == nullptr || done || !when(status)) return;
            done = true;
            machine->post([&machine, order] { order(*machine); });
        };
        auto made = Machine::make(table(), std::move(settings));
        ASSERT_TRUE(made) << made.error().message;
        machine = made->get();
        ASSERT_TRUE(machine->enable(true));
        begin(*machine);
        machine->run();
        last_ = machine->status();
    }
    void quit_on(MachineState state) { quit_on_ = state; }
    std::vector<std::string> texts(const char* kind) {
        std::vector<std::string> out;
        const auto entries = journal_->read({0, kind, 1000});
        for (const journal::Entry& entry : *entries) out.push_back(entry.text);
        return out;
    }
    /// Ends the journal as a completed run or as a killed one.
    void end(bool clean) {
        if (clean) {
            ASSERT_TRUE(journal_->close());
        }
        journal_.reset();
    }

    std::string path_;
    std::unique_ptr<journal::Journal> journal_;
    std::optional<JournalWriter> book_;
    std::optional<MachineState> quit_on_;
    Status last_;
};

TEST_F(JournalWriterTest, RecordsWhatRanAndWhereTheMachineStopped) {
    open();
    run(
        {},
        [](const Status& s) {
            return s.program == "part.ngc" && !s.program_runs && s.state == MachineState::standstill;
        },
        [](Machine& m) { m.quit(); },
        [](Machine& m) { ASSERT_TRUE(m.begin_program("G0 X12\nG1 Y3 F600\nM30\n", "part.ngc")); });
    end(true);
    open();
    EXPECT_THAT(texts("job"), ElementsAre("part.ngc began: 3 lines.", "part.ngc ended."));
    EXPECT_THAT(texts("state"), ElementsAre("moving.", "standstill."));
    EXPECT_THAT(texts("position"), ElementsAre("Stands at X 12.0000 mm, Y 3.0000 mm."));
    ASSERT_TRUE(journal_->before());
    const LastKnownPositions last = read_last(*journal_->before(), table());
    EXPECT_EQ(last.sentence, "");
    ASSERT_EQ(last.axes.size(), 2u);
    EXPECT_NEAR(last.axes[0].true_position, 12, 1e-9);
    EXPECT_NEAR(last.axes[0].commanded, 12, 1e-9);
    EXPECT_TRUE(last.axes[0].position_valid);
}

TEST_F(JournalWriterTest, HasOneEntryOfAStopWithTwoSources) {
    open();
    const auto stop = [&](int ms, const char* who, const char* address, bool releases = false) {
        book_->stopped({milliseconds(ms), {who, address, "STOP"}, {}, fmt::format("{} {}", who, ms), releases});
    };
    stop(1'000, "anna", "10.0.0.5");
    stop(1'003, "anna", "10.0.0.5");
    stop(1'004, "bert", "10.0.0.5");
    stop(3'000, "bert", "10.0.0.5");
    stop(3'100, "bert", "10.0.0.5", true);
    stop(3'200, "bert", "10.0.0.5");
    end(true);
    open();
    EXPECT_THAT(texts("stop"), ElementsAre("anna 1000", "bert 1004", "bert 3000", "bert 3200"))
        << "a second later, and after a reset, it is another one";
}

TEST_F(JournalWriterTest, IsNotFloodedByStopsOfAnIdleMachine) {
    open();
    const auto stop = [&](int ms, MachineState state) {
        const std::string who = ms % 2 == 0 ? "even" : "odd";
        book_->stopped({milliseconds(ms), {who, "10.0.0.5", "STOP"}, state, std::to_string(ms), false});
    };
    for (int ms = 0; ms < 100'000; ++ms) stop(ms, MachineState::error_stop);
    stop(100'000, MachineState::moving);
    end(true);
    open();
    const std::vector<std::string> stops = texts("stop");
    EXPECT_EQ(stops.size(), 30u) << "20 at once, then one in 10 s";
    EXPECT_EQ(stops.back(), "100000") << "one that stops something is always written";
}

/// With a paused clock the machine does not come to standstill.
TEST_F(JournalWriterTest, IsNotFloodedByStopsOfAMachineThatIsStopping) {
    open();
    const auto stop = [&](const std::string& who, MachineState state, int ms) {
        book_->stopped({milliseconds(ms), {who, "10.0.0.5", "STOP"}, state, fmt::format("{} {}", who, ms), false});
    };
    const auto see = [&](MachineState state) {
        Status status;
        status.state = state;
        book_->see(status);
    };
    stop("anna", MachineState::moving, 0);
    for (int i = 0; i < 1000; ++i) {
        see(MachineState::stopping);
        stop("bert", MachineState::stopping, 0);
        stop("anna", MachineState::stopping, 0);
    }
    stop("bert", MachineState::stopping, 2'000);
    see(MachineState::standstill);
    see(MachineState::stopping);
    stop("bert", MachineState::stopping, 4'000);
    for (int i = 0; i < 1000; ++i) stop(std::to_string(i), MachineState::stopping, 4'000);
    stop("carl", MachineState::moving, 6'000);
    end(true);
    open();
    const std::vector<std::string> stops = texts("stop");
    ASSERT_EQ(stops.size(), 2u + 20u + 1u);
    EXPECT_EQ(stops[0], "anna 0");
    EXPECT_EQ(stops[1], "bert 0");
    EXPECT_EQ(stops[2], "bert 4000") << "another stop";
    EXPECT_EQ(stops[21], "18 4000");
    EXPECT_EQ(stops[22], "carl 6000") << "one that stops something is always written";
}

TEST_F(JournalWriterTest, TheNextRunStartsAtThePositionOfTheMachine) {
    open();
    run(
        {}, [](const Status& s) { return s.axes[0].commanded == 12 && s.state == MachineState::standstill; },
        [](Machine& m) { m.quit(); }, [](Machine& m) { ASSERT_TRUE(m.line("G0 X12", 1)); });
    end(true);
    open();
    MachineSettings settings;
    settings.initial_axes = read_last(*journal_->before(), table()).axes;
    run(
        std::move(settings),
        [](const Status& s) { return s.axes[0].commanded == 15 && s.state == MachineState::standstill; },
        [](Machine& m) { m.quit(); },
        [](Machine& m) {
            EXPECT_EQ(m.status().axes[0].commanded, 12);
            EXPECT_TRUE(m.status().axes[0].position_valid);
            ASSERT_TRUE(m.line("G91 G0 X3", 1));
        });
    EXPECT_NEAR(last_.axes[0].true_position, 15, 1e-9);
}

TEST_F(JournalWriterTest, HasTheStopPositionOfAMachineThatEndedDuringAJog) {
    open();
    run(
        {}, [](const Status& s) { return s.axes[0].commanded > 20; }, [](Machine& m) { m.quit(); },
        [](Machine& m) { ASSERT_TRUE(m.manual().jog('X', 90)); });
    EXPECT_EQ(last_.state, MachineState::standstill);
    end(true);
    open();
    const LastKnownPositions last = read_last(*journal_->before(), table());
    ASSERT_EQ(last.axes.size(), 2u);
    EXPECT_GT(last.axes[0].true_position, 20.5) << "it took some way to stop";
    EXPECT_EQ(last.axes[0].true_position, last_.axes[0].true_position);
    EXPECT_EQ(last.axes[0].commanded, last_.axes[0].commanded);
    EXPECT_TRUE(last.axes[0].position_valid);
}

TEST_F(JournalWriterTest, AfterAKillReportsTheProgramAndPositionsAndInvalidatesThem) {
    open();
    // No entry of the program's end is written: as if it had been killed during the move.
    run(
        {}, [](const Status& s) { return s.axes[0].commanded > 50; },
        [this](Machine& m) {
            journal_.reset();
            open();
            EXPECT_FALSE(journal_->before()->clean);
            const LastKnownPositions last = read_last(*journal_->before(), table());
            EXPECT_THAT(last.sentence, HasSubstr("was interrupted"));
            EXPECT_THAT(last.sentence, HasSubstr("'part.ngc' ran and was at line 2"));
            EXPECT_THAT(last.sentence, HasSubstr("No position is valid"));
            EXPECT_NEAR(last.axes[0].true_position, 50, 12);  // at most 0.1 s old
            EXPECT_FALSE(last.axes[0].position_valid);
            m.quit();
        },
        [](Machine& m) { ASSERT_TRUE(m.begin_program("(a long way)\nG1 X200 F6000\nM30\n", "part.ngc")); });
    MachineSettings settings;
    settings.initial_axes = read_last(*journal_->before(), table()).axes;
    settings.alarm = read_last(*journal_->before(), table()).sentence;
    const auto machine = std::move(*Machine::make(table(), std::move(settings)));
    EXPECT_NEAR(machine->status().axes[0].true_position, 50, 12);
    EXPECT_FALSE(machine->status().axes[0].position_valid);
    ASSERT_EQ(machine->status().alarms.size(), 1u);
    EXPECT_THAT(machine->status().alarms[0].text, HasSubstr("interrupted"));
    EXPECT_EQ(machine->status().alarms[0].source, "last run");
    ASSERT_TRUE(machine->enable(true));
    EXPECT_FALSE(machine->begin_program("G0 X1\nM30\n", "again.ngc"));
}

TEST_F(JournalWriterTest, ReportsAlarmsSettingsAndInvalidPositions) {
    open();
    run(
        {}, [](const Status& s) { return s.axes[0].commanded > 50; },
        [this](Machine& m) {
            m.programs().set_overrides(0.5, 1);
            m.programs().set_single_block(true);
            ASSERT_TRUE(m.wires().force("estop", 0));
            quit_on(MachineState::error_stop);
        },
        [](Machine& m) { ASSERT_TRUE(m.begin_program("G1 X200 F6000\nM30\n", "part.ngc")); });
    end(true);
    open();
    EXPECT_THAT(texts("setting"), ElementsAre("Feed override 50 %.", "Single block on."));
    EXPECT_THAT(texts("alarm"), Contains(HasSubstr("emergency stop")));
    EXPECT_THAT(texts("position"), Contains(HasSubstr("not valid any more")));
    EXPECT_THAT(texts("job"), Contains(HasSubstr("failed at line 1")));
}

TEST_F(JournalWriterTest, IgnoresUnreadableEntries) {
    for (const char* kept :
         {"", "[]", "7", "{\"axes\": 3}",
          "{\"axes\": [1, {\"letter\": 5}, {\"letter\": \"X\"}, {\"letter\": \"XY\", \"true_position\": 1, "
          "\"commanded\": 1}, {\"letter\": \"Q\", \"true_position\": 1, \"commanded\": 1}]}",
          "{\"axes\": [{\"letter\": \"Y\", \"true_position\": 1, \"commanded\": \"1\", \"position_valid\": true}]}",
          "{\"line\": \"x\", \"state\": 4"}) {
        const LastKnownPositions last = read_last({1, false, 0, {{"machine", kept}}, {}, {}}, table());
        ASSERT_EQ(last.axes.size(), table().axes.size()) << kept;
        for (const InitialAxisState& one : last.axes) EXPECT_FALSE(one.position_valid) << kept;
        EXPECT_THAT(last.sentence, HasSubstr("interrupted")) << kept;
    }
}

TEST_F(JournalWriterTest, InvalidatesPositionsThatDoNotFitTheirChecksum) {
    const std::string kept =
        R"({"axes": [{"letter": "X", "true_position": 5, "commanded": 5, "position_valid": true}]})";
    EXPECT_TRUE(read_last({1, true, 0, {{"machine", kept}}, {}, {}}, table()).axes[0].position_valid);
    const LastKnownPositions last = read_last({1, true, 0, {{"machine", kept}}, {"its end does not fit"}, {}}, table());
    EXPECT_FALSE(last.axes[0].position_valid);
    EXPECT_THAT(last.sentence, HasSubstr("The journal is invalid: its end does not fit. No position is"));
    const LastKnownPositions none = read_last({1, true, 0, {}, {}, {}}, table());
    ASSERT_FALSE(none.axes.empty());
    EXPECT_FALSE(none.axes[0].position_valid) << "without a record it may stand anywhere";
    EXPECT_THAT(none.sentence, HasSubstr("has no axis positions"));
    const LastKnownPositions changed =
        read_last({1, true, 0, {{"machine", kept}}, {}, "Entry 3 was changed."}, table());
    EXPECT_TRUE(changed.axes[0].position_valid);
    EXPECT_EQ(changed.sentence, "Entry 3 was changed.");
}

TEST_F(JournalWriterTest, ReadsPositionsAsFormerVersionsWroteThem) {
    const std::string kept = R"({"axes": [{"letter": "X", "place": 5, "commanded": 6, "trusted": true},
                                          {"letter": "Y", "place": 7, "commanded": 7, "trusted": false}]})";
    const LastKnownPositions last = read_last({1, true, 0, {{"machine", kept}}, {}, {}}, table());
    ASSERT_GE(last.axes.size(), 2u);
    EXPECT_EQ(last.axes[0].true_position, 5);
    EXPECT_EQ(last.axes[0].commanded, 6);
    EXPECT_TRUE(last.axes[0].position_valid);
    EXPECT_FALSE(last.axes[1].position_valid);
    EXPECT_EQ(last.sentence, "");
}

TEST_F(JournalWriterTest, RecordsThePositionOfAnAxisPushedAtStandstill) {
    open();
    Status status;
    status.state = MachineState::standstill;
    status.axes.resize(1);
    status.axes[0].position_valid = true;
    book_->see(status);
    status.at = milliseconds(500);
    status.axes[0].commanded = status.axes[0].true_position = 1.57;
    book_->see(status);
    book_.reset();
    ASSERT_TRUE(journal_->close());
    journal_.reset();
    open();
    ASSERT_TRUE(journal_->before());
    const std::vector<InitialAxisState> kept = read_last(*journal_->before(), table()).axes;
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_DOUBLE_EQ(kept[0].commanded, 1.57);
}

/// A servo whose card hangs drifts on, so its position at the end of the run differs from the last periodic one.
TEST_F(JournalWriterTest, RecordsThePositionOfEachAxisAtTheEndOfTheRun) {
    open();
    Status status;
    status.state = MachineState::error_stop;
    status.axes.resize(1);
    status.axes[0].position_valid = true;
    for (int k = 0; k <= 305; ++k) {
        status.at = milliseconds(2 * k);
        status.axes[0].commanded = status.axes[0].true_position = 0.05 * k;
        status.ended = k == 305;
        book_->see(status);
    }
    book_.reset();
    end(true);
    open();
    ASSERT_TRUE(journal_->before());
    EXPECT_DOUBLE_EQ(read_last(*journal_->before(), table()).axes.at(0).commanded, 0.05 * 305);
}

}  // namespace
}  // namespace motionrack::operate
