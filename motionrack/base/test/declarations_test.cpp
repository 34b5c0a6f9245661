// The declaration languages refuse what is wrong; the same functions stand in the maps' static_asserts.
#include <gtest/gtest.h>

#include <motionrack/base/card_map.hpp>
#include <motionrack/base/describe.hpp>

namespace motionrack {
namespace {

constexpr FieldInfo good_fields[] = {{"LOW", 0x00FF, ""}, {"HIGH", 0xFF00, ""}};
constexpr FieldInfo overlapping[] = {{"A", 0x0003, ""}, {"B", 0x0002, ""}};
constexpr FieldInfo outside[] = {{"A", 0x10000, ""}};
constexpr FieldInfo same_name[] = {{"A", 0x0001, ""}, {"A", 0x0002, ""}};

TEST(RegisterTables, RefuseFieldsThatCollideOrLieOutside) {
    EXPECT_TRUE(fields_are_sound({"R", 0, 16, Access::read, false, "", "", good_fields}));
    EXPECT_FALSE(fields_are_sound({"R", 0, 16, Access::read, false, "", "", overlapping}));
    EXPECT_FALSE(fields_are_sound({"R", 0, 16, Access::read, false, "", "", outside}));
    EXPECT_FALSE(fields_are_sound({"R", 0, 16, Access::read, false, "", "", same_name}));
}

TEST(RegisterTables, AllowOneOffsetOncePerDirectionAndBank) {
    const RegisterInfo both[] = {{"W", 2, 16, Access::write, false, "", "", {}}, {"R", 2, 16, Access::read, false, "", "", {}}};
    const RegisterInfo twice[] = {{"W", 2, 16, Access::write, false, "", "", {}}, {"V", 2, 16, Access::write, false, "", "", {}}};
    const RegisterInfo banked[] = {{"W", 2, 16, Access::write, false, "", "", {}}, {"V", 2, 16, Access::write, false, "other", "", {}}};
    EXPECT_TRUE(registers_are_sound(both));
    EXPECT_FALSE(registers_are_sound(twice));
    EXPECT_TRUE(registers_are_sound(banked));
}

TEST(CommandTables, RefuseACodeOrANameTwice) {
    const CommandInfo code_twice[] = {{"A", 1, 0, 0, 0, "", "", ""}, {"B", 1, 0, 0, 0, "", "", ""}};
    const CommandInfo name_twice[] = {{"A", 1, 0, 0, 0, "", "", ""}, {"A", 2, 0, 0, 0, "", "", ""}};
    EXPECT_FALSE(commands_are_sound(code_twice));
    EXPECT_FALSE(commands_are_sound(name_twice));
}

TEST(StateTables, RefuseStatesThatCannotBeReachedOrLeft) {
    const StateInfo states[] = {{"a", ""}, {"b", ""}};
    const StateInfo states_final[] = {{"a", ""}, {"b", "", true}};
    const TransitionInfo there[] = {{"a", "b", ""}};
    const TransitionInfo there_and_back[] = {{"a", "b", ""}, {"b", "a", ""}};
    const TransitionInfo unknown[] = {{"a", "c", ""}};
    const TransitionInfo never[] = {{"b", "a", ""}};
    EXPECT_TRUE(machine_is_sound({"m", "", states, there_and_back}));
    EXPECT_TRUE(machine_is_sound({"m", "", states_final, there}));
    EXPECT_FALSE(machine_is_sound({"m", "", states, there})) << "b has no exit";
    EXPECT_FALSE(machine_is_sound({"m", "", states, never})) << "b is never reached";
    EXPECT_FALSE(machine_is_sound({"m", "", states, unknown}));
}

TEST(Descriptions, EscapeWhatJsonAsksFor) {
    const RegisterInfo registers[] = {{"R", 0, 16, Access::read, false, "", "says \"no\"\n", {}}};
    const std::string json = describe_json({"card", "title", registers, {}, {}, {}});
    EXPECT_NE(json.find(R"(says \"no\"\u000a)"), std::string::npos) << json;
}

}  // namespace
}  // namespace motionrack
