// Manual accesses to the cards' buses.
#include <gmock/gmock.h>

#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/operate/test/operated.hpp>

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

TEST(ByHand, ACardThatOnlyMeasuresIsAccessedWhileAxesMoveAndNoOther) {
    Operated o(two_axes("[card.glass]\ntype = \"ioflex02\"\nbase_address = 0x2300\npreloaded = true\n"));
    int answered = 0;
    std::string refused;
    const auto read = [&](Machine& m, const char* card, std::uint32_t address) {
        return m.access({card, 16, address, {}}, [&](std::uint32_t) { ++answered; });
    };
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.line("G91 G1 X20 F600", 1)); });
    o.at(0.5, [&](Machine& m) {
        EXPECT_TRUE(read(m, "glass", 0x2300 + ioflex02::offset("STATUS")));
        const Result<void> other = read(m, "m", 0);
        refused = other ? "" : other.error().message;
    });
    o.at(0.6, [&](Machine&) { EXPECT_EQ(answered, 1); });
    o.run(4);
    EXPECT_THAT(refused, HasSubstr("The card was not accessed: the machine is in state"));
    EXPECT_NEAR(o.x(), 30, 1e-9) << "the motion went on";
}

}  // namespace
}  // namespace motionrack::operate
