// The chip in the rack: time, wires, listeners and the encoders behind EP.
#include <fmt/format.h>

#include <limits>
#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max() / 4;
constexpr const char* axis_letters = "xyzu";
constexpr std::array<const char*, 10> input_names = {"in0", "in1", "in2", "in3", "expp", "expm", "inpos", "alarm", "lmtp", "lmtm"};
constexpr int emergency_pin = 100;
constexpr int output_pin = 200;  // + 16 * axis + (0 xpp, 1 xpm, 8 + n: nOUTn)

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Encoder counts for one count of EP (WR2 PINMD, PIND).
std::int64_t counts_per_ep(const Axis& axis) {
    if (bit(axis.wr2, 9)) return 1;
    return std::int64_t{1} << std::min(axis.wr2 >> 10 & 3, 2);
}

}  // namespace

std::string describe(const sim::Condition& condition, const std::string& card) {
    switch (condition.code) {
        case drive_ignored:
            return fmt::format("{}: drive command {:02X}h was ignored because axis {} is driving; wait for its end or stop it first", card,
                               condition.a, "XYZU"[condition.b & 3]);
        case path_ignored:
            return fmt::format("{}: interpolation command {:02X}h was ignored: the next segment is queued already, or an axis is named twice "
                               "or drives on its own; wait for CNEXT", card, condition.a);
        case unknown_command:
            return fmt::format("{}: command {:02X}h is not one of this model's; nothing was done", card, condition.a);
        default: return fmt::format("{}: condition {}", card, condition.code);
    }
}

// ---- building -----------------------------------------------------------------------------------------------------------------

Chip::Chip(sim::Kernel& kernel, const std::string& name) : kernel_(kernel), id_(kernel.add(*this, sim::Phase::cards, name)) {
    for (int a = 0; a < axes_of_chip; ++a) {
        const std::string prefix = name + "." + axis_letters[a];
        outputs_[a].chip = ears_[a].chip = this;
        outputs_[a].axis = ears_[a].axis = a;
        for (std::size_t i = 0; i < input_names.size(); ++i) {
            inputs_[a][i] = kernel_.add_wire(prefix + input_names[i], 1);
            kernel_.listen(inputs_[a][i], id_, 16 * a + static_cast<int>(i));
        }
        kernel_.drive_lazily(kernel_.add_wire(prefix + "pp", 0), id_, output_pin + 16 * a);
        kernel_.drive_lazily(kernel_.add_wire(prefix + "pm", 0), id_, output_pin + 16 * a + 1);
        for (int i = 0; i < 8; ++i) {
            general_outputs_[a][i] = kernel_.add_wire(prefix + "out" + std::to_string(i), 0);
            if (i >= 4) kernel_.drive_lazily(general_outputs_[a][i], id_, output_pin + 16 * a + 8 + i);
        }
    }
    emgn_ = kernel_.add_wire(name + ".emgn", 1);
    kernel_.listen(emgn_, id_, emergency_pin);
    kernel_.add_wire(name + ".expls_n", 1);
    int_n_ = kernel_.add_wire(name + ".int_n", 1);
    for (int a = 0; a < axes_of_chip; ++a) {
        set_wants(a);
        compare(a);
    }
    state_.next_event = far;
}

int Chip::Output::listen(sim::MotionListener& listener) {
    MOTIONRACK_ASSERT(listener_count < max_listeners);
    listeners[listener_count] = &listener;
    return listener_count++;
}

void Chip::connect_encoder(int axis, sim::Motion& counts) {
    EncoderEar& ear = ears_[axis];
    ear.motion = &counts;
    ear.slot = counts.listen(ear);
    set_encoder_position(axis, state_.axis[axis].ep);
}

/// Inputs that are not enabled are not wanted, so that a wire that is made on demand (an index) costs nothing.
void Chip::set_wants(int a) {
    Axis& axis = state_.axis[a];
    auto set = [&](Pin pin, bool wanted) {
        const int i = static_cast<int>(pin);
        kernel_.want(inputs_[a][i], id_, wanted);
        const unsigned mask = 1u << i;
        const bool high = !wanted || kernel_.level(inputs_[a][i]) != 0;
        axis.levels = static_cast<std::uint16_t>(high ? axis.levels | mask : axis.levels & ~mask);
    };
    for (int i = 0; i < 4; ++i) set(static_cast<Pin>(i), bit(axis.wr1, 2 * i + 1));
    set(Pin::exp_plus, false);
    set(Pin::exp_minus, false);
    set(Pin::in_position, bit(axis.wr2, 15));
    set(Pin::alarm, bit(axis.wr2, 13));
}

// ---- time ---------------------------------------------------------------------------------------------------------------------

void Chip::advance_to(std::int64_t to) {
    while (state_.tick < to) {
        if (state_.next_event > to) return skip(to - state_.tick);
        skip(state_.next_event - 1 - state_.tick);
        note_rates();
        tick();
        reschedule();
    }
}

/// Finds the next interesting tick.
void Chip::reschedule() {
    std::int64_t ticks = far;
    for (int a = 0; a < axes_of_chip; ++a)
        if (state_.axis[a].gen.drive != Drive::idle) ticks = std::min(ticks, ticks_to_event(a));
    state_.next_event = ticks >= far ? far : state_.tick + ticks;
}

/// After anything happened: everyone hears of it, and the kernel of the next event.
void Chip::settle(Instant now) {
    tell_listeners(now);
    update_interrupt();
    update_outputs();
    reschedule();
    kernel_.schedule(id_, state_.next_event >= far ? never : Instant{state_.next_event * rules::tick_100ps});
}

void Chip::act(Instant now) {
    advance_to(tick_of(now));
    settle(now);
}

void Chip::sync(Instant now) {
    advance_to(tick_of(now));
    for (int a = 0; a < axes_of_chip; ++a)
        if (outputs_[a].edge_listener) flush_edges(a);
}

void Chip::on_wire(int pin, int wire_level, Instant now) {
    // A level that changes at the very instant of a tick counts for that tick.
    advance_to((now.count() + rules::tick_100ps - 1) / rules::tick_100ps - 1);
    note_rates();
    if (pin == emergency_pin) {
        state_.emergency_high = wire_level != 0;
    } else {
        Axis& axis = state_.axis[pin / 16];
        const unsigned mask = 1u << (pin % 16);
        axis.levels = static_cast<std::uint16_t>(wire_level ? axis.levels | mask : axis.levels & ~mask);
    }
    for (Axis& axis : state_.axis) axis.gen.look = true;
    settle(now);
}

void Chip::update_interrupt() {
    bool active = state_.path_interrupt;
    for (const Axis& axis : state_.axis) active = active || axis.flags != 0;
    if (active == state_.interrupt) return;
    state_.interrupt = active;
    kernel_.set_wire(int_n_, active ? 0 : 1);
    if (active) kernel_.break_run();
}

void Chip::update_outputs() {
    for (int a = 0; a < axes_of_chip; ++a)
        for (int i = 0; i < 4; ++i)
            if (const int out = state_.wr4 >> (4 * a + i) & 1; kernel_.level(general_outputs_[a][i]) != out)
                kernel_.set_wire(general_outputs_[a][i], out);
}

/// Levels that are looked at rather than followed: pulses, directions, nOUT4..7.
int Chip::level_at(int pin, Instant now) const {
    const int a = (pin - output_pin) / 16, which = (pin - output_pin) % 16;
    const Axis& axis = state_.axis[a];
    if (which >= 8) {
        const int out = which - 8;
        if (!bit(axis.wr3, 7)) return axis.wr3 >> (4 + out) & 1;
        static constexpr std::array<int, 4> status_bits = {0, 1, 2, 4};  // CMP+, CMP-, ASND, DSND
        return status1(a) >> status_bits[out - 4] & 1;
    }
    const bool one_pulse = bit(axis.wr2, 6), negative_pulses = bit(axis.wr2, 7), high_is_plus = bit(axis.wr2, 8);
    if (one_pulse && which == 1) return (axis.direction > 0) == high_is_plus;
    const Generator& gen = state_.axis[state_.chain >> a & 1u ? state_.master : a].gen;
    bool active = false;
    if (gen.drive != Drive::idle && gen.wait == 0 && gen.n > 0 && (one_pulse || (axis.direction > 0) == (which == 0))) {
        // Half a period from the last basic pulse on, if this axis stepped with it.
        const std::int64_t age = gen.acc / gen.speed, width = std::max<std::int64_t>(1, gen.range_now / gen.speed / 2);
        const std::int64_t ago = (age + 1) * rules::tick_100ps;
        active = age < width && (gen.drive != Drive::path || count_at(a, now) != count_at(a, now - Duration{ago}));
    }
    return active != negative_pulses;
}

// ---- motions ------------------------------------------------------------------------------------------------------------------

void Chip::law_changed_of(int generator) {
    changed_ |= state_.axis[generator].gen.drive == Drive::path ? state_.path.command.mask() : 1u << generator;
}

/// Before anything happens: along an arc the rates drift between the changes that listeners hear of.
void Chip::note_rates() {
    if (state_.chain == 0 || !state_.path.command.arc()) return;
    for (int i = 0; i < 2; ++i) {
        const int a = state_.path.command.axis[i];
        if (outputs_[a].listener_count > 0) told_rate_[a] = rate_of(a);
    }
}

void Chip::tell_listeners(Instant now) {
    for (int a = 0; a < axes_of_chip; ++a) {
        Output& output = outputs_[a];
        const bool changed = changed_ >> a & 1u;
        if (changed) {
            changed_ &= ~(1u << a);
            if (output.edge_listener) flush_edges(a);
            if (output.listener_count > 0) {
                const double rate = rate_of(a);
                for (int i = 0; i < output.listener_count; ++i) output.listeners[i]->rate_changed(told_rate_[a], rate, now);
                told_rate_[a] = rate;
            }
        }
        Axis& axis = state_.axis[a];
        if (!axis.crossed_now) continue;
        axis.crossed_now = false;
        if (output.edge_listener) flush_edges(a);
        for (int i = 0; i < output.listener_count; ++i) {
            Watch& watched = axis.watch[i];
            if (axis.count > watched.below && axis.count < watched.above) continue;
            watched = Watch{};
            output.listeners[i]->crossed(now);
        }
    }
}

void Chip::watch(int a, int slot, std::int64_t below, std::int64_t above) {
    Axis& axis = state_.axis[a];
    axis.watch[slot] = {below, above};
    for (Axis& each : state_.axis) each.gen.special_known = false;
    if (axis.count <= below || axis.count >= above) axis.crossed_now = true;
    // Told at once, but not from inside the call: the kernel comes back at this very instant.
    kernel_.schedule(id_, kernel_.now());
}

std::int64_t Chip::count_at(int a, Instant t) const {
    const Axis& axis = state_.axis[a];
    std::int64_t ticks = tick_of(t) - state_.tick;
    if (ticks <= 0) return axis.count;
    const bool on_path = (state_.chain >> a & 1u) != 0;
    const Generator& gen = state_.axis[on_path ? state_.master : a].gen;
    ticks -= gen.wait;
    if (gen.drive == Drive::idle || ticks <= 0) return axis.count;
    const std::int64_t pulses = pulses_in(gen, ticks);
    if (!on_path) return axis.count + pulses * axis.direction;
    const std::array<std::int64_t, 3> steps = path_steps(pulses);
    for (int i = 0; i < state_.path.command.count; ++i)
        if (state_.path.command.axis[i] == a) return axis.count + steps[i];
    return axis.count;
}

/// Pulses a second of the present law, signed; for an arc those of the tangent where it is.
double Chip::rate_of(int a) const {
    const Axis& axis = state_.axis[a];
    const bool on_path = (state_.chain >> a & 1u) != 0;
    const Generator& gen = state_.axis[on_path ? state_.master : a].gen;
    if (gen.drive == Drive::idle) return 0;
    const double phase = 8e6 * static_cast<double>(gen.speed);
    if (!on_path) return phase / static_cast<double>(gen.range_now) * axis.direction;
    const Path& path = state_.path;
    const double r1 = static_cast<double>(path.range_for[0]);
    const double extra = path.command.count == 2 ? static_cast<double>(path.range_for[1]) - r1 : 0.0;
    for (int i = 0; i < path.command.count; ++i) {
        if (path.command.axis[i] != a) continue;
        const double sign = path_direction(i);
        if (path.command.arc()) {
            const int s = rules::octants[path.arc.octant].short_axis;
            const double slope = std::min(1.0, std::fabs(static_cast<double>(path.arc.at[s])) /
                                                   std::max(1.0, std::fabs(static_cast<double>(path.arc.at[1 - s]))));
            const double basic = phase / (r1 + extra * slope);
            return sign * (s == i ? basic : basic * slope);
        }
        const double longest = static_cast<double>(path.longest);
        double slope = 0;
        if (path.command.count == 2)
            slope = static_cast<double>(std::min(rules::magnitude(path.command.finish[0]), rules::magnitude(path.command.finish[1]))) / longest;
        return phase / (r1 + extra * slope) * static_cast<double>(path.command.finish[i]) / longest;
    }
    return 0;
}

std::int64_t Chip::pulses_made(int axis) { return state_.axis[axis].made; }
std::int32_t Chip::lp(int axis) { return state_.axis[axis].lp; }
std::int32_t Chip::ep(int axis) const { return encoder_position(state_.axis[axis], axis); }

// ---- encoders -------------------------------------------------------------------------------------------------------------------

std::int32_t Chip::encoder_position(const Axis& axis, int a) const {
    if (!ears_[a].motion) return axis.ep;
    const std::int64_t moved = ears_[a].motion->count(kernel_.now()) - axis.encoder_base;
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(axis.ep) + static_cast<std::uint32_t>(floor_div(moved, counts_per_ep(axis))));
}

void Chip::set_encoder_position(int a, std::int32_t value) {
    state_.axis[a].ep = value;
    state_.axis[a].encoder_base = ears_[a].motion ? ears_[a].motion->count(kernel_.now()) : 0;
}

/// Where EP is compared, the encoder tells when a comparison may change.
void Chip::watch_encoder(int a) {
    const Axis& axis = state_.axis[a];
    const EncoderEar& ear = ears_[a];
    if (!ear.motion) return;
    std::int64_t below = sim::unwatched_below, above = sim::unwatched_above;
    if (bit(axis.wr2, 5) && ((axis.wr2 & 3u) != 0 || (axis.wr1 & 0x1E00u) != 0)) {
        const std::int64_t ep_now = encoder_position(axis, a), ratio = counts_per_ep(axis);
        const std::int64_t plus = axis.comp_plus, minus = axis.comp_minus;
        for (const std::int64_t change : {plus, plus + 1, minus}) {  // comparisons differ below and from `change` on
            const std::int64_t counts = axis.encoder_base + (change - axis.ep) * ratio;
            if (change > ep_now) above = std::min(above, counts);
            if (change <= ep_now) below = std::max(below, counts - 1);
        }
    }
    ear.motion->watch(ear.slot, below, above);
}

void Chip::encoder_crossed(int a, Instant now) {
    advance_to((now.count() + rules::tick_100ps - 1) / rules::tick_100ps - 1);
    compare(a);
    watch_encoder(a);
    for (Axis& axis : state_.axis) axis.gen.look = true;
    settle(now);
}

}  // namespace motionrack::mcx314
