// The source's functions, and readings extended beyond 24 bits.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>

namespace motionrack::ioflex02 {

namespace {

constexpr std::uint16_t capture = field("STROBE", "CAPTURE").mask, clear_time = field("STROBE", "CLEAR_TIME").mask;
constexpr std::int64_t turn_24 = 0x1000000;
constexpr Field REVERSED = mode::REVERSED, EDGES = mode::EDGES, INDEX_LOW = mode::INDEX_LOW, FILTER = mode::FILTER;

std::uint32_t of_axis(std::uint32_t first, std::size_t axis) {
    return first + 4 * static_cast<std::uint32_t>(axis);
}

/// Returns the counts per line of the encoder, 1, 2 or 4, for a word MODE.
int edges_of(std::uint16_t mode_word) {
    const unsigned edges = EDGES.get(mode_word);
    return edges == 0 ? 4 : edges == 1 ? 2 : 1;
}

}  // namespace

void Flex2Pos::Init(std::uint16_t Addr) {
    Flex02::Init(Addr);
    Configure(own_image().empty() ? position_image() : own_image());
}

void Flex2Pos::Configure(std::span<const std::uint8_t> image) {
    Flex02::Configure(image);
    forget();
}

/// The card's counters are at or near 0: the extended values begin with them.
void Flex2Pos::forget() {
    ticks_ = 0;
    last_time_ = 0;
    raw_ = {};
    position_ = {};
    zero_ = {};
    host_then_ = now();
}

// ---- extension beyond 24 bits

/// The host's clock only determines how often the counter wrapped.
std::int64_t Flex2Pos::carry_time(std::uint32_t time, bool cleared) {
    const std::int64_t gone = (static_cast<std::int64_t>(time) - last_time_) & mask_24;
    const Instant host = now();
    const std::int64_t host_ticks = (host - host_then_) / time_tick;
    const std::int64_t turns = std::max<std::int64_t>(0, (host_ticks - gone + turn_24 / 2) / turn_24);
    ticks_ += gone + turns * turn_24;
    last_time_ = cleared ? 0 : time;
    host_then_ = host;
    return ticks_;
}

void Flex2Pos::carry_axis(std::size_t axis, std::uint32_t position, std::uint32_t raw) {
    Carried& carried = raw_[axis];
    const std::int64_t moved = signed24(std::int64_t{raw} - carried.last);
    carried.value += moved;
    carried.last = raw;
    const std::uint32_t zero = (raw - position) & mask_24;
    position_[axis] = zero == zero_[axis] ? position_[axis] + moved : signed24(position);
    zero_[axis] = zero;
}

Reading Flex2Pos::read_captured() {
    Reading out;
    if (!ok()) return out;
    out.ticks = carry_time(get24(offset("TIME_L")), false);
    for (std::size_t i = 0; i < axis_count; ++i) {
        const std::uint32_t position = get24(of_axis(offset("POS0_L"), i));
        const std::uint32_t raw = get24(of_axis(offset("RAW0_L"), i));
        carry_axis(i, position, raw);
        out.axes[i].position = position_[i];
        out.axes[i].raw = raw_[i].value;
        out.axes[i].age = get24(of_axis(offset("AGE0_L"), i));
    }
    const unsigned down = get(offset("DOWN"));
    for (std::size_t i = 0; i < axis_count; ++i) out.axes[i].down = (down >> i & 1) != 0;
    return out;
}

Reading Flex2Pos::read() {
    put(offset("STROBE"), capture);
    return read_captured();
}

std::array<AxisDetail, axis_count> Flex2Pos::read_details() {
    std::array<AxisDetail, axis_count> out;
    if (!ok()) return out;
    const Reading reading = read();
    for (std::size_t i = 0; i < axis_count; ++i) {
        AxisDetail& d = out[i];
        d.at = reading.axes[i];
        d.ticks = reading.ticks;
        put(offset("AXIS"), static_cast<std::uint16_t>(i));
        const std::uint16_t lines = get(offset("LINES"));
        d.a = field("LINES", "A").test(lines);
        d.b = field("LINES", "B").test(lines);
        d.z = field("LINES", "Z").test(lines);
        d.cal = field("LINES", "CAL").test(lines);
        d.edges_a = get(offset("EDGES_A"));
        d.edges_b = get(offset("EDGES_B"));
        d.indexes = get(offset("INDEXES"));
        d.index_at = d.at.raw - signed24(std::int64_t{raw_[i].last} - get24(offset("INDEX_AT_L")));
        d.illegal = get(offset("ILLEGAL"));
        d.illegal_at = d.at.raw - signed24(std::int64_t{raw_[i].last} - get24(offset("ILLEGAL_AT_L")));
        d.edges = edges_of(get(offset("MODE_NOW")));
    }
    return out;
}

// ---- the source's functions

std::int32_t Flex2Pos::ReadTime() {
    put(offset("STROBE"), capture);
    const std::uint32_t time = get24(offset("TIME_L"));
    if (ok()) carry_time(time, false);
    return static_cast<std::int32_t>(time);
}

std::int32_t Flex2Pos::ReadTimeClr() {
    put(offset("STROBE"), capture | clear_time);
    const std::uint32_t time = get24(offset("TIME_L"));
    if (ok()) carry_time(time, true);
    return static_cast<std::int32_t>(time);
}

std::int32_t Flex2Pos::read_position(std::uint32_t axis) {
    put(offset("STROBE"), capture);
    return signed24(get24(of_axis(offset("POS0_L"), axis)));
}

void Flex2Pos::ReadTimeClrPosition(std::int32_t& Time, std::int32_t& Pos0, std::int32_t& Pos1, std::int32_t& Pos2,
                                   std::int32_t& Pos3) {
    Time = ReadTimeClr();
    Pos0 = signed24(get24(offset("POS0_L")));
    Pos1 = signed24(get24(offset("POS1_L")));
    Pos2 = signed24(get24(offset("POS2_L")));
    Pos3 = signed24(get24(offset("POS3_L")));
}

void Flex2Pos::WriteCmd(tIOFlexCmd Cmd0, tIOFlexCmd Cmd1, tIOFlexCmd Cmd2, tIOFlexCmd Cmd3) {
    std::uint16_t word = 0;
    word = field("CMD", "CMD0").set(word, Cmd0);
    word = field("CMD", "CMD1").set(word, Cmd1);
    word = field("CMD", "CMD2").set(word, Cmd2);
    word = field("CMD", "CMD3").set(word, Cmd3);
    put(offset("CMD"), word);
}

void Flex2Pos::WriteCmdAxis(int axis, tIOFlexCmd Cmd) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < axis_count);
    const Field keep = field("CMD", "KEEP");
    const unsigned others = keep.mask & ~(0x100u << axis);
    put(offset("CMD"), static_cast<std::uint16_t>(others | unsigned{Cmd} << (2 * axis)));
}

void Flex2Pos::ReadSts(tIOFlexSts& Sts0, tIOFlexSts& Sts1, tIOFlexSts& Sts2, tIOFlexSts& Sts3) {
    const std::uint16_t word = get(offset("STS"));
    Sts0 = field("STS", "CAL0").test(word) ? sCal : sNotCal;
    Sts1 = field("STS", "CAL1").test(word) ? sCal : sNotCal;
    Sts2 = field("STS", "CAL2").test(word) ? sCal : sNotCal;
    Sts3 = field("STS", "CAL3").test(word) ? sCal : sNotCal;
}

// ---- extended interface

void Flex2Pos::calibrate(const std::array<tIOFlexCmd, axis_count>& commands) {
    WriteCmd(commands[0], commands[1], commands[2], commands[3]);
}

std::array<tIOFlexSts, axis_count> Flex2Pos::statuses() {
    std::array<tIOFlexSts, axis_count> out{};
    ReadSts(out[0], out[1], out[2], out[3]);
    return out;
}

motionrack::Result<void> Flex2Pos::wait_calibrated(int axis, Duration timeout) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < axis_count);
    if (!ok()) return fail(ErrorKind::machine, why());
    const Instant until = later(now(), timeout);
    while (statuses()[static_cast<std::size_t>(axis)] != sCal) {
        if (stop_requested())
            return fail(ErrorKind::stopped,
                        fmt::format("The wait for the calibration of axis {} was stopped by the user.", axis));
        if (now() >= until)
            return fail(
                ErrorKind::machine,
                fmt::format("Axis {} was not calibrated within {:.3f} s: no index pulse. Move the axis over its zero "
                            "position, and check lines Z and Cal.",
                            axis, to_seconds(timeout)));
        pass(milliseconds(1));
    }
    return {};
}

motionrack::Result<void> Flex2Pos::set_mode(int axis, const AxisMode& wanted) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < axis_count);
    if (!ok()) return fail(ErrorKind::machine, why());
    if (wanted.edges != 4 && wanted.edges != 2 && wanted.edges != 1)
        return fail(ErrorKind::refused,
                    fmt::format("Axis {} has {} edges per line; it must be 4, 2 or 1. Nothing was written.", axis,
                                wanted.edges));
    if (wanted.filter < 0 || wanted.filter > 15)
        return fail(
            ErrorKind::refused,
            fmt::format("The filter of axis {} is {}; it must be 0 to 15. Nothing was written.", axis, wanted.filter));
    std::uint16_t word = 0;
    word = REVERSED.set(word, wanted.reversed);
    word = EDGES.set(word, wanted.edges == 4 ? 0u : wanted.edges == 2 ? 1u : 2u);
    word = INDEX_LOW.set(word, wanted.index_low);
    word = FILTER.set(word, static_cast<unsigned>(wanted.filter));
    put(offset("AXIS"), static_cast<std::uint16_t>(axis));
    put(offset("MODE"), word);
    return {};
}

AxisMode Flex2Pos::mode(int axis) {
    MOTIONRACK_ASSERT(axis >= 0 && axis < axis_count);
    put(offset("AXIS"), static_cast<std::uint16_t>(axis));
    const std::uint16_t word = get(offset("MODE_NOW"));
    return {REVERSED.test(word), edges_of(word), INDEX_LOW.test(word), static_cast<int>(FILTER.get(word))};
}

void Flex2Pos::clear_errors() {
    put(offset("CONTROL"), field("CONTROL", "CLEAR_ERRORS").mask);
}

void Flex2Pos::reset() {
    if (!ok()) return;
    read();
    put(offset("CONTROL"), field("CONTROL", "RESET").mask);
    last_time_ = 0;
    for (std::size_t i = 0; i < axis_count; ++i) raw_[i].last = 0;
    position_ = {};
    zero_ = {};
}

}  // namespace motionrack::ioflex02
