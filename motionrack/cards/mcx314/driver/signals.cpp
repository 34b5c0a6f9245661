// Limits, signals, encoders, interrupts, inputs and outputs: bits of WR1..WR4, RR3..RR5.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr const char* pin_level = "0 active Low, 1 active High";
constexpr const char* on_off = "0 off, 1 on";
constexpr unsigned cause_shift = 8;  // causes are bits 0..7 of RR3 and bits 8..15 of WR1
static_assert(field("WR1", "DEND").mask == field("RR3", "DEND").mask << cause_shift);
static_assert(field("WR1", "PULSE").mask == field("RR3", "PULSE").mask << cause_shift);

}  // namespace

Result<void> Driver::HLMTP(int n, unsigned axes) {
    return write_switch("HLMTP", axes, 2, field("WR2", "HLMTP"), n, 1, pin_level);
}
Result<void> Driver::HLMTM(int n, unsigned axes) {
    return write_switch("HLMTM", axes, 2, field("WR2", "HLMTM"), n, 1, pin_level);
}
Result<void> Driver::HLMTSig(int n, unsigned axes) {
    return write_switch("HLMTSig", axes, 2, field("WR2", "LMTMD"), n, 1, "0 stop at once, 1 decelerating");
}
Result<void> Driver::SLMTP(int n, unsigned axes) {
    return write_switch("SLMTP", axes, 2, field("WR2", "SLMTP"), n, 1, on_off);
}
Result<void> Driver::SLMTM(int n, unsigned axes) {
    return write_switch("SLMTM", axes, 2, field("WR2", "SLMTM"), n, 1, on_off);
}
Result<void> Driver::SLMTSig(int n, unsigned axes) {
    return write_switch("SLMTSig", axes, 2, field("WR2", "CMPSL"), n, 1, "0 logical position LP, 1 real position EP");
}
Result<void> Driver::EncoderMode(int n, unsigned axes) {
    return write_switch("EncoderMode", axes, 2, field("WR2", "PINMD"), n, 1, "0 A/B quadrature, 1 up and down pulses");
}
Result<void> Driver::EncoderCWCCW(int n, unsigned axes) {
    return write_switch("EncoderCWCCW", axes, 2, field("WR2", "PIND"), n, 2,
                        "0 every edge, 1 every second, 2 every fourth");
}
Result<void> Driver::EnableALM(int n, unsigned axes) {
    return write_switch("EnableALM", axes, 2, field("WR2", "ALME"), n, 1, on_off);
}
Result<void> Driver::EnableInPos(int n, unsigned axes) {
    return write_switch("EnableInPos", axes, 2, field("WR2", "INPE"), n, 1, on_off);
}
Result<void> Driver::ALMSig(int n, unsigned axes) {
    return write_switch("ALMSig", axes, 2, field("WR2", "ALML"), n, 1, pin_level);
}
Result<void> Driver::InPosSig(int n, unsigned axes) {
    return write_switch("InPosSig", axes, 2, field("WR2", "INPL"), n, 1, pin_level);
}

Result<void> Driver::SetStopInput(unsigned axes, int input, StopInput mode) {
    MOTIONRACK_CHECK(check_axes(axes, "SetStopInput"));
    MOTIONRACK_CHECK(check_switch("SetStopInput", input, 3, "the number of the input IN0 .. IN3"));
    // IN0L, IN0E, IN1L, IN1E, ..: level and enable of each input are adjacent.
    const auto high = static_cast<std::uint16_t>(field("WR1", "IN0L").mask << 2 * input);
    const auto enable = static_cast<std::uint16_t>(field("WR1", "IN0E").mask << 2 * input);
    for (const int i : channels_of(axes)) {
        const unsigned word = Field{high}.set(mode1(i), mode == StopInput::at_high);
        write_mode(1u << i, 1, Field{enable}.set(word, mode != StopInput::off));
    }
    return {};
}

Result<void> Driver::SetExternalDrive(unsigned axes, ExternalDrive mode) {
    MOTIONRACK_CHECK(check_axes(axes, "SetExternalDrive"));
    set_mode(axes, 3, field("WR3", "EXOP"), static_cast<unsigned>(mode));
    return {};
}

// ---- synchronous actions of the MCX314As

Result<void> Driver::SetSynchronous(unsigned axes, std::uint16_t conditions, std::uint16_t actions) {
    MOTIONRACK_CHECK(check_axes(axes, "SetSynchronous"));
    write_data(axes, cmd::SM, std::uint32_t{actions} << 16 | conditions);
    return {};
}

Result<void> Driver::Synchronous(unsigned axes) {
    MOTIONRACK_CHECK(check_axes(axes, "Synchronous"));
    command(axes, cmd::SYNC);
    return {};
}

std::int32_t Driver::ReadBR(int axis) {
    return static_cast<std::int32_t>(read_data(axis, cmd::READ_BR));
}

// ---- outputs and inputs

void Driver::write_outputs(std::uint16_t word) {
    const PlainRegisters plain(*this);
    port_.write(reg::WR4, word);
    outputs_ = word;
}

Result<void> Driver::SetOutput(unsigned axes, int output, bool high) {
    MOTIONRACK_CHECK(check_axes(axes, "SetOutput"));
    MOTIONRACK_CHECK(check_switch("SetOutput", output, 7, "the number of the output nOUT0 .. nOUT7"));
    if (output >= 4) {
        const auto bit = static_cast<std::uint16_t>(field("WR3", "OUT4").mask << (output - 4));
        set_mode(axes, 3, Field{bit}, high);
        return {};
    }
    unsigned word = outputs_;
    for (const int i : channels_of(axes))
        word = Field{static_cast<std::uint16_t>(1u << (4 * i + output))}.set(word, high);
    write_outputs(static_cast<std::uint16_t>(word));
    return {};
}

Result<void> Driver::ShowDriveStatus(unsigned axes, bool on) {
    MOTIONRACK_CHECK(check_axes(axes, "ShowDriveStatus"));
    set_mode(axes, 3, field("WR3", "OUTSL"), on);
    return {};
}

InputLevels Driver::inputs(int axis) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < 4);
    // Two axes per register, eight bits each, all in the order of X.
    const unsigned both = port_.read(axis < 2 ? reg::RR4 : reg::RR5);
    const unsigned word = axis % 2 == 0 ? both : both >> 8;
    InputLevels levels;
    for (unsigned i = 0; i < 4; ++i) levels.in[i] = (field("RR4", "XIN").get(word) >> i & 1) != 0;
    levels.expp = field("RR4", "XEXPP").test(word);
    levels.expm = field("RR4", "XEXPM").test(word);
    levels.in_position = field("RR4", "XINP").test(word);
    levels.alarm = field("RR4", "XALM").test(word);
    return levels;
}

// ---- interrupts

Result<void> Driver::EnableInterrupt(unsigned axes, std::uint16_t causes) {
    return change_interrupts("EnableInterrupt", axes, causes, true);
}
Result<void> Driver::DisableInterrupt(unsigned axes, std::uint16_t causes) {
    return change_interrupts("DisableInterrupt", axes, causes, false);
}

Result<void> Driver::change_interrupts(const char* who, unsigned axes, std::uint16_t causes, bool on) {
    MOTIONRACK_CHECK(check_axes(axes, who));
    if (causes == 0 || (causes & ~unsigned{cause::all}) != 0)
        return fail(
            ErrorKind::refused,
            fmt::format("{}: the causes {:04X}h are not bits 0 to 7 of RR3. Nothing was written.", who, causes));
    for (const int i : channels_of(axes)) {
        const unsigned bits = unsigned{causes} << cause_shift;
        write_mode(1u << i, 1, static_cast<std::uint16_t>(on ? mode1(i) | bits : mode1(i) & ~bits));
    }
    return {};
}

std::uint16_t Driver::read_interrupts(int axis) {
    fetch_interrupts(axis);
    return std::exchange(kept(axis).interrupts, std::uint16_t{0});
}

/// Reading RR3 clears it, so the interrupts read by a wait are stored for read_interrupts(). Returns true if there were
/// any.
bool Driver::fetch_interrupts(int axis) {
    Kept& own = kept(axis);
    command(1u << axis, cmd::NOP);
    const std::uint16_t came = port_.read(reg::RR3);
    own.interrupts = static_cast<std::uint16_t>(own.interrupts | came);
    return came != 0;
}

void Driver::WriteMode1(unsigned axes, std::uint16_t word) {
    write_mode(axes, 1, word);
}
void Driver::WriteMode2(unsigned axes, std::uint16_t word) {
    write_mode(axes, 2, word);
}
void Driver::WriteMode3(unsigned axes, std::uint16_t word) {
    write_mode(axes, 3, word);
    for (const int i : channels_of(axes)) {
        kept(i).manual = field("WR3", "MANLD").test(word);
        kept(i).asymmetric = field("WR3", "DSNDE").test(word);
    }
}

}  // namespace motionrack::mcx314
