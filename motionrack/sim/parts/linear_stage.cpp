// Parabolas in whole numbers, and their ends.
#include <cmath>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/linear_stage.hpp>
#include <type_traits>

namespace motionrack::parts {

namespace {

constexpr int fine_bits = 68;
constexpr double fine_per_count = 0x1p68;  // fractions of a count
constexpr double counts_per_m = 1e9 * places_per_nm;
constexpr double ticks_per_s = 1e10;
constexpr std::int64_t endless = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t max_parabola = std::int64_t{1}
                                      << 40;       // ticks of one parabola: position and velocity stay within 128 bits
constexpr std::int64_t viscous_piece = 1'000'000;  // 100 us
constexpr double viscous_piece_s = 1e-4;
constexpr std::int64_t farthest_stage_counts = std::int64_t{1} << 50;  // counts, beyond every end of travel

template <class T>
int sign(T x) {
    return (x > 0) - (x < 0);
}

Wide fine_position(std::int64_t count) {
    return Wide{count} << fine_bits;
}

/// Converts m/s to 2^-68 counts per tick.
Wide fine_velocity(double m_s) {
    return static_cast<Wide>(m_s * (counts_per_m / ticks_per_s) * fine_per_count);
}

double in_m_s(Wide velocity) {
    return static_cast<double>(velocity) / fine_per_count * (ticks_per_s / counts_per_m);
}

std::int64_t count_of_nm(double nm) {
    return static_cast<std::int64_t>(std::floor(nm * static_cast<double>(places_per_nm) + 0.5));
}

/// Returns a / b, rounded up; both > 0.
std::int64_t steps_up(Wide a, Wide b) {
    const Wide steps = (a + b - 1) / b;
    return steps > max_parabola ? max_parabola : static_cast<std::int64_t>(steps);
}

}  // namespace

LinearStage::LinearStage(sim::Kernel& kernel, const std::string& name, const LinearStageSettings& s,
                         const std::string& wire)
    : kernel_(kernel),
      settings_(s),
      saturation_velocity_(fine_velocity(s.saturation_velocity)),
      end_minus_(count_of_nm(s.hard_stop_minus_nm)),
      end_plus_(count_of_nm(s.hard_stop_plus_nm)),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      drive_(kernel.add_wire(wire.empty() ? name + ".drive" : wire, 0)) {
    static_assert(sizeof(State) == 2 * sizeof(Wide) + 7 * std::size_t{8} + slots * sizeof(Range) + 6 * std::size_t{4},
                  "padding would get into the state's hash");
    MOTIONRACK_ASSERT(s.accel_per_volt > 0 && s.accel_per_volt <= 1'000 && s.current_limit_accel > 0 &&
                      s.current_limit_accel <= 1'000);
    MOTIONRACK_ASSERT(s.saturation_velocity > 0 && s.saturation_velocity <= 10 && s.viscous_friction >= 0 &&
                      s.viscous_friction <= 100);
    MOTIONRACK_ASSERT(s.coulomb_friction >= 0 && s.coulomb_friction <= 1'000 && s.load_mass_ratio >= 0 &&
                      s.load_mass_ratio <= 1'000);
    MOTIONRACK_ASSERT(s.hard_stop_minus_nm >= -1e10 && s.hard_stop_minus_nm <= s.start_nm &&
                      s.start_nm <= s.hard_stop_plus_nm && s.hard_stop_plus_nm <= 1e10);
    kernel.listen(drive_, id_, 0);
    state_.position = fine_position(count_of_nm(s.start_nm));
    state_.load = s.load_mass_ratio;
    begin_law();
}

// ---- position

std::int64_t LinearStage::count(Instant t) const {
    return static_cast<std::int64_t>(position_at(t) >> fine_bits);
}

double LinearStage::rate(Instant t) const {
    return static_cast<double>(velocity_at(t)) / fine_per_count * ticks_per_s;
}

double LinearStage::position_nm(Instant t) const {
    return static_cast<double>(position_at(t)) / (fine_per_count * static_cast<double>(places_per_nm));
}

double LinearStage::velocity(Instant t) const {
    return in_m_s(velocity_at(t));
}

double LinearStage::accel() const {
    return static_cast<double>(state_.half_accel) * 2 / fine_per_count * (ticks_per_s * ticks_per_s / counts_per_m);
}

/// Direction of the first tick of the parabola, and so of all of it.
int LinearStage::direction() const {
    return sign(state_.velocity + state_.half_accel);
}

// ---- one parabola

/// Half the acceleration in `direction` with a driving acceleration `push`, m/s2.
std::int64_t LinearStage::accel_law(double push, int direction) const {
    const double mass = 1 + state_.load, viscous = settings_.viscous_friction / mass;
    const double rubbing = (settings_.coulomb_friction + state_.rubbing) / mass;
    const double accel =
        (push - direction * rubbing - viscous * in_m_s(state_.velocity)) / (1 + viscous * viscous_piece_s / 2);
    return static_cast<std::int64_t>(
        std::floor(accel * (counts_per_m / (ticks_per_s * ticks_per_s)) * (fine_per_count / 2) + 0.5));
}

/// Begins the law of motion from the present position and velocity.
void LinearStage::begin_law() {
    State& s = state_;
    const double mass = 1 + s.load;
    const double push =
        std::clamp(volts() * settings_.accel_per_volt, -settings_.current_limit_accel, settings_.current_limit_accel) /
        mass;
    s.half_accel = 0;
    s.length = endless;
    if (s.held) s.velocity = 0;
    if (s.velocity > saturation_velocity_) s.velocity = saturation_velocity_;
    if (s.velocity < -saturation_velocity_) s.velocity = -saturation_velocity_;
    if (s.velocity != 0) {
        s.half_accel = accel_law(push, sign(s.velocity));
        const Wide change = 2 * Wide{s.half_accel} * sign(s.velocity);
        if (change < 0 && s.velocity * sign(s.velocity) < -change) {  // it reverses within a tick
            s.length = 1;
            if (settings_.coulomb_friction + s.rubbing == 0) return;
            s.velocity = 0;
        }
    }
    if (s.velocity == 0) {
        const bool is_stationary =
            s.held || s.blocked == sign(push) || std::fabs(push) * mass <= settings_.coulomb_friction + s.rubbing;
        s.half_accel = is_stationary ? 0 : accel_law(push, sign(push));
        s.length = endless;
        if (s.half_accel == 0) return;
    }
    s.blocked = 0;
    if (s.velocity * sign(s.half_accel) >= saturation_velocity_) s.half_accel = 0;
    s.length = law_length();
}

/// Ticks until the parabola reverses, reaches the saturation velocity or a marked velocity, or reaches its maximum
/// length.
std::int64_t LinearStage::law_length() const {
    std::int64_t length = settings_.viscous_friction > 0 ? viscous_piece : max_parabola;
    if (state_.half_accel == 0) return length;
    const Wide velocity = state_.velocity * direction(), change = 2 * Wide{state_.half_accel} * direction();
    const auto ends = [&](std::int64_t at) { length = std::min(length, std::max<std::int64_t>(at, 1)); };
    if (change < 0) ends(steps_up(velocity + change + 1, -change));  // the last tick before it moves back
    if (change > 0) ends(steps_up(saturation_velocity_ - velocity, change));
    for (int i = 0; i < mark_count_; ++i) {
        const Wide mark = marks_[static_cast<std::size_t>(i)];
        if (change > 0 && velocity <= mark) ends(steps_up(mark + 1 - velocity, change));
        if (change < 0 && velocity > mark) ends(steps_up(velocity - mark, -change));
    }
    return length;
}

void LinearStage::move_to(Instant now) {
    hand_over(now);
    state_.position = position_at(now);
    state_.velocity = velocity_at(now);
    state_.since = now;
}

/// Handles a change of voltage, load or position by hand.
void LinearStage::change(Instant now) {
    const double before = rate(now);
    move_to(now);
    begin_law();
    notify(before, now);
    reschedule();
}

void LinearStage::notify(double before, Instant now) {
    const double after = rate(now);
    if (after == state_.reported && before == after) return;
    state_.reported = after;
    listeners_.notify_rate(before, after, now);
}

// ---- instants of events

Instant LinearStage::law_end() const {
    return state_.length == endless ? never : state_.since + Duration{state_.length};
}

/// Approximate ticks for a distance `distance` (>= 0, in the direction of motion).
std::int64_t LinearStage::guess(Wide distance, std::int64_t last) const {
    const double d = static_cast<double>(distance), v = std::fabs(static_cast<double>(state_.velocity));
    const double a = static_cast<double>(state_.half_accel) * direction(), under = v * v + 4 * a * d;
    const double whole = v + (under > 0 ? std::sqrt(under) : 0);
    const double ticks = whole > 0 ? 2 * d / whole : static_cast<double>(last);
    return ticks < static_cast<double>(last) ? static_cast<std::int64_t>(ticks) : last;
}

/// The first instant of the present law at which the count is reached; never if it is not.
Instant LinearStage::reaches(std::int64_t there) const {
    const int way = direction();
    if (way == 0 || there > farthest_stage_counts || there < -farthest_stage_counts) return never;
    const Wide edge = fine_position(way > 0 ? there : there + 1);
    const auto passed = [&](std::int64_t ticks) {
        return way > 0 ? place_after(ticks) >= edge : place_after(ticks) < edge;
    };
    const std::int64_t last = state_.length;
    if (passed(0)) return state_.since;
    if (!passed(last)) return never;
    std::int64_t high = std::max<std::int64_t>(guess((edge - state_.position) * way, last), 1), low = 0, step = 1;
    if (passed(high)) {
        while (high - step > 0 && passed(high - step)) high -= step, step *= 2;
        low = std::max<std::int64_t>(high - step, 0);
    } else {
        low = high;
        while (low + step < last && !passed(low + step)) low += step, step *= 2;
        high = std::min(low + step, last);
    }
    while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        (passed(middle) ? high : low) = middle;
    }
    return state_.since + Duration{high};
}

Instant LinearStage::next(Instant now) const {
    const Range quiet = sim::Listeners::unwatched_range(state_.watches);
    if (quiet.left(count(now))) return now;
    Instant next = law_end();
    if (direction() > 0) next = std::min(next, reaches(std::min(quiet.above, end_plus_)));
    if (direction() < 0) next = std::min(next, reaches(std::max(quiet.below, end_minus_)));
    return std::max(next, now);
}

/// Stops at once at an end of travel.
bool LinearStage::meet_ends(Instant now) {
    const std::int64_t here = count(now);
    const int way = direction();
    const bool plus = way > 0 && here >= end_plus_, minus = way < 0 && here <= end_minus_;
    if (!plus && !minus) return false;
    const double before = rate(now);
    move_to(now);
    state_.position = fine_position(plus ? end_plus_ : end_minus_);
    state_.velocity = 0;
    state_.blocked = way;
    begin_law();
    kernel_.report(id_, static_cast<std::uint16_t>(AxisCondition::stage_end), way,
                   (plus ? end_plus_ : end_minus_) / places_per_nm);
    notify(before, now);
    return true;
}

void LinearStage::on_scheduled(Instant now) {
    if (!meet_ends(now) && now >= law_end()) {
        const double before = rate(now);
        move_to(now);
        begin_law();
        notify(before, now);
    }
    listeners_.notify_crossed(state_.watches, count(now), now);
    reschedule();
}

void LinearStage::on_wire(int, int level, Instant now) {
    state_.microvolts = level;
    change(now);
}

bool LinearStage::fault(std::string_view name, double value, Instant now) {
    if (!(std::fabs(value) <= 1e10)) return false;
    const bool factor = value >= 0 && value <= 1'000;
    if (name == "motor.stall") {
        state_.held = value != 0;
    } else if (name == "motor.push") {
        move_to(now);
        const std::int64_t there = std::clamp(count(now) + count_of_nm(value), end_minus_, end_plus_);
        state_.position += fine_position(there - count(now));
        state_.blocked = 0;
    } else if (name == "motor.friction" && factor) {
        state_.rubbing = value;
    } else if (name == "motor.load" && factor) {
        state_.load = value;
    } else {
        return false;
    }
    change(now);
    return true;
}

// ---- listeners

void LinearStage::watch(int slot, std::int64_t below, std::int64_t above) {
    state_.watches[static_cast<std::size_t>(slot)] = {below, above};
    reschedule();
}

int LinearStage::add_listener(sim::PositionListener& listener) {
    return listeners_.add(listener);
}

void LinearStage::watch_rate(double rate) {
    MOTIONRACK_ASSERT(mark_count_ < slots && rate >= 0);
    const double limit = static_cast<double>(saturation_velocity_);
    marks_[static_cast<std::size_t>(mark_count_++)] =
        static_cast<Wide>(std::min(rate / ticks_per_s * fine_per_count, limit));
}

void LinearStage::set_edge_listener(sim::EdgeListener* listener) {
    state_.handed = kernel_.now();
    edges_ = listener;
}

/// Delivers the edges since the last delivery, each computed separately.
void LinearStage::hand_over(Instant now) {
    const Instant from = std::max(state_.handed, state_.since);
    state_.handed = now;
    const int way = direction();
    if (!edges_ || way == 0) return;
    const std::int64_t last = count(now);
    for (std::int64_t here = count(from); here != last; here += way)
        row_.add(*edges_, std::max(reaches(here + way), from), here + way, way);
    row_.hand_over(*edges_);
}

}  // namespace motionrack::parts
