// Closed form of the grating and its inverse; lines for listeners.
#include <cmath>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/linear_scale.hpp>
#include <type_traits>

namespace motionrack::parts {

namespace {

constexpr Wide max_ratio = Wide{1} << 50;                              // limit that keeps all products in range
constexpr std::int64_t farthest_scale_counts = std::int64_t{1} << 46;  // counts; watches beyond are never left
constexpr Wide billion = 1'000'000'000;

Wide floor_of(Wide a, Wide b) {
    const Wide q = a / b;
    return a % b < 0 ? q - 1 : q;
}

std::int64_t ceiling(Wide a, Wide b) {
    return static_cast<std::int64_t>(-floor_of(-a, b));
}

Wide common(Wide a, Wide b) {
    while (b != 0) {
        const Wide rest = a % b;
        a = b, b = rest;
    }
    return a;
}

std::int64_t nearest(double x) {
    return static_cast<std::int64_t>(std::floor(x + 0.5));
}

}  // namespace

Duration edge_spacing(const LinearScaleSettings& settings) {
    return Duration{std::max<std::int64_t>(1, static_cast<std::int64_t>(0.75e10 / settings.max_count_rate))};
}

LinearScale::LinearScale(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                         const LinearScaleSettings& s)
    : kernel_(kernel),
      position_(position),
      settings_(s),
      spacing_(edge_spacing(s)),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      slot_(position.add_listener(*this)) {
    static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");
    MOTIONRACK_ASSERT(s.pitch_pm >= 1'000 && s.pitch_pm <= 1'000'000'000);
    MOTIONRACK_ASSERT(s.interpolation >= 4 && s.interpolation <= 65'536 && s.interpolation % 4 == 0);
    MOTIONRACK_ASSERT(s.max_count_rate >= 1 && s.max_count_rate <= 1e9 && std::fabs(s.zero_offset_nm) <= 1e10);
    MOTIONRACK_ASSERT(s.places >= 1 && s.places <= 1'000'000'000 && s.places_nm >= 1 && s.places_nm <= 1'000'000'000);
    const auto position_of = [&s](double nm) {
        return nearest(nm * static_cast<double>(s.places) / static_cast<double>(s.places_nm));
    };
    state_.zero = position_of(s.zero_offset_nm);
    state_.direction = s.reversed ? -1 : 1;
    set_ratio(0);
    dirt_at_ = grating(position_of(s.dirt_position_nm));
    index_at_ = s.index_nm ? grating(position_of(*s.index_nm)) : 0;
    position.watch_rate(s.max_count_rate / counts_per_place());
    constexpr const char* names[] = {".a", ".b", ".z"};
    for (std::size_t i = 0; i < wires_.size(); ++i) {
        wires_[i] = kernel.add_wire(name + names[i], level_at(static_cast<int>(i), Instant{0}));
        kernel.drive_lazily(wires_[i], id_, static_cast<int>(i));
    }
}

// ---- the closed form

/// Sets the ratio of scale counts to position counts, for a grating that is longer by `ppm`.
void LinearScale::set_ratio(double ppm) {
    Wide num = Wide{settings_.places_nm} * 1'000 * settings_.interpolation,
         den = Wide{settings_.pitch_pm} * settings_.places;
    Wide shared = common(num, den);
    num /= shared, den /= shared;
    MOTIONRACK_ASSERT(num <= max_ratio && den <= max_ratio);
    if (ppm != 0) num *= billion, den *= billion + nearest(ppm * 1e3);
    shared = common(num, den);
    state_.num = num / shared, state_.den = den / shared;
}

std::int64_t LinearScale::grating(std::int64_t position) const {
    return static_cast<std::int64_t>(floor_of((Wide{position} - state_.zero) * state_.num, state_.den));
}

/// Within the dirt the count is constant.
std::int64_t LinearScale::visible(std::int64_t grating) const {
    if (grating <= dirt_at_) return grating;
    return std::max(dirt_at_, grating - state_.dirt);
}

std::int64_t LinearScale::counted(std::int64_t position) const {
    return state_.too_fast ? state_.frozen : state_.shift + state_.direction * visible(grating(position));
}

bool LinearScale::index(std::int64_t position) const {
    return settings_.index_nm && grating(position) == index_at_;
}

double LinearScale::rate(Instant t) const {
    if (state_.too_fast) return 0;
    const std::int64_t at = grating(position_.count(t));
    if (at > dirt_at_ && at < dirt_at_ + state_.dirt) return 0;
    return state_.direction * position_.rate(t) * counts_per_place();
}

/// Positions within which `counts` is not left.
Range LinearScale::place_range(const Range& counts) const {
    if (state_.too_fast) return {};
    Range seen = counts.moved(-state_.shift);
    if (state_.direction < 0) {
        seen = {seen.above == sim::unwatched_above ? sim::unwatched_below : -seen.above,
                seen.below == sim::unwatched_below ? sim::unwatched_above : -seen.below};
    }
    Range out;
    if (seen.below > -farthest_scale_counts && seen.below < farthest_scale_counts) {
        const std::int64_t at = seen.below < dirt_at_ ? seen.below : seen.below + state_.dirt;
        out.below = state_.zero + ceiling((Wide{at} + 1) * state_.den, state_.num) - 1;
    }
    if (seen.above > -farthest_scale_counts && seen.above < farthest_scale_counts) {
        const std::int64_t at = seen.above <= dirt_at_ ? seen.above : seen.above + state_.dirt;
        out.above = state_.zero + ceiling(Wide{at} * state_.den, state_.num);
    }
    return out;
}

// ---- listeners

int LinearScale::add_listener(sim::PositionListener& listener) {
    return listeners_.add(listener);
}

void LinearScale::watch(int slot, std::int64_t below, std::int64_t above) {
    state_.watches[static_cast<std::size_t>(slot)] = {below, above};
    if (!looking_) aim(kernel_.now());
}

/// Notifies listeners of left ranges and updates subscribed wires.
void LinearScale::update(Instant now) {
    looking_ = true;
    if (live()) show(now);
    listeners_.notify_crossed(state_.watches, count(now), now);
    looking_ = false;
    aim(now);
}

/// Watches the nearest position of an event, and schedules events that are due without one.
void LinearScale::aim(Instant now) {
    const std::int64_t here = count(now);
    Range places;
    Instant next = never;
    for (int i = 0; i < listeners_.size(); ++i) {
        const Range& watch = state_.watches[static_cast<std::size_t>(i)];
        if (watch.left(here)) next = now;
        places = places.within(place_range(watch));
    }
    if (live()) {
        places = places.within(place_range({here - 1, here + 1}));
        if (state_.shown != here) next = std::min(next, std::max(now, state_.free_at));
    }
    position_.watch(slot_, places.below, places.above);
    kernel_.schedule(id_, next);
}

void LinearScale::on_scheduled(Instant now) {
    update(now);
}

void LinearScale::rate_changed(double before, double rate, Instant now) {
    const bool was = state_.too_fast != 0, fast = std::fabs(rate) * counts_per_place() > settings_.max_count_rate;
    if (fast && !was) {
        state_.frozen = count(now);
        state_.too_fast = state_.counts_invalid = 1;
        const double counts = state_.direction * rate * counts_per_place();
        report(AxisCondition::scale_too_fast, nearest(counts), nearest(settings_.max_count_rate));
    } else if (was && !fast) {
        state_.too_fast = 0;
        const std::int64_t gone = count(now) - state_.frozen;
        state_.shift -= gone;
        state_.lost += gone < 0 ? -gone : gone;
        report(AxisCondition::scale_lost, gone, state_.lost);
    }
    const double factor = state_.direction * counts_per_place();
    listeners_.notify_rate(was ? 0 : before * factor, fast ? 0 : rate * factor, now);
    if (was != fast) update(now);
}

void LinearScale::report(AxisCondition code, std::int64_t a, std::int64_t b) {
    kernel_.report(id_, static_cast<std::uint16_t>(code), a, b);
}

// ---- lines

int LinearScale::level_at(int pin, Instant now) const {
    if (pin == 2) return index(position_.count(now));
    return sim::lines_of(live() ? state_.shown : count(now)) >> pin & 1;
}

void LinearScale::wanted_changed(int pin, bool wanted, Instant now) {
    if (!live()) state_.shown = count(now);
    state_.wanted = wanted ? state_.wanted | 1 << pin : state_.wanted & ~(1 << pin);
    aim(now);
}

void LinearScale::set_edge_listener(sim::EdgeListener* listener) {
    flush();
    if (!live()) state_.shown = count(kernel_.now());
    edges_ = listener;
    aim(kernel_.now());
}

/// Makes one edge towards the count if the electronics are ready for it.
void LinearScale::show(Instant now) {
    const std::int64_t here = count(now);
    if (state_.shown != here && now >= state_.free_at) {
        const int step = here > state_.shown ? 1 : -1;
        state_.shown += step;
        state_.free_at = now + spacing_;
        if (edges_) row_.add(*edges_, now, state_.shown, step);
    }
    put_out(now);
}

void LinearScale::put_out(Instant now) {
    for (std::size_t i = 0; i < wires_.size(); ++i)
        if (state_.wanted >> i & 1) kernel_.set_wire(wires_[i], level_at(static_cast<int>(i), now));
}

void LinearScale::flush() {
    if (edges_) row_.hand_over(*edges_);
}

// ---- faults

bool LinearScale::fault(std::string_view name, double value, Instant now) {
    const std::int64_t position = position_.count(now);
    const auto followed = [&] { return state_.direction * visible(grating(position)); };
    const std::int64_t before = followed();
    if (name == "scale.lose" && std::fabs(value) <= 1e12) {
        const std::int64_t counts = nearest(value);
        state_.shift -= counts;
        state_.frozen -= counts;
        state_.shown -= counts;
        state_.lost += counts < 0 ? -counts : counts;
        state_.counts_invalid = 1;
        report(AxisCondition::scale_lost, counts, state_.lost);
    } else if (name == "scale.dirt" && value >= 0 && value <= 1e9) {
        state_.dirt = nearest(value / nm_per_count());
        state_.shift += before - followed();
    } else if (name == "scale.swapped") {
        const int swapped = value != 0;
        if (swapped != state_.swapped) state_.direction = -state_.direction;
        state_.swapped = swapped;
        state_.shift += before - followed();
    } else if (name == "scale.expansion" && std::fabs(value) <= 1e5) {
        const std::int64_t here = grating(position);
        set_ratio(value);
        state_.zero = position - ceiling(Wide{here} * state_.den, state_.num);
    } else {
        return false;
    }
    update(now);
    return true;
}

}  // namespace motionrack::parts
