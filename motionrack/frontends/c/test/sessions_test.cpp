// Checks that the invariants of sessions (tests/invariants/c_sessions.cpp) are checked in all tests of this module.
#include <motionrack/frontends/c/test/world.hpp>
#include <tests/invariants/c_sessions.hpp>

namespace motionrack::c_test {
namespace {

TEST(CSessions, AreUnderTheLawsAndSoAreTheirCopies) {
    const int before = test::sessions_under_laws();
    World world(homing_rack);
    run(world, "G21 G90\nG1 X15 F1200\nM2\n");
    EXPECT_EQ(test::sessions_under_laws(), before + 1);
    const World copy(world.rack);
    EXPECT_EQ(test::sessions_under_laws(), before + 2);
}

}  // namespace
}  // namespace motionrack::c_test
