// The map matches the card, the rules of the modes are those of its drawing, and the page made from it is current.
#include <gtest/gtest.h>

#include <motionrack/base/describe.hpp>
#include <motionrack/cards/io8255/test/rig.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::io8255 {
namespace {

TEST(Io8255Map, TheCardHasTheDeclaredRegistersAndNoOthers) {
    for (unsigned at = 0; at < 256; ++at)
        for (const bool write : {false, true}) {
            bool declared = false;
            for (const RegisterInfo& reg : card_map().registers)
                declared = declared || (reg.offset == at && (reg.access == Access::write) == write);
            Rig rig;
            rig.start();
            if (write)
                rig.port.out(static_cast<std::uint8_t>(at), 0);
            else
                rig.port.in(static_cast<std::uint8_t>(at));
            EXPECT_EQ(rig.conditions().empty(), declared) << at << (write ? " written" : " read");
        }
}

TEST(Io8255Map, TheCardHasThePinsOfTheMap) {
    Rig rig;
    for (const PinInfo& pin : card_map().pins)
        EXPECT_NE(rig.kernel.find_wire("c1." + std::string(pin.name)), sim::WireId::none) << pin.name;
    EXPECT_EQ(rig.kernel.wire_count(), card_map().pins.size());
}

TEST(Io8255Map, AControlWordIsReadBackAsItsModes) {
    for (unsigned word = 0x80; word < 0x100; ++word)
        if (mode::A_MODE.get(word) < 2) {
            EXPECT_EQ(word_of(modes_of(word)), word);
        }
    EXPECT_EQ(word_of({}), 0x9B);
}

TEST(Io8255Map, EachLineOfPortCHasOneUseInEveryMode) {
    for (unsigned word = 0x80; word < 0xC0; ++word) {
        const PortCLines lines = port_c_lines(modes_of(word));
        EXPECT_EQ(lines.strobes & lines.flags, 0u) << word;
        EXPECT_EQ(lines.outputs & (lines.strobes | lines.flags), 0u) << word;
        EXPECT_EQ(lines.writable & ~lines.outputs, 0u) << word;
    }
}

TEST(Io8255Map, TheReferencePageIsCurrent) {
    EXPECT_EQ(text_of(source_root / "docs/reference/io8255.md"), describe_markdown(card_map()))
        << "make it anew: motionrack describe io8255 --markdown > docs/reference/io8255.md";
}

}  // namespace
}  // namespace motionrack::io8255
