// Laws of motion of the rotor, and their end points.
#include <algorithm>
#include <cmath>
#include <motionrack/base/exponential.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>

namespace motionrack::parts {

namespace {

constexpr Duration grid = microseconds(1);
constexpr double grid_s = 1e-6;
/// Listeners are notified of velocity changes by this part of the saturation velocity.
constexpr double telling = 1.0 / 16;

int sign_of(double x) {
    return (x > 0) - (x < 0);
}

}  // namespace

// ---- one law

double DcMotorModel::travel(double seconds) const {
    const double s = std::min(seconds, end);
    if (lag == 0) return velocity0 * s + aim * s * s * 0.5;
    return aim * s + (velocity0 - aim) * lag * (1 - exponential(-s / lag));
}

double DcMotorModel::velocity(double seconds) const {
    if (seconds >= end) return after;
    return lag == 0 ? velocity0 + aim * seconds : aim + (velocity0 - aim) * exponential(-seconds / lag);
}

int DcMotorModel::direction() const {
    return velocity0 != 0 ? sign_of(velocity0) : sign_of(aim);
}

double DcMotor::wanted_velocity() const {
    const double volts = std::fabs(state_.volts) - settings_.dead_band_v;
    if (volts <= 0) return 0;
    return sign_of(state_.volts) * std::min(volts * settings_.gain, settings_.saturation_velocity);
}

/// Computes the law of motion from `velocity` on with the present voltage and load.
DcMotorModel DcMotor::law_from(double velocity) const {
    const double inertia = 1 + state_.load;
    const double limit = settings_.current_limit_accel / inertia, friction = settings_.coulomb_friction / inertia,
                 lag = settings_.time_constant_s * inertia;
    const double wanted = wanted_velocity(), error = wanted - velocity;
    int direction = sign_of(velocity);
    if (direction == 0) {
        if (state_.held || wanted == 0 || state_.blocked == sign_of(wanted)) return {0, 0, 0, DcMotorModel::endless, 0};
        const double push = std::clamp(wanted / lag, -limit, limit);
        if (std::fabs(push) <= friction) return {0, 0, 0, DcMotorModel::endless, 0};
        direction = sign_of(push);
    }
    DcMotorModel law{velocity, 0, 0, DcMotorModel::endless, 0};
    const double step = settings_.saturation_velocity * telling;
    auto ends = [&law](double at, double after) {
        if (at < law.end) law.end = at, law.after = after;
    };
    if (std::fabs(error) > limit * lag * (1 + 1e-9)) {
        law.aim = sign_of(error) * limit - direction * friction;
        if (law.aim == 0) return law;
        const double full = wanted - sign_of(error) * limit * lag;  // velocity at which the current leaves its limit
        if ((full - velocity) / law.aim > 0) ends((full - velocity) / law.aim, full);
        if (law.aim * direction < 0) ends(-velocity / law.aim, 0);
        ends(step / std::fabs(law.aim), velocity + sign_of(law.aim) * step);
        return law;
    }
    law.lag = lag;
    law.aim = wanted - direction * friction * lag;
    if (velocity != 0 && law.aim * direction < 0) ends(lag * natural_log(1 - velocity / law.aim), 0);
    const double gap = law.aim - velocity;
    if (std::fabs(gap) > 1.5 * step)
        ends(lag * natural_log(gap / (gap - sign_of(gap) * step)), velocity + sign_of(gap) * step);
    return law;
}

// ---- the rotor

DcMotor::DcMotor(sim::Kernel& kernel, const std::string& name, const DcMotorSettings& settings, const std::string& wire)
    : kernel_(kernel),
      settings_(settings),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      drive_(kernel.add_wire(wire.empty() ? name + ".drive" : wire, 0)) {
    MOTIONRACK_ASSERT(settings.gain > 0 && settings.saturation_velocity > 0 && settings.saturation_velocity <= 1e6 &&
                      settings.coulomb_friction >= 0);
    MOTIONRACK_ASSERT(settings.current_limit_accel > settings.coulomb_friction && settings.time_constant_s >= 1e-4 &&
                      settings.time_constant_s <= 10);
    MOTIONRACK_ASSERT(settings.dead_band_v >= 0 && settings.load_inertia_ratio >= 0);
    MOTIONRACK_ASSERT(settings.end_minus.value_or(0) <= 0 && settings.end_plus.value_or(0) >= 0);
    kernel.listen(drive_, id_, 0);
    state_.load = settings.load_inertia_ratio;
    state_.law.end = DcMotorModel::endless;
}

/// Whole microseconds since the law began.
double DcMotor::seconds(Instant t) const {
    return static_cast<double>((t - state_.since) / grid) * grid_s;
}

double DcMotor::position(Instant t) const {
    return static_cast<double>(state_.base) + state_.part + state_.law.travel(seconds(t));
}

std::int64_t DcMotor::count(Instant t) const {
    return state_.base + static_cast<std::int64_t>(std::floor(state_.part + state_.law.travel(seconds(t))));
}

double DcMotor::rate(Instant t) const {
    return state_.law.velocity(seconds(t));
}

void DcMotor::begin_law(double velocity, Instant now) {
    hand_over(now);
    const double here = state_.part + state_.law.travel(seconds(now)), whole = std::floor(here);
    state_.base += static_cast<std::int64_t>(whole);
    state_.part = here - whole;
    state_.since = now;
    state_.law = law_from(velocity);
}

/// Handles a change of voltage, load or position by hand.
void DcMotor::change(Instant now) {
    const double before = rate(now);
    begin_law(state_.held ? 0 : before, now);
    if (state_.law.direction() != 0) state_.blocked = 0;
    notify(before, now);
    reschedule();
}

void DcMotor::notify(double before, Instant now) {
    const double after = rate(now);
    if (after == state_.reported && before == after) return;
    state_.reported = after;
    listeners_.notify_rate(before, after, now);
}

Instant DcMotor::law_end() const {
    if (state_.law.end >= DcMotorModel::endless) return never;
    return state_.since + grid * static_cast<std::int64_t>(std::ceil(state_.law.end / grid_s));
}

/// The first instant of the present law at which the count is reached; never if it is not.
Instant DcMotor::reaches(std::int64_t there) const {
    const int direction = state_.law.direction();
    const Instant end = law_end();
    auto passed = [&](std::int64_t step) {
        const std::int64_t here = count(state_.since + grid * step);
        return direction > 0 ? here >= there : here <= there;
    };
    if (direction == 0) return never;
    constexpr std::int64_t farthest = std::int64_t{1} << 40;  // microseconds, 12 days
    const std::int64_t last = end == never ? farthest : (end - state_.since) / grid;
    std::int64_t low = -1, high = 1;
    while (high < last && !passed(high)) low = high, high *= 2;
    high = std::min(high, last);
    if (!passed(high)) return never;
    while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        (passed(middle) ? high : low) = middle;
    }
    return state_.since + grid * high;
}

Instant DcMotor::next(Instant now) const {
    Instant next = law_end();
    const int direction = state_.law.direction();
    Range quiet = sim::Listeners::unwatched_range(state_.watches);
    if (quiet.left(count(now))) return now;
    if (settings_.end_plus) quiet.above = std::min(quiet.above, *settings_.end_plus);
    if (settings_.end_minus) quiet.below = std::max(quiet.below, *settings_.end_minus);
    if (direction > 0 && quiet.above != sim::unwatched_above) next = std::min(next, reaches(quiet.above));
    if (direction < 0 && quiet.below != sim::unwatched_below) next = std::min(next, reaches(quiet.below));
    return std::max(next, now);
}

/// Stops the rotor at once at an end of travel.
bool DcMotor::meet_ends(Instant now) {
    const int direction = state_.law.direction();
    const std::int64_t here = count(now);
    const bool plus = direction > 0 && settings_.end_plus && here >= *settings_.end_plus;
    const bool minus = direction < 0 && settings_.end_minus && here <= *settings_.end_minus;
    if (!plus && !minus) return false;
    const double before = rate(now);
    hand_over(now);
    state_.base = plus ? *settings_.end_plus : *settings_.end_minus;
    state_.part = 0.5;
    state_.since = now;
    state_.blocked = direction;
    state_.law = law_from(0);
    kernel_.report(id_, static_cast<std::uint16_t>(AxisCondition::end_of_travel), direction, state_.base);
    notify(before, now);
    return true;
}

void DcMotor::on_scheduled(Instant now) {
    if (!meet_ends(now) && law_end() <= now) {
        const double before = state_.law.after;
        begin_law(before, now);
        notify(before, now);
    }
    listeners_.notify_crossed(state_.watches, count(now), now);
    reschedule();
}

void DcMotor::on_wire(int, int level, Instant now) {
    state_.volts = level * 1e-6;
    change(now);
}

bool DcMotor::fault(std::string_view name, double value, Instant now) {
    if (name == "motor.load" && value >= 0 && value <= 1000)
        state_.load = value;
    else if (name == "motor.stall")
        state_.held = value != 0;
    else if (name == "motor.push" && std::fabs(value) <= 1e12) {
        change(now);
        hand_over(now);
        state_.base += static_cast<std::int64_t>(value);
    } else
        return false;
    change(now);
    return true;
}

// ---- listeners

void DcMotor::watch(int slot, std::int64_t below, std::int64_t above) {
    state_.watches[static_cast<std::size_t>(slot)] = {below, above};
    reschedule();
}

int DcMotor::add_listener(sim::PositionListener& listener) {
    return listeners_.add(listener);
}

void DcMotor::set_edge_listener(sim::EdgeListener* listener) {
    state_.handed = kernel_.now();
    edges_ = listener;
}

/// Delivers the edges since the last delivery, each computed separately.
void DcMotor::hand_over(Instant now) {
    const Instant from = std::max(state_.handed, state_.since);
    state_.handed = now;
    const int direction = state_.law.direction();
    if (!edges_ || direction == 0) return;
    std::int64_t at = count(from);
    const std::int64_t last = count(now);
    while (at != last) {
        batch_.size = 0;
        batch_.origin = state_.since;
        batch_.tick = grid;
        batch_.step = direction;
        batch_.first_count = at + direction;
        while (at != last && batch_.size < sim::EdgeBatch::capacity) {
            const std::int64_t steps = (reaches(at + direction) - batch_.origin) / grid;
            if (steps > 0xFFFF'FFFF) {
                if (batch_.size > 0) break;
                batch_.origin += grid * steps;
                batch_.at[batch_.size++] = 0;
            } else {
                batch_.at[batch_.size++] = static_cast<std::uint32_t>(steps);
            }
            at += direction;
        }
        edges_->edges(batch_);
    }
}

}  // namespace motionrack::parts
