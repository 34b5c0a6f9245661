// Every function of the source once, with the values it writes.
#include <gtest/gtest.h>

#include <motionrack/frontends/mcx314lib/test/chip.hpp>
#include <vector>

namespace motionrack::mcx314lib_test {
namespace {

struct Seen {
    const char* name;  ///< register name
    std::int64_t mask;
    std::int64_t value;
};

/// A call on an initialised, stationary chip, and the expected state afterwards.
struct Row {
    const char* function;
    void (*call)();
    std::vector<Seen> seen;
};

constexpr std::int64_t whole = -1;

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
    {"SetD", [] { SetD(u, 55); }, {{"u.D", whole, 55}, {"u.WR3", 2, 2}}},
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

TEST(Mcx314lib, EveryFunctionWritesTheDocumentedRegisters) {
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

}  // namespace
}  // namespace motionrack::mcx314lib_test
