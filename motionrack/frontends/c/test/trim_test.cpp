// Trim table (voltage and rate) of a DataBoard 4002 in a rack over the C interface.
#include <gmock/gmock.h>

#include <motionrack/frontends/c/test/world.hpp>

namespace motionrack::c_test {
namespace {

using testing::HasSubstr;

/// Writes to a port of card 13, then waits for Ready.
void out(World& world, std::uint32_t port, unsigned value) {
    EXPECT_EQ(mr_write8(world, "c1", port, static_cast<std::uint8_t>(value)), MR_OK) << mr_last_error();
    world.pass(200'000);
}

TEST(CTrim, ConvertsARateToItsVoltage) {
    World world("[card.c1]\ntype = \"databoard4002\"\ntrim = \"0.5 15000, 10 16383\"\n");
    out(world, 1, 13);
    out(world, 3, 'R');
    out(world, 0, 15'000 & 0xFF);
    out(world, 0, 15'000 >> 8);
    out(world, 3, 'N');
    for (const unsigned byte : {0x00u, 0x00u, 0x10u}) out(world, 0, byte);
    out(world, 3, 'G');
    EXPECT_EQ(world.wire("c1.vout"), 0.5);
    EXPECT_EQ(world.wire("c1.vdirect"), 0.5);
}

TEST(CTrim, ADecreasingTableIsRejectedWithItsRow) {
    mr_rack* rack = nullptr;
    EXPECT_EQ(mr_rack_open("[card.c1]\ntype = \"databoard4002\"\ntrim = \"0.5 15000, 0.4 16383\"\n", &rack),
              MR_BAD_INPUT);
    EXPECT_THAT(mr_last_error(), HasSubstr("Row 2 of the trim table"));
    EXPECT_EQ(rack, nullptr);
}

}  // namespace
}  // namespace motionrack::c_test
