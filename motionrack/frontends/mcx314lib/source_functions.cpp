// Functions with the names of the source, each over its counterpart in the C++ library.
#include <mcx314lib.h>

#include <algorithm>
#include <motionrack/cards/mcx314/driver/home_series.hpp>
#include <motionrack/frontends/mcx314lib/calls.hpp>

namespace {

using namespace motionrack::mcx314lib;
using motionrack::Result;
using motionrack::mcx314::Driver;

using Number = Result<void> (Driver::*)(unsigned axes, std::int64_t value);
using Switch = Result<void> (Driver::*)(int n, unsigned axes);

void set(const char* who, int axis, std::int64_t value, Number function) {
    on_axes(who, axis, [&](OpenChip& chip, unsigned axes) { return (chip.driver.*function)(axes, value); });
}

/// Calls a function for all axes.
void set_all(const char* who, std::int64_t value, Number function) {
    set(who, static_cast<int>(motionrack::mcx314::xyzu), value, function);
}

void turn(const char* who, int n, int axis, Switch function) {
    on_axes(who, axis, [&](OpenChip& chip, unsigned axes) { return (chip.driver.*function)(n, axes); });
}

void turn_all(const char* who, int n, Switch function) {
    turn(who, n, static_cast<int>(motionrack::mcx314::xyzu), function);
}

void line(const char* who, const LINEDATA* data, int axis,
          Result<void> (Driver::*function)(const motionrack::mcx314::LINEDATA&, unsigned)) {
    on_axes(who, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(data, "The line"));
        motionrack::mcx314::LINEDATA out{data->SV, data->V, data->A, data->D, data->K};
        std::copy(data->P, data->P + 4, out.P.begin());
        return (chip.driver.*function)(out, axes);
    });
}

void circle(const char* who, const CIRCLEDATA* data, int axis,
            Result<void> (Driver::*function)(const motionrack::mcx314::CIRCLEDATA&, unsigned)) {
    on_axes(who, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_CHECK(check_pointer(data, "The arc"));
        motionrack::mcx314::CIRCLEDATA out{data->SV, data->V, data->A, data->D};
        std::copy(data->P, data->P + 4, out.P.begin());
        std::copy(data->C, data->C + 4, out.C.begin());
        return (chip.driver.*function)(out, axes);
    });
}

template <class Function>
void home(const char* who, int wr1, int sv, int v, int a, Function function) {
    done(who, [&](OpenChip& chip) -> Result<void> {
        MOTIONRACK_TRY(const unsigned word, mode_word(wr1));
        const auto reports = function(chip.driver, chip.home_axes, word, sv, v, a);
        return reports ? Result<void>{} : tl::unexpected<motionrack::Error>(reports.error());
    });
}

unsigned read(const char* who, int axis, std::int32_t (Driver::*function)(int)) {
    return with_chip(who, 0u, [&](OpenChip& chip) -> Result<unsigned> {
        MOTIONRACK_TRY(const int channel, channel_of(axis));
        return static_cast<unsigned>((chip.driver.*function)(channel));
    });
}

/// Converts 32 bits to the signed value of a counter.
std::int64_t with_sign(unsigned data) {
    return static_cast<std::int32_t>(data);
}

}  // namespace

// ---- initial

void SetPulseMode(int axis, int mode) {
    on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) { return chip.driver.SetPulseMode(axes, mode); });
}
void SetMultiple(int axis, int data) {
    set(__func__, axis, data, &Driver::SetMultiple);
}
void SetRange(int data) {
    set_all(__func__, data, &Driver::SetRange);
}
void SetMaxSpeed(int data) {
    set_all(__func__, data, &Driver::SetMaxSpeed);
}

// ---- basic motion

void SetSV(int axis, int data) {
    set(__func__, axis, data, &Driver::SetSV);
}
void SetV(int axis, int data) {
    set(__func__, axis, data, &Driver::SetV);
}
void SetA(int axis, int data) {
    set(__func__, axis, data, &Driver::SetA);
}
void SetD(int axis, int data) {
    on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) -> Result<void> {
        MOTIONRACK_CHECK(chip.driver.SetD(axes, data));
        return chip.driver.SetAsymmetric(axes, true);
    });
}
void SetAA(int axis, int data) {
    set(__func__, axis, data, &Driver::SetAA);
}
void SetAO(int axis, int data) {
    on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) { return chip.driver.SetAO(axes, data); });
}
void Pulse(int axis, int data) {
    set(__func__, axis, data, &Driver::Pulse);
}
void AutoDec(void) {
    done(__func__, [](OpenChip& chip) { return chip.driver.AutoDec(); });
}
void ManualDec(int axis, int DecPulse) {
    set(__func__, axis, DecPulse, &Driver::ManualDec);
}
void ManDec(int axis, int DecPulse) {
    set(__func__, axis, DecPulse, &Driver::ManDec);
}

void TCurve_F(int axis, int m_SV, int m_V, int m_A, int m_Pulse) {
    on_axes(__func__, axis,
            [&](OpenChip& chip, unsigned axes) { return chip.driver.TCurve_F(axes, m_SV, m_V, m_A, m_Pulse); });
}
void TCurve_C(int axis, int m_SV, int m_V, int m_A) {
    on_axes(__func__, axis, [&](OpenChip& chip, unsigned axes) { return chip.driver.TCurve_C(axes, m_SV, m_V, m_A); });
}
void SCurve_F(int axis, int m_SV, int m_V, int m_A, int m_K, int m_Pulse) {
    on_axes(__func__, axis,
            [&](OpenChip& chip, unsigned axes) { return chip.driver.SCurve_F(axes, m_SV, m_V, m_A, m_K, m_Pulse); });
}
void SCurve_C(int axis, int m_SV, int m_V, int m_A, int m_K) {
    on_axes(__func__, axis,
            [&](OpenChip& chip, unsigned axes) { return chip.driver.SCurve_C(axes, m_SV, m_V, m_A, m_K); });
}

// ---- interpolation

void Line2D_C(LINEDATA* pLD, int axis) {
    line(__func__, pLD, axis, &Driver::Line2D_C);
}
void Line3D_C(LINEDATA* pLD, int axis) {
    line(__func__, pLD, axis, &Driver::Line3D_C);
}
void Line2D_T(LINEDATA* pLD, int axis) {
    line(__func__, pLD, axis, &Driver::Line2D_T);
}
void Line3D_T(LINEDATA* pLD, int axis) {
    line(__func__, pLD, axis, &Driver::Line3D_T);
}
void Line2D_S(LINEDATA* pLD, int axis) {
    line(__func__, pLD, axis, &Driver::Line2D_S);
}
void Line3D_S(LINEDATA* pLD, int axis) {
    line(__func__, pLD, axis, &Driver::Line3D_S);
}
void CircleCW_C(CIRCLEDATA* pCD, int axis) {
    circle(__func__, pCD, axis, &Driver::CircleCW_C);
}
void CircleCCW_C(CIRCLEDATA* pCD, int axis) {
    circle(__func__, pCD, axis, &Driver::CircleCCW_C);
}
void CircleCW_T(CIRCLEDATA* pCD, int axis) {
    circle(__func__, pCD, axis, &Driver::CircleCW_T);
}
void CircleCCW_T(CIRCLEDATA* pCD, int axis) {
    circle(__func__, pCD, axis, &Driver::CircleCCW_T);
}
void SetCP(int axis, int data) {
    set(__func__, axis, data, &Driver::SetCP);
}
void SetC(int axis, int data) {
    set(__func__, axis, data, &Driver::SetC);
}
void SetFP(int axis, int data) {
    set(__func__, axis, data, &Driver::SetFP);
}
void SetP(int axis, int data) {
    set(__func__, axis, data, &Driver::SetP);
}

// ---- signals

void HLMTP(int n, int axis) {
    turn(__func__, n, axis, &Driver::HLMTP);
}
void HLMTM(int n, int axis) {
    turn(__func__, n, axis, &Driver::HLMTM);
}
void HLMTSig(int n, int axis) {
    turn(__func__, n, axis, &Driver::HLMTSig);
}
void SLMTP(int n) {
    turn_all(__func__, n, &Driver::SLMTP);
}
void SLMTM(int n) {
    turn_all(__func__, n, &Driver::SLMTM);
}
void SLMTSig(int n) {
    turn_all(__func__, n, &Driver::SLMTSig);
}
void EncoderMode(int n, int axis) {
    turn(__func__, n, axis, &Driver::EncoderMode);
}
void EncoderCWCCW(int n, int axis) {
    turn(__func__, n, axis, &Driver::EncoderCWCCW);
}
void EnableALM(int n) {
    turn_all(__func__, n, &Driver::EnableALM);
}
void EnableInPos(int n) {
    turn_all(__func__, n, &Driver::EnableInPos);
}
void ALMSig(int n, int axis) {
    turn(__func__, n, axis, &Driver::ALMSig);
}
void InPosSig(int n, int axis) {
    turn(__func__, n, axis, &Driver::InPosSig);
}

// ---- home

void HomeType1(int WR1Reg, int SV, int V, int A) {
    home(__func__, WR1Reg, SV, V, A, motionrack::mcx314::HomeType1);
}
void HomeType2(int WR1Reg, int SV, int V, int A) {
    home(__func__, WR1Reg, SV, V, A, motionrack::mcx314::HomeType2);
}
void HomeType3(int WR1Reg, int SV, int V, int A) {
    home(__func__, WR1Reg, SV, V, A, motionrack::mcx314::HomeType3);
}
void HomeType4(int WR1Reg, int SV, int V, int A) {
    home(__func__, WR1Reg, SV, V, A, motionrack::mcx314::HomeType4);
}

// ---- positions

void LPS(int axis, unsigned data) {
    set(__func__, axis, with_sign(data), &Driver::LPS);
}
void EPS(int axis, unsigned data) {
    set(__func__, axis, with_sign(data), &Driver::EPS);
}
unsigned ReadLPS(int axis) {
    return read(__func__, axis, &Driver::ReadLPS);
}
unsigned ReadEPS(int axis) {
    return read(__func__, axis, &Driver::ReadEPS);
}
unsigned ReadCV(int axis) {
    return read(__func__, axis, &Driver::ReadCV);
}
unsigned ReadCA(int axis) {
    return read(__func__, axis, &Driver::ReadCA);
}
void SetCompP(int axis, int data) {
    set(__func__, axis, data, &Driver::SetCompP);
}
void SetCompM(int axis, int data) {
    set(__func__, axis, data, &Driver::SetCompM);
}
void RESET(void) {
    done(__func__, [](OpenChip& chip) -> Result<void> {
        chip.driver.RESET();
        return {};
    });
}
