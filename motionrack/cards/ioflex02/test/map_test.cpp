// The map matches the card, and the page generated from it is current.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <motionrack/base/describe.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::ioflex02 {
namespace {

TEST(Ioflex02Map, TheCardHasTheDeclaredRegistersAndNoOthers) {
    for (std::uint32_t at = 0; at < window; ++at)
        for (const bool write : {false, true}) {
            bool declared = false;
            for (const RegisterInfo& reg : card_map().registers)
                declared = declared || (reg.offset == at && (reg.access == Access::write) == write);
            Rig rig;
            rig.start();
            if (write)
                rig.write(at, 0);
            else
                rig.read(at);
            const bool reported = !rig.conditions().empty();
            EXPECT_EQ(reported, !declared) << at << (write ? " written" : " read");
        }
}

TEST(Ioflex02Map, EveryDeclaredReadRegisterAnswersWithItsDeclaredBitsOnly) {
    Rig rig;
    rig.start();
    for (int axis = 0; axis < 4; ++axis) rig.turn(axis, -5);
    rig.capture();
    for (const RegisterInfo& reg : card_map().registers) {
        if (reg.access == Access::write) continue;
        unsigned bits = reg.fields.empty() ? 0xFFFF : 0;
        for (const FieldInfo& info : reg.fields) bits |= info.mask;
        EXPECT_EQ(rig.read(reg.offset) & ~bits, 0u) << reg.name;
    }
}

TEST(Ioflex02Map, TheCardHasThePinsOfTheMap) {
    Rig rig;
    for (const PinInfo& pin : card_map().pins)
        EXPECT_NE(rig.kernel.find_wire("c1." + std::string(pin.name)), sim::WireId::none) << pin.name;
    const auto names = std::count_if(card_map().pins.begin(), card_map().pins.end(),
                                     [](const PinInfo& pin) { return !pin.same_as.empty(); });
    EXPECT_EQ(names, 16) << "the inputs by their bit are those of the encoders";
    EXPECT_EQ(rig.kernel.wire_count() + 16, card_map().pins.size() + 1);  // and the bus' interrupt line
}

TEST(Ioflex02Map, TheStateTableIsTheDeclaredMachine) {
    const DeclarationError flaw = transitions_flaw(card_map().machines[1], [](std::size_t from, std::size_t to) {
        bool steps = false;
        for (int event = 0; event < 6; ++event)
            steps = steps || calibration_step(static_cast<CalState>(from), static_cast<CalEvent>(event)).next ==
                                 static_cast<CalState>(to);
        return steps;
    });
    EXPECT_EQ(flaw.text(), "");
}

TEST(Ioflex02Map, TheReferencePageIsCurrent) {
    std::ifstream file(source_dir() + "/docs/reference/ioflex02.md");
    std::stringstream stored;
    stored << file.rdbuf();
    EXPECT_EQ(stored.str(), describe_markdown(card_map()))
        << "make it anew: motionrack describe ioflex02 --markdown > docs/reference/ioflex02.md";
}

}  // namespace
}  // namespace motionrack::ioflex02
