// Crossings, rates and faults of one axis.
#include <motionrack/sim/parts/axis_mechanics.hpp>

namespace motionrack::parts {

namespace {

std::int64_t whole(double value) {
    return static_cast<std::int64_t>(value + (value < 0 ? -0.5 : 0.5));
}

/// Reports the effects of a change of the motor.
template <class Report>
void report_change(const StepperState& before, const StepperState& after, std::int64_t rotor_before, std::int64_t rotor,
                   Report report) {
    const bool in_step = after.hold == RotorHold::in_step;
    const bool new_rate = before.rate_hz != after.rate_hz;
    if (after.jammed && !before.jammed) report(AxisCondition::axle_held, rotor_before, 0);
    if (before.hold == RotorHold::in_step && new_rate && (!in_step || rotor != rotor_before))
        report(AxisCondition::fell_out_of_step, whole(before.rate_hz), whole(after.rate_hz));
    if (in_step && after.lost != before.lost) report(AxisCondition::lost_steps, after.lost - before.lost, after.lost);
}

}  // namespace

AxisMechanics::AxisMechanics(sim::Kernel& kernel, const std::string& name, const AxisMechanicsSettings& settings)
    : kernel_(kernel),
      settings_(settings),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      motor_(settings.motor, state_.motor),
      input_(motor_, state_.motor, state_.aimed),
      strain_(state_.strain, motor_, state_.motor),
      axle_(settings.axle, settings.motor.pulses_per_rev(), state_.axle),
      encoder_(settings.encoder, settings.motor.pulses_per_rev(), state_.encoder),
      switches_(kernel, name, {settings.limit_minus, settings.limit_plus, settings.home}, axle_, state_.switches),
      index_(kernel, id_, name, encoder_, state_.index, state_.index_wanted, state_.index_level),
      faces_(input_, encoder_, state_.watches),
      positions_{MechanicsPosition(*this, MechanicsFaces::rotor_face),
                 MechanicsPosition(*this, MechanicsFaces::encoder_face)},
      edges_(input_, state_.motor, encoder_, state_.edges_until, state_.last_edge) {}

void AxisMechanics::connect(sim::PositionFunction& pulses) {
    input_.connect(pulses, *this);
    aim(kernel_.now());
}

sim::PositionFunction& AxisMechanics::rotor() {
    return positions_[MechanicsFaces::rotor_face];
}

sim::PositionFunction& AxisMechanics::encoder() {
    return positions_[MechanicsFaces::encoder_face];
}

int AxisMechanics::level_at(int, Instant now) const {
    return encoder_.index(input_.rotor_at(now));
}

void AxisMechanics::wanted_changed(int, bool wanted, Instant now) {
    index_.subscribe(wanted, input_.rotor_at(now));
    aim(now);
}

// ---- notifications of the pulses

void AxisMechanics::rate_changed(double pulses_before, double rate, Instant now) {
    if (strain_.change_rate(pulses_before, rate, now)) {
        const double reported = state_.motor.rate_hz;
        strain_.strain(rate, input_.pulses_at(now), now);
        put_off();
        faces_.notify_rate(reported, input_.rotor_rate(), now);
        return;
    }
    if (!motor_.in_step() || std::fabs(rate) > motor_.settings().pull_out_hz) {
        change_motor(now, [&] { motor_.change_rate(rate, input_.pulses_at(now)); });
        return;
    }
    const double before = state_.motor.rate_hz;
    if (axle_.play() != 0 && (rate > 0) - (rate < 0) != (before > 0) - (before < 0)) axle_.turn(input_.rotor_at(now));
    motor_.note_rate(rate);
    const double velocity = std::fabs(rate);
    if (velocity > state_.top_hz) state_.top_hz = velocity;
    faces_.notify_rate(motor_.rotor_rate(before), input_.rotor_rate(), now);
}

void AxisMechanics::crossed(Instant now) {
    input_.note_crossed();
    if (check_ends(now)) return;
    check(now);
}

// ---- The motor

template <class Change>
void AxisMechanics::change_motor(Instant now, Change change) {
    const std::int64_t pulses = input_.pulses_at(now);
    const StepperState before = state_.motor;
    const std::int64_t rotor_before = motor_.rotor(pulses);
    axle_.turn(rotor_before);
    change();
    const std::int64_t rotor = motor_.rotor(pulses);
    axle_.turn(rotor);
    report_change(before, state_.motor, rotor_before, rotor, [&](AxisCondition code, std::int64_t a, std::int64_t b) {
        kernel_.report(id_, static_cast<std::uint16_t>(code), a, b);
    });
    edges_.jump(rotor_before, rotor, now);
    check(now);
    const double reported = before.hold == RotorHold::in_step ? before.rate_hz : 0;
    if (input_.rotor_rate() != reported) faces_.notify_rate(reported, input_.rotor_rate(), now);
}

bool AxisMechanics::check_ends(Instant now) {
    const std::int64_t rotor = input_.rotor_at(now);
    if (!axle_.travel().left(rotor)) return false;
    const int direction = rotor >= axle_.travel().above ? 1 : -1;
    const std::int64_t end = direction > 0 ? axle_.travel().above - 1 : axle_.travel().below + 1;
    kernel_.report(id_, static_cast<std::uint16_t>(AxisCondition::end_of_travel), direction, end);
    change_motor(now, [&] { motor_.block(direction, end, input_.pulses_at(now)); });
    return true;
}

// ---- Crossings

void AxisMechanics::check(Instant now) {
    if (checking_) return;
    checking_ = true;
    const std::int64_t rotor = input_.rotor_at(now);
    switches_.check(rotor, now);
    index_.check(rotor);
    faces_.check(rotor, now);
    checking_ = false;
    aim(now);
}

// Watches the nearest position of any event.
void AxisMechanics::aim(Instant now) {
    if (checking_) return;
    const std::int64_t rotor = input_.rotor_at(now);
    Range all = axle_.travel();
    bool left = all.left(rotor);
    auto add = [&](const Range& range) {
        if (range.left(rotor))
            left = true;
        else
            all = all.within(range);
    };
    switches_.add_ranges(add);
    index_.add_range(add);
    faces_.add_ranges(add);
    state_.pending = left ? now + Duration{1} : never;
    put_off();
    input_.watch(all);
}

// Schedules the next event that needs no pulse.
void AxisMechanics::put_off() {
    kernel_.schedule(id_, std::min({state_.pending, strain_.deadline(), switches_.next()}));
}

void AxisMechanics::on_scheduled(Instant now) {
    switches_.act(now);
    if (strain_.deadline() <= now)
        strain_.expire(input_, now, [&](double rate) {
            change_motor(now, [&] { motor_.change_rate(rate, input_.pulses_at(now)); });
        });
    if (state_.pending <= now) {
        state_.pending = never;
        crossed(now);
    }
    put_off();
}

// ---- Faults

bool AxisMechanics::fault(std::string_view name, double value, Instant now) {
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) return motor_fault(name, value, now) || encoder_fault(name, value, now);
    const std::string_view part = name.substr(0, dot);
    const std::string_view what = name.substr(dot + 1);
    if (part == "motor") return motor_fault(what, value, now);
    if (part == "encoder") return encoder_fault(what, value, now);
    return switches_.fault(part, what, value);
}

bool AxisMechanics::motor_fault(std::string_view name, double value, Instant now) {
    constexpr double max_microsteps = 1e12;
    if (!(std::fabs(value) <= max_microsteps)) return false;
    if (name == "stall") {
        change_motor(now, [&] { motor_.jam(value != 0, input_.pulses_at(now)); });
    } else if (name == "lose_steps") {
        const double back = state_.motor.rate_hz < 0 ? value : -value;
        change_motor(now, [&] { motor_.push(whole(back), input_.pulses_at(now)); });
    } else if (name == "push") {
        change_motor(now, [&] { motor_.push(whole(value), input_.pulses_at(now)); });
    } else {
        return false;
    }
    check_ends(now);
    return true;
}

bool AxisMechanics::encoder_fault(std::string_view name, double value, Instant now) {
    const LineFault fault = name == "broken_a"   ? LineFault::broken_a
                            : name == "broken_b" ? LineFault::broken_b
                            : name == "swapped"  ? LineFault::swapped
                                                 : LineFault::none;
    if (fault == LineFault::none || !encoder_.present()) return false;
    if (value == 0 && encoder_.fault() != fault) return true;
    const std::int64_t rotor = input_.rotor_at(now);
    const std::int64_t before = encoder_.count(rotor);
    encoder_.set_fault(value != 0 ? fault : LineFault::none, rotor);
    edges_.count_jump(before, encoder_.count(rotor), now);
    faces_.renew_encoder_ranges(rotor);
    aim(now);
    faces_.notify_rate(input_.rotor_rate(), input_.rotor_rate(), now);
    return true;
}

}  // namespace motionrack::parts
