// The twin's register bus: the effects of writes.
#include <algorithm>
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

Twin::Twin(const ChipOptions& options) : options_(options), extended_(options.variant == Variant::mcx314as) {
    reset();
}

void Twin::reset() {
    for (Axis& axis : axes_) {
        Axis fresh;
        fresh.pin = axis.pin;
        fresh.lines = axis.lines;
        fresh.heard = axis.heard;
        fresh.pulse_end = axis.pulse_end;
        fresh.pulse_direction = axis.pulse_direction;
        axis = fresh;
        axis.reg.offset = options_.offset_after_reset;
    }
    selected_ = 1;
    wr4_ = wr5_ = wr6_ = wr7_ = rr6_ = rr7_ = 0;
    chain_ = 0;
    queued_ = decel_enabled_ = path_interrupt_ = step_under_way_ = false;
    pattern_ = {};
    wr0_high_ = 0;
    expls_low_ = 0;
    for (int a = 0; a < axis_count; ++a) compare(a);
}

// ---- writing

void Twin::write(std::uint32_t offset, std::uint16_t value) {
    write_register(offset, value, 0xFFFF);
    act_together();
}

void Twin::write_byte(std::uint32_t port, std::uint8_t value) {
    if (port == 0)
        write(0, static_cast<std::uint16_t>(wr0_high_ << 8 | value));
    else if (port == 1)
        wr0_high_ = value;
    else {
        if (port % 2 == 0)
            write_register(port, value, 0x00FF);
        else
            write_register(port - 1, static_cast<std::uint16_t>(value << 8), 0xFF00);
        act_together();
    }
}

// Writes the bits in `mask` of a register.
void Twin::write_register(std::uint32_t offset, std::uint16_t value, std::uint16_t mask) {
    const auto mixed = [=](std::uint16_t old) { return static_cast<std::uint16_t>((old & ~mask) | (value & mask)); };
    const auto put = [&](std::uint16_t& old) { old = mixed(old); };
    if (pattern_.writable && offset >= 4) return put(pattern_.registers[(offset - 4) / 2]);
    for (int a = 0; a < axis_count && offset >= 2 && offset <= 6; ++a) {
        if (!(selected_ >> a & 1)) continue;
        if (offset == 2) put(axes_[a].wr1);
        if (offset == 4) put(axes_[a].wr2), compare(a);
        if (offset == 6) write_wr3(axes_[a], mixed(axes_[a].wr3));
    }
    if (offset == 0) command(value);
    if (offset == 8) put(wr4_);
    if (offset == 10) put(wr5_);
    if (offset == 12) put(wr6_);
    if (offset == 14) put(wr7_);
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
        if (axes != 0 && code == 0x10) note(selected(), 0x0100);
    } else if (code >= 0x20 && code <= 0x23) {
        drive_command(code, axes);
    } else if (code >= 0x30 && code <= 0x35) {
        path_command(code);
    } else if (code >= 0x36 && code <= 0x39) {
        pattern_command(code);
    } else if (code == 0x3A) {
        if (!ask_step(Segment::by_command)) ++conditions_;
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
        path_interrupt_ = pattern_.interrupt = false;
    } else if (code != 0x0F && !(extended_ && extended_command(code, axes))) {
        ++conditions_;
    }
}

void Twin::pattern_command(int code) {
    if (code == 0x36) pattern_.writable = true;
    if (code == 0x37) pattern_.writable = false;
    if (code == 0x38) {
        pattern_.interrupt = false;
        if (!pattern_.stack()) ++conditions_;
    }
    if (code == 0x39) pattern_.clear();
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
            p.pulses = extended_ ? value : value & 0x0FFF'FFFF;
            break;
        case 0x07:
            p.decel_point = extended_ ? value : value & 0x0FFF'FFFF;
            break;
        case 0x08:
            p.centre = value;
            break;
        case 0x09:
            set_lp(axis, value);
            break;
        case 0x0A:
            set_ep(axis, value);
            break;
        case 0x0B:
            axis.comp_plus = static_cast<std::int32_t>(value);
            set_lp(axis, static_cast<std::uint32_t>(axis.lp));
            set_ep(axis, static_cast<std::uint32_t>(axis.ep));
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

void Twin::drive_command(int code, unsigned axes) {
    for (int a = 0; a < axis_count; ++a) {
        if (!(axes >> a & 1)) continue;
        if (driving(a))
            ++conditions_;
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
    note(a, 0x0010);
}

void Twin::begin_generator(int a, Generator::Kind kind) {
    Axis& axis = axes_[a];
    axis.as.cap = 0;
    Generator gen;
    gen.kind = kind;
    gen.wait = 2;
    gen.manual = bit(axis.wr3, 0);
    gen.own_decel = bit(axis.wr3, 1);
    gen.s_curve = bit(axis.wr3, 2);
    gen.range = gen.range_now = used_range(axis.reg);
    gen.constant = drive_speed(axis) <= used_start_speed(axis.reg);
    gen.speed = gen.constant ? drive_speed(axis) : used_start_speed(axis.reg);
    gen.no_triangle = kind == Generator::Kind::fixed && (axis.as.em6 & 0x08) && !gen.manual && !gen.s_curve;
    axes_[a].gen = gen;
}

Segment Twin::captured(int code) const {
    Segment s;
    s.kind = code <= 0x31   ? Segment::Kind::line
             : code == 0x32 ? Segment::Kind::arc_cw
             : code == 0x33 ? Segment::Kind::arc_ccw
                            : Segment::Kind::pattern;
    s.count = code == 0x31 || code == 0x35 ? 3 : 2;
    s.constant_speed = wr5_ >> 8 & 3;
    s.steps = (bit(wr5_, 11) ? Segment::by_wire : 0) | (bit(wr5_, 12) ? Segment::by_command : 0);
    const auto coordinate = [this](std::uint32_t v) {
        if (extended_) return std::clamp<std::int64_t>(static_cast<std::int32_t>(v), -2'147'483'646, 2'147'483'646);
        return static_cast<std::int64_t>((v & 0xFF'FFFF) ^ 0x80'0000) - 0x80'0000;
    };
    for (int i = 0; i < 3; ++i) {
        s.axis[i] = wr5_ >> (2 * i) & 3;
        s.finish[i] = coordinate(axes_[s.axis[i]].reg.pulses);
        if (i < 2) s.centre[i] = coordinate(axes_[s.axis[i]].reg.centre);
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
    const bool no_location = chain_ != 0 && (queued_ || path_.is_pattern() || segment.kind == Segment::Kind::pattern);
    if (segment.names_an_axis_twice() || any_busy(segment) || no_location) {
        ++conditions_;
    } else if (chain_ != 0) {
        queued_ = true;
        queue_ = segment;
        for (int a = 0; a < axis_count; ++a)
            if ((segment.mask() & ~chain_) >> a & 1) axes_[a].finished = axes_[a].causes = 0, note(a, 0x0010);
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
    step_under_way_ = false;
    for (int a = 0; a < axis_count; ++a)
        if (chain_ >> a & 1) axes_[a].finished = axes_[a].causes = 0;
    begin_generator(master_, Generator::Kind::path);
    begin_segment(segment);
    check_final(master_);
    for (int a = 0; a < axis_count; ++a)
        if (chain_ >> a & 1) note(a, 0x0010);
}

void Twin::free_held(unsigned axes) {
    for (int a = 0; a < axis_count; ++a) {
        if (!(axes >> a & 1)) continue;
        axes_[a].hold = false;
        axes_[a].finished = 0;
        axes_[a].as.error = false;
    }
    for (int a = 0; a < axis_count; ++a) {
        const int code = axes_[a].held_command;
        if (!(axes >> a & 1) || code == 0) continue;
        axes_[a].held_command = 0;
        if (code < 0x30) {
            driving(a) ? void(++conditions_) : start_drive(a, code);
        } else {
            chain_ != 0 || any_busy(axes_[a].held_segment) ? void(++conditions_) : start_path(axes_[a].held_segment);
        }
    }
}

void Twin::ask_stop(unsigned axes, bool immediate) {
    for (int a = 0; a < axis_count; ++a) {
        if (!(axes >> a & 1)) continue;
        axes_[a].held_command = 0;
        if (axes_[a].as.hmst != 0) axes_[a].as.cancelled = true;
        Generator& gen = axes_[chain_ >> a & 1 ? master_ : a].gen;
        if (gen.kind == Generator::Kind::idle) continue;
        (immediate ? gen.ask_immediate : gen.ask_decelerating) = true;
    }
}

}  // namespace motionrack::mcx314::twin
