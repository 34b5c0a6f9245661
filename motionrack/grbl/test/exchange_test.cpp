// Protocol rules, each as bytes in and bytes out.
#include "bench.hpp"

namespace motionrack::grbl {
namespace {

const std::string exchange_banner = "\r\nGrbl 1.1h ['$' for help]\r\n",
                  exchange_unlock = "[MSG:'$H'|'$X' to unlock]\r\n";

const std::string startup_refused =
    "[MSG:Not stored: a startup line runs at each reset, and a reset starts no motion, spindle, coolant or output]\r\n"
    "error:20\r\n";

/// An exchange on a machine of three axes, in Idle at 0; each row starts with a new machine.
struct Exchange {
    const char* rule;
    std::string in;
    std::string out;
};

void PrintTo(const Exchange& row, std::ostream* out) {
    *out << row.rule;
}

const Exchange exchanges[] = {
    // lines
    {"an empty line", "\n", "ok\r\n"},
    {"each CR and each LF ends a line", "\r\n", "ok\r\nok\r\n"},
    {"comments and blanks are dropped", "( G1 X9 ) ; G1\n", "ok\r\n"},
    {"lower case, blanks, a slash", "/ g21 g9 0\n", "ok\r\n"},
    {"no percent sign", "%\n", "error:1\r\n"},
    {"79 characters fit, comments do not count", "G1F100X (a comment) " + std::string(71, '0') + "1\n", "ok\r\n"},
    {"80 do not, and nothing is run", "G1F100X" + std::string(72, '0') + "1\n?",
     "error:11\r\n<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n"},
    {"one answer a line", "G21\nG90\n\nG17\n", "ok\r\nok\r\nok\r\nok\r\n"},
    {"bytes above 7F are nothing",
     "G\xC3\xA9"
     "21\n",
     "ok\r\n"},
    {"real-time bytes inside a line",
     "G\x90"
     "2\x95"
     "1\n",
     "ok\r\n"},
    // errors by number
    {"1 no letter", "1X\n", "error:1\r\n"},
    {"2 no number", "GX\n", "error:2\r\n"},
    {"3 no such command", "$G1\n", "error:3\r\n"},
    {"2 a setting without a number", "$FOO\n", "error:2\r\n"},
    {"3 no such setting", "$99=1\n", "[MSG:Unknown setting $99]\r\nerror:3\r\n"},
    {"4 a negative setting", "$10=-1\n", "error:4\r\n"},
    {"4 a negative word", "G4 P-1\n", "error:4\r\n"},
    {"5 homing is off", "$H\n", "error:5\r\n"},
    {"6 too short a pulse", "$0=2\n", "error:6\r\n"},
    {"16 no jog", "$J=G2 X1 F100\n", "error:16\r\n"},
    {"16 a spindle word in a jog", "$J=M3 X1 F100\n", "error:16\r\n"},
    {"22 a jog without a feed", "$J=X1\n", "error:22\r\n"},
    {"22 a jog without a feed, though one is active", "G1 F100\n$J=X1\n", "ok\r\nerror:22\r\n"},
    {"15 a jog past the travel", "$J=X301 F100\n", "error:15\r\n"},
    {"36 S in a jog", "$J=X1 F100 S3\n", "error:36\r\n"},
    {"3 a jog without an equals sign", "$JX1F1\n", "error:3\r\n"},
    {"20 probing", "G38.2 Z-1 F10\n", "error:20\r\n"},
    {"20 tool change", "T1 M6\n", "error:20\r\n"},
    {"20 an axis that is not shown", "G0 A1\n", "error:20\r\n"},
    {"21 two of one group", "G0 G1 X1 F1\n", "error:21\r\n"},
    {"22 no feed", "G1 X1\n", "error:22\r\n"},
    {"23 not whole", "G10 L2 P1.5 X0\n", "error:23\r\n"},
    {"24 two that take axes", "G92 G1 X1 F1\n", "error:24\r\n"},
    {"25 twice", "G0 X1 X2\n", "error:25\r\n"},
    {"26 no axes", "G2 F100\n", "error:26\r\n"},
    {"27 line number", "N99999999 G0\n", "error:27\r\n"},
    {"28 P is missing", "G4\n", "error:28\r\n"},
    {"30 G53 goes with G0 and G1", "G2 G53 X1 I1 F100\n", "error:30\r\n"},
    {"31 axes that nothing uses", "G80\nX1\n", "ok\r\nerror:31\r\n"},
    {"33 radii differ", "G2 X1 Y1 I5 F100\n", "error:33\r\n"},
    {"34 radius too small", "G2 X10 R1 F100\n", "error:34\r\n"},
    {"36 a word that nothing uses", "G0 X0 R1\n", "error:36\r\n"},
    {"37 tool length along X", "G43.1 X1\n", "error:37\r\n"},
    // $ commands
    {"help", "$\n", "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]\r\nok\r\n"},
    {"modes", "$G\n", "[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\nok\r\n"},
    {"modes that were changed", "G20 G91 G1 G55 G18 T4 S900 M3 M8 F10\n$G\n",
     "ok\r\n[GC:G1 G55 G18 G20 G91 G94 M3 M8 T4 F254 S900]\r\nok\r\n"},
    {"modes after G80", "G80\n$G\n", "ok\r\n[GC:G80 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\nok\r\n"},
    {"it begins in G0", "X0\n", "ok\r\n"},
    {"build", "$I\n", "[VER:1.1h.20190830:]\r\n[OPT:V,15,128]\r\nok\r\n"},
    {"build with a name", "$I=mill 3\n$I\n", "ok\r\n[VER:1.1h.20190830:MILL3]\r\n[OPT:V,15,128]\r\nok\r\n"},
    {"startup lines", "$N\n", "$N0=\r\n$N1=\r\nok\r\n"},
    {"a startup line is kept, and run at a reset", "$N0=G20\n$N\n\x18",
     "ok\r\n$N0=G20\r\n$N1=\r\nok\r\n" + exchange_banner + ">G20:ok\r\n"},
    {"a startup line must be right", "$N0=G0G1\n", "error:21\r\n"},
    {"a startup line starts nothing", "$N0=G91G1X5F600\n$N1=M3S1000\n$N1=M8\n$N\n",
     startup_refused + startup_refused + startup_refused + "$N0=\r\n$N1=\r\nok\r\n"},
    {"unlock where nothing is locked", "$X\n", "ok\r\n"},
    {"offsets", "$#\n",
     "[G54:0.000,0.000,0.000]\r\n[G55:0.000,0.000,0.000]\r\n[G56:0.000,0.000,0.000]\r\n[G57:0.000,0.000,0.000]\r\n[G58:"
     "0.000,0.000,0.000]\r\n"
     "[G59:0.000,0.000,0.000]\r\n[G28:0.000,0.000,0.000]\r\n[G30:0.000,0.000,0.000]\r\n[G92:0.000,0.000,0.000]\r\n[TLO:"
     "0.000]\r\n"
     "[PRB:0.000,0.000,0.000:0]\r\nok\r\n"},
    {"offsets are forgotten with $RST=#", "G10 L2 P2 X5\n$RST=#\n",
     "ok\r\n[MSG:Restoring defaults]\r\nok\r\n" + exchange_banner},
    {"$RST of something else", "$RST=1\n", "error:3\r\n"},
    {"settings that last for the session", "$10=2\n$13=1\n?",
     "ok\r\nok\r\n<Idle|WPos:0.0000,0.0000,0.0000|Bf:15,128|FS:0.0,0|WCO:0.0000,0.0000,0.0000>\r\n"},
    {"a setting of the rack as it is", "$110=6000\n$100=640.000\n", "ok\r\nok\r\n"},
    {"a setting of the rack that is different", "$110=500\n",
     "[MSG:$110 is 6000.000 in the rack file. It was not changed; change the rack file]\r\nerror:3\r\n"},
    {"check mode", "$C\nG1 X100 F10\nG1\nG0 G1\n$C\n",
     "[MSG:Enabled]\r\nok\r\nok\r\nok\r\nerror:21\r\n[MSG:Disabled]\r\nok\r\n" + exchange_banner},
    {"check mode in the report", "$C\n?",
     "[MSG:Enabled]\r\nok\r\n<Check|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n"},
    {"sleep takes no line until a reset, then it is locked", "$SLP\nG0 X1\n?\x18",
     "ok\r\n[MSG:Sleeping]\r\n<Sleep|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n" + exchange_banner +
         exchange_unlock},
    // real-time bytes
    {"a report gives no ok", "?", "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n"},
    {"two before a report are one", "??", "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n"},
    {"a reset in Idle does not alarm", "\x18", exchange_banner},
    {"hold in Idle, then a reset", "!?\x18",
     "<Hold:0|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n" + exchange_banner},
    {"a hold keeps G-code waiting, questions are answered", "!\n$G\n$$\nG0\n~",
     "ok\r\n[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\nok\r\nerror:8\r\nok\r\n"},
    {"a door that is shut again", "\x84?~?",
     "[MSG:Check "
     "Door]\r\n<Door:0|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n<Idle|MPos:0.000,0.000,0.000|FS:0,0|Ov:"
     "100,100,100>\r\n"},
    {"jog cancel outside a jog, as UTF-8 too", "\x85\xC2\x85?",
     "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n"},
    {"a line of an alarm: too far", "G0 X301\n", "ALARM:2\r\n[MSG:Reset to continue]\r\n"},
    {"after it only a reset is heard, and the line is answered then", "G0 X301\n$X\nG0\n\x18",
     "ALARM:2\r\n[MSG:Reset to continue]\r\nok\r\n" + exchange_banner + exchange_unlock},
    {"a lock takes no G-code, $X ends it", "G0 X301\n\x18G0 X1\n$X\n$G\n",
     "ALARM:2\r\n[MSG:Reset to continue]\r\nok\r\n" + exchange_banner + exchange_unlock +
         "error:9\r\n[MSG:Caution: Unlocked]\r\nok\r\n[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\nok\r\n"},
    {"the end of a program", "M2\n$G\n", "[MSG:Pgm End]\r\nok\r\n[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\nok\r\n"},
};

class EachRule : public testing::TestWithParam<Exchange> {};

TEST_P(EachRule, IsKept) {
    Bench b(three_axes());
    EXPECT_EQ(b.ask(GetParam().in, 0.2), GetParam().out);
}

INSTANTIATE_TEST_SUITE_P(OfGrbl, EachRule, testing::ValuesIn(exchanges));

}  // namespace
}  // namespace motionrack::grbl
