// Register traffic of the function library: range check, then WR7, WR6, WR0.
#include <motionrack/cards/mcx314/driver/driver.hpp>

#include <fmt/format.h>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr std::int64_t finish_least = -8'388'608;
constexpr std::int64_t finish_greatest = 8'388'607;
constexpr std::int64_t least_32 = -2'147'483'648LL;
constexpr std::int64_t greatest_32 = 2'147'483'647LL;

std::string axes_text(unsigned axes) {
    std::string out;
    for (int i = 0; i < 4; ++i)
        if (axes >> i & 1) out += "XYZU"[i];
    return out;
}

}  // namespace

std::string AxisStatus::why_stopped() const {
    struct Cause {
        std::uint16_t rr1, rr2;
        const char* text;
    };
    static constexpr Cause causes[] = {
        {0x8000, 0x0020, "the emergency stop input is active"}, {0x4000, 0x0010, "the drive's alarm is active"},
        {0x1000, 0, "the + limit switch was reached"},          {0x2000, 0, "the - limit switch was reached"},
        {0, 0x0001, "the + software limit was passed"},         {0, 0x0002, "the - software limit was passed"},
        {0x0100, 0, "input IN0 stopped it"},                    {0x0200, 0, "input IN1 stopped it"},
        {0x0400, 0, "input IN2 stopped it"},                    {0x0800, 0, "input IN3 stopped it"},
    };
    for (const Cause& cause : causes)
        if ((rr1 & cause.rr1) || (rr2 & cause.rr2)) return cause.text;
    return {};
}

// ---- traffic ----------------------------------------------------------------------------------------------------------------

void Driver::command(unsigned axes, unsigned code) {
    port_.write(reg::WR0, static_cast<std::uint16_t>((axes & 0xFu) << 8 | code));
}

void Driver::write_data(unsigned axes, unsigned code, std::uint32_t value) {
    port_.write(reg::WR7, static_cast<std::uint16_t>(value >> 16));
    port_.write(reg::WR6, static_cast<std::uint16_t>(value & 0xFFFFu));
    command(axes, code);
}

std::uint32_t Driver::read_data(int axis, unsigned code) {
    command(1u << axis, code);
    const std::uint32_t low = port_.read(reg::RR6);
    const std::uint32_t high = port_.read(reg::RR7);
    return high << 16 | low;
}

Result<void> Driver::checked(unsigned axes, unsigned code, std::int64_t value, std::int64_t least, std::int64_t greatest,
                             const char* name) {
    if (axes == 0 || axes > 15)
        return fail(Trouble::refused, fmt::format("{}: the axis mask {} names no axes; X is 1, Y 2, Z 4, U 8 and sums of these. "
                                                  "Nothing was written.", name, axes));
    if (value < least || value > greatest)
        return fail(Trouble::refused, fmt::format("{} of {} is {}, but the chip takes {} to {}. Nothing was written.", name,
                                                  axes_text(axes), value, least, greatest));
    write_data(axes, code, static_cast<std::uint32_t>(value));
    return {};
}

void Driver::write_mode(unsigned axes, int number, std::uint16_t word) {
    command(axes, cmd::NOP);
    port_.write(reg::WR0 + 2u * number, word);
    for (std::size_t i = 0; i < 4; ++i)
        if (axes >> i & 1) mode_[i][number - 1] = word;
}

// ---- initial ----------------------------------------------------------------------------------------------------------------

void Driver::RESET() {
    port_.write(reg::WR0, 0x8000);
    interrupt_.pass(nanoseconds(875));
    for (auto& axis : mode_) axis = {};
}

Result<void> Driver::SetPulseMode(unsigned axes, int mode) {
    if (mode != 0 && mode != 1)
        return fail(Trouble::refused, fmt::format("SetPulseMode: the mode is {}, but it is 0 (two pulse trains) or 1 (pulse and "
                                                  "direction). Nothing was written.", mode));
    for (int i = 0; i < 4; ++i)
        if (axes >> i & 1) {
            const unsigned rest = mode_[i][1] & ~0x0040u;
            write_mode(1u << i, 2, static_cast<std::uint16_t>(mode == 1 ? rest | 0x0040u : rest));
        }
    return {};
}

Result<void> Driver::SetRange(unsigned axes, std::int64_t range) {
    return checked(axes, cmd::R, range, 16'000, 13'856'000, "The range R");
}

// ---- speeds and ramps -------------------------------------------------------------------------------------------------------

Result<void> Driver::SetSV(unsigned axes, std::int64_t value) { return checked(axes, cmd::SV, value, 1, 8'000, "The initial speed SV"); }
Result<void> Driver::SetV(unsigned axes, std::int64_t value) { return checked(axes, cmd::V, value, 1, 8'000, "The drive speed V"); }
Result<void> Driver::SetA(unsigned axes, std::int64_t value) { return checked(axes, cmd::A, value, 1, 8'000, "The acceleration A"); }
Result<void> Driver::SetD(unsigned axes, std::int64_t value) { return checked(axes, cmd::D, value, 1, 8'000, "The deceleration D"); }
Result<void> Driver::SetAA(unsigned axes, std::int64_t value) {
    return checked(axes, cmd::K, value, 1, 65'535, "The acceleration's rate K");
}
Result<void> Driver::SetAO(unsigned axes, std::int64_t value) {
    return checked(axes, cmd::AO, value, 0, 65'535, "The acceleration counter offset AO");
}

Result<void> Driver::Pulse(unsigned axes, std::int64_t pulses) {
    return checked(axes, cmd::P, pulses < 0 ? -pulses : pulses, 0, 268'435'455, "The number of output pulses P");
}

Result<void> Driver::AutoDec(unsigned axes) {
    for (int i = 0; i < 4; ++i)
        if (axes >> i & 1) write_mode(1u << i, 3, static_cast<std::uint16_t>(mode_[i][2] & ~0x0001u));
    return {};
}

Result<void> Driver::SetDecPoint(unsigned axes, std::int64_t point) {
    return checked(axes, cmd::DP, point, 0, 268'435'455, "The manual deceleration point DP");
}

Result<void> Driver::ManualDec(unsigned axes, std::int64_t point) {
    MOTIONRACK_CHECK(SetDecPoint(axes, point));
    for (int i = 0; i < 4; ++i)
        if (axes >> i & 1) write_mode(1u << i, 3, static_cast<std::uint16_t>(mode_[i][2] | 0x0001u));
    return {};
}

void Driver::SetSCurve(unsigned axes, bool on) {
    for (int i = 0; i < 4; ++i) {
        if (!(axes >> i & 1)) continue;
        const unsigned rest = mode_[i][2] & ~0x0004u;
        write_mode(1u << i, 3, static_cast<std::uint16_t>(on ? rest | 0x0004u : rest));
    }
}

// ---- drives -----------------------------------------------------------------------------------------------------------------

void Driver::Drive(unsigned axes, bool negative) { command(axes, negative ? cmd::FIXED_MINUS : cmd::FIXED_PLUS); }
void Driver::DriveContinuous(unsigned axes, bool negative) { command(axes, negative ? cmd::CONTINUOUS_MINUS : cmd::CONTINUOUS_PLUS); }
void Driver::Hold(unsigned axes) { command(axes, cmd::HOLD); }
void Driver::Start(unsigned axes) { command(axes, cmd::START); }
void Driver::SlowStop(unsigned axes) { command(axes, cmd::SLOW_STOP); }
void Driver::QuickStop(unsigned axes) { command(axes, cmd::QUICK_STOP); }

// ---- interpolation ----------------------------------------------------------------------------------------------------------

void Driver::SetInterpolationAxes(int first, int second, int third, bool constant_vector, bool interrupt_at_joints) {
    unsigned word = static_cast<unsigned>(first) | static_cast<unsigned>(second) << 2 | static_cast<unsigned>(third < 0 ? 0 : third) << 4;
    if (constant_vector) word |= 0x0100u;
    if (interrupt_at_joints) word |= 0x4000u;
    port_.write(reg::WR5, static_cast<std::uint16_t>(word));
}

Result<void> Driver::Line(const Finish* ends, int count) {
    for (int i = 0; i < count; ++i)
        MOTIONRACK_CHECK(checked(1u << ends[i].axis, cmd::P, ends[i].pulses, finish_least, finish_greatest, "The finish point P"));
    command(0, count == 3 ? cmd::LINE3 : cmd::LINE2);
    return {};
}

Result<void> Driver::Arc(const Finish (&ends)[2], bool clockwise) {
    for (const Finish& end : ends) {
        MOTIONRACK_CHECK(checked(1u << end.axis, cmd::P, end.pulses, finish_least, finish_greatest, "The finish point P"));
        MOTIONRACK_CHECK(checked(1u << end.axis, cmd::C, end.centre, finish_least, finish_greatest, "The centre C"));
    }
    command(0, clockwise ? cmd::ARC_CW : cmd::ARC_CCW);
    return {};
}

void Driver::EnableDeceleration(bool on) { command(0, on ? cmd::DECELERATION_ON : cmd::DECELERATION_OFF); }
void Driver::ClearInterpolationInterrupt() { command(0, cmd::INTERPOLATION_INTERRUPT_CLEAR); }

// ---- modes, positions, status -----------------------------------------------------------------------------------------------

void Driver::WriteMode1(unsigned axes, std::uint16_t word) { write_mode(axes, 1, word); }
void Driver::WriteMode2(unsigned axes, std::uint16_t word) { write_mode(axes, 2, word); }
void Driver::WriteMode3(unsigned axes, std::uint16_t word) { write_mode(axes, 3, word); }

Result<void> Driver::LPS(unsigned axes, std::int64_t value) {
    return checked(axes, cmd::LP, value, least_32, greatest_32, "The logical position LP");
}
Result<void> Driver::EPS(unsigned axes, std::int64_t value) {
    return checked(axes, cmd::EP, value, least_32, greatest_32, "The real position EP");
}
Result<void> Driver::SetCompP(unsigned axes, std::int64_t value) {
    return checked(axes, cmd::COMP_PLUS, value, least_32, greatest_32, "The comparison value COMP+");
}
Result<void> Driver::SetCompM(unsigned axes, std::int64_t value) {
    return checked(axes, cmd::COMP_MINUS, value, least_32, greatest_32, "The comparison value COMP-");
}

std::int32_t Driver::ReadLPS(int axis) { return static_cast<std::int32_t>(read_data(axis, cmd::READ_LP)); }
std::int32_t Driver::ReadEPS(int axis) { return static_cast<std::int32_t>(read_data(axis, cmd::READ_EP)); }
std::int32_t Driver::ReadCV(int axis) { return static_cast<std::int32_t>(read_data(axis, cmd::READ_CV)); }
std::int32_t Driver::ReadCA(int axis) { return static_cast<std::int32_t>(read_data(axis, cmd::READ_CA)); }

MainStatus Driver::status() { return {port_.read(reg::RR0)}; }

AxisStatus Driver::axis_status(int axis) {
    command(1u << axis, cmd::NOP);
    AxisStatus status;
    status.rr1 = port_.read(reg::RR1);
    status.rr2 = port_.read(reg::RR2);
    return status;
}

std::uint16_t Driver::read_interrupts(int axis) {
    command(1u << axis, cmd::NOP);
    return port_.read(reg::RR3);
}

Result<void> Driver::wait_until_stopped(unsigned axes, Duration timeout) {
    const Instant end = interrupt_.now() + timeout;
    bool stopped = false;
    while (status().driving(axes)) {
        if (!stopped && interrupt_.stop_requested()) {
            SlowStop(axes);
            stopped = true;
        }
        if (interrupt_.now() >= end)
            return fail(Trouble::machine, fmt::format("{} still moves after {:.3f} s; nothing was stopped. Wait longer, or stop the axes.",
                                                      axes_text(axes), to_seconds(timeout)));
        // The drive-end interrupt, where enabled, wakes at once; otherwise the status is looked at every 100 us.
        if (interrupt_.wait(microseconds(100)))
            for (int i = 0; i < 4; ++i)
                if (axes >> i & 1) read_interrupts(i);
    }
    if (stopped) return fail(Trouble::stopped, fmt::format("Stopped on request; {} stands still.", axes_text(axes)));
    return {};
}

}  // namespace motionrack::mcx314
