// The register fields used by the chip, from the map: wr2::ALME.test(axis.wr2).
#pragma once

#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace wr1 {
inline constexpr Field IN0L = field("WR1", "IN0L"), IN0E = field("WR1", "IN0E"), PULSE = field("WR1", "PULSE"),
                       DEND = field("WR1", "DEND");
}  // namespace wr1

namespace wr2 {
inline constexpr Field SLMTP = field("WR2", "SLMTP"), SLMTM = field("WR2", "SLMTM"), LMTMD = field("WR2", "LMTMD"),
                       HLMTP = field("WR2", "HLMTP"), HLMTM = field("WR2", "HLMTM"), CMPSL = field("WR2", "CMPSL"),
                       PLSMD = field("WR2", "PLSMD"), PLSL = field("WR2", "PLSL"), DIRL = field("WR2", "DIRL"),
                       PINMD = field("WR2", "PINMD"), PIND = field("WR2", "PIND"), ALML = field("WR2", "ALML"),
                       ALME = field("WR2", "ALME"), INPL = field("WR2", "INPL"), INPE = field("WR2", "INPE");
}  // namespace wr2

namespace wr3 {
inline constexpr Field MANLD = field("WR3", "MANLD"), DSNDE = field("WR3", "DSNDE"), SACC = field("WR3", "SACC"),
                       EXOP = field("WR3", "EXOP"), OUTSL = field("WR3", "OUTSL"), OUT4 = field("WR3", "OUT4");
}  // namespace wr3

namespace wr5 {
inline constexpr Field AX1 = field("WR5", "AX1"), AX2 = field("WR5", "AX2"), AX3 = field("WR5", "AX3"),
                       LSPD = field("WR5", "LSPD"), EXPLS = field("WR5", "EXPLS"), CMPLS = field("WR5", "CMPLS"),
                       CIINT = field("WR5", "CIINT"), BPINT = field("WR5", "BPINT");
}  // namespace wr5

namespace rr0 {
inline constexpr Field DRV = field("RR0", "DRV"), ERR = field("RR0", "ERR"), IDRV = field("RR0", "IDRV"),
                       CNEXT = field("RR0", "CNEXT"), ZONE = field("RR0", "ZONE"), BPSC = field("RR0", "BPSC");
}  // namespace rr0

namespace rr1 {
inline constexpr Field CMPP = field("RR1", "CMPP"), CMPM = field("RR1", "CMPM"), ASND = field("RR1", "ASND"),
                       CNST = field("RR1", "CNST"), DSND = field("RR1", "DSND"), AASND = field("RR1", "AASND"),
                       IN0 = field("RR1", "IN0"), LMTP = field("RR1", "LMTP"), LMTM = field("RR1", "LMTM"),
                       ALARM = field("RR1", "ALARM"), EMG = field("RR1", "EMG");
/// Flags left by a stop through a limit switch, the alarm or the emergency stop.
inline constexpr Field errors{static_cast<std::uint16_t>(LMTP.mask | LMTM.mask | ALARM.mask | EMG.mask)};
}  // namespace rr1

namespace rr2 {
inline constexpr Field SLMTP = field("RR2", "SLMTP"), SLMTM = field("RR2", "SLMTM"), HLMTP = field("RR2", "HLMTP"),
                       HLMTM = field("RR2", "HLMTM"), ALARM = field("RR2", "ALARM"), EMG = field("RR2", "EMG"),
                       HOME = field("RR2", "HOME"), HMST = field("RR2", "HMST");
/// All except the state of the home search.
inline constexpr Field errors{
    static_cast<std::uint16_t>(SLMTP.mask | SLMTM.mask | HLMTP.mask | HLMTM.mask | ALARM.mask | EMG.mask | HOME.mask)};
}  // namespace rr2

namespace rr3 {
inline constexpr Field PULSE = field("RR3", "PULSE"), PGECM = field("RR3", "PGECM"), PLCM = field("RR3", "PLCM"),
                       PLCP = field("RR3", "PLCP"), PGECP = field("RR3", "PGECP"), CEND = field("RR3", "CEND"),
                       CSTA = field("RR3", "CSTA"), DEND = field("RR3", "DEND"), HMEND = field("RR3", "HMEND"),
                       SYNC = field("RR3", "SYNC");
inline constexpr Field comparisons{static_cast<std::uint16_t>(PGECM.mask | PLCM.mask | PLCP.mask | PGECP.mask)};
}  // namespace rr3

namespace em {
inline constexpr Field EPCLR = field("EM6", "EPCLR"), EPINV = field("EM6", "EPINV"), POINV = field("EM6", "POINV"),
                       AVTRI = field("EM6", "AVTRI"), VRING = field("EM6", "VRING"), HMINT = field("EM6", "HMINT"),
                       FE0 = field("EM6", "FE0"), FE3 = field("EM6", "FE3"), FL = field("EM6", "FL");
inline constexpr Field ST1E = field("EM7", "ST1E"), ST1D = field("EM7", "ST1D"), PCLR = field("EM7", "PCLR"),
                       SAND = field("EM7", "SAND"), LIMIT = field("EM7", "LIMIT"), DCCE = field("EM7", "DCCE"),
                       DCCL = field("EM7", "DCCL"), DCCW = field("EM7", "DCCW");
}  // namespace em

namespace sm {
inline constexpr Field DSTA = field("SM6", "DSTA"), DEND = field("SM6", "DEND"), IN3UP = field("SM6", "IN3UP"),
                       IN3DN = field("SM6", "IN3DN"), LPRD = field("SM6", "LPRD"), CMD = field("SM6", "CMD"),
                       PGECP = field("SM6", "PGECP"), PLCP = field("SM6", "PLCP"), PLCM = field("SM6", "PLCM"),
                       PGECM = field("SM6", "PGECM"), AXIS = field("SM6", "AXIS");
inline constexpr Field FDRVP = field("SM7", "FDRVP"), FDRVM = field("SM7", "FDRVM"), CDRVP = field("SM7", "CDRVP"),
                       CDRVM = field("SM7", "CDRVM"), SSTOP = field("SM7", "SSTOP"), ISTOP = field("SM7", "ISTOP"),
                       LPSAV = field("SM7", "LPSAV"), EPSAV = field("SM7", "EPSAV"), LPSET = field("SM7", "LPSET"),
                       EPSET = field("SM7", "EPSET"), OPSET = field("SM7", "OPSET"), VLSET = field("SM7", "VLSET"),
                       OUT = field("SM7", "OUT"), INT = field("SM7", "INT");
}  // namespace sm

// WR1 D8..D15 enable the interrupts of RR3 D0..D7.
inline constexpr int enable_shift = 8;
static_assert(wr1::PULSE.mask == rr3::PULSE.mask << enable_shift && wr1::DEND.mask == rr3::DEND.mask << enable_shift);

}  // namespace motionrack::mcx314
