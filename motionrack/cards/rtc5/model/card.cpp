// Connects the engine to the rack: reads inputs from wires, runs ticks, and drives the output wires.
#include <algorithm>
#include <motionrack/cards/rtc5/model/card.hpp>

namespace motionrack::rtc5 {

namespace {

/// Indices of the pins in map::pins.
enum Pin : int { enc0_a, enc0_b, enc1_a, enc1_b, start_n, stop_n, mcbsp, mcbsp_frame, laser_on, xout, yout, busy, io };
static_assert(map::pins[laser_on].name == "laser_on" && map::pins[io].name == "io" && std::size(map::pins) == io + 1);

constexpr Duration half_us = nanoseconds(500);

}  // namespace

Card::Card(sim::Kernel& kernel, const std::string& name, const Settings& settings)
    : kernel_(kernel), engine_(settings) {
    id_ = kernel.add(*this, sim::Phase::cards, name);
    lists_.bytes = std::as_writable_bytes(engine_.parts().lists.commands());
    lists_.hashed = false;  // State::memory_hash covers it
    inputs_.bytes = sim::bytes_of(lines_);
    kernel.add(lists_, sim::Phase::cards, name + ".lists");
    kernel.add(inputs_, sim::Phase::cards, name + ".lines");
    for (std::size_t i = 0; i < wires_.size(); ++i) {
        const PinInfo& pin = map::pins[i];
        wires_[i] = kernel.add_wire(name + "." + std::string(pin.name), pin.active_low, map::lines[i].bits);
        if (pin.direction == PinDirection::input) kernel.listen(wires_[i], id_, static_cast<int>(i));
    }
    for (const Pin pin : {xout, yout}) kernel.drive_lazily(wire(pin), id_, pin);
    kernel.schedule(id_, Instant{0});
}

Engine& Card::engine() {
    caught_up();
    // A command may start motion: check again in the next tick.
    kernel_.schedule(id_, std::min((kernel_.now() / tick_time + 1) * tick_time,
                                   lines_.change_count > 0 ? Instant{lines_.changes[0]} : never));
    return engine_;
}

const Engine& Card::caught_up() {
    catch_up(kernel_.now());
    return engine_;
}

sim::WireId Card::busy_wire() const {
    return wire(busy);
}

/// Executes the ticks up to and including `now`.
void Card::catch_up(Instant now) {
    engine_.run_until(now / tick_time + 1, this);
    notify();
}

void Card::laser(std::int64_t at, bool on) {
    if (watcher_ != nullptr) watcher_->laser(at, on);
    if (lines_.change_count < static_cast<std::int64_t>(lines_.changes.size()))
        lines_.changes[static_cast<std::size_t>(lines_.change_count++)] = (at * half_us).count();
}

void Card::on_scheduled(Instant now) {
    catch_up(now);
    put_out();
    plan(now);
}

void Card::sync(Instant now) {
    catch_up(now);
    put_out();
}

/// Writes the present levels of the output wires; xout and yout only while they have listeners.
void Card::put_out() {
    WireLevels& l = lines_;
    std::int64_t done = 0;
    for (; done < l.change_count && l.changes[static_cast<std::size_t>(done)] <= kernel_.now().count(); ++done)
        l.laser = !l.laser;
    if (done > 0) {
        std::copy(l.changes.begin() + done, l.changes.begin() + l.change_count, l.changes.begin());
        l.change_count -= done;
        std::fill(l.changes.begin() + l.change_count, l.changes.end(), 0);
    }
    kernel_.set_wire(wire(laser_on), static_cast<int>(l.laser));
    kernel_.set_wire(wire(busy), engine_.busy());
    kernel_.set_wire(wire(io), static_cast<int>(engine_.state().io));
    if (kernel_.wanted(wire(xout))) kernel_.set_wire(wire(xout), engine_.output().a[0]);
    if (kernel_.wanted(wire(yout))) kernel_.set_wire(wire(yout), engine_.output().a[1]);
}

/// Schedules the card at the next instant at which one of its wires may change.
void Card::plan(Instant now) {
    Instant next = lines_.change_count > 0 ? Instant{lines_.changes[0]} : never;
    const bool looked_at = kernel_.wanted(wire(xout)) || kernel_.wanted(wire(yout));
    if (!engine_.at_rest() || (looked_at && engine_.state().fly.on()))
        next = std::min(next, (now / tick_time + 1) * tick_time);
    kernel_.schedule(id_, next);
}

int Card::level_at(int pin, Instant) const {
    return engine_.output().a[pin == xout ? 0 : 1];
}

void Card::wanted_changed(int, bool wanted, Instant now) {
    if (wanted) plan(now);
}

void Card::on_wire(int pin, int level, Instant now) {
    catch_up(now);
    switch (pin) {
        case enc0_a:
        case enc0_b:
        case enc1_a:
        case enc1_b:
            count_line(static_cast<std::size_t>(pin / 2), pin % 2, level, now);
            break;
        case start_n:
            if (level == 0) engine_.parts().starts.trigger();
            break;
        case stop_n:
            if (level == 0) engine_.external_stop();
            break;
        case mcbsp:
        case mcbsp_frame:
            engine_.parts().mcbsp.receive(static_cast<std::uint32_t>(kernel_.level(wire(mcbsp))));
            break;
        default:
            break;
    }
    put_out();
    plan(now);
}

/// Counts a change of an encoder line: 00 - 01 - 11 - 10 (B A) is up. Both lines changing at one instant is a sequence
/// error, not a count.
void Card::count_line(std::size_t encoder, std::int64_t bit, int level, Instant now) {
    const std::int64_t before = lines_.levels[encoder],
                       after = level != 0 ? before | 1 << bit : before & ~(std::int64_t{1} << bit);
    if (before == after) return;
    lines_.levels[encoder] = after;
    const auto phase = [](std::int64_t l) { return l == 0 ? 0 : l == 1 ? 1 : l == 3 ? 2 : 3; };
    std::int64_t step = (phase(after) - phase(before)) & 3;
    if (step == 3) step = -1;
    if (lines_.changed_at[encoder] == now.count()) {
        step = -lines_.last_step[encoder];
        lines_.changed_at[encoder] = -1;
        engine_.parts().flags.raise_sequence_error(static_cast<int>(encoder), engine_.tick());
    } else {
        lines_.changed_at[encoder] = now.count();
        lines_.last_step[encoder] = step;
    }
    const auto input = static_cast<std::uint32_t>(engine_.state().encoders.input[encoder]);
    engine_.parts().encoders.set_count(static_cast<int>(encoder),
                                       static_cast<std::int32_t>(input + static_cast<std::uint32_t>(step)));
}

void Card::notify() {
    const State& s = engine_.state();
    const std::int64_t fresh = s.flags.marking_info & ~lines_.reported_flags;
    if (fresh != 0)
        for (std::int64_t bit = 0; bit < 32; ++bit)
            if (fresh >> bit & 1)
                report(CardCondition::flag_set, bit, s.flags.flag_tick[static_cast<std::size_t>(bit)]);
    lines_.reported_flags = s.flags.marking_info;
    if (s.lists.ended_unwritten > lines_.reported_unwritten)
        report(CardCondition::unwritten_place, s.lists.current, s.tick - 1);
    lines_.reported_unwritten = s.lists.ended_unwritten;
    const std::int64_t lost = s.flags.startstop_info & startstop_bit("START_LOST");
    if (lost != 0 && lines_.reported_lost == 0) report(CardCondition::start_lost, 0, s.tick - 1);
    lines_.reported_lost = lost;
}

void Card::report(CardCondition code, std::int64_t a, std::int64_t tick) {
    kernel_.report(id_, static_cast<std::uint16_t>(code), a, tick);
}

}  // namespace motionrack::rtc5
