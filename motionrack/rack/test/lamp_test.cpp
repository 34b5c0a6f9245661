// Signal lamps of a rack: section, wire, quantity, fault.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>

namespace motionrack::rack {
namespace {

using testing::HasSubstr;

/// A rack with two lamps: one is lit while the emergency stop is released, the other has no wire.
const char* const two_lamps = R"(
[card.m]
type = "mcx314"
[axis.X]
card = "m"
channel = "x"
[lamp.ready]
[lamp.spare]
active_low = true
[wires]
"ready.in" = "estop"
)";

TEST(Lamps, ShineWhileWhatDrivesThemSaysSo) {
    StartedRack rack(two_lamps);
    EXPECT_EQ(*get_quantity(rack, "ready.lit"), 1);
    WireAccess wires(rack);
    ASSERT_TRUE(wires.force("estop", 0));
    EXPECT_EQ(*get_quantity(rack, "ready.lit"), 0);
    EXPECT_EQ(*wires.get("ready.in"), 0);
}

TEST(Lamps, AreLowWithoutAWireAndCanBeDrivenByHand) {
    StartedRack rack(two_lamps);
    EXPECT_EQ(*get_quantity(rack, "spare.lit"), 1) << "its input is low, which it shines at";
    WireAccess wires(rack);
    ASSERT_TRUE(wires.force("spare.in", 1));
    EXPECT_EQ(*get_quantity(rack, "spare.lit"), 0);
}

TEST(Lamps, StayDarkWhenTheyBurnOut) {
    StartedRack rack(two_lamps);
    ASSERT_TRUE(inject_fault(rack, "burnt_out", "ready"));
    EXPECT_EQ(*get_quantity(rack, "ready.lit"), 0);
    EXPECT_EQ(*get_quantity(rack, "spare.lit"), 1) << "the other one is whole";
    ASSERT_TRUE(inject_fault(rack, "burnt_out=0", "ready"));
    EXPECT_EQ(*get_quantity(rack, "ready.lit"), 1);
    const auto refused = inject_fault(rack, "burnt_out=2", "ready");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::refused);
    EXPECT_FALSE(set_quantity(rack, "ready.lit", 1)) << "a lamp is no switch";
}

TEST(Lamps, AreInputsInTheWires) {
    const RackConfig config = good(two_lamps);
    ASSERT_EQ(config.lamps.size(), 2U);
    EXPECT_EQ(config.end_name({EndOwner::lamp, 1, "in"}), "spare.in");
    const std::string head = two_lamps;
    const std::string both = all_texts(read_rack_text(head + "\"spare.in\" = \"ready.in\"\n").errors);
    EXPECT_THAT(both, HasSubstr("spare.in and ready.in are both inputs; name the output that drives spare.in."));
    const std::string driver = all_texts(read_rack_text(head + "\"m.xin0\" = \"ready.in\"\n").errors);
    EXPECT_THAT(driver, HasSubstr("m.xin0 and ready.in are both inputs"));
}

TEST(Lamps, HaveANameOfTheirOwn) {
    const std::string card = "[card.m]\ntype = \"mcx314\"\n";
    for (const char* name : {"m", "estop", "L", "9lives"})
        EXPECT_THAT(all_texts(read_rack_text(fmt::format("{}[lamp.{}]\n", card, name)).errors),
                    HasSubstr(fmt::format("'{}' cannot be a lamp's name", name)));
    EXPECT_THAT(all_texts(read_rack_text(card + "[belt.line]\n[lamp.line]\n").errors),
                HasSubstr("'line' cannot be a lamp's name"));
    EXPECT_THAT(all_texts(read_rack_text(card + "[lamp]\nred = 1\n").errors),
                HasSubstr("lamp.red is a whole number, but must be a table"));
}

}  // namespace
}  // namespace motionrack::rack
