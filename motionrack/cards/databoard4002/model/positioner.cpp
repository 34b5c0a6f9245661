// Beginning, rate and end of a move, and lock, by the table of its states; the next position at which a pass has an
// effect.
#include <algorithm>
#include <cstdlib>
#include <motionrack/cards/databoard4002/model/positioner.hpp>

namespace motionrack::databoard4002 {

namespace {

/// Counts: from this difference on, a 24-bit difference changes its sign.
constexpr std::int64_t half_range = std::int64_t{1} << 23;

}  // namespace

struct Positioner::MoveSteps {
    enum class Event : std::uint8_t { go, lock, manual, quit, emergency, pass };

    static bool arrived(const Positioner& p, Instant now) {
        const TargetMove& move = p.state_.move;
        return signed24(move.target - p.counter_.value(now)) * move.direction <= 0;
    }
    static bool deviates(const Positioner& p, Instant now) {
        return p.state_.went != 0 && std::abs(p.deviation(now)) > p.state_.window;
    }
    static void begin(Positioner& p, Instant now) { p.begin_move(p.state_.requested, now); }
    static void raise_position(Positioner& p, Instant) { p.events_.raise(event::POSITION); }
    static void report_aborted(Positioner& p, Instant now) {
        p.conditions_.report(CardCondition::move_aborted, signed24(p.counter_.value(now)), p.state_.move.target);
    }

    using enum MoveState;
    static constexpr StateRow<Positioner, MoveState, Event, Instant> rows[] = {
        {standing, Event::go, moving, nullptr, begin},
        {standing, Event::lock, locked},
        {moving, Event::go, moving, nullptr, begin},
        {moving, Event::lock, going_back},
        {moving, Event::quit, standing},
        {moving, Event::emergency, standing, nullptr, report_aborted},
        {moving, Event::pass, standing, arrived, raise_position},
        {locked, Event::go, moving, nullptr, begin},
        {locked, Event::manual, standing},
        {locked, Event::quit, standing},
        {locked, Event::emergency, standing},
        {locked, Event::pass, going_back, deviates, begin},
        {going_back, Event::go, moving, nullptr, begin},
        {going_back, Event::manual, moving},
        {going_back, Event::quit, standing},
        {going_back, Event::emergency, standing, nullptr, report_aborted},
        {going_back, Event::pass, locked, arrived, raise_position},
    };
    static_assert(declared<rows_flaw(machine_named(map::machines, "move"), rows)>());

    static void run(Positioner& p, Event event, Instant now) {
        PositionerState& s = p.state_;
        const MoveState from = s.move.on ? (s.lock ? going_back : moving) : (s.lock ? locked : standing);
        step(rows, from, event, p, now, [&s](MoveState to) {
            s.move.on = to == moving || to == going_back;
            s.lock = to == locked || to == going_back;
        });
    }
};

Positioner::Positioner(PositionerState& state, const ConditionReporter& conditions, PassSchedule& passes,
                       const Pins& pins, PositionCounter& counter, EventRegister& events)
    : state_(state), conditions_(conditions), passes_(passes), pins_(pins), counter_(counter), events_(events) {}

// ---- commands

void Positioner::go(Instant now) {
    PositionerState& s = state_;
    const std::int64_t here = signed24(counter_.value(now));
    const std::int64_t target = s.relative ? here + s.number : s.target;
    if (target != signed24(target) || std::abs(target - here) > max_move_counts)
        return conditions_.report(CardCondition::move_refused, target, here);
    if (pins_.inputs() & stat::EMS) return conditions_.report(CardCondition::go_in_emergency, here);
    if (s.move.on) conditions_.report(CardCondition::during_move, 'G');
    if (s.sloped) report_flaw();
    events_.clear(event::POSITION);
    s.went = 1;
    s.requested = target;
    MoveSteps::run(*this, MoveSteps::Event::go, now);
}

void Positioner::report_flaw() {
    int interval = 0;
    const SlopeFlaw flaw = state_.table.flaw(interval);
    if (flaw != SlopeFlaw::none)
        conditions_.report(CardCondition::table_flawed, static_cast<std::int64_t>(flaw), interval);
}

void Positioner::begin_move(std::int64_t target, Instant now) {
    const std::int64_t u = counter_.value(now);
    TargetMove& move = state_.move;
    move.target = target;
    move.start = u;
    move.direction = target >= signed24(u) ? 1 : -1;
    move.sloped = state_.sloped;
    if (state_.sloped) move.table = state_.table;
}

void Positioner::home(Instant now) {
    zero(now);
    if (!state_.move.on) state_.requested = 0;
}

void Positioner::zero(Instant now) {
    state_.move.start -= counter_.value(now);
    counter_.zero(now);
}

void Positioner::lock() {
    MoveSteps::run(*this, MoveSteps::Event::lock, {});
}

void Positioner::select_manual() {
    state_.sloped = 0;
    MoveSteps::run(*this, MoveSteps::Event::manual, {});
}

void Positioner::quit(bool zeroes) {
    MoveSteps::run(*this, MoveSteps::Event::quit, {});
    if (zeroes) state_.target = state_.number = 0;
}

void Positioner::set_number(std::int64_t counts) {
    state_.number = counts;
    state_.relative = 1;
}

void Positioner::set_target(std::int64_t position) {
    state_.target = position;
    state_.relative = 0;
}

// ---- a pass

void Positioner::abort(Instant now) {
    MoveSteps::run(*this, MoveSteps::Event::emergency, now);
}

void Positioner::check_position(Instant now) {
    MoveSteps::run(*this, MoveSteps::Event::pass, now);
}

int Positioner::output_rate(Instant now) const {
    const TargetMove& move = state_.move;
    if (!move.on) return 0;
    if (!move.sloped) return state_.rate;
    const std::int64_t u = counter_.value(now);
    const std::int64_t to_go = signed24(move.target - u) * move.direction;
    const std::int64_t travelled = signed24(u - move.start) * move.direction;
    return std::min({state_.rate, move.table.decelerating(to_go).rate,
                     move.table.accelerating(std::max<std::int64_t>(0, travelled)).rate});
}

void Positioner::aim(Instant now) {
    const PositionerState& s = state_;
    const std::int64_t u = counter_.value(now);
    auto [below, above] = counter_.turn_range();
    if (s.move.on) {
        const TargetMove& move = s.move;
        const std::int64_t to_go = signed24(move.target - u) * move.direction;
        std::int64_t forward = to_go, back = half_range - to_go;
        if (move.sloped) {
            const std::int64_t travelled = signed24(u - move.start) * move.direction;
            const SlopeTable::Step slower = move.table.decelerating(to_go);
            const SlopeTable::Step faster = move.table.accelerating(std::max<std::int64_t>(0, travelled));
            forward = std::min({forward, to_go - slower.min + 1, faster.max + 1 - travelled, half_range - travelled});
            back = std::min({back, slower.max + 1 - to_go, travelled + half_range + 1});
            if (faster.min > 0) back = std::min(back, travelled - faster.min + 1);
        }
        above = std::min(above, u + (move.direction > 0 ? forward : back));
        below = std::max(below, u - (move.direction > 0 ? back : forward));
    } else if (s.lock && s.went) {
        const std::int64_t away = signed24(u - s.requested);
        if (std::abs(away) > s.window) passes_.request(now + Duration{1});
        above = std::min(above, u + s.window + 1 - away);
        below = std::max(below, u - (away + s.window + 1));
    }
    counter_.watch({std::min(below, u - 1), std::max(above, u + 1)});
}

}  // namespace motionrack::databoard4002
