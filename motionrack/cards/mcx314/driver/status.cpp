// Status words as text.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <motionrack/cards/mcx314/driver/status.hpp>

namespace motionrack::mcx314 {

namespace {

/// Remedies of status bits; all other text is in the map.
struct Advice {
    std::string_view reg, name, next;
};
constexpr Advice advices[] = {
    {"RR0", "DRV", "Wait for the end, or stop the axis."},
    {"RR0", "ERR", "Read RR1 and RR2 of the axis."},
    {"RR0", "IDRV", "Wait for the end, or stop one of its axes."},
    {"RR0", "CNEXT", "Write the next segment, or nothing."},
    {"RR0", "BPSC", "Stack the next word while it is below 3."},
    {"RR1", "IN0", "If that was not intended, check the input and SetStopInput."},
    {"RR1", "IN1", "If that was not intended, check the input and SetStopInput."},
    {"RR1", "IN2", "If that was not intended, check the input and SetStopInput."},
    {"RR1", "IN3", "If that was not intended, check the input and SetStopInput."},
    {"RR1", "LMTP", "Drive in - direction, away from the switch."},
    {"RR1", "LMTM", "Drive in + direction, away from the switch."},
    {"RR1", "ALARM", "Clear the alarm at the motor's drive, then home again."},
    {"RR1", "EMG", "Release the emergency stop, then home again."},
    {"RR2", "SLMTP", "Drive in - direction, or set a higher COMP+."},
    {"RR2", "SLMTM", "Drive in + direction, or set a lower COMP-."},
    {"RR2", "HLMTP", "Drive in - direction, away from the switch; if it is not pressed, check its wire and HLMTP."},
    {"RR2", "HLMTM", "Drive in + direction, away from the switch; if it is not pressed, check its wire and HLMTM."},
    {"RR2", "ALARM", "Clear the alarm at the motor's drive; if the drive has none, check its wire and ALMSig."},
    {"RR2", "EMG", "Release the emergency stop."},
    {"RR2", "HOME", "Move off the encoder's index, then search again."},
};

constexpr bool advises_on_what_exists() {
    for (const Advice& advice : advices) {
        bool found = false;
        for (const RegisterInfo& reg : map::registers)
            if (reg.name == advice.reg)
                for (const FieldInfo& info : reg.fields) found = found || info.name == advice.name;
        if (!found) return false;
    }
    return true;
}
static_assert(advises_on_what_exists());

constexpr std::string_view status_registers[] = {"RR0", "RR1", "RR2", "RR3"};

constexpr std::size_t count_bits() {
    std::size_t count = 0;
    for (const RegisterInfo& reg : map::registers)
        for (const std::string_view name : status_registers)
            if (reg.name == name) count += reg.fields.size();
    return count;
}

constexpr std::array<StatusBit, count_bits()> make_bits() {
    std::array<StatusBit, count_bits()> out;
    std::size_t n = 0;
    for (const std::string_view name : status_registers)
        for (const RegisterInfo& reg : map::registers) {
            if (reg.name != name) continue;
            for (const FieldInfo& info : reg.fields) {
                StatusBit& bit = out[n++];
                bit = {reg.name, info.name, static_cast<std::uint16_t>(info.mask), info.meaning, {}};
                for (const Advice& advice : advices)
                    if (advice.reg == reg.name && advice.name == info.name) bit.next = advice.next;
            }
        }
    return out;
}

constexpr auto bits = make_bits();

/// Reason for the end of a drive: the latched bits first, then the live ones.
struct Cause {
    std::string_view reg;
    std::uint16_t mask;
    const char* text;
};
constexpr Cause causes[] = {
    {"RR1", field("RR1", "EMG").mask, "the emergency stop input is active"},
    {"RR2", field("RR2", "EMG").mask, "the emergency stop input is active"},
    {"RR1", field("RR1", "ALARM").mask, "the drive's alarm is active"},
    {"RR2", field("RR2", "ALARM").mask, "the drive's alarm is active"},
    {"RR1", field("RR1", "LMTP").mask, "the + limit switch was reached"},
    {"RR1", field("RR1", "LMTM").mask, "the - limit switch was reached"},
    {"RR2", field("RR2", "SLMTP").mask, "the + software limit was passed"},
    {"RR2", field("RR2", "SLMTM").mask, "the - software limit was passed"},
    {"RR1", field("RR1", "IN0").mask, "input IN0 stopped it"},
    {"RR1", field("RR1", "IN1").mask, "input IN1 stopped it"},
    {"RR1", field("RR1", "IN2").mask, "input IN2 stopped it"},
    {"RR1", field("RR1", "IN3").mask, "input IN3 stopped it"},
};

const Cause* cause_of(const DriveStatus& status) {
    for (const Cause& cause : causes)
        if (((cause.reg == "RR1" ? status.rr1 : status.rr2) & cause.mask) != 0) return &cause;
    return nullptr;
}

}  // namespace

std::span<const StatusBit> status_bits() {
    return bits;
}

std::string explain(std::string_view reg, std::uint16_t word) {
    std::string out;
    for (const StatusBit& bit : bits) {
        if (bit.reg != reg || (bit.mask & word) == 0) continue;
        out += fmt::format("{}: {}", bit.name, bit.meaning);
        const Field one{bit.mask};
        if (one.get(bit.mask) != 1) out += fmt::format(" = {}", one.get(word));
        out += bit.next.empty() ? ".\n" : fmt::format(". {}\n", bit.next);
    }
    return out;
}

std::string DriveStatus::why_stopped() const {
    const Cause* cause = cause_of(*this);
    return cause ? cause->text : "";
}

std::string DriveStatus::what_next() const {
    const Cause* cause = cause_of(*this);
    if (!cause) return {};
    for (const StatusBit& bit : bits)
        if (bit.reg == cause->reg && bit.mask == cause->mask) return std::string(bit.next);
    return {};
}

std::string AxisReport::text() const {
    const std::string why = status.why_stopped();
    std::string out = fmt::format("{} {} at LP {}, EP {}", "XYZU"[axis], driving ? "drives" : "stands", lp, ep);
    if (driving) out += fmt::format(", V {}", cv);
    if (!why.empty()) out += ": " + why;
    out += fmt::format(" (RR1 {:04X}h, RR2 {:04X}h).", status.rr1, status.rr2);
    const std::string next = status.what_next();
    return next.empty() ? out : out + " " + next;
}

}  // namespace motionrack::mcx314
