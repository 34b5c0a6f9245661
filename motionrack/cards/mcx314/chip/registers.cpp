// The bus: what a write does and what a read shows.
#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

namespace {
enum Offset : std::uint32_t { r0 = 0, r1 = 2, r2 = 4, r3 = 6, r4 = 8, r5 = 10, r6 = 12, r7 = 14 };
}  // namespace

void Chip::reset() {
    for (int a = 0; a < axes_of_chip; ++a) {
        Axis& axis = state_.axis[a];
        if (driving(a)) law_changed(a);
        Axis fresh;
        fresh.levels = axis.levels;
        fresh.count = axis.count;
        fresh.made = axis.made;
        fresh.watch = axis.watch;
        fresh.pulses_wanted = axis.pulses_wanted;
        fresh.outputs_wanted = axis.outputs_wanted;
        fresh.encoder_lines = axis.encoder_lines;
        fresh.shown = axis.shown;
        fresh.mark = axis.mark;
        fresh.told_rate = axis.told_rate;
        axis = fresh;
        set_encoder_position(a, 0);
        set_wants(a);
        watch_encoder(a);
    }
    state_.selected = 1;
    state_.wr4 = state_.wr5 = state_.wr6 = state_.wr7 = state_.rr6 = state_.rr7 = 0;
    state_.chain = state_.working = state_.in_place = 0;
    state_.queued = state_.decel_enabled = state_.path_interrupt = false;
    for (int a = 0; a < axes_of_chip; ++a) compare(a);
    update_outputs();
}

// ---- writing ------------------------------------------------------------------------------------------------------------------

void Chip::write(std::uint32_t offset, std::uint16_t value) {
    const Instant now = kernel_.now();
    catch_up(now);
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(state_.selected >> a & 1u)) continue;
        Axis& axis = state_.axis[a];
        if (offset == r1) {
            compare(a);  // the counter has moved uncompared while nothing was enabled: only what comes from now on counts
            axis.wr1 = value;
        }
        if (offset == r2) {
            const std::int32_t ep_now = encoder_position(axis, a);
            axis.wr2 = value;
            set_encoder_position(a, ep_now);  // the edge ratio may have changed
            compare(a);
        }
        if (offset == r3) axis.wr3 = value;
        if (offset == r1 || offset == r2) {
            set_wants(a);
            watch_encoder(a);
        }
    }
    switch (offset) {
        case r0: command(value); break;
        case r4:
            state_.wr4 = value;
            update_outputs();
            break;
        case r5: state_.wr5 = value; break;
        case r6: state_.wr6 = value; break;
        case r7: state_.wr7 = value; break;
        default: break;
    }
    // Whatever changed: the next working tick of every generator is worked in full.
    for (Axis& axis : state_.axis) {
        axis.gen.look = true;
        axis.gen.special_known = false;
    }
    settle(now);
}

void Chip::command(std::uint16_t value) {
    if (bit(value, 15)) return reset();
    const int code = value & 0xFF;
    const unsigned axes = value >> 8 & 0xFu;
    if (axes != 0) state_.selected = static_cast<std::uint16_t>(axes);
    auto each = [axes](auto&& call) {
        for (int a = 0; a < axes_of_chip; ++a)
            if (axes >> a & 1u) call(a);
    };
    if (code <= 0x0D) {
        each([&](int a) { data_write(code, a); });
        if (code == 0x06 || code == 0x07 || code == 0x0D)
            each([&](int a) {
                if (state_.axis[a].gen.drive == Drive::fixed) check_final(a);
            });
    } else if (code == 0x0F) {
    } else if (code >= 0x10 && code <= 0x13) {
        if (axes != 0) data_read(code, first_selected());
    } else if (code >= 0x20 && code <= 0x23) {
        drive_command(code, axes);
    } else if (code >= 0x30 && code <= 0x33) {
        path_command(code);
    } else if (code == 0x24) {
        each([&](int a) { state_.axis[a].hold = true; });
    } else if (code == 0x25) {
        free_held(axes);
    } else if (code == 0x26 || code == 0x27) {
        ask_stop(axes, code == 0x27);
    } else if (code == 0x3B) {
        state_.decel_enabled = true;
        if (state_.chain != 0) check_final(state_.master);
    } else if (code == 0x3C) {
        state_.decel_enabled = false;
    } else if (code == 0x3D) {
        state_.path_interrupt = false;
    } else {
        kernel_.report(id_, unknown_command, code);
    }
}

void Chip::data_write(int code, int a) {
    const std::uint32_t value = std::uint32_t{state_.wr7} << 16 | state_.wr6;
    Axis& axis = state_.axis[a];
    switch (code) {
        case 0x00: axis.range = value & 0x00FF'FFFFu; break;
        case 0x01: axis.jerk = state_.wr6; break;
        case 0x02: axis.accel = state_.wr6; break;
        case 0x03: axis.decel = state_.wr6; break;
        case 0x04: axis.start_speed = state_.wr6; break;
        case 0x05: axis.speed = state_.wr6; break;
        case 0x06: axis.pulses = value & 0x0FFF'FFFFu; break;
        case 0x07: axis.decel_point = value & 0x0FFF'FFFFu; break;
        case 0x08: axis.centre = value & 0x00FF'FFFFu; break;
        case 0x09: axis.lp = static_cast<std::int32_t>(value); break;
        case 0x0A: set_encoder_position(a, static_cast<std::int32_t>(value)); break;
        case 0x0B: axis.comp_plus = static_cast<std::int32_t>(value); break;
        case 0x0C: axis.comp_minus = static_cast<std::int32_t>(value); break;
        default: axis.offset = state_.wr6; break;
    }
    if (code >= 0x09 && code <= 0x0C) {
        compare(a);
        watch_encoder(a);
    }
}

void Chip::data_read(int code, int a) {
    const Axis& axis = state_.axis[a];
    std::uint32_t value = 0;
    switch (code) {
        case 0x10: value = static_cast<std::uint32_t>(axis.lp); break;
        case 0x11: value = static_cast<std::uint32_t>(encoder_position(axis, a)); break;
        case 0x12: value = axis.gen.drive == Drive::idle ? 0 : static_cast<std::uint32_t>(axis.gen.speed); break;
        default: value = static_cast<std::uint32_t>(axis.gen.rate); break;
    }
    state_.rr6 = static_cast<std::uint16_t>(value);
    state_.rr7 = static_cast<std::uint16_t>(value >> 16);
}

// ---- drive commands -------------------------------------------------------------------------------------------------------------

bool Chip::driving(int a) const { return state_.axis[a].gen.drive != Drive::idle || (state_.chain >> a & 1u) != 0; }

void Chip::drive_command(int code, unsigned axes) {
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(axes >> a & 1u)) continue;
        if (driving(a))
            kernel_.report(id_, drive_ignored, code, a);
        else if (state_.axis[a].hold)
            state_.axis[a].held_command = code;
        else
            start_drive(a, code);
    }
}

void Chip::start_drive(int a, int code) {
    state_.axis[a].direction = code & 1 ? -1 : 1;
    begin_generator(a, code <= 0x21 ? Drive::fixed : Drive::continuous);
    state_.axis[a].finished = state_.axis[a].causes = 0;
    check_final(a);
    law_changed(a);
}

void Chip::begin_generator(int a, Drive drive) {
    Axis& axis = state_.axis[a];
    Generator gen;
    gen.drive = drive;
    gen.wait = rules::start_ticks;
    gen.manual = bit(axis.wr3, 0);
    gen.own_deceleration = bit(axis.wr3, 1);
    gen.s_curve = bit(axis.wr3, 2);
    gen.range = gen.range_now = rules::used_range(axis.range);
    const std::int64_t v = rules::used_speed(axis.speed), sv = rules::used_speed(axis.start_speed);
    gen.constant = v <= sv;
    gen.speed = std::min(v, sv);
    gen.at = state_.tick;
    axis.gen = gen;
    state_.working |= 1u << a;
}

PathCommand Chip::captured(int code) const {
    PathCommand command;
    command.code = code;
    command.count = code == 0x31 ? 3 : 2;
    command.vector_speed = state_.wr5 >> 8 & 3;
    for (int i = 0; i < 3; ++i) {
        command.axis[i] = state_.wr5 >> (2 * i) & 3;
        command.finish[i] = rules::signed24(state_.axis[command.axis[i]].pulses);
        if (i < 2) command.centre[i] = rules::signed24(state_.axis[command.axis[i]].centre);
    }
    return command;
}

bool Chip::any_busy(const PathCommand& command) const {
    for (int a = 0; a < axes_of_chip; ++a)
        if ((command.mask() >> a & 1u) && driving(a) && !(state_.chain >> a & 1u)) return true;
    return false;
}

void Chip::path_command(int code) {
    state_.path_interrupt = false;
    const PathCommand command = captured(code);
    if (command.names_an_axis_twice() || any_busy(command) || (state_.chain != 0 && state_.queued)) {
        kernel_.report(id_, path_ignored, code);
    } else if (state_.chain != 0) {
        state_.queued = true;
        state_.queue = command;
        for (int a = 0; a < axes_of_chip; ++a)
            if ((command.mask() & ~state_.chain) >> a & 1u) state_.axis[a].finished = state_.axis[a].causes = 0;
        state_.chain |= command.mask();
    } else if (Axis& first = state_.axis[command.axis[0]]; first.hold) {
        first.held_command = code;
        first.held_path = command;
    } else {
        start_path(command);
    }
}

void Chip::start_path(const PathCommand& command) {
    state_.chain = command.mask();
    state_.master = command.axis[0];
    state_.queued = false;
    state_.stepped = 1;
    for (int a = 0; a < axes_of_chip; ++a)
        if (state_.chain >> a & 1u) state_.axis[a].finished = state_.axis[a].causes = 0;
    begin_generator(state_.master, Drive::path);
    begin_segment(command);
    check_final(state_.master);
    law_changed_of(state_.master);
}

void Chip::free_held(unsigned axes) {
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(axes >> a & 1u)) continue;
        state_.axis[a].hold = false;
        state_.axis[a].finished = 0;
    }
    for (int a = 0; a < axes_of_chip; ++a) {
        Axis& axis = state_.axis[a];
        const int code = axis.held_command;
        if (!(axes >> a & 1u) || code == 0) continue;
        axis.held_command = 0;
        if (code < 0x30) {
            if (driving(a))
                kernel_.report(id_, drive_ignored, code, a);
            else
                start_drive(a, code);
        } else if (state_.chain != 0 || any_busy(axis.held_path)) {
            kernel_.report(id_, path_ignored, code);
        } else {
            start_path(axis.held_path);
        }
    }
}

void Chip::ask_stop(unsigned axes, bool immediate) {
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(axes >> a & 1u)) continue;
        state_.axis[a].held_command = 0;
        Generator& gen = state_.axis[state_.chain >> a & 1u ? state_.master : a].gen;
        if (gen.drive == Drive::idle) continue;
        (immediate ? gen.ask_immediate : gen.ask_decelerating) = true;
    }
}

// ---- reading ------------------------------------------------------------------------------------------------------------------

int Chip::first_selected() const {
    int a = 0;
    while (a < axes_of_chip - 1 && !(state_.selected >> a & 1u)) ++a;
    return a;
}

std::uint16_t Chip::read(std::uint32_t offset) {
    const Instant now = kernel_.now();
    catch_up(now);
    const std::uint16_t value = peek(offset);
    if (offset == r3) {
        state_.axis[first_selected()].flags = 0;
        for (Axis& axis : state_.axis) axis.gen.special_known = false;
    }
    settle(now);
    return value;
}

std::uint16_t Chip::peek(std::uint32_t offset) const {
    switch (offset) {
        case r0: return main_status();
        case r1: return status1(first_selected());
        case r2: return status2(first_selected());
        case r3: return state_.axis[first_selected()].flags;
        case r4: return static_cast<std::uint16_t>(input_levels(0) | input_levels(1) << 8);
        case r5: return static_cast<std::uint16_t>(input_levels(2) | input_levels(3) << 8);
        case r6: return state_.rr6;
        case r7: return state_.rr7;
        default: return 0;
    }
}

std::uint16_t Chip::main_status() const {
    unsigned v = 0;
    for (int a = 0; a < axes_of_chip; ++a) {
        const Axis& axis = state_.axis[a];
        const bool out_of_position = bit(axis.wr2, 15) && level(axis, Pin::in_position) != bit(axis.wr2, 14);
        if (driving(a) || ((state_.in_place >> a & 1u) && out_of_position)) v |= 1u << a;
        if ((status2(a) & 0x3Fu) != 0 || (axis.finished & 0xF000u) != 0) v |= 1u << (4 + a);
    }
    if (state_.chain != 0) {
        v |= 1u << 8;
        if (!state_.queued) v |= 1u << 9;
        if (state_.path.command.arc())
            v |= static_cast<unsigned>(state_.path.arc.clockwise ? 7 - state_.path.arc.octant : state_.path.arc.octant) << 10;
    }
    return static_cast<std::uint16_t>(v);
}

std::uint16_t Chip::status1(int a) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    const std::int32_t counter = bit(axis.wr2, 5) ? encoder_position(axis, a) : axis.lp;
    unsigned v = axis.finished;
    if (counter >= axis.comp_plus) v |= 1u << 0;
    if (counter < axis.comp_minus) v |= 1u << 1;
    if (gen.drive != Drive::idle) {
        v |= gen.ramp > 0 ? 1u << 2 : gen.ramp < 0 ? 1u << 4 : 1u << 3;
        if (gen.s_curve && gen.ramp != 0) v |= 1u << (5 + static_cast<int>(gen.phase));
    }
    return static_cast<std::uint16_t>(v);
}

std::uint16_t Chip::status2(int a) const {
    const Axis& axis = state_.axis[a];
    unsigned v = 0;
    if (beyond_software_limit(a)) v |= axis.direction > 0 ? 1u << 0 : 1u << 1;
    if (level(axis, Pin::limit_plus) == bit(axis.wr2, 3)) v |= 1u << 2;
    if (level(axis, Pin::limit_minus) == bit(axis.wr2, 4)) v |= 1u << 3;
    if (bit(axis.wr2, 13) && level(axis, Pin::alarm) == bit(axis.wr2, 12)) v |= 1u << 4;
    if (!state_.emergency_high) v |= 1u << 5;
    return static_cast<std::uint16_t>(v);
}

/// RR4 and RR5: eight input levels of one axis.
std::uint16_t Chip::input_levels(int a) const {
    unsigned v = 0;
    for (int i = 0; i < 8; ++i) v |= static_cast<unsigned>(kernel_.level(inputs_[a][i]) != 0) << i;
    return static_cast<std::uint16_t>(v);
}

}  // namespace motionrack::mcx314
