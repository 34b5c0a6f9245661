// Tests of the card's map: constants follow from the tables, and the virtual chip and the reference page match the map.
#include <gtest/gtest.h>

#include <fstream>
#include <motionrack/base/describe.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <set>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::mcx314 {
namespace {

TEST(Mcx314Map, ConstantsAreThoseOfTheDocumentedMap) {
    EXPECT_EQ(reg::WR5, 0x0Au);
    EXPECT_EQ(reg::RR7, 0x0Eu);
    EXPECT_EQ(cmd::LINE3, 0x31u);
    EXPECT_EQ(cmd::READ_CV, 0x12u);
    EXPECT_TRUE(field("RR0", "CNEXT").test(0x0200));
    EXPECT_EQ(field("RR0", "ZONE").get(0x1400), 5u);
    EXPECT_EQ(field("WR2", "PIND").set(0xF3FF, 2), 0xFBFF);
    EXPECT_EQ(field("WR5", "AX3").get(0x0024), 2u) << "0024h is X, Y, Z";
}

TEST(Mcx314Map, HasEveryDocumentedCode) {
    std::set<std::uint32_t> codes, documented = {0x60, 0x61, 0x62, 0x63, 0x64, 0x65};
    for (const auto& [first, last] : {std::pair{0x00, 0x14}, std::pair{0x20, 0x27}, std::pair{0x30, 0x3D}})
        for (int code = first; code <= last; ++code) documented.insert(static_cast<std::uint32_t>(code));
    for (const CommandInfo& command : card_map().commands) codes.insert(command.code);
    EXPECT_EQ(codes, documented);
}

TEST(Mcx314Map, DeclaresTheHomingStatesThatHmstShows) {
    for (const MachineInfo& machine : card_map().machines) {
        if (machine.name != "home search") continue;
        ASSERT_EQ(machine.states.size(), std::size(map::home_drives) + 1);
        for (std::size_t i = 0; i < machine.states.size(); ++i) {
            const int hmst = i == 0 ? 0 : map::home_drives[i - 1].hmst;
            EXPECT_EQ(machine.states[i].meaning.find("HMST " + std::to_string(hmst) + ":"), 0u)
                << machine.states[i].name;
        }
        return;
    }
    FAIL() << "the map has no home search";
}

// Returns true if a new chip accepts a command code; false if it reports the code as unknown.
bool chip_knows(std::uint32_t code, Variant variant) {
    sim::Kernel kernel;
    Chip chip(kernel, "c", {variant});
    kernel.start();
    chip.write(reg::WR0, static_cast<std::uint16_t>(0x0100u | code));
    for (const sim::Condition& condition : kernel.conditions())
        if (condition.code == unknown_command) return false;
    return true;
}

TEST(Mcx314Map, TheChipExecutesTheReproducedCommandsAndNoOthers) {
    std::set<std::uint32_t> original, extended;
    for (const CommandInfo& command : card_map().commands) {
        if (!command.reproduced) continue;
        extended.insert(command.code);
        if (command.variant.empty()) original.insert(command.code);
    }
    EXPECT_GT(extended.size(), original.size());
    for (std::uint32_t code = 0; code < 256; ++code) {
        EXPECT_EQ(chip_knows(code, Variant::mcx314), original.count(code) == 1) << "code " << code;
        EXPECT_EQ(chip_knows(code, Variant::mcx314as), extended.count(code) == 1) << "code " << code;
    }
}

TEST(Mcx314Map, TheChipHasThePinsOfTheMapAndActiveLowOnesAreHighAtReset) {
    sim::Kernel kernel;
    Chip chip(kernel, "c");
    kernel.start();
    std::set<std::string> wires, pins;
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) wires.insert(kernel.wire_name(static_cast<sim::WireId>(i)));
    for (const PinInfo& pin : card_map().pins)
        for (const char axis : std::string(pin.name[0] == '*' ? "xyzu" : "-")) {
            std::string name = "c." + std::string(pin.name);
            if (axis != '-') name[2] = axis;
            pins.insert(name);
            const sim::WireId wire = kernel.find_wire(name);
            ASSERT_NE(wire, sim::WireId::none) << name;
            if (pin.active_low) {
                EXPECT_EQ(kernel.level(wire), 1) << name;
            }
        }
    EXPECT_EQ(wires, pins);
}

TEST(Mcx314Map, ReadingClearsTheRegistersDeclaredSoAndNoOthers) {
    for (const RegisterInfo& each : card_map().registers) {
        if (each.access == Access::write) continue;
        sim::Kernel kernel;
        Chip chip(kernel, "c");
        kernel.start();
        chip.write(reg::WR0, static_cast<std::uint16_t>(0x0100u | cmd::NOP));
        chip.write(reg::WR1, 0xFF00);  // every interrupt
        chip.write(reg::WR7, 0xFFFF);  // makes a comparison value lower than the counter
        chip.write(reg::WR6, 0xFFF0);
        chip.write(reg::WR0, static_cast<std::uint16_t>(0x0100u | cmd::LP));
        chip.write(reg::WR0, static_cast<std::uint16_t>(0x0100u | cmd::READ_LP));
        const std::uint16_t seen = chip.peek(each.offset);
        EXPECT_EQ(chip.read(each.offset), seen) << each.name;
        EXPECT_EQ(chip.peek(each.offset), each.access == Access::read_clears ? 0 : seen) << each.name;
        if (each.access == Access::read_clears) {
            EXPECT_NE(seen, 0) << each.name;
        }
    }
}

TEST(Mcx314Map, TheReferencePageIsCurrent) {
    std::ifstream file(source_dir() + "/docs/reference/mcx314.md");
    std::stringstream stored;
    stored << file.rdbuf();
    EXPECT_EQ(stored.str(), describe_markdown(card_map()))
        << "make it anew: motionrack describe mcx314 --markdown > docs/reference/mcx314.md";
}

}  // namespace
}  // namespace motionrack::mcx314
