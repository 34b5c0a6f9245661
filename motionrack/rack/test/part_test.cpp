// Parts of a rack: their order, quantities and faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const char* const one_of_each = R"(
[card.m]
type = "mcx314"
[card.decoder]
type = "grating_decoder"
scales = 1
[card.host]
type = "grating_bus"
scales = 1
[card.scan]
type = "rtc5"
[axis.X]
card = "m"
channel = "x"
[stage.mask]
card = "host"
input = 0
[belt.line]
card = "scan"
[scanner.head]
card = "scan"
conveyor = "line"
[lamp.red]
)";

Part& part_named(Rack& rack, std::string_view name) {
    for (const auto& part : rack.parts())
        if (part->name() == name) return *part;
    ADD_FAILURE() << "the rack has no part " << name;
    return *rack.parts().front();
}

TEST(Parts, AreAxesThenCardsStagesConveyorsScanHeadsAndLamps) {
    Rack rack(good(one_of_each));
    std::vector<std::string> names, subjects;
    for (const auto& part : rack.parts()) {
        names.push_back(part->name());
        subjects.push_back(part->subject());
    }
    EXPECT_THAT(names, ElementsAre("X", "m", "decoder", "host", "scan", "mask", "line", "head", "red"));
    EXPECT_THAT(subjects, ElementsAre("Axis X", "Card m", "Card decoder", "Card host", "Card scan", "Stage mask",
                                      "line", "head", "Lamp red"));
}

TEST(Parts, GiveTheValuesThatTheirListsOfQuantitiesName) {
    StartedRack rack(one_of_each);
    const Instant now = rack.kernel().now();
    for (const auto& part : rack.parts())
        for (const Quantity& one : part->quantities()) {
            EXPECT_EQ(part->quantity(one.name, now), one.get(now)) << part->name() << '.' << one.name;
            EXPECT_EQ(*get_quantity(rack, part->name() + "." + one.name), one.get(now));
        }
}

TEST(Parts, NumberTheirFaultsAsTheInputLogHasThem) {
    Rack rack(good(one_of_each));
    EXPECT_THAT(part_named(rack, "X").fault_names(),
                ElementsAre("motor.stall", "motor.lose_steps", "motor.push", "encoder.broken_a", "encoder.broken_b",
                            "encoder.swapped", "limit_minus.stuck_open", "limit_minus.stuck_closed",
                            "limit_plus.stuck_open", "limit_plus.stuck_closed", "home.stuck_open", "home.stuck_closed",
                            "motor.load", "encoder.inverted_a", "encoder.inverted_b", "encoder.noise", "encoder.jitter",
                            "encoder.dirt", "encoder.overspeed", "encoder.eccentricity"));
    EXPECT_THAT(part_named(rack, "mask").fault_names(),
                ElementsAre("motor.stall", "motor.push", "motor.friction", "motor.load", "scale.lose", "scale.dirt",
                            "scale.swapped", "scale.expansion"));
    EXPECT_THAT(part_named(rack, "line").fault_names(),
                ElementsAre("drive.speed", "drive.profile", "encoder.broken_a", "encoder.broken_b", "encoder.swapped",
                            "encoder.inverted_a", "encoder.inverted_b", "encoder.noise", "encoder.jitter"));
    EXPECT_THAT(part_named(rack, "head").fault_names(), IsEmpty());
    EXPECT_THAT(part_named(rack, "red").fault_names(), ElementsAre("burnt_out"));
    EXPECT_THAT(part_named(rack, "m").fault_names(), IsEmpty());
}

TEST(Parts, CannotHaveTheFaultsOfWhatTheyLack) {
    Rack rack(good(one_of_each));
    const Part& axis = part_named(rack, "X");
    EXPECT_TRUE(axis.can_have("motor.stall"));
    EXPECT_TRUE(axis.can_have("motor.lose_steps"));
    EXPECT_FALSE(axis.can_have("motor.load")) << "it is no fault of a stepping motor";
    EXPECT_FALSE(axis.can_have("encoder.dirt")) << "its encoder is a link, without lines";
}

TEST(Parts, CannotHaveFaultsThatTheyDoNotName) {
    StartedRack rack(one_of_each);
    for (const std::string_view name : {"X", "mask", "line", "head", "red"}) {
        Part& part = part_named(rack, name);
        EXPECT_FALSE(part.can_have("motor.melt")) << name;
        EXPECT_FALSE(part.inject(rack.kernel(), "motor.melt", 1)) << name;
    }
    EXPECT_FALSE(part_named(rack, "X").inject(rack.kernel(), "motor.load", 1)) << "a stepping motor has no such fault";
}

}  // namespace
}  // namespace motionrack::rack
