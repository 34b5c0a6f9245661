// The twin's register bus: what a write does and what a read shows.
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

namespace {
constexpr bool bit(std::uint16_t value, int n) {
    return (value >> n & 1) != 0;
}
}  // namespace

Twin::Twin() {
    reset();
}

void Twin::reset() {
    for (Axis& axis : axes_) {
        const auto pins = axis.pin;
        axis = Axis{};
        axis.pin = pins;
    }
    selected_ = 1;
    wr4_ = wr5_ = wr6_ = wr7_ = rr6_ = rr7_ = 0;
    chain_ = 0;
    queued_ = decel_enabled_ = path_interrupt_ = false;
    for (int a = 0; a < axis_count; ++a) compare(a);
}

// ---- writing
// ----------------------------------------------------------------------------------------------------------------

void Twin::write(std::uint32_t offset, std::uint16_t value) {
    for (int a = 0; a < axis_count && offset >= 2 && offset <= 6; ++a) {
        if (!(selected_ >> a & 1)) continue;
        if (offset == 2) axes_[a].wr1 = value;
        if (offset == 4) axes_[a].wr2 = value, compare(a);
        if (offset == 6) axes_[a].wr3 = value;
    }
    switch (offset) {
        case 0:
            command(value);
            break;
        case 8:
            wr4_ = value;
            break;
        case 10:
            wr5_ = value;
            break;
        case 12:
            wr6_ = value;
            break;
        case 14:
            wr7_ = value;
            break;
        default:
            break;
    }
}

void Twin::command(std::uint16_t value) {
    if (bit(value, 15)) return reset();
    const unsigned axes = value >> 8 & 15;
    const int code = value & 0xFF;
    if (axes != 0) selected_ = axes;
    if (code <= 0x0D) {
        for (int a = 0; a < axis_count; ++a)
            if (axes >> a & 1) data_write(code, axes_[a]), compare(a);
        if (code == 0x06 || code == 0x07 || code == 0x0D)
            for (int a = 0; a < axis_count; ++a)
                if ((axes >> a & 1) && axes_[a].gen.kind == Generator::Kind::fixed) check_final(a);
    } else if (code >= 0x10 && code <= 0x13) {
        if (axes != 0) data_read(code, axes_[selected()]);
    } else if (code >= 0x20 && code <= 0x23) {
        drive_command(code, axes);
    } else if (code >= 0x30 && code <= 0x33) {
        path_command(code);
    } else if (code == 0x24) {
        for (int a = 0; a < axis_count; ++a)
            if (axes >> a & 1) axes_[a].hold = true;
    } else if (code == 0x25) {
        free_held(axes);
    } else if (code == 0x26 || code == 0x27) {
        ask_stop(axes, code == 0x27);
    } else if (code == 0x3B) {
        decel_enabled_ = true;
        if (chain_ != 0) check_final_of_path();
    } else if (code == 0x3C) {
        decel_enabled_ = false;
    } else if (code == 0x3D) {
        path_interrupt_ = false;
    }
}

void Twin::data_write(int code, Axis& axis) {
    const std::uint32_t value = std::uint32_t{wr7_} << 16 | wr6_;
    Parameters& p = axis.reg;
    switch (code) {
        case 0x00:
            p.range = value & 0x00FF'FFFF;
            break;
        case 0x01:
            p.jerk = wr6_;
            break;
        case 0x02:
            p.accel = wr6_;
            break;
        case 0x03:
            p.decel = wr6_;
            break;
        case 0x04:
            p.start_speed = wr6_;
            break;
        case 0x05:
            p.speed = wr6_;
            break;
        case 0x06:
            p.pulses = value & 0x0FFF'FFFF;
            break;
        case 0x07:
            p.decel_point = value & 0x0FFF'FFFF;
            break;
        case 0x08:
            p.centre = value;
            break;
        case 0x09:
            axis.lp = static_cast<std::int32_t>(value);
            break;
        case 0x0A:
            axis.ep = static_cast<std::int32_t>(value);
            break;
        case 0x0B:
            axis.comp_plus = static_cast<std::int32_t>(value);
            break;
        case 0x0C:
            axis.comp_minus = static_cast<std::int32_t>(value);
            break;
        default:
            p.offset = wr6_;
            break;
    }
}

void Twin::data_read(int code, const Axis& axis) {
    const Generator& gen = axis.gen;
    std::uint32_t value = 0;
    switch (code) {
        case 0x10:
            value = static_cast<std::uint32_t>(axis.lp);
            break;
        case 0x11:
            value = static_cast<std::uint32_t>(axis.ep);
            break;
        case 0x12:
            value = gen.kind == Generator::Kind::idle ? 0 : static_cast<std::uint32_t>(gen.speed);
            break;
        default:
            value = static_cast<std::uint32_t>(gen.rate);
            break;
    }
    rr6_ = static_cast<std::uint16_t>(value);
    rr7_ = static_cast<std::uint16_t>(value >> 16);
}

// ---- commands
// ---------------------------------------------------------------------------------------------------------------

void Twin::drive_command(int code, unsigned axes) {
    for (int a = 0; a < axis_count; ++a) {
        if (!(axes >> a & 1)) continue;
        if (driving(a))
            ++ignored_;
        else if (axes_[a].hold)
            axes_[a].held_command = code;
        else
            start_drive(a, code);
    }
}

void Twin::start_drive(int a, int code) {
    axes_[a].direction = code & 1 ? -1 : +1;
    begin_generator(a, code <= 0x21 ? Generator::Kind::fixed : Generator::Kind::continuous);
    axes_[a].finished = axes_[a].causes = 0;
    check_final(a);
}

void Twin::begin_generator(int a, Generator::Kind kind) {
    const Axis& axis = axes_[a];
    Generator gen;
    gen.kind = kind;
    gen.wait = 2;
    gen.manual = bit(axis.wr3, 0);
    gen.own_decel = bit(axis.wr3, 1);
    gen.s_curve = bit(axis.wr3, 2);
    gen.range = gen.range_now = used_range(axis.reg);
    gen.constant = used_speed(axis.reg) <= used_start_speed(axis.reg);
    gen.speed = gen.constant ? used_speed(axis.reg) : used_start_speed(axis.reg);
    axes_[a].gen = gen;
}

Segment Twin::captured(int code) const {
    Segment s;
    s.kind = code <= 0x31 ? Segment::Kind::line : code == 0x32 ? Segment::Kind::arc_cw : Segment::Kind::arc_ccw;
    s.count = code == 0x31 ? 3 : 2;
    s.constant_speed = wr5_ >> 8 & 3;
    const auto signed24 = [](std::uint32_t v) {
        return static_cast<std::int64_t>((v & 0xFF'FFFF) ^ 0x80'0000) - 0x80'0000;
    };
    for (int i = 0; i < 3; ++i) {
        s.axis[i] = wr5_ >> (2 * i) & 3;
        s.finish[i] = signed24(axes_[s.axis[i]].reg.pulses);
        if (i < 2) s.centre[i] = signed24(axes_[s.axis[i]].reg.centre);
    }
    return s;
}

bool Twin::any_busy(const Segment& segment) const {
    for (int a = 0; a < axis_count; ++a)
        if ((segment.mask() >> a & 1) && driving(a) && !(chain_ >> a & 1)) return true;
    return false;
}

void Twin::path_command(int code) {
    path_interrupt_ = false;
    const Segment segment = captured(code);
    const bool second_in_queue = chain_ != 0 && queued_;
    if (segment.names_an_axis_twice() || any_busy(segment) || second_in_queue) {
        ++ignored_;
    } else if (chain_ != 0) {
        queued_ = true;
        queue_ = segment;
        for (int a = 0; a < axis_count; ++a)
            if ((segment.mask() & ~chain_) >> a & 1) axes_[a].finished = axes_[a].causes = 0;
        chain_ |= segment.mask();
    } else if (axes_[segment.axis[0]].hold) {
        axes_[segment.axis[0]].held_command = code;
        axes_[segment.axis[0]].held_segment = segment;
    } else {
        start_path(segment);
    }
}

void Twin::start_path(const Segment& segment) {
    chain_ = segment.mask();
    master_ = segment.axis[0];
    queued_ = false;
    path_stepped_ = 1;
    for (int a = 0; a < axis_count; ++a)
        if (chain_ >> a & 1) axes_[a].finished = axes_[a].causes = 0;
    begin_generator(master_, Generator::Kind::path);
    begin_segment(segment);
    check_final(master_);
}

void Twin::free_held(unsigned axes) {
    for (int a = 0; a < axis_count; ++a) {
        if (!(axes >> a & 1)) continue;
        axes_[a].hold = false;
        axes_[a].finished = 0;
    }
    for (int a = 0; a < axis_count; ++a) {
        const int code = axes_[a].held_command;
        if (!(axes >> a & 1) || code == 0) continue;
        axes_[a].held_command = 0;
        if (code < 0x30) {
            driving(a) ? void(++ignored_) : start_drive(a, code);
        } else {
            chain_ != 0 || any_busy(axes_[a].held_segment) ? void(++ignored_) : start_path(axes_[a].held_segment);
        }
    }
}

void Twin::ask_stop(unsigned axes, bool immediate) {
    for (int a = 0; a < axis_count; ++a) {
        if (!(axes >> a & 1)) continue;
        axes_[a].held_command = 0;
        Generator& gen = axes_[chain_ >> a & 1 ? master_ : a].gen;
        if (gen.kind == Generator::Kind::idle) continue;
        (immediate ? gen.ask_immediate : gen.ask_decelerating) = true;
    }
}

// ---- reading
// ----------------------------------------------------------------------------------------------------------------

int Twin::selected() const {
    int a = 0;
    while (a < axis_count - 1 && !(selected_ >> a & 1)) ++a;
    return a;
}

std::uint16_t Twin::read(std::uint32_t offset) {
    const std::uint16_t value = peek(offset);
    if (offset == 6) axes_[selected()].flags = 0;
    return value;
}

std::uint16_t Twin::peek(std::uint32_t offset) const {
    switch (offset) {
        case 0:
            return main_status();
        case 2:
            return status1(selected());
        case 4:
            return status2(selected());
        case 6:
            return axes_[selected()].flags;
        case 8:
            return static_cast<std::uint16_t>(levels(0) | levels(1) << 8);
        case 10:
            return static_cast<std::uint16_t>(levels(2) | levels(3) << 8);
        case 12:
            return rr6_;
        case 14:
            return rr7_;
        default:
            return 0;
    }
}

std::uint16_t Twin::main_status() const {
    unsigned v = 0;
    for (int a = 0; a < axis_count; ++a) {
        const Axis& axis = axes_[a];
        const bool out_of_position =
            bit(axis.wr2, 15) && axis.pin[static_cast<int>(Pin::in_position)] != bit(axis.wr2, 14);
        if (driving(a) || (axis.waits_position && out_of_position)) v |= 1u << a;
        if ((status2(a) & 0x3F) != 0 || (axis.finished & 0xF000) != 0) v |= 1u << (4 + a);
    }
    if (chain_ != 0) {
        v |= 1u << 8;
        if (!queued_) v |= 1u << 9;
        v |= static_cast<unsigned>(path_.zone()) << 10;
    }
    return static_cast<std::uint16_t>(v);
}

std::uint16_t Twin::status1(int a) const {
    const Axis& axis = axes_[a];
    const Generator& gen = axis.gen;
    const std::int32_t counter = bit(axis.wr2, 5) ? axis.ep : axis.lp;
    unsigned v = axis.finished;
    if (counter >= axis.comp_plus) v |= 1u << 0;
    if (counter < axis.comp_minus) v |= 1u << 1;
    if (gen.kind != Generator::Kind::idle) {
        v |= gen.ramp > 0 ? 1u << 2 : gen.ramp < 0 ? 1u << 4 : 1u << 3;
        if (gen.s_curve && gen.ramp != 0) v |= 1u << (5 + static_cast<int>(gen.phase));
    }
    return static_cast<std::uint16_t>(v);
}

std::uint16_t Twin::status2(int a) const {
    const Axis& axis = axes_[a];
    unsigned v = 0;
    if (beyond_software_limit(axis)) v |= axis.direction > 0 ? 1u << 0 : 1u << 1;
    if (axis.pin[static_cast<int>(Pin::limit_plus)] == bit(axis.wr2, 3)) v |= 1u << 2;
    if (axis.pin[static_cast<int>(Pin::limit_minus)] == bit(axis.wr2, 4)) v |= 1u << 3;
    if (bit(axis.wr2, 13) && axis.pin[static_cast<int>(Pin::alarm)] == bit(axis.wr2, 12)) v |= 1u << 4;
    if (!emgn_) v |= 1u << 5;
    return static_cast<std::uint16_t>(v);
}

// RR4 and RR5: eight input levels of one axis.
std::uint16_t Twin::levels(int a) const {
    unsigned v = 0;
    for (int i = 0; i < 8; ++i) v |= static_cast<unsigned>(axes_[a].pin[i]) << i;
    return static_cast<std::uint16_t>(v);
}

}  // namespace motionrack::mcx314::twin
