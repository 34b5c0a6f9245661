// The declaration checks refuse every flaw with a sentence; the maps' static_asserts use the same functions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/base/card_map.hpp>
#include <motionrack/base/describe.hpp>
#include <nlohmann/json.hpp>

namespace motionrack {
namespace {

using ::testing::HasSubstr;

constexpr FieldInfo good_fields[] = {{"LOW", 0x00FF, "low half"}, {"HIGH", 0xFF00, "high half"}};

constexpr RegisterInfo reg(std::string_view name, std::uint32_t offset, Access access,
                           std::span<const FieldInfo> fields = {}, std::string_view bank = "") {
    return {name, offset, 16, access, false, bank, "a register", fields};
}

// The compiler message for a register with these fields.
std::string with_fields(std::initializer_list<FieldInfo> list) {
    const std::vector<FieldInfo> fields(list);
    return std::string(fields_flaw(reg("R", 0, Access::read, fields)).text());
}

TEST(RegisterTables, RefuseFieldsThatCollideOrLieOutside) {
    EXPECT_TRUE(fields_flaw(reg("R", 0, Access::read, good_fields)).empty());
    EXPECT_EQ(with_fields({{"A", 0x0003, "a"}, {"B", 0x0002, "b"}}), "R: the fields A and B share a bit");
    EXPECT_EQ(with_fields({{"A", 0x10000, "a"}}), "R: the field A has bits outside the register's width");
    EXPECT_EQ(with_fields({{"A", 0x0005, "a"}}), "R: the bits of the field A are not neighbours");
    EXPECT_EQ(with_fields({{"A", 0, "a"}}), "R: the field A has no bits");
    EXPECT_EQ(with_fields({{"A", 1, "a"}, {"A", 2, "b"}}), "R: two of the fields are called A");
    EXPECT_EQ(with_fields({{"A", 1, ""}}), "R: the field A has no meaning");
    EXPECT_EQ(with_fields({{"", 1, "a"}}), "R: a field has no name");
}

TEST(RegisterTables, AllowAFieldAsWideAs32Bits) {
    constexpr FieldInfo all[] = {{"ALL", 0xFFFFFFFF, "everything"}};
    EXPECT_TRUE(fields_flaw({"R", 0, 32, Access::read, false, "", "a register", all}).empty());
    EXPECT_EQ(fields_flaw({"R", 0, 33, Access::read, false, "", "a register", {}}).text(),
              "R: the width must be 1 to 32 bits");
}

TEST(RegisterTables, AllowOneOffsetOncePerDirectionAndBank) {
    const RegisterInfo both[] = {reg("W", 2, Access::write), reg("R", 2, Access::read_clears)};
    const RegisterInfo twice[] = {reg("W", 2, Access::write), reg("V", 2, Access::write)};
    const RegisterInfo read_twice[] = {reg("W", 2, Access::read), reg("V", 2, Access::read_clears)};
    const RegisterInfo banked[] = {reg("W", 2, Access::write), reg("V", 2, Access::write, {}, "other")};
    const RegisterInfo same_name[] = {reg("W", 2, Access::write), reg("W", 4, Access::write)};
    EXPECT_TRUE(registers_flaw(both).empty());
    EXPECT_TRUE(registers_flaw(banked).empty());
    EXPECT_EQ(registers_flaw(twice).text(), "the registers W and V are at one offset in one direction and bank");
    EXPECT_EQ(registers_flaw(read_twice).text(), "the registers W and V are at one offset in one direction and bank");
    EXPECT_EQ(registers_flaw(same_name).text(), "the registers: two of the registers are called W");
}

TEST(Fields, GetAndSetTheirBitsAndNoOthers) {
    constexpr Field high{0xFF00};
    static_assert(high.get(0x1234) == 0x12);
    static_assert(high.set(0x1234, 0xAB) == 0xAB34);
    static_assert(high.set(0x1234, 0x1FF) == 0xFF34, "what does not fit is cut");
    static_assert(high.test(0x0100) && !high.test(0x00FF));
    static_assert(Field{mask_of(reg("R", 0, Access::read, good_fields), "LOW")}.get(0x1234) == 0x34);
}

std::string with_commands(std::initializer_list<CommandInfo> list) {
    const std::vector<CommandInfo> commands(list);
    return std::string(commands_flaw(commands).text());
}

TEST(CommandTables, RefuseACodeOrANameTwice) {
    EXPECT_EQ(with_commands({{"A", 1, 0, 0, 0, "", "", "a"}, {"B", 1, 0, 0, 0, "", "", "b"}}),
              "the commands A and B have one code");
    EXPECT_EQ(with_commands({{"A", 1, 0, 0, 0, "", "", "a"}, {"A", 2, 0, 0, 0, "", "", "b"}}),
              "the commands: two of the commands are called A");
}

TEST(CommandTables, RefuseRangesThatCannotBe) {
    EXPECT_EQ(with_commands({{"A", 1, 2, 5, 4, "", "", "a"}}), "the range of the command A is upside down");
    EXPECT_EQ(with_commands({{"A", 1, 2, 0, 65'536, "", "", "a"}}),
              "the range of the command A does not fit its bytes of data");
    EXPECT_EQ(with_commands({{"A", 1, 2, -32'769, 0, "", "", "a"}}),
              "the range of the command A does not fit its bytes of data");
    EXPECT_EQ(with_commands({{"A", 1, 0, 0, 1, "", "", "a"}}),
              "the range of the command A does not fit its bytes of data");
    EXPECT_EQ(with_commands({{"A", 1, 5, 0, 1, "", "", "a"}}), "the command A has a table of data, which has no range");
    EXPECT_EQ(with_commands({{"A", 1, 240, 0, 0, "", "", "a"}}), "");
    EXPECT_EQ(with_commands({{"A", 1, 1025, 0, 0, "", "", "a"}}),
              "the command A does not have 0 to 1024 bytes of data or answer");
    EXPECT_EQ(with_commands({{"A", 1, 0, 0, 0, "", "", "a", true, -1}}),
              "the command A does not have 0 to 1024 bytes of data or answer");
    EXPECT_EQ(with_commands({{"A", 1, 4, -2'147'483'648LL, 4'294'967'295LL, "", "", "a"}}), "");
}

std::string machine(std::initializer_list<StateInfo> state_list,
                    std::initializer_list<TransitionInfo> transition_list) {
    const std::vector<StateInfo> states(state_list);
    const std::vector<TransitionInfo> transitions(transition_list);
    return std::string(machine_flaw({"m", "a machine", states, transitions}).text());
}

TEST(StateTables, RefuseStatesThatCannotBeReachedOrLeft) {
    const StateInfo a{"a", "first"}, b{"b", "second"}, b_final{"b", "second", true};
    EXPECT_EQ(machine({a, b}, {{"a", "b", "go"}, {"b", "a", "back"}}), "");
    EXPECT_EQ(machine({a, b_final}, {{"a", "b", "go"}}), "");
    EXPECT_EQ(machine({a, b}, {{"a", "b", "go"}}), "m: the state b has no exit and is not final");
    EXPECT_EQ(machine({a, b}, {{"a", "b", "go"}, {"b", "b", "stay"}}), "m: the state b has no exit and is not final");
    EXPECT_EQ(machine({{"a", "first", true}, b}, {{"b", "a", "back"}}), "m: the state b is never reached");
    EXPECT_EQ(machine({a, b}, {{"a", "c", "go"}}), "m: a transition goes to c, which is not a state");
    EXPECT_EQ(machine({a, b}, {{"c", "a", "go"}}), "m: a transition comes from c, which is not a state");
    EXPECT_EQ(machine({a, b}, {{"a", "b", ""}}), "m: the transition from a to b does not say when");
    EXPECT_EQ(machine({}, {}), "m: there are not 1 to 64 states");
}

TEST(StateTables, AcceptStatesReachedThroughAChainDeclaredInReverse) {
    EXPECT_EQ(machine({{"a", "1"}, {"b", "2"}, {"c", "3"}, {"d", "4", true}},
                      {{"c", "d", "x"}, {"b", "c", "x"}, {"a", "b", "x"}}),
              "");
}

TEST(Flaws, TruncateASentenceThatIsTooLong) {
    const std::string name(500, 'x');
    EXPECT_EQ(DeclarationError({name, " is long"}).text(), std::string(159, 'x'));
}

// A small card with every kind of declaration and awkward characters.
struct Sample {
    RegisterInfo registers[2] = {reg("R", 0, Access::read, good_fields), reg("W", 2, Access::write)};
    CommandInfo commands[3] = {{"SET", 6, 4, -8'388'608, 268'435'455, "a|b", "", "sets"},
                               {"GO", 7, 0, 0, 0, "", "As", "goes", false},
                               {"BOTH", 8, 2, 0, 9, "", "", "sets or tells", true, 3}};
    StateInfo states[1] = {{"rest", "says \"no\"\n\\", true}};
    MachineInfo machines[1] = {{"m", "a machine", states, {}}};
    PinInfo pins[1] = {{"*pp", PinDirection::output, true, "pulses"}};
    CardMap map = {"card", "A card", registers, commands, machines, pins};
};

TEST(Descriptions, AsJsonAreReadBackWhole) {
    const Sample sample;
    const auto json = nlohmann::json::parse(describe_json(sample.map));
    EXPECT_EQ(json["name"], "card");
    ASSERT_EQ(json["registers"].size(), 2u);
    EXPECT_EQ(json["registers"][0]["fields"][1]["name"], "HIGH");
    EXPECT_EQ(json["registers"][0]["fields"][1]["mask"], 0xFF00);
    EXPECT_TRUE(json["registers"][1]["fields"].empty());
    EXPECT_EQ(json["commands"][0]["min"], -8'388'608);
    EXPECT_EQ(json["commands"][1]["reproduced"], false);
    EXPECT_EQ(json["machines"][0]["states"][0]["meaning"], "says \"no\"\n\\");
    EXPECT_EQ(json["pins"][0]["active_low"], true);
}

TEST(Descriptions, AsMarkdownGroupDigitsAndKeepTheirTablesWhole) {
    const Sample sample;
    const std::string page = describe_markdown(sample.map);
    EXPECT_THAT(page, HasSubstr("| D15-D8 | HIGH | high half |\n"));
    EXPECT_THAT(page, HasSubstr("| 06h | SET | 4 bytes | -8,388,608 .. 268,435,455 | a\\|b | sets |\n"));
    EXPECT_THAT(page, HasSubstr("| 07h | GO | - |  |  | goes (As only) (not reproduced) |\n"));
    EXPECT_THAT(page, HasSubstr("| 08h | BOTH | 2 bytes, or 3 back | 0 .. 9 |  | sets or tells |\n"));
    EXPECT_THAT(page, HasSubstr("| \\*pp | output | low | pulses |\n"));
}

TEST(Descriptions, AsTextHaveEveryRegisterCommandStateAndPin) {
    const Sample sample;
    const std::string text = describe_text(sample.map);
    for (const char* word : {"HIGH", "SET", "goes (As only) (not reproduced)", "rest", "*pp", "active low"})
        EXPECT_THAT(text, HasSubstr(word));
}

}  // namespace
}  // namespace motionrack
