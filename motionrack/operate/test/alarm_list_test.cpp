// The list of alarms: its size, alarms that replace others, and the ends of alarms.
#include <gmock/gmock.h>

#include <motionrack/operate/alarm_list.hpp>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::ElementsAre;

/// A list of three alarms at most.
class AlarmListTest : public testing::Test {
  protected:
    std::vector<std::int64_t> numbers() const {
        std::vector<std::int64_t> out;
        for (const Alarm& alarm : alarms) out.push_back(alarm.number);
        return out;
    }
    /// Returns "+-": the first is active, the second is over.
    std::string active() const {
        std::string out;
        for (const Alarm& alarm : alarms) out += alarm.active ? '+' : '-';
        return out;
    }

    rack::Rack rack{two_axes()};
    std::vector<Alarm> alarms;
    AlarmList list{rack, alarms, 3};
};

TEST_F(AlarmListTest, NumbersAlarmsAndRemovesTheOldestOfTooMany) {
    for (const char* text : {"one", "two", "three"}) list.raise("machine", text);
    EXPECT_THAT(numbers(), ElementsAre(1, 2, 3));
    EXPECT_EQ(list.raise("machine", "four").text, "four");
    EXPECT_THAT(numbers(), ElementsAre(2, 3, 4));
    EXPECT_EQ(alarms[0].source, "machine");
    EXPECT_EQ(alarms[0].text, "two");
}

TEST_F(AlarmListTest, RemovesFirstWhatIsOverAndAcknowledged) {
    list.raise("machine", "over and acknowledged");
    list.raise("machine", "over");
    list.reset();
    EXPECT_TRUE(list.acknowledge(1));
    list.raise("machine", "acknowledged");
    EXPECT_THAT(numbers(), ElementsAre(2, 3));
    EXPECT_TRUE(list.acknowledge(3));
    list.raise("machine", "new");
    EXPECT_THAT(numbers(), ElementsAre(2, 3, 4));
    EXPECT_EQ(active(), "-++");
}

TEST_F(AlarmListTest, HasAnActiveAlarmOnceAndAsksAgainToAcknowledgeIt) {
    list.raise("position", "A line of the encoder is faulty.");
    list.raise("machine", "A line of the encoder is faulty.");
    list.raise("position", "A line of the encoder is faulty.", 'X');
    EXPECT_TRUE(list.acknowledge(1));
    EXPECT_EQ(list.raise("position", "A line of the encoder is faulty.").number, 1);
    EXPECT_THAT(numbers(), ElementsAre(1, 2, 3));
    EXPECT_FALSE(alarms[0].acknowledged);
    list.reset();
    EXPECT_EQ(list.raise("position", "A line of the encoder is faulty.").number, 4) << "the reset ended the first";
}

TEST_F(AlarmListTest, AcknowledgesNoUnknownAlarm) {
    list.raise("machine", "one");
    EXPECT_FALSE(list.acknowledge(2));
    EXPECT_FALSE(alarms[0].acknowledged);
}

TEST_F(AlarmListTest, HasOneAlarmOfAnAxis) {
    std::vector<Alarm> found(3);
    found[0].axis = 'X';
    found[1].axis = 'Y';
    found[1].source = "position";
    found[1].text = "Y is off.";
    list.raise(found);
    list.raise("position", "X is off again.", 'X');
    EXPECT_THAT(numbers(), ElementsAre(2, 3, 4)) << "it takes the place of the first";
    EXPECT_EQ(alarms[0].source, "position");
    EXPECT_EQ(alarms[0].text, "Y is off.");
    EXPECT_EQ(active(), "+++");
    list.supersede("XZ");
    EXPECT_EQ(active(), "++-") << "neither Y's nor the one of no axis";
    EXPECT_TRUE(alarms[2].acknowledged);
    EXPECT_FALSE(alarms[1].acknowledged);
}

TEST_F(AlarmListTest, KeepsAlarmsThatAResetDoesNotEnd) {
    list.raise("card bench", "It may move.").stays = true;
    list.raise("machine", "It was stopped.");
    list.raise("card bench", "It was read.");
    list.end_staying("card other");
    list.reset();
    EXPECT_EQ(active(), "+--");
    list.end_staying("card bench");
    EXPECT_EQ(active(), "---");
    EXPECT_FALSE(alarms[0].stays);
}

}  // namespace
}  // namespace motionrack::operate
