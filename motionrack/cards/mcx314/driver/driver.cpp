// Register traffic of the function library: range check, then WR7, WR6, WR0; and the parameters.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr std::int64_t max_multiple = 500, max_pulse_rate = 4'000'000;
constexpr Duration reset_time = nanoseconds(875);
constexpr std::uint16_t reset_word = field("WR0", "RESET").mask;

std::int64_t range_of_multiple(std::int64_t multiple) {
    return param::R.max / multiple;
}

}  // namespace

std::string axes_text(unsigned axes) {
    std::string out;
    for (const int i : channels_of(axes)) out += "XYZU"[i];
    return out;
}

// ---- traffic

void Driver::command(unsigned axes, unsigned code) {
    port_.write(reg::WR0, static_cast<std::uint16_t>((axes & xyzu) << 8 | code));
}

void Driver::write_data(unsigned axes, unsigned code, std::uint32_t value) {
    const PlainRegisters plain(*this);
    port_.write(reg::WR7, static_cast<std::uint16_t>(value >> 16));
    port_.write(reg::WR6, static_cast<std::uint16_t>(value & 0xFFFFu));
    command(axes, code);
}

std::uint32_t Driver::read_data(int axis, unsigned code) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < 4);
    command(1u << axis, code);
    const std::uint32_t low = port_.read(reg::RR6);
    const std::uint32_t high = port_.read(reg::RR7);
    return high << 16 | low;
}

void Driver::write_mode(unsigned axes, int number, std::uint16_t word) {
    const PlainRegisters plain(*this);
    command(axes, cmd::NOP);
    port_.write(reg::WR0 + 2u * static_cast<unsigned>(number), word);
    for (const int i : channels_of(axes)) kept(i).mode[static_cast<std::size_t>(number - 1)] = word;
}

void Driver::set_mode(unsigned axes, int number, Field bits, unsigned value) {
    for (const int i : channels_of(axes))
        write_mode(1u << i, number, bits.set(kept(i).mode[static_cast<std::size_t>(number - 1)], value));
}

void Driver::put(unsigned axes, const Parameter& parameter, std::int64_t value) {
    write_data(axes, parameter.code, static_cast<std::uint32_t>(value));
    for (const int i : channels_of(axes)) kept(i).data[parameter.code] = value;
}

Driver::Kept& Driver::kept(int axis) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < 4);
    return kept_[static_cast<std::size_t>(axis)];
}

const Driver::Kept& Driver::kept(int axis) const {
    MOTIONRACK_ASSERT(axis >= 0 && axis < 4);
    return kept_[static_cast<std::size_t>(axis)];
}

// ---- checks

Result<void> Driver::check_channel(int axis, const char* who) {
    if (axis >= 0 && axis < 4) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("{}: the axis is {}; it must be one of 0 X, 1 Y, 2 Z, 3 U. Nothing was written.", who, axis));
}

Result<void> Driver::check_standing(unsigned axes, const char* who, MainStatus main) {
    const unsigned busy = field("RR0", "DRV").get(main.word) & axes;
    if (busy == 0) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: {} {} driving. Nothing was written. Wait for the end of the drive, or stop it first.",
                            who, axes_text(busy), (busy & (busy - 1)) == 0 ? "is" : "are"));
}

Result<void> Driver::check_initialised(unsigned axes, const char* who) const {
    unsigned without = 0;
    for (const int i : channels_of(axes))
        if (!kept(i).data[cmd::R]) without |= 1u << i;
    if (without == 0) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: the multiple of {} is not set. Nothing was written. Call SetMultiple, SetRange or "
                            "SetMaxSpeed first.",
                            who, axes_text(without)));
}

Result<void> Driver::write(unsigned axes, const Parameter& parameter, std::int64_t value) {
    MOTIONRACK_CHECK(check(axes, parameter, value));
    put(axes, parameter, value);
    return {};
}

Result<void> Driver::write_switch(const char* who, unsigned axes, int number, Field bits, int n, int max_n,
                                  const char* meanings) {
    MOTIONRACK_CHECK(check_axes(axes, who));
    MOTIONRACK_CHECK(check_switch(who, n, max_n, meanings));
    set_mode(axes, number, bits, static_cast<unsigned>(n));
    return {};
}

// ---- initial

void Driver::RESET() {
    port_.write(reg::WR0, reset_word);
    interrupt_.pass(reset_time);
    kept_ = {};
    outputs_ = 0;
    path_axes_ = 0;
    path_mode_ = 0;
    vector_axes_ = 1;
    chain_ = {};
    pattern_ = {};
    pieces_ = {};
}

void Driver::initialise() {
    RESET();
    for (int number = 1; number <= 3; ++number) write_mode(xyzu, number, 0);
    write_outputs(0);
    write_path_mode(0);
    put(xyzu, param::AO, 0);
    put(xyzu, param::LP, 0);
    put(xyzu, param::EP, 0);
    EnableDeceleration(false);
}

Result<void> Driver::SetPulseMode(unsigned axes, int mode) {
    MOTIONRACK_CHECK(check_axes(axes, "SetPulseMode"));
    MOTIONRACK_CHECK(check_switch("SetPulseMode", mode, 1, "0 two pulse trains, 1 pulse and direction"));
    MOTIONRACK_CHECK(check_standing(axes, "SetPulseMode"));
    set_mode(axes, 2, field("WR2", "PLSMD"), static_cast<unsigned>(mode));
    return {};
}

Result<void> Driver::SetPulseLevels(unsigned axes, bool negative, bool direction_high) {
    MOTIONRACK_CHECK(check_axes(axes, "SetPulseLevels"));
    MOTIONRACK_CHECK(check_standing(axes, "SetPulseLevels"));
    set_mode(axes, 2, field("WR2", "PLSL"), negative);
    set_mode(axes, 2, field("WR2", "DIRL"), direction_high);
    return {};
}

Result<void> Driver::SetMultiple(unsigned axes, std::int64_t multiple) {
    if (multiple < 1 || multiple > max_multiple)
        return fail(ErrorKind::refused,
                    fmt::format("SetMultiple: the multiple is {}; it must be 1 to {}. Nothing was written.", multiple,
                                max_multiple));
    MOTIONRACK_CHECK(check_axes(axes, "SetMultiple"));
    MOTIONRACK_CHECK(check_standing(axes, "SetMultiple"));
    return WriteRange(axes, range_of_multiple(multiple));
}

Result<void> Driver::SetRange(unsigned axes, std::int64_t range) {
    MOTIONRACK_CHECK(check(axes, param::R, range));
    MOTIONRACK_CHECK(check_standing(axes, "SetRange"));
    return WriteRange(axes, range);
}

Result<void> Driver::SetMaxSpeed(unsigned axes, std::int64_t pulses_a_second) {
    if (pulses_a_second < 1 || pulses_a_second > max_pulse_rate)
        return fail(ErrorKind::refused,
                    fmt::format("SetMaxSpeed: the speed is {} pulses/s, but the chip makes 1 to {}. Nothing was "
                                "written.",
                                pulses_a_second, max_pulse_rate));
    return SetMultiple(axes, rules::ceil_div(pulses_a_second, param::V.max));
}

Result<void> Driver::WriteRange(unsigned axes, std::int64_t range) {
    MOTIONRACK_CHECK(write(axes, param::vector_range, range));
    for (const int i : channels_of(axes)) kept(i).own_range = range;
    return {};
}

double Driver::multiple(int axis) const {
    const std::int64_t range = kept(axis).own_range;
    return range == 0 ? 0 : static_cast<double>(rules::sclk_hz) / static_cast<double>(range);
}

// ---- speeds and ramps

Result<void> Driver::SetSV(unsigned axes, std::int64_t value) {
    return write(axes, param::SV, value);
}
Result<void> Driver::SetV(unsigned axes, std::int64_t value) {
    return write(axes, param::V, value);
}
Result<void> Driver::SetA(unsigned axes, std::int64_t value) {
    return write(axes, param::A, value);
}
Result<void> Driver::SetD(unsigned axes, std::int64_t value) {
    return write(axes, param::D, value);
}
Result<void> Driver::SetAA(unsigned axes, std::int64_t value) {
    return write(axes, param::K, value);
}
Result<void> Driver::SetAO(unsigned axes, std::optional<std::int64_t> value) {
    MOTIONRACK_CHECK(write(axes, param::AO, value.value_or(0)));
    for (const int i : channels_of(axes)) kept(i).own_offset = value.has_value();
    return {};
}

Result<void> Driver::Pulse(unsigned axes, std::int64_t pulses) {
    MOTIONRACK_CHECK(check(axes, param::pulses, pulses));
    put(axes, param::pulses, rules::magnitude(pulses));
    for (const int i : channels_of(axes)) kept(i).negative = pulses < 0;
    return {};
}

Result<void> Driver::AutoDec(unsigned axes) {
    MOTIONRACK_CHECK(check_axes(axes, "AutoDec"));
    set_mode(axes, 3, field("WR3", "MANLD"), 0);
    for (const int i : channels_of(axes)) kept(i).manual = false;
    return {};
}

Result<void> Driver::SetDecPoint(unsigned axes, std::int64_t point) {
    MOTIONRACK_CHECK(write(axes, param::DP, point));
    for (const int i : channels_of(axes)) kept(i).dec_point = point;
    return {};
}

Result<void> Driver::ManualDec(unsigned axes, std::int64_t point) {
    MOTIONRACK_CHECK(SetDecPoint(axes, point));
    set_mode(axes, 3, field("WR3", "MANLD"), 1);
    for (const int i : channels_of(axes)) kept(i).manual = true;
    return {};
}

Result<void> Driver::SetAsymmetric(unsigned axes, bool on) {
    MOTIONRACK_CHECK(check_axes(axes, "SetAsymmetric"));
    set_mode(axes, 3, field("WR3", "DSNDE"), on);
    for (const int i : channels_of(axes)) kept(i).asymmetric = on;
    return {};
}

void Driver::SetSCurve(unsigned axes, bool on) {
    set_mode(axes, 3, field("WR3", "SACC"), on);
}

// ---- positions

Result<void> Driver::LPS(unsigned axes, std::int64_t value) {
    MOTIONRACK_CHECK(write(axes, param::LP, value));
    for (const int i : channels_of(axes)) kept(i).from_known = false;
    if (axes & path_axes_) pieces_ = {};  // the start position of its axes is unknown now
    return {};
}
Result<void> Driver::EPS(unsigned axes, std::int64_t value) {
    return write(axes, param::EP, value);
}
Result<void> Driver::SetCompP(unsigned axes, std::int64_t value) {
    return write(axes, param::COMP_PLUS, value);
}
Result<void> Driver::SetCompM(unsigned axes, std::int64_t value) {
    return write(axes, param::COMP_MINUS, value);
}

std::int32_t Driver::ReadLPS(int axis) {
    return static_cast<std::int32_t>(read_data(axis, cmd::READ_LP));
}
std::int32_t Driver::ReadEPS(int axis) {
    return static_cast<std::int32_t>(read_data(axis, cmd::READ_EP));
}
// CV and CA are 16-bit: the chip fetches them to RR6, and the content of RR7 is then undocumented.
std::int32_t Driver::ReadCV(int axis) {
    return static_cast<std::int32_t>(read_data(axis, cmd::READ_CV) & 0xFFFFu);
}
std::int32_t Driver::ReadCA(int axis) {
    return static_cast<std::int32_t>(read_data(axis, cmd::READ_CA) & 0xFFFFu);
}

}  // namespace motionrack::mcx314
