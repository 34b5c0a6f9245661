// Drive and interpolation commands: when they begin a drive, wait for its start, or are ignored.
#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void Drives::command(int code, unsigned axes) {
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(axes >> a & 1u)) continue;
        if (state_.driving(a))
            kernel_.report(id_, drive_ignored, code, a);
        else if (state_.axis[a].hold)
            state_.axis[a].held_command = code;
        else
            start(a, code);
    }
}

void Drives::start(int a, int code) {
    state_.axis[a].direction = code == cmd::FIXED_MINUS || code == cmd::CONTINUOUS_MINUS ? -1 : 1;
    begin_generator(a, code == cmd::FIXED_PLUS || code == cmd::FIXED_MINUS ? Drive::fixed : Drive::continuous);
    state_.axis[a].finished = state_.axis[a].causes = 0;
    generators_.check_final(a);
    requests_.law_changed(a);
    if (extended_) conditions_.note(a, sm::DSTA);
}

void Drives::begin_generator(int a, Drive drive) {
    Axis& axis = state_.axis[a];
    if (extended_) prepare_drive(a);
    Generator gen;
    gen.drive = drive;
    gen.wait = rules::start_ticks;
    gen.manual = wr3::MANLD.test(axis.wr3);
    gen.own_deceleration = wr3::DSNDE.test(axis.wr3);
    gen.s_curve = wr3::SACC.test(axis.wr3);
    gen.range = gen.range_now = rules::used_range(axis.range);
    const std::int64_t v = rules::used_speed(axis.speed), sv = rules::used_speed(axis.start_speed);
    gen.constant = v <= sv;
    gen.speed = std::min(v, sv);
    gen.at = state_.tick;
    gen.full_tick = true;  // the first working tick in full, independent of events in the start ticks
    axis.gen = gen;
    if (extended_) choose_deceleration(a);
    state_.working |= 1u << a;
}

PathCommand Drives::captured(int code) const {
    PathCommand command;
    command.code = code;
    command.count = code == cmd::LINE3 || code == cmd::BP3 ? 3 : 2;
    command.vector_speed = static_cast<std::int32_t>(wr5::LSPD.get(state_.bus.wr5));
    if (wr5::EXPLS.test(state_.bus.wr5)) command.steps |= PathCommand::by_wire;
    if (wr5::CMPLS.test(state_.bus.wr5)) command.steps |= PathCommand::by_command;
    static constexpr std::array<Field, 3> axes = {wr5::AX1, wr5::AX2, wr5::AX3};
    for (int i = 0; i < 3; ++i) {
        command.axis[i] = static_cast<std::int32_t>(axes[i].get(state_.bus.wr5));
        command.finish[i] = coordinate(state_.axis[command.axis[i]].pulses);
        if (i < 2) command.centre[i] = coordinate(state_.axis[command.axis[i]].centre);
    }
    return command;
}

bool Drives::any_busy(const PathCommand& command) const {
    for (int a = 0; a < axes_of_chip; ++a)
        if ((command.mask() >> a & 1u) && state_.driving(a) && !(state_.chain >> a & 1u)) return true;
    return false;
}

void Drives::path_command(int code) {
    state_.path_interrupt = false;
    const PathCommand command = captured(code);
    const bool full = state_.queued || command.pattern() || state_.path.command.pattern();
    if (command.names_an_axis_twice() || any_busy(command) || (state_.chain != 0 && full)) {
        kernel_.report(id_, path_ignored, code);
    } else if (state_.chain != 0) {
        state_.queued = true;
        state_.queue = command;
        for (int a = 0; a < axes_of_chip; ++a)
            if ((command.mask() & ~state_.chain) >> a & 1u) state_.axis[a].finished = state_.axis[a].causes = 0;
        if (extended_) for_each_axis(command.mask() & ~state_.chain, [this](int a) { conditions_.note(a, sm::DSTA); });
        state_.chain |= command.mask();
    } else if (Axis& first = state_.axis[command.axis[0]]; first.hold) {
        first.held_command = code;
        first.held_path = command;
    } else {
        start_path(command);
    }
}

void Drives::start_path(const PathCommand& command) {
    state_.chain = command.mask();
    state_.master = command.axis[0];
    state_.queued = state_.steps.in_progress = false;
    state_.stepped = 1;
    for (int a = 0; a < axes_of_chip; ++a)
        if (state_.chain >> a & 1u) state_.axis[a].finished = state_.axis[a].causes = 0;
    begin_generator(state_.master, Drive::path);
    generators_.begin_segment(command);
    generators_.check_final(state_.master);
    requests_.law_changed_of(state_.master);
    if (extended_) for_each_axis(state_.chain, [this](int a) { conditions_.note(a, sm::DSTA); });
}

void Drives::free_held(unsigned axes) {
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(axes >> a & 1u)) continue;
        state_.axis[a].hold = false;
        state_.axis[a].finished = 0;
        state_.extension[a].home.error = false;
    }
    for (int a = 0; a < axes_of_chip; ++a) {
        Axis& axis = state_.axis[a];
        const int code = axis.held_command;
        if (!(axes >> a & 1u) || code == 0) continue;
        axis.held_command = 0;
        if (code < static_cast<int>(cmd::LINE2)) {
            if (state_.driving(a))
                kernel_.report(id_, drive_ignored, code, a);
            else
                start(a, code);
        } else if (state_.chain != 0 || any_busy(axis.held_path)) {
            kernel_.report(id_, path_ignored, code);
        } else {
            start_path(axis.held_path);
        }
    }
}

void Drives::ask_stop(unsigned axes, bool immediate) {
    for (int a = 0; a < axes_of_chip; ++a) {
        if (!(axes >> a & 1u)) continue;
        state_.axis[a].held_command = 0;
        if (bit(state_.homing, a)) state_.extension[a].home.cancelled = true, requests_.wake();
        Generator& gen = state_.axis[state_.chain >> a & 1u ? state_.master : a].gen;
        if (gen.drive == Drive::idle) continue;
        (immediate ? gen.ask_immediate : gen.ask_decelerating) = true;
    }
}

// ---- only the MCX314As

/// Removes the speed cap before a drive begins.
void Drives::prepare_drive(int a) {
    state_.extension[a].cap = 0;
    generators_.set_drive_speed(a);
}

/// Determines for the new drive whether its automatic deceleration uses D, and whether a triangle is prevented.
void Drives::choose_deceleration(int a) {
    Generator& gen = state_.axis[a].gen;
    const bool automatic = !gen.manual && !gen.s_curve;
    gen.weighted = automatic && gen.own_deceleration && gen.drive != Drive::continuous;
    gen.no_triangle = automatic && gen.drive == Drive::fixed && em::AVTRI.test(state_.extension[a].em6);
}

}  // namespace motionrack::mcx314
