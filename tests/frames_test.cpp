// The page about frames: every command on it prints the output shown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tests/ran.hpp>

namespace motionrack {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FramesPage : public InFolder {};

TEST_F(FramesPage, ShowsTheOutputOfItsCommands) {
    std::map<std::string, int> codes = run_page("docs/howto/grating_bus/frames.md");
    ASSERT_GE(codes.size(), 4u);
    EXPECT_EQ(codes["frames examples/grating_bus/crate.toml --duration 0.05 --picture frame.svg"], 0);
    EXPECT_EQ(text_of(folder / "frame.svg"), text_of(source_root / "docs/pictures/grating_frame.svg"))
        << "make it anew: motionrack frames examples/grating_bus/crate.toml --duration 0.05 --picture "
           "docs/pictures/grating_frame.svg";
    EXPECT_EQ(text_of(folder / "three.svg"), text_of(source_root / "docs/pictures/grating_three_hosts.svg"))
        << "make it anew: motionrack frames examples/grating_bus/three_hosts.toml --duration 0.05 --picture "
           "docs/pictures/grating_three_hosts.svg";
}

TEST_F(FramesPage, HostAndSlavesAgreeAndThreeHostsDoNot) {
    const Ran crate = motionrack("frames examples/grating_bus/crate.toml --duration 0.05 --json");
    EXPECT_EQ(crate.code, 0);
    EXPECT_THAT(crate.out, HasSubstr("\"conflicts\":0,\"agree\":true"));
    const Ran three = motionrack("frames examples/grating_bus/three_hosts.toml --duration 0.05 --json");
    EXPECT_EQ(three.code, 4);
    EXPECT_THAT(three.out, HasSubstr("\"agree\":false"));
}

TEST_F(FramesPage, WavesHaveStatesAndLinesOfEveryBit) {
    ASSERT_EQ(motionrack("frames examples/grating_bus/crate.toml --duration 0.001 -q --vcd f.vcd").code, 0);
    const std::string vcd = text_of(folder / "f.vcd");
    for (const char* signal : {"wire 1 ", "bus_clk", "bus_hold", "bus_read_n", "bus_addr0", "bus_data31", "real 64 ",
                               "c1_state", "bus_data", "\nr12 "})
        EXPECT_THAT(vcd, HasSubstr(signal));
}

TEST_F(FramesPage, PositionsBelowZeroAreNegativeInJsonAndInWaves) {
    const std::string scale = "scale = { pitch_um = 4, interpolation = 4 }\n";
    write("below_zero.toml",
          "[card.dec]\ntype = \"grating_decoder\"\nscales = 2\n[card.c1]\ntype = \"grating_bus\"\nscales = 2\n"
          "[stage.S0]\ncard = \"c1\"\ninput = 0\noutput = 0\nstart_mm = -0.0005\n" +
              scale + "[stage.S1]\ncard = \"c1\"\ninput = 1\noutput = 1\nstart_mm = -32.9425\n" + scale);
    const Ran ran = motionrack("frames below_zero.toml --duration 0.001 --json --vcd f.vcd");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("\"counts\":[-1,-32943]"));
    EXPECT_THAT(text_of(folder / "f.vcd"), AllOf(HasSubstr("\nr-1 "), HasSubstr("\nr-32943 ")));
}

TEST_F(FramesPage, WrongOptionsAndRacksAreRefused) {
    EXPECT_THAT(motionrack("frames examples/racks/carriage.toml").out, HasSubstr("grating_bus"));
    const Ran negative = motionrack("frames examples/grating_bus/crate.toml --duration -1");
    EXPECT_NE(negative.code, 0);
    EXPECT_THAT(negative.out, HasSubstr("--duration is -1 s"));
    EXPECT_THAT(motionrack("frames examples/grating_bus/crate.toml --fault bus.nix=1@0.1s").out, HasSubstr("bus.nix"));
    const Ran refused = motionrack("frames examples/grating_bus/crate.toml --duration 0.02 --fault c2.late=-5@0.01s");
    EXPECT_EQ(refused.code, 0) << "the run goes on without it";
    EXPECT_THAT(refused.out,
                HasSubstr("the fault c2.late=-5@0.01s was refused: c2 cannot have the fault late with the value -5"));
}

}  // namespace
}  // namespace motionrack
