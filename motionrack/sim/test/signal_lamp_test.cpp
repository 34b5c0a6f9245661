// A signal lamp: its input, its fault and its state in a snapshot.
#include <gtest/gtest.h>

#include <motionrack/sim/parts/signal_lamp.hpp>

namespace motionrack::parts {
namespace {

TEST(SignalLamp, ShinesWhileItsInputIsHigh) {
    sim::Kernel kernel;
    const SignalLamp lamp(kernel, "red", false);
    kernel.start();
    EXPECT_FALSE(lamp.lit());
    kernel.force(kernel.find_wire("red.in"), 1);
    EXPECT_TRUE(lamp.lit());
    kernel.release(kernel.find_wire("red.in"));
    EXPECT_FALSE(lamp.lit());
}

TEST(SignalLamp, ActiveLowShinesWhileItsInputIsLow) {
    sim::Kernel kernel;
    const SignalLamp lamp(kernel, "red", true);
    kernel.start();
    EXPECT_TRUE(lamp.lit());
    kernel.force(kernel.find_wire("red.in"), 1);
    EXPECT_FALSE(lamp.lit());
}

TEST(SignalLamp, StaysDarkWhileItIsBurntOut) {
    sim::Kernel kernel;
    SignalLamp lamp(kernel, "red", true);
    kernel.start();
    EXPECT_TRUE(lamp.fault("burnt_out", 1, kernel.now()));
    EXPECT_FALSE(lamp.lit());
    EXPECT_TRUE(lamp.fault("burnt_out", 0, kernel.now()));
    EXPECT_TRUE(lamp.lit());
    EXPECT_FALSE(lamp.fault("burnt_out", 0.5, kernel.now()));
    EXPECT_FALSE(lamp.fault("broken", 1, kernel.now()));
    EXPECT_TRUE(lamp.lit()) << "what it does not know changes nothing";
}

TEST(SignalLamp, IsAsASnapshotHasIt) {
    sim::Kernel kernel;
    SignalLamp lamp(kernel, "red", true);
    kernel.start();
    const sim::Snapshot whole = kernel.snapshot();
    EXPECT_TRUE(lamp.fault("burnt_out", 1, kernel.now()));
    const sim::Snapshot dark = kernel.snapshot();
    kernel.restore(whole);
    EXPECT_TRUE(lamp.lit());
    kernel.restore(dark);
    EXPECT_FALSE(lamp.lit());
}

}  // namespace
}  // namespace motionrack::parts
