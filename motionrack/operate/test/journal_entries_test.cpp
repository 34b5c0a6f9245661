// Sentences of the journal about each change of a machine's status.
#include <gmock/gmock.h>

#include <motionrack/operate/journal_writer.hpp>

namespace motionrack::operate {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A writer without a journal, and its entries as "kind: text".
class JournalEntries : public testing::Test {
  protected:
    JournalEntries() {
        status.state = MachineState::standstill;
        status.axes.resize(2);
        status.axes[0].commanded = 1.5;
        status.axes[0].position_valid = true;
        status.axes[1].letter = 'A';
        status.axes[1].rotary = true;
        status.axes[1].commanded = 90;
        EXPECT_THAT(seen(), IsEmpty()) << "the first status is the state that it begins with";
    }
    /// Returns the entries of the present status.
    std::vector<std::string> seen() {
        entries.clear();
        writer.see(status);
        return entries;
    }

    std::vector<std::string> entries;
    JournalWriter writer{nullptr, [this](Instant, const std::string& kind, const std::string& text,
                                         const std::string&) { entries.push_back(kind + ": " + text); }};
    Status status;
};

TEST_F(JournalEntries, TellBeginAndStopOfAProgramAndWhereTheAxesStand) {
    status.program = "p.ngc";
    status.lines = 9;
    status.program_runs = true;
    status.state = MachineState::moving;
    EXPECT_THAT(seen(), ElementsAre("job: p.ngc began: 9 lines.", "state: moving."));
    EXPECT_THAT(seen(), IsEmpty());
    status.program_runs = false;
    status.line = 4;
    status.state = MachineState::stopping;
    status.reason = "STOP by anna: p.ngc, line 4 was stopped.";
    EXPECT_THAT(seen(), ElementsAre("job: p.ngc was stopped at line 4 of 9.", "state: stopping: " + status.reason));
    status.state = MachineState::standstill;
    status.reason = "";
    EXPECT_THAT(seen(),
                ElementsAre("state: standstill.", "position: Stands at X 1.5000 mm, A 90.0000 deg (not valid)."));
    status.state = MachineState::error_stop;
    status.reason = "The button is pressed";
    EXPECT_THAT(seen(), ElementsAre("state: error stop: The button is pressed.")) << "it stood before";
}

TEST_F(JournalEntries, TellFailureAndEndOfAProgram) {
    const auto begin = [this] {
        status.program = "p.ngc";
        status.program_runs = true;
        status.state = MachineState::moving;
        seen();
    };
    status.lines = 9;
    begin();
    status.program_runs = false;
    status.line = 3;
    status.state = MachineState::error_stop;
    status.reason = "A limit switch was reached";
    EXPECT_THAT(seen(), ElementsAre("job: p.ngc failed at line 3 of 9: A limit switch was reached.",
                                    "state: error stop: A limit switch was reached.",
                                    "position: Stands at X 1.5000 mm, A 90.0000 deg (not valid)."));
    begin();
    status.program_runs = false;
    EXPECT_THAT(seen(), ElementsAre("job: p.ngc ended."));
}

TEST_F(JournalEntries, TellGainAndLossOfAPosition) {
    status.axes[1].position_valid = true;
    EXPECT_THAT(seen(), ElementsAre("position: Axis A: its position, 90.0000 deg, is valid."));
    status.axes[0].position_valid = false;
    EXPECT_THAT(seen(), ElementsAre("position: Axis X: its position, 1.5000 mm, is not valid any more."));
    EXPECT_THAT(seen(), IsEmpty());
}

TEST_F(JournalEntries, TellEachChangeOfAnAlarmOnce) {
    Alarm alarm;
    alarm.number = 1;
    alarm.text = "The button is pressed.";
    status.alarms.push_back(alarm);
    EXPECT_THAT(seen(), ElementsAre("alarm: The button is pressed."));
    status.alarms[0].active = false;
    EXPECT_THAT(seen(), ElementsAre("alarm: Over: The button is pressed."));
    status.alarms[0].acknowledged = true;
    EXPECT_THAT(seen(), ElementsAre("alarm: Acknowledged: The button is pressed."));
    EXPECT_THAT(seen(), IsEmpty());
}

TEST_F(JournalEntries, TellEachSettingThatChanges) {
    status.rapid_override = 0.25;
    EXPECT_THAT(seen(), ElementsAre("setting: Rapid override 25 %."));
    status.feed_override = 1.5;
    status.single_block = true;
    EXPECT_THAT(seen(), ElementsAre("setting: Feed override 150 %.", "setting: Single block on."));
    status.single_block = false;
    EXPECT_THAT(seen(), ElementsAre("setting: Single block off."));
    EXPECT_THAT(seen(), IsEmpty());
}

}  // namespace
}  // namespace motionrack::operate
