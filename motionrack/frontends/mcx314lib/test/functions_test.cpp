// Every function of the source once, with what it writes; and with an argument that it refuses.
#include <gmock/gmock.h>

#include <algorithm>
#include <motionrack/frontends/mcx314lib/test/chip.hpp>
#include <vector>

namespace motionrack::mcx314lib_test {
namespace {

using testing::HasSubstr;

struct Seen {
    const char* name;  ///< of a register
    std::int64_t mask;
    std::int64_t value;
};

/// A call, on a chip that is set up and stands, and what is seen after it.
struct Row {
    const char* function;
    void (*call)();
    std::vector<Seen> seen;
};

constexpr std::int64_t whole = -1;

LINEDATA line_of(int px, int py, int pz) {
    return {100, 4000, 400, 0, 500, {px, py, pz, 0}};
}
/// A quarter from (0, 0) round (1000, 0).
CIRCLEDATA quarter(bool clockwise) {
    return {100, 1000, 400, 0, {1000, clockwise ? 1000 : -1000, 0, 0}, {1000, 0, 0, 0}};
}

const Row rows[] = {
    {"SetPulseMode",
     [] { SetPulseMode(x + u, 1); },
     {{"x.WR2", 0x40, 0x40}, {"y.WR2", 0x40, 0}, {"u.WR2", 0x40, 0x40}}},
    {"SetMultiple", [] { SetMultiple(y, 500); }, {{"x.R", whole, 800'000}, {"y.R", whole, 16'000}}},
    {"SetRange", [] { SetRange(8'000'000); }, {{"x.R", whole, 8'000'000}, {"u.R", whole, 8'000'000}}},
    {"SetMaxSpeed", [] { SetMaxSpeed(4'000'000); }, {{"x.R", whole, 16'000}, {"u.R", whole, 16'000}}},
    {"SetSV", [] { SetSV(x, 8000); }, {{"x.SV", whole, 8000}, {"y.SV", whole, 100}}},
    {"SetV", [] { SetV(y, 1); }, {{"y.V", whole, 1}, {"x.V", whole, 4000}}},
    {"SetA", [] { SetA(z, 77); }, {{"z.A", whole, 77}, {"x.A", whole, 400}}},
    {"SetD", [] { SetD(u, 55); }, {{"u.D", whole, 55}}},
    {"SetAA", [] { SetAA(x, 65'535); }, {{"x.K", whole, 65'535}}},
    {"SetAO", [] { SetAO(x, 65'535); }, {{"x.AO", 0xFFFF, 65'535}}},
    {"Pulse", [] { Pulse(x, 268'435'455); }, {{"x.P", whole, 268'435'455}}},
    {"AutoDec", [] { ManualDec(all, 5), AutoDec(); }, {{"x.WR3", 1, 0}, {"u.WR3", 1, 0}}},
    {"ManualDec", [] { ManualDec(x, 1234); }, {{"x.WR3", 1, 1}, {"x.DP", whole, 1234}, {"y.WR3", 1, 0}}},
    {"ManDec", [] { ManDec(y, 4321); }, {{"y.WR3", 1, 1}, {"y.DP", whole, 4321}}},
    {"TCurve_F", [] { TCurve_F(x, 100, 4000, 400, -1000); }, {{"RR0", 0xF, 1}, {"x.P", whole, 1000}, {"x.WR3", 4, 0}}},
    {"TCurve_C", [] { TCurve_C(y, 100, 4000, 400); }, {{"RR0", 0xF, 2}, {"y.V", whole, 4000}}},
    {"SCurve_F",
     [] { SCurve_F(z, 100, 4000, 400, 500, 1000); },
     {{"RR0", 0xF, 4}, {"z.WR3", 4, 4}, {"z.K", whole, 500}}},
    {"SCurve_C", [] { SCurve_C(u, 100, 4000, 400, 500); }, {{"RR0", 0xF, 8}, {"u.WR3", 4, 4}, {"u.K", whole, 500}}},
    {"Line2D_C",
     [] {
         auto l = line_of(0, 500, 300);
         Line2D_C(&l, y + z);
     },
     {{"RR0", 0x10F, 0x106}, {"y.P", whole, 500}, {"z.P", whole, 300}, {"y.SV", whole, 4000}}},
    {"Line3D_C",
     [] {
         auto l = line_of(900, 500, 300);
         Line3D_C(&l, x + y + z);
     },
     {{"RR0", 0x10F, 0x107}, {"x.P", whole, 900}}},
    {"Line2D_T",
     [] {
         auto l = line_of(900, 500, 0);
         Line2D_T(&l, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.SV", whole, 100}}},
    {"Line3D_T",
     [] {
         auto l = line_of(900, 500, 300);
         Line3D_T(&l, x + y + z);
     },
     {{"RR0", 0x10F, 0x107}, {"x.WR3", 4, 0}}},
    {"Line2D_S",
     [] {
         auto l = line_of(900, 500, 0);
         Line2D_S(&l, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.WR3", 4, 4}}},
    {"Line3D_S",
     [] {
         auto l = line_of(900, 500, 300);
         Line3D_S(&l, x + y + z);
     },
     {{"RR0", 0x10F, 0x107}, {"x.WR3", 4, 4}}},
    {"CircleCW_C",
     [] {
         auto c = quarter(true);
         CircleCW_C(&c, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.C", whole, 1000}, {"y.C", whole, 0}, {"y.P", whole, 1000}}},
    {"CircleCCW_C",
     [] {
         auto c = quarter(false);
         CircleCCW_C(&c, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.C", whole, 1000}}},
    {"CircleCW_T",
     [] {
         auto c = quarter(true);
         CircleCW_T(&c, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.WR3", 1, 1}}},
    {"CircleCCW_T",
     [] {
         auto c = quarter(false);
         CircleCCW_T(&c, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.WR3", 1, 1}}},
    {"SetCP, SetFP",
     [] {
         CIRCLEDATA c = {0, 1000, 0, 0, {0}, {0}};
         SetCP(x, 1000), SetCP(y, 0), SetFP(x, 2000), SetFP(y, 0);
         CircleCW_C(&c, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"x.C", whole, 1000}, {"x.P", whole, 2000}}},
    {"SetC, SetP",
     [] {
         CIRCLEDATA c = {0, 1000, 0, 0, {0}, {0}};
         SetC(x, 0), SetC(y, 700), SetP(x, 0), SetP(y, 1400);
         CircleCW_C(&c, x + y);
     },
     {{"RR0", 0x10F, 0x103}, {"y.C", whole, 700}, {"y.P", whole, 1400}}},
    {"HLMTP", [] { HLMTP(1, x); }, {{"x.WR2", 0x08, 0x08}, {"y.WR2", 0x08, 0}}},
    {"HLMTM", [] { HLMTM(1, y); }, {{"y.WR2", 0x10, 0x10}, {"x.WR2", 0x10, 0}}},
    {"HLMTSig", [] { HLMTSig(1, x + y); }, {{"x.WR2", 0x04, 0x04}, {"y.WR2", 0x04, 0x04}}},
    {"SLMTP", [] { SLMTP(1); }, {{"x.WR2", 0x01, 0x01}, {"u.WR2", 0x01, 0x01}}},
    {"SLMTM", [] { SLMTM(1); }, {{"x.WR2", 0x02, 0x02}, {"u.WR2", 0x02, 0x02}}},
    {"SLMTSig", [] { SLMTSig(1); }, {{"x.WR2", 0x20, 0x20}, {"u.WR2", 0x20, 0x20}}},
    {"EncoderMode", [] { EncoderMode(1, z); }, {{"z.WR2", 0x200, 0x200}, {"x.WR2", 0x200, 0}}},
    {"EncoderCWCCW", [] { EncoderCWCCW(2, z); }, {{"z.WR2", 0xC00, 0x800}}},
    {"EnableALM", [] { EnableALM(1); }, {{"x.WR2", 0x2000, 0x2000}, {"u.WR2", 0x2000, 0x2000}}},
    {"EnableInPos", [] { EnableInPos(1); }, {{"x.WR2", 0x8000, 0x8000}, {"u.WR2", 0x8000, 0x8000}}},
    {"ALMSig", [] { ALMSig(1, u); }, {{"u.WR2", 0x1000, 0x1000}, {"x.WR2", 0x1000, 0}}},
    {"InPosSig", [] { InPosSig(1, u); }, {{"u.WR2", 0x4000, 0x4000}, {"x.WR2", 0x4000, 0}}},
    {"LPS",
     [] {
         LPS(x, 0xFFFFFFFFu);
         LPS(y, 5);
     },
     {{"x.LP", whole, -1}, {"y.LP", whole, 5}}},
    {"EPS",
     [] {
         EPS(x, 0x80000000u);
         EPS(y, 6);
     },
     {{"x.EP", whole, -2'147'483'648}, {"y.EP", whole, 6}}},
    {"SetCompP", [] { SetCompP(x, 2'147'483'647); }, {{"x.COMP_PLUS", whole, 2'147'483'647}}},
    {"SetCompM", [] { SetCompM(x, -5000); }, {{"x.COMP_MINUS", whole, -5000}}},
    {"RESET", [] { HLMTP(1, all), RESET(); }, {{"x.WR2", 0xFFFF, 0}, {"x.R", whole, 0}, {"x.V", whole, 0}}},
    {"mcx314_asymmetric", [] { mcx314_asymmetric(x, 1); }, {{"x.WR3", 2, 2}, {"y.WR3", 2, 0}}},
    {"mcx314_set_output", [] { mcx314_set_output(y, 1, 1); }, {{"WR4", 0xFFFF, 0x20}}},
    {"mcx314_enable_interrupt", [] { mcx314_enable_interrupt(x, MCX314_DRIVE_END); }, {{"x.WR1", 0xFF00, 0x8000}}},
    {"mcx314_disable_interrupt",
     [] { mcx314_enable_interrupt(x, 0xFF), mcx314_disable_interrupt(x, 0x0F); },
     {{"x.WR1", 0xFF00, 0xF000}}},
};

TEST(Mcx314lib, EveryFunctionWritesWhatItShould) {
    for (const Row& row : rows) {
        const Open chip;
        set_up();
        row.call();
        EXPECT_STREQ(mcx314_last_error(), "") << row.function;
        for (const Seen& seen : row.seen)
            EXPECT_EQ(peek(seen.name) & seen.mask, seen.value & seen.mask) << row.function << ": " << seen.name;
    }
}

TEST(Mcx314lib, SpeedAndPulsesOfADriveAreChanged) {
    const Open chip;
    set_up();
    TCurve_F(x, 100, 1000, 400, 50'000);
    mcx314_advance_ms(100);
    EXPECT_EQ(ReadCV(x), 1000u);
    SetV(x, 4000);
    Pulse(x, 20'000);
    mcx314_advance_ms(100);
    EXPECT_EQ(ReadCV(x), 4000u);
    EXPECT_EQ(mcx314_wait(x, 10'000), 0) << mcx314_last_error();
    EXPECT_EQ(ReadLPS(x), 20'000u);
}

TEST(Mcx314lib, CountersAndSpeedsAreRead) {
    const Open chip;
    set_up();
    LPS(x, 1000);
    EPS(x, 1000);
    TCurve_F(x, 100, 4000, 400, -20'000);
    mcx314_advance_ms(20);
    EXPECT_EQ(ReadCA(x), 400u);
    mcx314_advance_ms(180);
    EXPECT_EQ(ReadCV(x), 4000u);
    EXPECT_LT(static_cast<int>(ReadLPS(x)), -1000);
    EXPECT_EQ(mcx314_wait(x, 10'000), 0) << mcx314_last_error();
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), -19'000);
    EXPECT_EQ(static_cast<int>(ReadEPS(x)), -19'000);
    EXPECT_EQ(ReadCV(x), 0u);
}

/// A call that is refused, and what its sentence tells.
struct Refused {
    const char* function;
    void (*call)();
    const char* told;
};

const Refused refusals[] = {
    {"SetPulseMode", [] { SetPulseMode(x, 2); }, "0 to 1"},
    {"SetMultiple", [] { SetMultiple(x, 501); }, "1 to 500"},
    {"SetMultiple", [] { SetMultiple(0, 5); }, "1 to 15"},
    {"SetRange", [] { SetRange(15'999); }, "16000 to 8000000"},
    {"SetMaxSpeed", [] { SetMaxSpeed(4'000'001); }, "1 to 4000000"},
    {"SetSV", [] { SetSV(x, 0); }, "1 to 8000"},
    {"SetV", [] { SetV(x, 8001); }, "1 to 8000"},
    {"SetA", [] { SetA(16, 5); }, "1 to 15"},
    {"SetA", [] { SetA(x, -1); }, "1 to 8000"},
    {"SetD", [] { SetD(x, 8001); }, "1 to 8000"},
    {"SetAA", [] { SetAA(x, 65'536); }, "1 to 65535"},
    {"SetAO", [] { SetAO(x, -1); }, "0 to 65535"},
    {"Pulse", [] { Pulse(x, 268'435'456); }, "268435455"},
    {"ManualDec", [] { ManualDec(x, -1); }, "0 to 268435455"},
    {"ManDec", [] { ManDec(-1, 1); }, "1 to 15"},
    {"TCurve_F", [] { TCurve_F(x, 100, 8001, 400, 1); }, "1 to 8000"},
    {"TCurve_C", [] { TCurve_C(x, 0, 4000, 400); }, "1 to 8000"},
    {"SCurve_F", [] { SCurve_F(x, 100, 4000, 400, 0, 1); }, "1 to 65535"},
    {"SCurve_C", [] { SCurve_C(x, 100, 4000, 8001, 5); }, "1 to 8000"},
    {"Line2D_C",
     [] {
         auto l = line_of(1, 2, 3);
         Line2D_C(&l, x);
     },
     "two"},
    {"Line3D_C",
     [] {
         auto l = line_of(1, 2, 3);
         Line3D_C(&l, x + y);
     },
     "three"},
    {"Line2D_T",
     [] {
         auto l = line_of(8'388'608, 2, 3);
         Line2D_T(&l, x + y);
     },
     "8388607"},
    {"Line3D_T", [] { Line3D_T(nullptr, x + y + z); }, "null pointer"},
    {"Line2D_S",
     [] {
         auto l = line_of(1, 2, 3);
         l.K = 65'536;
         Line2D_S(&l, x + y);
     },
     "1 to 65535"},
    {"Line3D_S",
     [] {
         auto l = line_of(1, 2, 3);
         l.V = 0;
         Line3D_S(&l, x + y + z);
     },
     "1 to 8000"},
    {"CircleCW_C",
     [] {
         auto c = quarter(true);
         c.P[1] = 1500;
         CircleCW_C(&c, x + y);
     },
     "1500.0"},
    {"CircleCCW_C", [] { CircleCCW_C(nullptr, x + y); }, "null pointer"},
    {"CircleCW_T",
     [] {
         auto c = quarter(true);
         c.A = 0;
         CircleCW_T(&c, x + y);
     },
     "1 to 8000"},
    {"CircleCCW_T",
     [] {
         auto c = quarter(false);
         CircleCCW_T(&c, x + y + z);
     },
     "two"},
    {"SetCP", [] { SetCP(x, 8'388'608); }, "8388607"},
    {"SetC", [] { SetC(x, -8'388'609); }, "-8388608"},
    {"SetFP", [] { SetFP(x, 8'388'608); }, "8388607"},
    {"SetP", [] { SetP(x, -8'388'609); }, "-8388608"},
    {"HLMTP", [] { HLMTP(2, x); }, "0 to 1"},
    {"HLMTM", [] { HLMTM(-1, x); }, "0 to 1"},
    {"HLMTSig", [] { HLMTSig(2, x); }, "0 to 1"},
    {"SLMTP", [] { SLMTP(2); }, "0 to 1"},
    {"SLMTM", [] { SLMTM(2); }, "0 to 1"},
    {"SLMTSig", [] { SLMTSig(2); }, "0 to 1"},
    {"EncoderMode", [] { EncoderMode(2, x); }, "0 to 1"},
    {"EncoderCWCCW", [] { EncoderCWCCW(3, x); }, "0 to 2"},
    {"EnableALM", [] { EnableALM(2); }, "0 to 1"},
    {"EnableInPos", [] { EnableInPos(2); }, "0 to 1"},
    {"ALMSig", [] { ALMSig(2, x); }, "0 to 1"},
    {"InPosSig", [] { InPosSig(0, 99); }, "1 to 15"},
    {"HomeType1", [] { HomeType1(0, 100, 1000, 100); }, "WR1Reg"},
    {"HomeType2", [] { HomeType2(2, 0, 1000, 100); }, "1 to 8,000"},
    {"HomeType3", [] { HomeType3(65'536, 100, 1000, 100); }, "0 to 65535"},
    {"HomeType4", [] { HomeType4(2, 100, 9000, 100); }, "1 to 8,000"},
    {"ReadLPS", [] { EXPECT_EQ(ReadLPS(3), 0u); }, "one of"},
    {"ReadEPS", [] { EXPECT_EQ(ReadEPS(0), 0u); }, "one of"},
    {"ReadCV", [] { EXPECT_EQ(ReadCV(16), 0u); }, "one of"},
    {"ReadCA", [] { EXPECT_EQ(ReadCA(-8), 0u); }, "one of"},
    {"LPS", [] { LPS(0, 1); }, "1 to 15"},
    {"EPS", [] { EPS(16, 1); }, "1 to 15"},
    {"SetCompP", [] { SetCompP(0, 1); }, "1 to 15"},
    {"SetCompM", [] { SetCompM(0, 1); }, "1 to 15"},
    {"mcx314_wait", [] { EXPECT_EQ(mcx314_wait(x, -1), -1); }, "0 to 2147483647"},
    {"mcx314_advance_ms", [] { EXPECT_EQ(mcx314_advance_ms(-1), -1); }, "0 to 2147483647"},
    {"mcx314_moving", [] { EXPECT_EQ(mcx314_moving(0), -1); }, "1 to 15"},
    {"mcx314_at_limit", [] { EXPECT_EQ(mcx314_at_limit(16), -1); }, "1 to 15"},
    {"mcx314_report", [] { EXPECT_STREQ(mcx314_report(0), ""); }, "1 to 15"},
    {"mcx314_stop", [] { EXPECT_EQ(mcx314_stop(0), -1); }, "1 to 15"},
    {"mcx314_stop_now", [] { EXPECT_EQ(mcx314_stop_now(-1), -1); }, "1 to 15"},
    {"mcx314_asymmetric", [] { EXPECT_EQ(mcx314_asymmetric(x, 2), -1); }, "0 or 1"},
    {"mcx314_set_output", [] { EXPECT_EQ(mcx314_set_output(x, 8, 1), -1); }, "0 to 7"},
    {"mcx314_enable_interrupt", [] { EXPECT_EQ(mcx314_enable_interrupt(x, 256), -1); }, "1 to 255"},
    {"mcx314_disable_interrupt", [] { EXPECT_EQ(mcx314_disable_interrupt(x, 0), -1); }, "1 to 255"},
    {"mcx314_read_interrupt", [] { EXPECT_EQ(mcx314_read_interrupt(3), -1); }, "one of"},
    {"mcx314_jog", [] { EXPECT_EQ(mcx314_jog(x, 100, 8001, 100), -1); }, "1 to 8000"},
    {"mcx314_jog_step", [] { EXPECT_EQ(mcx314_jog_step(x, 100, 100, 100, 0), -1); }, "0 pulses"},
    {"mcx314_jog_home", [] { EXPECT_EQ(mcx314_jog_home(x, 5, 2, 100, 100, 100), -1); }, "1 to 4"},
    {"mcx314_home_axes", [] { EXPECT_EQ(mcx314_home_axes(0), -1); }, "1 to 15"},
    {"mcx314_contour_begin", [] { EXPECT_EQ(mcx314_contour_begin(nullptr), -1); }, "null pointer"},
    {"mcx314_contour_line", [] { EXPECT_EQ(mcx314_contour_line(x + y, nullptr, 0), -1); }, "null pointer"},
    {"mcx314_contour_line",
     [] {
         int p[4] = {1, 1, 0, 0};
         EXPECT_EQ(mcx314_contour_line(x + y, p, 0), -1);
     },
     "Call mcx314_contour_begin first"},
    {"mcx314_contour_arc",
     [] {
         int p[4] = {2, 0, 0, 0}, c[4] = {1, 0, 0, 0};
         EXPECT_EQ(mcx314_contour_arc(x + y, p, c, 2, 0), -1);
     },
     "0 or 1"},
    {"mcx314_contour_end", [] { EXPECT_EQ(mcx314_contour_end(), -1); },
     "Call mcx314_contour_begin and mcx314_contour_line first"},
    {"mcx314_pattern_begin",
     [] {
         MCX314_PATTERN p = {0, 8001, 0, 0};
         EXPECT_EQ(mcx314_pattern_begin(&p, x + y), -1);
     },
     "1 to 8000"},
    {"mcx314_pattern_start", [] { EXPECT_EQ(mcx314_pattern_start(), -1); },
     "Call mcx314_pattern_begin and mcx314_pattern_steps first"},
    {"mcx314_pattern_end", [] { EXPECT_EQ(mcx314_pattern_end(), -1); }, "Call mcx314_pattern_begin first"},
    {"mcx314_pattern_begin", [] { EXPECT_EQ(mcx314_pattern_begin(nullptr, x + y), -1); }, "null pointer"},
    {"mcx314_pattern_steps",
     [] {
         MCX314_STEPS s = {{65'536, 0, 0}, {0, 0, 0}};
         EXPECT_EQ(mcx314_pattern_steps(&s), -1);
     },
     "0 to 65535"},
    {"mcx314_peek",
     [] {
         std::int64_t v = 0;
         EXPECT_EQ(mcx314_peek("x.WR9", &v), -1);
     },
     "x.WR9"},
    {"mcx314_set_wire", [] { EXPECT_EQ(mcx314_set_wire("c1.xlmtp", 2), -1); }, "2"},
};

/// All that the library could have written, and whether an axis drives.
std::vector<std::int64_t> written() {
    std::vector<std::int64_t> out = {peek("WR4"), peek("WR5"), peek("RR0")};
    for (const char* axis : {"x.", "y.", "z.", "u."})
        for (const char* name : {"WR1", "WR2", "WR3", "R", "K", "A", "D", "SV", "V", "P", "DP", "C", "LP", "EP",
                                 "COMP_PLUS", "COMP_MINUS", "AO"})
            out.push_back(peek(std::string(axis) + name));
    return out;
}

TEST(Mcx314lib, WhatIsRefusedTellsTheRangeAndWritesNothing) {
    const Open chip;
    set_up();
    const auto before = written();
    for (const Refused& row : refusals) {
        mcx314_clear_error();
        row.call();
        EXPECT_THAT(mcx314_last_error(), testing::StartsWith(std::string(row.function) + ": "));
        EXPECT_THAT(mcx314_last_error(), HasSubstr(row.told)) << row.function;
        EXPECT_THAT(mcx314_last_error(), testing::Not(testing::ContainsRegex("Cont[A-Z]|BP[23]D|BPS|BPE")))
            << "names of the C++ library";
        EXPECT_EQ(written(), before) << row.function;
    }
}

/// Of the functions of the header, those that take nothing wrong, and those that bench_test.cpp refuses.
TEST(Mcx314lib, EveryFunctionThatCanBeRefusedIsAmongThese) {
    std::set<std::string> left = declared_functions();
    for (const Refused& row : refusals) left.erase(row.function);
    EXPECT_THAT(left, testing::UnorderedElementsAre("AutoDec", "RESET", "mcx314_open", "mcx314_select", "mcx314_close",
                                                    "mcx314_last_error", "mcx314_clear_error", "mcx314_on_error",
                                                    "mcx314_now_us"));
}

}  // namespace
}  // namespace motionrack::mcx314lib_test
