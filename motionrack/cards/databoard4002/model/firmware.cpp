// One pass of the firmware, and the instant of the next relevant pass.
#include <algorithm>
#include <cstdlib>
#include <motionrack/cards/databoard4002/model/card.hpp>

namespace motionrack::databoard4002 {

namespace {

/// Beyond it a 24-bit difference changes its sign.
constexpr std::int64_t half_range = std::int64_t{1} << 23;

}  // namespace

void Card::pass(Instant now) {
    Firmware& f = state_.firmware;
    passes_.clear();
    if (f.access_due <= now) work(now);
    if (events_.note_stops() & stat::EMS) {
        if (f.move.on) conditions_.report(CardCondition::move_aborted, signed24(counter_.value(now)), f.move.target);
        f.move.on = 0;
        f.lock = 0;
    }
    position(now);
    counter_.note_turn(now);
    f.out_rate = speed(now);
    put_out(now);
    update_interrupt();
    aim(now);
}

void Card::position(Instant now) {
    Firmware& f = state_.firmware;
    const std::int64_t u = counter_.value(now);
    if (f.move.on) {
        if (signed24(f.move.target - u) * f.move.direction > 0) return;
        f.move.on = 0;
        events_.raise(event::POSITION);
    } else if (f.lock && f.went && std::abs(signed24(u - f.requested)) > f.window) {
        begin_move(f.requested, now);
    }
}

int Card::speed(Instant now) const {
    const Firmware& f = state_.firmware;
    if (!f.move.on) return 0;
    if (!f.move.sloped) return f.rate;
    const std::int64_t u = counter_.value(now);
    const std::int64_t to_go = signed24(f.move.target - u) * f.move.direction;
    const std::int64_t travelled = signed24(u - f.move.start) * f.move.direction;
    return std::min({f.rate, f.move.table.decelerating(to_go).rate,
                     f.move.table.accelerating(std::max<std::int64_t>(0, travelled)).rate});
}

void Card::go(Instant now) {
    Firmware& f = state_.firmware;
    const std::int64_t here = signed24(counter_.value(now));
    const std::int64_t target = f.relative ? here + f.number : f.target;
    if (target != signed24(target) || std::abs(target - here) > max_move_counts)
        return conditions_.report(CardCondition::move_refused, target, here);
    if (pins_.inputs() & stat::EMS) return conditions_.report(CardCondition::go_in_emergency, here);
    if (f.move.on) conditions_.report(CardCondition::during_move, 'G');
    if (f.sloped) report_flaw();
    events_.clear(event::POSITION);
    f.lock = 0;
    f.went = 1;
    f.requested = target;
    begin_move(target, now);
}

void Card::report_flaw() {
    int interval = 0;
    const SlopeFlaw flaw = state_.firmware.table.flaw(interval);
    if (flaw != SlopeFlaw::none)
        conditions_.report(CardCondition::table_flawed, static_cast<std::int64_t>(flaw), interval);
}

void Card::begin_move(std::int64_t target, Instant now) {
    Firmware& f = state_.firmware;
    const std::int64_t u = counter_.value(now);
    f.move.target = target;
    f.move.start = u;
    f.move.direction = target >= signed24(u) ? 1 : -1;
    f.move.on = 1;
    f.move.sloped = f.sloped;
    if (f.sloped) f.move.table = f.table;
}

/// Watches the counter for the next position at which a pass has an effect, and requests the next pass that is due
/// anyway.
void Card::aim(Instant now) {
    const Firmware& f = state_.firmware;
    if (f.access != Work::none) passes_.request_at(f.access_due);
    const std::int64_t u = counter_.value(now);
    auto [below, above] = counter_.turn_range();
    if (f.move.on) {
        const TargetMove& move = f.move;
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
    } else if (f.lock && f.went) {
        const std::int64_t deviation = signed24(u - f.requested);
        if (std::abs(deviation) > f.window) passes_.request(now + Duration{1});
        above = std::min(above, u + f.window + 1 - deviation);
        below = std::max(below, u - (deviation + f.window + 1));
    }
    counter_.watch({std::min(below, u - 1), std::max(above, u + 1)});
}

}  // namespace motionrack::databoard4002
