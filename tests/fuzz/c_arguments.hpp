// Arguments of the fuzz target of the C interface: a rack, names, programs, numbers.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace motionrack::fuzz {

inline constexpr const char* rack_text = R"([card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
[axis.X.switches]
limit_plus_mm = 301
home_mm = 1
[axis.B]
card = "c1"
channel = "y"
[card.p]
type = "databoard4002"
[card.i]
type = "ioflex02"
[card.s]
type = "rtc5"
list_memory = 2000
[belt.line]
card = "s"
velocity_mm_s = 1
counts_per_mm = 100
[scanner.head]
card = "s"
)";

inline constexpr std::array names = {"c1.xlmtp",
                                     "c1.xlmtm",
                                     "c1.xeca",
                                     "c1.xecb",
                                     "c1.yeca",
                                     "c1.yecb",
                                     "c1.xin0",
                                     "c1.emgn",
                                     "c1.xalarm",
                                     "estop",
                                     "X.limit_plus",
                                     "X.home",
                                     "X.enc_z",
                                     "B.enc_z",
                                     "X.step",
                                     "c1.xpp",
                                     "c1.int_n",
                                     "X.position_mm",
                                     "B.position_deg",
                                     "X.position_pulses",
                                     "X.in_step",
                                     "RR0",
                                     "x.RR1",
                                     "u.LP",
                                     "x.WR2",
                                     "y.P",
                                     "X",
                                     "B",
                                     "line",
                                     "head",
                                     "line.speed_mm_s",
                                     "line.parts",
                                     "head.spot_x_mm",
                                     "head.marked_mm",
                                     "s.xout",
                                     "s.mcbsp",
                                     "s.start_n",
                                     "p.esl",
                                     "p.vout",
                                     "i.in0",
                                     "motor.stall",
                                     "motor.stall=0",
                                     "motor.push=99",
                                     "motor.lose_steps=3",
                                     "encoder.broken_a",
                                     "encoder.swapped=1",
                                     "limit_plus.stuck_closed",
                                     "home.stuck_open=0",
                                     "drive.speed=5",
                                     "sender.silent",
                                     "encoder.jitter=1e-6",
                                     "motor.load=nan"};
inline constexpr std::uint64_t max_ns = 1'000'000'000'000'001;  ///< mr_advance_ns refuses values from here on
inline constexpr std::array cards = {"c1", "p", "i", "s", "c2", ""};
inline constexpr std::array patterns = {"",     "*",           "X.* c1.xlmtp", "c1.xpp,c1.xlp", "Q.*", "line.* head.*",
                                        "????", "c1.*\n\t,s.*"};
inline constexpr std::array programs = {"G21 G90\nG1 X1 F6000\n", "G1 X0.5 B3 F600\nM2\n", "G2 X1 I0.5 F600\n",
                                        "#1=3\nG1 X[#1]\n",       "no/such.ngc",           "",
                                        "G1 X-5 F1\n\n(",         "o<side> call\n"};
inline constexpr std::array homed = {"X", "x, X", "B", "Q", "", "XB"};
inline constexpr std::array<double, 12> numbers = {0,
                                                   1,
                                                   0.5,
                                                   -1,
                                                   17.25,
                                                   1e6,
                                                   1e300,
                                                   -1e-300,
                                                   std::numeric_limits<double>::quiet_NaN(),
                                                   std::numeric_limits<double>::infinity(),
                                                   -std::numeric_limits<double>::infinity(),
                                                   2};

}  // namespace motionrack::fuzz
