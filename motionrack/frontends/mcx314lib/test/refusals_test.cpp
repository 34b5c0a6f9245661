// Every function of the source with an argument that it rejects.
#include <gmock/gmock.h>

#include <motionrack/frontends/mcx314lib/test/chip.hpp>
#include <vector>

namespace motionrack::mcx314lib_test {
namespace {

using testing::HasSubstr;

/// A rejected call and the text of its sentence.
struct Refused {
    const char* function;
    void (*call)();
    const char* reported;
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
    {"mcx314_plan", [] { EXPECT_EQ(mcx314_plan(x, 100, 4000, 400, 0, 1000, nullptr), -1); }, "null pointer"},
    {"mcx314_plan",
     [] {
         MCX314_PLAN plan = {};
         EXPECT_EQ(mcx314_plan(x, 100, 4000, 400, 65'536, 1000, &plan), -1);
     },
     "1 to 65535"},
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

/// Registers that the library could have written, and whether an axis is driving.
std::vector<std::int64_t> written() {
    std::vector<std::int64_t> out = {peek("WR4"), peek("WR5"), peek("RR0")};
    for (const char* axis : {"x.", "y.", "z.", "u."})
        for (const char* name : {"WR1", "WR2", "WR3", "R", "K", "A", "D", "SV", "V", "P", "DP", "C", "LP", "EP",
                                 "COMP_PLUS", "COMP_MINUS", "AO"})
            out.push_back(peek(std::string(axis) + name));
    return out;
}

TEST(Mcx314lib, ARefusedCallStatesTheRangeAndWritesNothing) {
    const Open chip;
    set_up();
    const auto before = written();
    for (const Refused& row : refusals) {
        mcx314_clear_error();
        row.call();
        EXPECT_THAT(mcx314_last_error(), testing::StartsWith(std::string(row.function) + ": "));
        EXPECT_THAT(mcx314_last_error(), HasSubstr(row.reported)) << row.function;
        EXPECT_THAT(mcx314_last_error(), testing::Not(testing::ContainsRegex("Cont[A-Z]|BP[23]D|BPS|BPE")))
            << "names of the C++ library";
        EXPECT_EQ(written(), before) << row.function;
    }
}

/// Functions of the header without invalid arguments, and those rejected in bench_test.cpp.
TEST(Mcx314lib, EveryFunctionThatCanBeRejectedIsInTheTable) {
    std::set<std::string> left = declared_functions();
    for (const Refused& row : refusals) left.erase(row.function);
    EXPECT_THAT(left, testing::UnorderedElementsAre("AutoDec", "RESET", "mcx314_open", "mcx314_select", "mcx314_close",
                                                    "mcx314_last_error", "mcx314_clear_error", "mcx314_on_error",
                                                    "mcx314_now_us"));
}

}  // namespace
}  // namespace motionrack::mcx314lib_test
